/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpPlanSearch.h"
#include "vpServoCheck.h"
#include "vpServoLaws.h"

#include <visp3/feedforward/vpObjectAverage.h>
#include <visp3/trajectory/vpTwistShaper.h>

#include <algorithm>
#include <cmath>
#include <utility>

BEGIN_VISP_NAMESPACE

namespace
{
using Vector6 = vpTwistSpline::Vector6;
using vpServoPose::Pose;
constexpr double h = vpTwistSpline::knot;

// Of the limits, the part for the plan in ff-dtg; the rest is for the feedback, which has to overcome friction.
constexpr double planLinear = 0.94, planAngular = 0.65;
// A goal nearer to the planned one, m and rad, is noise. While the camera of dtg moves, it may lag behind its plan.
constexpr double zone = 0.002, zoneTurn = 0.006, lag = 0.1;
// A goal that was moved by more than so many of these is another one: the shortest motion to it, whatever was planned.
constexpr double jump = 5.;
// Least duration of a plan for a better measurement of the same goal, s.
constexpr double leastCorrection = 0.4;
// Nearer to the arrival than this, s, a plan is replaced only when it ends elsewhere.
constexpr double freeze = 0.1;
// dtg at rest: friction did not let it move; only this relative change of the error makes another try worthwhile.
constexpr double worthTrying = 0.25;
// Work of a cycle, evaluations of a twist: per second, and its limits.
constexpr double evaluationRate = 20000.;
constexpr int leastWork = 16, mostWork = 800;
// Part of the limits by which a command may differ from the law's and still count as executed.
constexpr double tolerance = 1e-6;
// Feedback: gains in units of lambda, the part of its acceleration with which it comes to rest.
constexpr double linearGain = 4., angularGain = 4., integralGain = 4., braking = 0.7;
// At the end of a plan the feedback rests while its error is below the first of these multiples of the zone, until it is beyond the other.
constexpr double settled = 1., unsettled = 1.5;

vpServoMotionLimits scaled(vpServoMotionLimits limits, double linear, double angular)
{
  for (double vpServoMotionLimits::*field :
       {&vpServoMotionLimits::linearVelocity, &vpServoMotionLimits::linearAcceleration,
        &vpServoMotionLimits::linearJerk}) {
    limits.*field *= linear;
  }
  for (double vpServoMotionLimits::*field :
       {&vpServoMotionLimits::angularVelocity, &vpServoMotionLimits::angularAcceleration,
        &vpServoMotionLimits::angularJerk}) {
    limits.*field *= angular;
  }
  return limits;
}

vpTwistShaperLimits shaperLimits(const vpServoMotionLimits &motion)
{
  vpTwistShaperLimits limits;
  limits.linearAcceleration = motion.linearAcceleration;
  limits.linearJerk = motion.linearJerk;
  limits.angularAcceleration = motion.angularAcceleration;
  limits.angularJerk = motion.angularJerk;
  return limits;
}

Vector6 parts(double linear, double angular)
{
  Vector6 x;
  x << linear, linear, linear, angular, angular, angular;
  return x;
}

bool isPlausible(const vpTwist &twist)
{
  return twist.linearNorm() <= vpTwistShaper::implausible && twist.angularNorm() <= vpTwistShaper::implausible;
}

// Length of the translation and angle between two poses of the camera.
struct Distance {
  double shift, turn;
  Distance(const Pose &a, const Pose &b) : shift((a.t - b.t).norm()), turn(vpSO3::log(a.R.transpose() * b.R).norm()) {}
};

/*
 * Direct trajectory generation in the visual loop (thesis 6.1.1, figure 6.1). The object is averaged in the odometry
 * frame; a vpPlanSearch finds a plan to the goal camera, from a knot of the commanded spline some cycles ahead; until a
 * verified plan is there, the motion goes on as verified before: along the old plan, which ends at rest, or braking.
 * Braking control points come from a vpTwistShaper, whose steps of a knot are within the limits by themselves.
 */
class vpServoPlanLaw : public vpServoLaw
{
public:
  vpServoPlanLaw(const char *id, const vpServoGains &gains, const vpServoMotionLimits &motion, bool feedback)
    : vpServoLaw(id, gains, angularGain), m_feedback(feedback), m_motionLimits(motion),
      m_share(feedback ? parts(planLinear, planAngular) : Vector6::Ones()),
      m_rest(scaled(motion, 1. - planLinear, 1. - planAngular)), m_search(scaled(motion, m_share[0], m_share[3])),
      m_brake(shaperLimits(scaled(motion, m_share[0], m_share[3]))), m_correction(shaperLimits(m_rest))
  {}

