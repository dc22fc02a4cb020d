/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/avoidance/vpDirectTrajectoryAvoidance.h>

#include "vpFieldCheck.h"
#include "vpDetourSearch.h"

#include <visp3/avoidance/vpStopSupervisor.h>

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr vpFieldCheck fields("the direct trajectory avoidance");
using Eigen::Vector3d;
constexpr double offPlan = 1e-3;   // m: tolerance for the tool to be on its plan
constexpr double correction = 10.; // 1/s, gain on second-order errors of the steps: low, to keep the bounds
constexpr double reserve = 0.995;  // fraction of the acceleration bound, for errors of the Jacobian
constexpr double atGoal = 1e-4;    // m
constexpr double atRest = 1e-3;    // m/s
constexpr double ending = 0.5;     // s: the last part of a motion is not changed, to keep its smooth end
constexpr double quicker = 0.9;    // of the rest of a detour: faster direct paths replace it

//! Largest fraction of a change for which |present + part * change| keeps a bound; the best one if none does. 0..1.
double partWithin(const Vector3d &present, const Vector3d &change, double bound)
{
  const double a = change.squaredNorm(), b = present.dot(change), c = present.squaredNorm() - bound * bound;
  if ((present + change).norm() <= bound || a == 0.) {
    return 1.;
  }
  const double part = c > 0. ? -b / a : (-b + std::sqrt(std::max(0., b * b - a * c))) / a;
  return std::clamp(part, 0., 1.);
}
} // namespace

void vpDirectTrajectoryAvoidanceSpec::validate() const
{
  common.validate();
  fields.notNegative("clearance", clearance, "m");
  fields.notNegative("toolClearance", toolClearance, "m");
  fields.in("sides", sides, {2, 32});
  fields.in("forecasts", forecasts, {1});
}

class vpDirectTrajectoryAvoidance::Impl
{
public:
  Impl(const vpCollisionScene &s, const vpDirectTrajectoryAvoidanceSpec &p)
    : scene(&s), spec(checked(p)), motion(s.arm(), motionSpec(p)), search(s, p, motionSpec(p)),
      path(p.common.maxVelocity, p.common.maxAcceleration), plan(vpToolPath::room()), supervisor(s, supervisorSpec(p))
  {}

  bool begin(const vpJointVector &q, const vpAvoidanceGoal &wish)
  {
    scene->place(q, data);
    started = data.placed && wish.fits(scene->arm());
    if (!started) {
      return false;
    }
    goal = wished = wish;
    configuration = q;
    velocity = vpJointVector::Zero(q.size());
    orientation = data.arm.tool.R;
    tool = vpToolState();
    tool.x = data.arm.tool.p;
    toolVelocity.setZero();
    task = vpToolTask();
    task.goal = tool.x;
    toGoal = false;
    rebase = true;
    status = vpAvoidanceStatus::Waiting;
    supervisor.reset();
    return true;
  }

  void look()
  {
    const bool moved =
        (wished.position - goal.position).norm() > 1e-9 || (wished.velocity - goal.velocity).norm() > 1e-9;
    goal = wished;
    const vpDetourStart here{tool, configuration, velocity, posture(), orientation};
    if (!moved && following()) {
      const vpForecast rest = search.foresee(here, plan, clock, spec.common.margin + 0.5 * spec.clearance);
      if (rest.status == vpForecastStatus::Free) {
        if (toGoal && task.viaCount == 0) {
          return;
        }
        if (!toGoal || plan.duration() - clock > ending) {
          shorten(here);
        }
        return;
      }
    }
    else if (!moved && toGoal && isArrived()) {
      return;
    }
    const vpDetourResult found = search.search(here, goal.position, goal.velocity);
    pair = found.direct.status == vpForecastStatus::Conflict ? found.direct.pair : vpClearance();
    if (found.task) {
      take(*found.task);
      return;
    }
    status = whyNot(here, found.direct.status);
    brake();
  }

  void step(const vpJointVector &q, vpAvoidanceOutput &output) noexcept
  {
    const double period = spec.common.period;
    if (rebase) {
      rebase = false;
      clock = 0.;
      if (!path.plan(tool, task, plan) && !path.stop(tool, plan)) {
        vpToolPath::hold(tool.x, plan);
      }
    }
    const Vector3d here = vpToolPath::at(plan, clock).x;
    clock = std::min(clock + period, plan.duration());
    const vpToolState next = vpToolPath::at(plan, clock);
    scene->place(q, data);
    const Vector3d x = data.arm.tool.p;
    scene->place(q + 0.5 * period * velocity, data); // the Jacobian half a period later is that of the mean
    scene->near(data, motion.spec().repelRange, near);
    const Vector3d wish = (next.x - here) / period + correction * (here - x);
    motion.step(data, near, wish, leaning, orientation, velocity, solved, !stands());
    keepAcceleration();
    supervisor.step(q, solved.velocity, supervised);
    finish(q, next, output);
  }

