/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpTaskLevel.h"

#include <visp3/core/vpException.h>
#include <visp3/manipulator/vpJointBounds.h>
#include <visp3/manipulator/vpRedundancySolver.h>

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
using vpTaskLevel::Basis;
using vpTaskLevel::Joints;
using vpTaskLevel::Rows;
using vpTaskLevel::Square;
using vpTaskLevel::Task;

constexpr double slack = 1e-9;     // rad/s: tolerance of bounds
constexpr double exactness = 1e-6; // relative error of the velocity that still counts as exact
constexpr double least = 1e-3;     // m/s: slower requests have the absolute tolerance of this one

void check(const vpArmModel &model, bool good, const char *field, double value, const char *range)
{
  if (!good) {
    throw vpException(vpException::badValue, "%s of the redundancy solver for %s is %g, must be %s", field,
                      model.label().c_str(), value, range);
  }
}

bool isPlausible(const vpTwist &twist)
{
  for (std::size_t i = 0; i < 6; ++i) {
    if (!(std::fabs(twist[i]) <= vpArmLargest)) {
      return false;
    }
  }
  return true;
}

bool usable(const vpArmModel &model, const vpArmData &data, const vpRedundancyInput &input)
{
  const int n = model.size();
  if (data.size != n || data.J.cols() != n || data.q.size() != n || input.previous.size() != n ||
      !vpIsPlausibleForArm(input.previous) || !vpIsPlausibleForArm(data.J) || !vpIsPlausibleForArm(data.q) ||
      !isPlausible(input.twist) || input.taskCount < 0 || input.taskCount > vpMaxArmTasks || input.indexCount < 0 ||
      input.indexCount > vpMaxArmIndices || !(input.selfMotionShare >= 0. && input.selfMotionShare <= 1.)) {
    return false;
  }
  for (int t = 0; t < input.taskCount; ++t) {
    const vpArmTask &task = input.tasks[static_cast<std::size_t>(t)];
    if (task.rows < 0 || task.rows > 6 || task.J.cols() != n || !vpIsPlausibleForArm(task.velocity.head(task.rows)) ||
        !vpIsPlausibleForArm(task.J.topRows(task.rows))) {
      return false;
    }
  }
  return true;
}

// Main task in weighted coordinates and scaled units, without the free axes.
struct MainTask {
  Rows B = Rows::Zero();
  Task r = Task::Zero();
  std::array<int, 6> row{}; // rows of the twist
  int rows = 0;
};

// Working data of a cycle.
struct Work {
  MainTask main;
  vpJointBounds bounds;
  unsigned int stopped = 0;       // joints held at a position limit
  Joints held = Joints::Zero();   // their velocities
  Joints motion = Joints::Zero(); // joint velocities for the tasks
  Basis basis;
  vpTaskLevel::Info info;
  bool escaping = false;
  bool noEscape = false;
};

bool isStopped(const Work &work, int i) { return (work.stopped >> i & 1U) != 0U; }
} // namespace

void vpRedundancySpec::validate(const vpArmModel &model) const
{
  const auto positive = [&model](const char *field, double value) {
    check(model, value >= 1e-12 && value <= vpArmLargest, field, value, "> 0 and finite (1e-12 to 1e9)");
  };
  const auto notNegative = [&model](const char *field, double value) {
    check(model, value >= 0. && value <= vpArmLargest, field, value, ">= 0 and finite (at most 1e9)");
  };
  positive("period", period);
  positive("taskLength", taskLength);
  positive("singularRegion", singularRegion);
  positive("damping", damping);
  positive("escapeDemand", escapeDemand);
  positive("softGradient", softGradient);
  notNegative("escapeSpeed", escapeSpeed);
  notNegative("minSelfMotion", minSelfMotion);
  notNegative("positionMargin", positionMargin);
  check(model, selfAcceleration >= 0. && selfAcceleration <= 1., "selfAcceleration", selfAcceleration, "in [0, 1]");
  check(model, selfMotion >= 0. && selfMotion <= 1., "selfMotion", selfMotion, "in [0, 1]");
  check(model, weights.size() == 0 || weights.size() == model.size(), "number of weights",
        static_cast<double>(weights.size()), "0 or the number of joints");
  for (int i = 0; i < weights.size(); ++i) {
    positive("weight", weights(i));
  }
  for (int i = 0; i < model.size(); ++i) {
    check(model, model.upper()(i) - model.lower()(i) > 2. * positionMargin, "positionMargin", positionMargin,
          "less than half the range of every joint");
  }
}