  bool plansMotion() const noexcept VP_OVERRIDE { return true; }
  void setMotionCheck(vpServoMotionCheck *check) noexcept VP_OVERRIDE { m_search.setCheck(check); }

  double timeToArrival() const noexcept VP_OVERRIDE
  {
    if (m_state != State::Following || m_goalMoved) {
      return std::numeric_limits<double>::quiet_NaN();
    }
    return std::max(m_plan.duration() - planTime(), 0.);
  }

  int plans() const noexcept VP_OVERRIDE { return m_plans; }

  void notifyExecuted(const vpTwist &commanded, const vpTwist &moved) noexcept VP_OVERRIDE
  {
    m_sent = vpTwistSpline::fromTwist(isPlausible(commanded) ? commanded : vpTwist());
    m_moved = isPlausible(moved) ? moved : vpTwist();
  }

protected:
  void goalChanged() VP_OVERRIDE { m_goalMoved = true; }

  void stateReset() VP_OVERRIDE
  {
    m_object.reset();
    m_knotPose = Pose();
    m_goalMoved = true;
    brakeFrom(m_spline.c1, m_spline.c2);
  }

  void elapsed(double dt) noexcept VP_OVERRIDE
  {
    m_object.move(m_moved, dt);
    Vector6 rate = m_period > 0. ? Vector6((m_sent - m_sentBefore) / m_period) : Vector6(Vector6::Zero());
    if (!(rate.head<3>().norm() <= (1. + tolerance) * m_motionLimits.linearAcceleration &&
          rate.tail<3>().norm() <= (1. + tolerance) * m_motionLimits.angularAcceleration)) {
      rate.setZero(); // a jump, such as that of an emergency stop, is no acceleration to go on with
    }
    m_sentBefore = m_sent;
    m_period = dt;
    const Vector6 off = m_sent - m_own;
    if (off.head<3>().norm() > tolerance * m_motionLimits.linearVelocity ||
        off.tail<3>().norm() > tolerance * m_motionLimits.angularVelocity) {
      restart(rate);
    }
    m_speed = m_own;
    m_own.setZero(); // until compute()
  }

  vpServoCommand compute(const vpServoMeasurement &measurement, double dt) noexcept VP_OVERRIDE
  {
    const bool image = m_object.see(measurement);
    const Pose goal = Pose{m_object.fRo(), m_object.fto()} * vpServoPose::pose(m_goal.cdMo).inverse();
    m_sinceSearch += dt;
    const int work = std::clamp(static_cast<int>(evaluationRate * dt), leastWork, mostWork);
    if (wantsPlan(goal, image)) {
      openSearch(goal, work, dt);
    }
    m_search.work(work);
    if (m_search.state() == vpPlanSearch::State::Failed) {
      refused();
    }
    const Pose before = reference();
    advance(dt);
    m_own = m_spline.at(m_phase);
    if (m_feedback) {
      m_own += correction(before, dt);
    }
    return {vpTwistSpline::toTwist(m_own), m_stuck ? vpServoStatus::Degenerate : vpServoStatus::Servoing};
  }

private:
  enum class State {
    Braking,  // or at rest without a plan
    Following // m_plan
  };

  Pose camera() const { return {m_object.fRc(), m_object.ftc()}; }

  // Where the commanded motion has led.
  Pose reference() const
  {
    return m_phase > 0. ? movedBy(m_knotPose, m_spline.mean(0., m_phase), m_phase * h) : m_knotPose;
  }
  static Pose movedBy(const Pose &pose, const Vector6 &twist, double dt)
  {
    return vpServoPose::moved(pose, twist.head<3>(), twist.tail<3>(), dt);
  }