  //! The arm's state is unknown: follows the last proven stop.
  void stop(const vpJointVector &q, vpAvoidanceOutput &output) noexcept
  {
    supervisor.step(q, velocity, supervised);
    output.velocity = velocity = supervised.velocity;
    output.stopping = true;
    configuration += spec.common.period * velocity;
    vpArmKinematics::forward(scene->arm(), configuration, data.arm);
    leave(data.arm.tool.p);
  }

  [[nodiscard]] bool isArrived() const noexcept
  {
    return (tool.x - goal.position).norm() < atGoal && tool.v.norm() < atRest;
  }

  const vpCollisionScene *scene;
  vpDirectTrajectoryAvoidanceSpec spec;
  vpAvoidanceGoal goal, wished;
  bool started = false;
  vpJointVector configuration, velocity; // commanded, at the end of the last period
  vpAvoidanceStatus status = vpAvoidanceStatus::InvalidInput;
  vpToolTask task;
  bool toGoal = false; // the task ends at the goal, not at a place beside an obstacle or a stop
  vpCollisionData data;

private:
  static const vpDirectTrajectoryAvoidanceSpec &checked(const vpDirectTrajectoryAvoidanceSpec &spec)
  {
    spec.validate();
    return spec;
  }
  static vpToolMotionSpec motionSpec(const vpDirectTrajectoryAvoidanceSpec &spec)
  {
    vpToolMotionSpec result;
    result.period = spec.common.period;
    result.keepOrientation = spec.keepOrientation;
    return result;
  }
  static vpStopSupervisorSpec supervisorSpec(const vpDirectTrajectoryAvoidanceSpec &spec)
  {
    vpStopSupervisorSpec result;
    result.period = spec.common.period;
    result.margin = spec.common.margin;
    return result;
  }

  //! Moving on a motion chosen by look().
  [[nodiscard]] bool following() const noexcept { return !stopped && !rebase && clock < plan.duration(); }
  [[nodiscard]] vpJointVector posture() const { return spec.usePosture ? goal.q : vpJointVector(); }

  //! At the goal or a waiting position: the whole arm stands.
  [[nodiscard]] bool stands() const noexcept { return tool.v.norm() < atRest && (stopped || (toGoal && isArrived())); }

  vpAvoidanceStatus whyNot(const vpDetourStart &here, vpForecastStatus direct)
  {
    scene->place(here.q, data);
    const vpClearance now = scene->clearance(data, spec.common.margin);
    if (now.distance < 0.) {
      pair = now;
      return vpAvoidanceStatus::StartInCollision;
    }
    if (direct != vpForecastStatus::Conflict) {
      return vpAvoidanceStatus::Unreachable;
    }
    const std::optional<vpJointVector> end = search.endOf(here, goal.position);
    if (!end) {
      return vpAvoidanceStatus::Waiting;
    }
    scene->place(*end, data);
    const vpClearance there = scene->clearance(data, spec.common.margin);
    if (there.kind == vpCollisionKind::None) {
      return vpAvoidanceStatus::Waiting;
    }
    pair = there;
    return vpAvoidanceStatus::GoalInCollision;
  }

  void take(const vpToolTask &wish)
  {
    task = wish;
    toGoal = (task.goal - goal.position).norm() < 1e-9;
    stopped = false;
    rebase = true;
    leaning = posture();
    status = toGoal && task.viaCount == 0 ? vpAvoidanceStatus::Moving : vpAvoidanceStatus::Detouring;
  }

  //! On a detour: checks whether the direct path has become free.
  void shorten(const vpDetourStart &here)
  {
    vpToolTask direct;
    direct.goal = goal.position;
    direct.goalVelocity = goal.velocity;
    const vpForecast ahead = search.foresee(here, direct, spec.common.margin + spec.clearance);
    const bool better = !toGoal || ahead.time < quicker * (plan.duration() - clock);
    if (ahead.status == vpForecastStatus::Free && better) {
      take(direct);
    }
  }

  void brake()
  {
    if (!stopped || tool.v.norm() > atRest) {
      vpTrajectoryPlan stop = vpToolPath::room();
      task = vpToolTask();
      task.goal = path.stop(tool, stop) ? vpToolPath::at(stop, stop.duration()).x : tool.x;
      rebase = true;
    }
    stopped = true;
    toGoal = false;
  }

  //! Joints at their limits may bend the tool path, but only within its acceleration bound.
  void keepAcceleration() noexcept
  {
    const auto J = data.arm.J.topRows<3>();
    const Vector3d present = J * velocity - toolVelocity, change = J * (solved.velocity - velocity);
    const double bound = reserve * spec.common.maxAcceleration * spec.common.period;
    solved.velocity = velocity + partWithin(present, change, bound) * (solved.velocity - velocity);
  }