vpArmTask vpArmTask::pointVelocity(const vpArmModel &model, const vpArmData &data, int joint,
                                   const Eigen::Vector3d &velocity) noexcept
{
  vpArmTask task;
  task.rows = 3;
  task.J.setZero(6, model.size());
  task.J.topRows<3>() = vpArmKinematics::pointJacobian(model, data, joint);
  task.velocity.head<3>() = velocity;
  return task;
}

const char *vpRedundancyOutput::message() const noexcept
{
  switch (status) {
  case vpRedundancyStatus::Exact:
    return "The arm moves as wanted.";
  case vpRedundancyStatus::Accelerating:
    return "The arm is on the way to the wanted velocity, at an acceleration limit.";
  case vpRedundancyStatus::Scaled:
    return "The arm is slower than wanted because a joint is at its limit.";
  case vpRedundancyStatus::Damped:
    return "The arm is near a singularity and slower than wanted in the direction it is losing.";
  case vpRedundancyStatus::Escaping:
    return "The arm is near a singularity and leaves it by self-motion.";
  case vpRedundancyStatus::JointsStopped:
    return "Joints are held at their position limits and the others do not make up for all of it.";
  case vpRedundancyStatus::BlockedByLimits:
    return "The wanted motion is impossible because joints are at their position limits.";
  case vpRedundancyStatus::BlockedBySingularity:
    return "The wanted motion is impossible in this pose: the arm is singular and the motion leads out of its "
           "workspace.";
  case vpRedundancyStatus::InvalidInput:
    return "An input is not finite, beyond 1e9 or of a wrong size; the arm brakes.";
  }
  return "";
}

vpRedundancySolver::vpRedundancySolver(const vpArmModel &model, const vpRedundancySpec &spec)
  : m_model(&model), m_spec(spec)
{
  model.requireMotionLimits("the redundancy solver");
  spec.validate(model);
  m_scale.setZero();
  for (int i = 0; i < model.size(); ++i) {
    m_scale(i) = spec.weights.size() == 0 ? 1. : 1. / std::sqrt(spec.weights(i));
  }
}