  // Time on m_plan, s.
  double planTime() const { return (m_index - 2 - m_queued + m_phase) * h; }

  bool isAtRest() const
  {
    return m_queued == 0 && m_spline.isAtRest() &&
           (m_state == State::Braking || (m_index - 1) * h >= m_plan.duration());
  }

  // The next control point of the verified motion.
  Vector6 generate()
  {
    if (m_state == State::Braking) {
      return vpTwistSpline::fromTwist(m_brake.step(vpTwist(), h));
    }
    return m_plan.twist((m_index++ + 0.5) * h);
  }

  void brakeFrom(const Vector6 &before, const Vector6 &last)
  {
    m_brake.reset(vpTwistSpline::toTwist(last), vpTwistSpline::toTwist((last - before) / h));
    m_state = State::Braking;
    m_queued = 0;
    m_search.close();
  }

  // Something else was commanded than this law asked for: go on from there.
  void restart(const Vector6 &rate)
  {
    const Vector6 value = m_share.cwiseProduct(m_sent), slope = m_share.cwiseProduct(rate);
    m_spline.c0 = value - 0.5 * h * slope;
    m_spline.c1 = value + 0.5 * h * slope;
    brakeFrom(m_spline.c0, m_spline.c1);
    m_spline.c2 = generate();
    m_phase = 0.;
    m_knotPose = camera();
    m_correction.reset(vpTwistSpline::toTwist(m_sent - value), vpTwistSpline::toTwist(rate - slope));
    m_integral.setZero();
  }

  bool wantsPlan(const Pose &goal, bool image)
  {
    if (m_search.state() != vpPlanSearch::State::Idle) {
      return false;
    }
    const bool moved = std::exchange(m_goalMoved, false);
    m_fresh = true;
    if (m_state == State::Braking) {
      return true;
    }
    const double off = offBy(goal);
    m_fresh = moved && off > jump;
    if (m_gains.replanPeriod > 0.) {
      return m_fresh || (m_sinceSearch >= m_gains.replanPeriod && (off > 1. || timeToArrival() > freeze));
    }
    return (image || moved) && off > 1.;
  }

  // How far from the goal the plan would end, in units of what is noise.
  double offBy(const Pose &goal) const
  {
    if (m_feedback) {
      const Distance off(goal, m_planGoal);
      return std::max(off.shift / zone, off.turn / zoneTurn);
    }
    const Distance off(goal, camera() * reference().inverse() * m_planGoal);
    const double share = std::max(off.shift / (zone + lag * m_speed.head<3>().norm()),
                                  off.turn / (zoneTurn + lag * m_speed.tail<3>().norm()));
    return isAtRest() && std::abs(share - m_tried) < worthTrying * m_tried ? 0. : share;
  }

  void openSearch(const Pose &goal, int work, double dt)
  {
    m_sinceSearch = 0.;
    vpPlanSearch::Task task;
    task.gaze = !m_gazeFailed;
    task.origin = vpServoPose::translation(m_goal.cdMo);
    m_rested = isAtRest();
    if (!m_rested) {
      const double cycles = std::ceil(m_search.effort(m_expected) / static_cast<double>(work)) + 1.;
      const int delay = static_cast<int>(std::clamp(std::ceil(cycles * dt / h), 1., 1. * vpPlanSearch::maxDelay));
      while (m_queued < delay) {
        m_queue[static_cast<std::size_t>((m_first + m_queued) % vpPlanSearch::maxDelay)] = generate();
        ++m_queued;
      }
    }
    const double left = m_plan.duration() - (m_index - 1) * h; // when the new plan begins
    task.floor = m_fresh ? 0. : offBy(goal) > 1. ? std::max(left, leastCorrection) : std::max(left, 0.);
    vpTwistSpline spline = m_spline;
    Pose place = m_knotPose;
    task.way[0] = spline.c1;
    task.wayCount = 1;
    for (int i = 0; i <= m_queued; ++i) {
      place = movedBy(place, spline.mean(0., 1.), h);
      task.way[static_cast<std::size_t>(task.wayCount++)] = spline.c2;
      if (i < m_queued) {
        spline.push(queued(i));
      }
    }
    m_startPose = m_feedback ? place : camera() * reference().inverse() * place;
    task.before = spline.c1;
    task.last = spline.c2;
    task.isAtRest = m_rested;
    task.start = {goal.inverse() * m_startPose, 0.5 * (task.before + task.last), (task.last - task.before) / h};
    m_searchGoal = goal;
    m_search.open(task);
  }