  //! Stores the command and its result, and checks whether the plan is still valid.
  void finish(const vpJointVector &q, const vpToolState &next, vpAvoidanceOutput &output) noexcept
  {
    const double period = spec.common.period;
    output.velocity = supervised.velocity;
    output.wanted = next.x;
    configuration = q + period * supervised.velocity;
    vpArmKinematics::forward(scene->arm(), configuration, data.arm);
    const Vector3d reached = data.arm.tool.p;
    vpArmKinematics::forward(scene->arm(), q, data.arm);
    toolVelocity = (reached - data.arm.tool.p) / period;
    velocity = supervised.velocity;
    const bool passed = supervised.status == vpSupervision::Passed || supervised.status == vpSupervision::Limited;
    // The joints may still be moving where the tool is not, towards the goal's posture and away from limits.
    const bool rests = velocity.norm() < vpToolMotion::jointRest;
    if (passed && (reached - next.x).norm() < offPlan) {
      tool = next;
    }
    else {
      leave(reached);
    }
    output.stopping = supervised.status == vpSupervision::Stopping || supervised.status == vpSupervision::Slowed ||
                      supervised.status == vpSupervision::Unsafe;
    output.pair = passed ? pair : supervised.pair;
    output.status = supervised.status == vpSupervision::Unsafe         ? vpAvoidanceStatus::Unsafe
                    : supervised.status == vpSupervision::InvalidInput ? vpAvoidanceStatus::InvalidInput
                    : toGoal && isArrived() && rests                   ? vpAvoidanceStatus::Arrived
                    : passed || stopped                                ? status
                                                                       : vpAvoidanceStatus::Slowed;
  }

  //! The next motion starts from the allowed state.
  void leave(const Vector3d &reached) noexcept
  {
    const Vector3d before = tool.v;
    vpToolState now;
    now.x = reached;
    now.v = toolVelocity;
    now.a = (now.v - before) / spec.common.period;
    const double fast = spec.common.maxVelocity / std::max(1e-9, now.v.norm());
    const double hard = spec.common.maxAcceleration / std::max(1e-9, now.a.norm());
    now.v *= std::min(1., fast);
    now.a *= std::min(1., hard);
    tool = now;
    dropPassedVias();
    rebase = true;
  }

  void dropPassedVias() noexcept
  {
    while (task.viaCount > 0 && plan.vias() >= task.viaCount && clock >= plan.viaTime(plan.vias() - task.viaCount)) {
      for (int k = 1; k < task.viaCount; ++k) {
        task.vias[static_cast<std::size_t>(k - 1)] = task.vias[static_cast<std::size_t>(k)];
      }
      --task.viaCount;
    }
  }

  vpToolMotion motion;
  vpDetourSearch search;
  vpToolPath path;
  vpTrajectoryPlan plan;
  vpStopSupervisor supervisor;
  vpToolState tool;                         // commanded, at the end of the last period
  Vector3d toolVelocity = Vector3d::Zero(); // in the last period, m/s
  Eigen::Matrix3d orientation = Eigen::Matrix3d::Identity();
  vpJointVector leaning;
  double clock = 0.;
  bool rebase = true;  // the next step plans from #tool
  bool stopped = true; // braking or standing, because no motion is free
  vpClearance pair;
  vpNearPairs near;
  vpRedundancyOutput solved;
  vpSupervisedVelocity supervised;
};

vpDirectTrajectoryAvoidance::vpDirectTrajectoryAvoidance(const vpCollisionScene &scene,
                                                         const vpDirectTrajectoryAvoidanceSpec &spec)
  : m_impl(std::make_unique<Impl>(scene, spec))
{}
vpDirectTrajectoryAvoidance::~vpDirectTrajectoryAvoidance() = default;

vpAvoidanceStatus vpDirectTrajectoryAvoidance::start(const vpJointVector &q, const vpAvoidanceGoal &goal)
{
  if (!m_impl->begin(q, goal)) {
    return vpAvoidanceStatus::InvalidInput;
  }
  m_impl->look();
  return m_impl->status;
}

void vpDirectTrajectoryAvoidance::setGoal(const vpAvoidanceGoal &goal) noexcept
{
  if (m_impl->started && goal.fits(m_impl->scene->arm())) {
    m_impl->wished = goal;
  }
}

void vpDirectTrajectoryAvoidance::look()
{
  if (m_impl->started) {
    m_impl->look();
  }
}

void vpDirectTrajectoryAvoidance::step(const vpJointVector &q, vpAvoidanceOutput &output) noexcept
{
  output = vpAvoidanceOutput();
  output.velocity = vpJointVector::Zero(m_impl->scene->arm().size());
  if (m_impl->started) {
    m_impl->scene->place(q, m_impl->data);
    m_impl->data.placed ? m_impl->step(q, output) : m_impl->stop(q, output);
  }
}

std::vector<Vector3d> vpDirectTrajectoryAvoidance::detour() const
{
  const vpToolTask &task = m_impl->task;
  std::vector<Vector3d> places(task.vias.begin(), task.vias.begin() + task.viaCount);
  if (m_impl->started && !m_impl->toGoal) {
    places.push_back(task.goal);
  }
  return places;
}

END_VISP_NAMESPACE