namespace
{
MainTask mainTask(const vpArmModel &model, const vpArmData &data, const vpRedundancyInput &input,
                  const vpRedundancySpec &spec, const Joints &scale)
{
  MainTask main;
  const vpArmJacobian J = vpArmKinematics::geometric(model, data, input.frame);
  for (int k = 0; k < 6; ++k) {
    const std::size_t component = static_cast<std::size_t>(k);
    if (!input.free[component]) {
      const double unit = k < 3 ? 1. : spec.taskLength;
      for (int i = 0; i < data.size; ++i) {
        main.B(i, main.rows) = unit * J(k, i) * scale(i);
      }
      main.r(main.rows) = unit * input.twist[component];
      main.row[static_cast<std::size_t>(main.rows++)] = k;
    }
  }
  return main;
}

// Rows without the joints that are stopped.
template <class Matrix> Matrix moving(const Work &work, Matrix B, int n)
{
  for (int i = 0; i < n; ++i) {
    if (isStopped(work, i)) {
      B.row(i).setZero();
    }
  }
  return B;
}

// Joint motion out of a singularity, in weighted coordinates.
Joints escape(const vpArmModel &model, const vpArmData &data, const vpRedundancyInput &input,
              const vpRedundancySpec &spec, const Joints &scale, const Rows &B, const Joints &y, Work &work)
{
  const int n = data.size;
  double demand = 0.;
  Eigen::Matrix<double, 6, 1> lost = Eigen::Matrix<double, 6, 1>::Zero(); // lost direction in components of the twist
  Joints slope = Joints::Zero();
  for (int i = 0; i < work.main.rows; ++i) {
    const int k = work.main.row[static_cast<std::size_t>(i)];
    const double u = work.info.lost(i);
    demand += u * work.main.r(i);
    lost(k) = u * (k < 3 ? 1. : spec.taskLength);
    slope += u * B.col(i);
  }
  if (!(std::fabs(demand) > 1e-9)) {
    return Joints::Zero();
  }
  // Space that neither the regular directions nor stopped joints need.
  Basis regular;
  Joints mayMove = Joints::Zero();
  for (int i = 0; i < n; ++i) {
    mayMove(i) = isStopped(work, i) ? 0. : 1.;
  }
  for (int i = 0; i < work.basis.count; ++i) {
    const Joints v = work.basis.vectors.col(i);
    if (std::fabs(slope.dot(v)) < 0.5 * slope.norm() || slope.norm() < 1e-6) {
      regular.add(v);
    }
  }
  const Square H = vpSingularityEscape::curvature(model, data, input.frame, lost, scale);
  Joints z;
  if (!vpSingularityEscape::direction(vpSingularityEscape::room(regular, mayMove), H, demand > 0. ? 1. : -1., slope, y,
                                      z)) {
    work.noEscape = true;
    return Joints::Zero();
  }
  // A joint at its limit decides between the two signs if it can follow only one.
  const auto possible = [&](double sign) {
    for (int i = 0; i < n; ++i) {
      if ((sign * z(i) > 0.05 && work.bounds.upper(i) < 1e-6) ||
          (sign * z(i) < -0.05 && work.bounds.lower(i) > -1e-6)) {
        return false;
      }
    }
    return true;
  };
  if (!possible(1.) && possible(-1.)) {
    z = -z;
  }
  work.escaping = true;
  const double ratio = work.info.smallest / spec.singularRegion;
  const double speed = spec.escapeSpeed * (1. - ratio * ratio) * std::min(1., std::fabs(demand) / spec.escapeDemand);
  return speed / std::max(1e-9, scale.cwiseProduct(z).norm()) * z;
}

// All tasks in order, with the stopped joints at their velocities.
void solveTasks(const vpArmModel &model, const vpArmData &data, const vpRedundancyInput &input,
                const vpRedundancySpec &spec, const Joints &scale, Work &work)
{
  const int n = data.size;
  const vpTaskLevel::Options options{spec.singularRegion, spec.damping};
  work.basis.count = 0;
  work.escaping = work.noEscape = false;
  // Motion of the stopped joints; the other joints compensate its effect on the task.
  Task r = work.main.r;
  Joints held = Joints::Zero();
  for (int i = 0; i < n; ++i) {
    if (isStopped(work, i)) {
      held(i) = work.held(i) / scale(i);
    }
  }
  for (int i = 0; i < work.main.rows; ++i) {
    r(i) -= work.main.B.col(i).dot(held);
  }
  const Rows B = moving(work, work.main.B, n);
  Joints y = Joints::Zero();
  work.info = vpTaskLevel::solve(B, r, work.main.rows, options, work.basis, y);
  if (work.info.singular && spec.escapeSpeed > 0.) {
    y += escape(model, data, input, spec, scale, B, y, work);
  }
  for (int t = 0; t < input.taskCount; ++t) {
    const vpArmTask &task = input.tasks[static_cast<std::size_t>(t)];
    Rows lower = Rows::Zero();
    Task wanted = Task::Zero();
    for (int k = 0; k < task.rows; ++k) {
      wanted(k) = task.velocity(k);
      for (int i = 0; i < n; ++i) {
        lower(i, k) = task.J(k, i) * scale(i);
      }
      wanted(k) -= lower.col(k).dot(held);
    }
    static_cast<void>(vpTaskLevel::solve(moving(work, lower, n), wanted, task.rows, options, work.basis, y));
  }
  work.motion = scale.cwiseProduct(y + held);
}

// Stops the joint that exceeds its position bound most. False if none does.
bool stopWorst(const vpArmModel &model, Work &work)
{
  int worst = -1;
  double most = slack;
  for (int i = 0; i < model.size(); ++i) {
    const double v = work.motion(i);
    // A bound equal to the velocity limit is not a position bound.
    const double over = std::max(work.bounds.upper(i) < work.bounds.velocityLimit(i) ? v - work.bounds.upper(i) : 0.,
                                 work.bounds.lower(i) > -work.bounds.velocityLimit(i) ? work.bounds.lower(i) - v : 0.);
    if (!isStopped(work, i) && over > most) {
      most = over;
      worst = i;
    }
  }
  if (worst < 0) {
    return false;
  }
  work.stopped |= 1U << worst;
  work.held(worst) = work.motion(worst) > 0. ? work.bounds.upper(worst) : work.bounds.lower(worst);
  return true;
}

void toVector(const Joints &from, int n, vpJointVector &to) { to = from.head(n); }

// Largest factor up to 1 that brings the motion within its bounds.
double scaleWithin(const vpArmModel &model, const Work &work, const vpRedundancySpec &spec)
{
  double scale = 1.;
  for (int i = 0; i < model.size(); ++i) {
    const double v = std::fabs(work.motion(i)), bound = work.bounds.velocityLimit(i);
    scale = v > bound ? std::min(scale, bound / v) : scale;
  }
  if (spec.policy == vpLimitPolicy::ScaleMotion) {
    vpJointVector direction;
    toVector(scale * work.motion, model.size(), direction);
    scale *= work.bounds.together(model, direction, spec.period);
  }
  return scale;
}

// Moves the last self-motion towards the new one with a fraction of the accelerations; the task has the rest.
Joints slowlyChanged(const vpArmModel &model, const vpRedundancyInput &input, const vpRedundancySpec &spec,
                     const Joints &scale, const Work &work, const Joints &wanted)
{
  Joints before = Joints::Zero();
  for (int i = 0; i < model.size(); ++i) {
    before(i) = isStopped(work, i) ? 0. : input.previous(i) / scale(i);
  }
  before = scale.cwiseProduct(work.basis.free(before));
  double share = 1.;
  for (int i = 0; i < model.size(); ++i) {
    const double change = std::fabs(wanted(i) - before(i));
    share = std::min(share, spec.selfAcceleration * model.acceleration()(i) * spec.period / std::max(1e-12, change));
  }
  return before + share * (wanted - before);
}

// Self-motion in joint velocities: gradient, projection, k0, reduced to the bounds.
Joints selfMotion(const vpArmModel &model, const vpArmData &data, const vpRedundancyInput &input,
                  const vpRedundancySpec &spec, const Joints &scale, const Work &work)
{
  const int n = data.size;
  Joints gradient = Joints::Zero();
  vpIndexValue index;
  for (int k = 0; k < input.indexCount; ++k) {
    const vpSelfMotionIndex &wish = input.indices[static_cast<std::size_t>(k)];
    if (wish.gain > 0. && vpEvaluateIndex(model, data, wish, index)) {
      for (int i = 0; i < n; ++i) {
        gradient(i) += wish.gain * index.gradient(i);
      }
    }
  }
  for (int i = 0; i < n; ++i) {
    gradient(i) = isStopped(work, i) ? 0. : gradient(i) * scale(i);
  }
  Joints motion = scale.cwiseProduct(work.basis.free(gradient));
  const double length = motion.norm();
  if (!(length > 1e-12 * (1. + gradient.norm()))) {
    return Joints::Zero();
  }
  motion *= input.selfMotionShare * spec.selfMotion * std::max(work.motion.norm(), spec.minSelfMotion) /
            std::max(length, spec.softGradient);
  if (spec.selfAcceleration > 0.) {
    motion = slowlyChanged(model, input, spec, scale, work, motion);
  }
  double room = 1.;
  for (int i = 0; i < n; ++i) {
    const double bound = motion(i) > 0. ? work.bounds.upper(i) - work.motion(i) : work.motion(i) - work.bounds.lower(i);
    if (std::fabs(motion(i)) > std::max(0., bound)) {
      room = std::min(room, std::max(0., bound) / std::fabs(motion(i)));
    }
  }
  vpJointVector direction;
  toVector(room * motion, n, direction);
  return work.bounds.together(model, direction, spec.period) * room * motion;
}

// Comparison of the output with the request.
struct Likeness {
  bool exact = false;  // same velocity
  bool onPath = false; // same direction
};

vpRedundancyStatus judge(const Work &work, bool accelerating, bool clamped, const Likeness &likeness,
                         const vpRedundancyOutput &output)
{
  const bool wanted = work.main.r.norm() > 1e-9;
  const bool little = wanted && output.taskShare < 0.01 && !accelerating;
  const bool limits = work.stopped != 0U || output.scale < 1.;
  if (little && limits) {
    return vpRedundancyStatus::BlockedByLimits;
  }
  if (little && work.info.singular && !work.escaping) {
    return vpRedundancyStatus::BlockedBySingularity;
  }
  if ((work.stopped != 0U && !likeness.exact) || clamped) {
    return vpRedundancyStatus::JointsStopped;
  }
  if (work.escaping) {
    return vpRedundancyStatus::Escaping;
  }
  if (output.scale < 1. && likeness.onPath) {
    return vpRedundancyStatus::Scaled;
  }
  if (work.info.singular && !likeness.exact && !accelerating) {
    return vpRedundancyStatus::Damped;
  }
  return likeness.exact && !accelerating ? vpRedundancyStatus::Exact : vpRedundancyStatus::Accelerating;
}
} // namespace