  const Vector6 &queued(int i) const
  {
    return m_queue[static_cast<std::size_t>((m_first + i) % vpPlanSearch::maxDelay)];
  }

  // No plan was found. Towards another goal, braking is better than going on to the old one.
  void refused()
  {
    m_search.close();
    if (m_fresh && m_state == State::Following) {
      brakeFrom(m_spline.c1, m_spline.c2);
    }
    m_stuck = m_stuck || (m_rested && m_gazeFailed);
    m_gazeFailed = m_rested && !m_gazeFailed;
  }

  void adopt()
  {
    std::swap(m_plan, m_search.found());
    m_search.close();
    ++m_plans;
    m_state = State::Following;
    m_index = 1;
    m_knotPose = m_startPose;
    m_planGoal = m_searchGoal;
    m_expected = 1.2 * m_plan.duration();
    m_stuck = m_gazeFailed = false;
    if (m_rested) {
      const Distance way(m_startPose, m_planGoal);
      m_tried = std::max(way.shift / zone, way.turn / zoneTurn);
    }
  }

  void nextInterval()
  {
    m_knotPose = movedBy(m_knotPose, m_spline.mean(0., 1.), h);
    if (m_queued == 0) {
      const bool found = m_search.state() == vpPlanSearch::State::Found;
      if (found && (!m_feedback || isCorrectionSmall())) {
        adopt();
      }
      else if (m_search.state() != vpPlanSearch::State::Idle && !m_rested) { // too late for its start
        m_search.close();
        m_expected *= found ? 1. : 2.;
        m_goalMoved = m_goalMoved || (m_fresh && m_state == State::Following);
      }
    }
    if (m_queued > 0) {
      m_spline.push(queued(0));
      m_first = (m_first + 1) % vpPlanSearch::maxDelay;
      --m_queued;
    }
    else {
      m_spline.push(generate());
    }
  }

  void advance(double dt)
  {
    m_phase += dt / h;
    while (m_phase >= 1. - 1e-9) {
      nextInterval();
      m_phase = std::max(m_phase - 1., 0.);
    }
  }

  // Twist that leads the camera back to the commanded motion, which moved it from \e before to reference() in a cycle:
  // its middle is where a camera is that executes the last twist of each cycle for all of it.
  Vector6 correction(const Pose &before, double dt)
  {
    const Pose now = camera(), after = reference();
    const Eigen::Matrix3d toCamera = now.R.transpose();
    const Eigen::Vector3d shift = toCamera * (0.5 * (before.t + after.t) - now.t);
    const Eigen::Vector3d turn = 0.5 * (vpSO3::log(toCamera * before.R) + vpSO3::log(toCamera * after.R));
    const double off = std::max(shift.norm() / zone, turn.norm() / zoneTurn);
    m_settled = isAtRest() && off < (m_settled ? unsettled : settled);
    if (m_settled) { // stiction makes smaller corrections a limit cycle
      m_integral.setZero();
      return vpTwistSpline::fromTwist(m_correction.step(vpTwist(), dt));
    }
    const Eigen::Vector3d w = m_own.tail<3>();
    for (int i = 0; i < 3; ++i) {
      if (w[i] * m_integral[i] < 0. && std::abs(w[i]) > std::abs(m_integral[i])) {
        m_integral[i] = 0.; // friction has reversed
      }
    }
    const auto [linearRoom, angularRoom] = room();
    const Eigen::Vector3d v = wish(shift, linearGain * m_gains.lambda, m_rest.linearAcceleration);
    const Eigen::Vector3d turnWish = wish(turn, rotationGain(), m_rest.angularAcceleration) + m_integral;
    if (turnWish.norm() <= angularRoom || turn.dot(m_integral) < 0.) {
      m_integral += integralGain * m_gains.integral * dt * turn;
      m_integral *= std::min(1., m_gains.integralLimit / std::max(m_integral.norm(), 1e-300));
    }
    const vpTwist limited =
        vpServoPose::twist(v * std::min(1., linearRoom / std::max(v.norm(), 1e-300)),
                           turnWish * std::min(1., angularRoom / std::max(turnWish.norm(), 1e-300)));
    return vpTwistSpline::fromTwist(m_correction.step(limited, dt));
  }

  // In proportion to the error, but not faster than the camera can come to rest at its end.
  static Eigen::Vector3d wish(const Eigen::Vector3d &error, double gain, double acceleration)
  {
    const double length = error.norm();
    return error * std::min(gain, std::sqrt(2. * braking * acceleration / std::max(length, 1e-300)));
  }

  // Speeds that the rest of the plan leaves to the feedback. They only grow along a plan, and the shaper is never faster than
  // its fastest input; a new plan is followed once the feedback is within what every plan leaves.
  std::pair<double, double> room() const
  {
    if (m_state == State::Braking || m_search.state() != vpPlanSearch::State::Idle) {
      return {m_rest.linearVelocity, m_rest.angularVelocity};
    }
    const auto [linear, angular] = m_plan.speedsFrom(planTime());
    return {std::max(m_motionLimits.linearVelocity - linear, m_rest.linearVelocity),
            std::max(m_motionLimits.angularVelocity - angular, m_rest.angularVelocity)};
  }

  // Now and at the end of its acceleration.
  bool isCorrectionSmall() const
  {
    const Vector6 y = vpTwistSpline::fromTwist(m_correction.twist()),
                  a = vpTwistSpline::fromTwist(m_correction.acceleration());
    const auto within = [](const Eigen::Vector3d &v, const Eigen::Vector3d &slope, double jerk, double limit) {
      return std::max(v.norm(), (v + 0.5 * slope.norm() / jerk * slope).norm()) <= limit * (1. + 1e-9);
    };
    return within(y.head<3>(), a.head<3>(), m_rest.linearJerk, m_rest.linearVelocity) &&
           within(y.tail<3>(), a.tail<3>(), m_rest.angularJerk, m_rest.angularVelocity);
  }

  bool m_feedback;
  vpServoMotionLimits m_motionLimits;
  Vector6 m_share; // of the limits for the plan
  vpServoMotionLimits m_rest;
  vpObjectAverage m_object;
  vpPlanSearch m_search;

  // The commanded motion: interval, fraction of it, pose at its first knot, control points after it.
  vpTwistSpline m_spline;
  double m_phase = 0.;
  Pose m_knotPose;
  std::array<Vector6, vpPlanSearch::maxDelay> m_queue;
  int m_first = 0, m_queued = 0;
  State m_state = State::Braking;
  vpTwistShaper m_brake;
  vpGazePlan m_plan;
  int m_index = 1; // of the next control point of m_plan
  Pose m_planGoal;
  int m_plans = 0;

  // The search.
  Pose m_startPose, m_searchGoal;
  bool m_goalMoved = true, m_fresh = true, m_rested = true, m_gazeFailed = false, m_stuck = false;
  double m_sinceSearch = 0., m_expected = 3., m_tried = 0.;

  // Feedback and what was executed.
  vpTwistShaper m_correction;
  bool m_settled = false;
  Eigen::Vector3d m_integral = Eigen::Vector3d::Zero();
  Vector6 m_own = Vector6::Zero(), m_speed = m_own, m_sent = Vector6::Zero(), m_sentBefore = Vector6::Zero();
  vpTwist m_moved;
  double m_period = 0.;
};
} // namespace

std::unique_ptr<vpServoLaw> vpServoLaws::makeDtg(const vpServoGains &gains, const vpServoMotionLimits &motion)
{
  return std::make_unique<vpServoPlanLaw>("dtg", gains, motion, false);
}

std::unique_ptr<vpServoLaw> vpServoLaws::makeFeedforwardDtg(const vpServoGains &gains,
                                                            const vpServoMotionLimits &motion)
{
  return std::make_unique<vpServoPlanLaw>("ff-dtg", gains, motion, true);
}

END_VISP_NAMESPACE