// Without using data that may be invalid.
void vpRedundancySolver::brake(const vpRedundancyInput &input, vpRedundancyOutput &output) const noexcept
{
  const int n = m_model->size();
  output.selfMotion.setZero(n);
  output.velocity.setZero(n);
  for (int i = 0; i < n && input.previous.size() == n; ++i) {
    const double v = input.previous(i), step = m_spec.period * m_model->acceleration()(i);
    const double speed = std::min(std::fabs(v), m_model->velocity()(i));
    output.velocity(i) = std::fabs(v) <= vpArmLargest ? std::copysign(std::max(0., speed - step), v) : 0.;
  }
  output.scale = 1.;
  output.status = vpRedundancyStatus::InvalidInput;
}

void vpRedundancySolver::step(const vpArmData &data, const vpRedundancyInput &input,
                              vpRedundancyOutput &output) const noexcept
{
  const vpArmModel &model = *m_model;
  const int n = model.size();
  output.selfMotion.setZero(n);
  output.stoppedJoints = 0;
  output.taskShare = 0.;
  output.scale = 1.;
  output.smallestSingular = 0.;
  if (!usable(model, data, input)) {
    brake(input, output);
    return;
  }

  Work work;
  work.main = mainTask(model, data, input, m_spec, m_scale);
  work.bounds.update(model, data.q, input.previous, m_spec.period, m_spec.positionMargin);
  do {
    solveTasks(model, data, input, m_spec, m_scale, work);
  } while (m_spec.policy == vpLimitPolicy::StopJoints && stopWorst(model, work));
  output.scale = scaleWithin(model, work, m_spec);
  work.motion *= output.scale;
  Joints motion = work.motion;
  if (input.indexCount > 0 && input.selfMotionShare > 0. && m_spec.selfMotion > 0.) {
    const Joints self = selfMotion(model, data, input, m_spec, m_scale, work);
    toVector(self, n, output.selfMotion);
    motion += self;
  }
  if (!motion.allFinite()) { // the tasks have no finite solution
    brake(input, output);
    return;
  }

  // One factor on the change of velocity for all joints, so that a start from rest keeps its direction.
  double blend = 1.;
  for (int i = 0; i < n; ++i) {
    const double change = std::fabs(motion(i) - input.previous(i)), most = m_spec.period * model.acceleration()(i);
    blend = change > most ? std::min(blend, most / change) : blend;
  }
  bool clamped = false;
  output.velocity.resize(n);
  for (int i = 0; i < n; ++i) {
    const double wanted = input.previous(i) + blend * (motion(i) - input.previous(i));
    output.velocity(i) = work.bounds.clamp(i, wanted);
    clamped = clamped || std::fabs(output.velocity(i) - wanted) > 1e-6;
  }

  double done = 0., missed = 0.;
  for (int i = 0; i < work.main.rows; ++i) {
    double rate = 0.;
    for (int k = 0; k < n; ++k) {
      rate += work.main.B(k, i) / m_scale(k) * output.velocity(k);
    }
    done += rate * work.main.r(i);
    missed += (rate - work.main.r(i)) * (rate - work.main.r(i));
  }
  const double wanted = work.main.r.squaredNorm();
  output.taskShare = wanted > 1e-18 ? std::min(1., std::max(0., done / wanted)) : 1.;
  output.smallestSingular = work.info.smallest;
  output.stoppedJoints = work.stopped;
  const double tolerance = exactness * (std::sqrt(wanted) + least);
  const double along =
      wanted > 0. ? (wanted - done) * (wanted - done) / wanted : 0.; // fraction in the requested direction
  const Likeness likeness{std::sqrt(missed) <= tolerance, std::sqrt(std::max(0., missed - along)) <= tolerance};
  output.status = judge(work, blend < 1., clamped, likeness, output);
}

END_VISP_NAMESPACE
