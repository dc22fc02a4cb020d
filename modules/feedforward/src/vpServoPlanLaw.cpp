/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpFeedforwardErrors.h"
#include "vpPlanFeedback.h"
#include "vpPlanMotion.h"
#include "vpServoCheck.h"
#include "vpServoLaws.h"

#include <visp3/feedforward/vpObjectAverage.h>

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
// While the camera of dtg moves, it may lag behind its plan, s.
constexpr double lag = 0.1;
// Least factor on the speeds.
constexpr double slowest = 0.01;
// Multiple of the noise: a goal that moved by more is a new one, and the old plan does not delay the motion to it.
constexpr double jump = 5.;
// Least duration of a plan for a better measurement of the same goal, s.
constexpr double leastCorrection = 0.4;
// A plan made for a lower factor on the speeds is replaced from this ratio on.
constexpr double quicker = 1.25;
// Nearer to the arrival than this, s, a plan is replaced only when it ends elsewhere.
constexpr double freeze = 0.1;
// dtg at rest: friction did not let it move; only this relative change of the error makes another try worthwhile.
constexpr double worthTrying = 0.25;
// Work of a cycle, evaluations of a twist: per second, and its limits.
constexpr double evaluationRate = 20000.;
constexpr int leastWork = 16, mostWork = 800;
// Part of the limits by which motions may exceed them.
constexpr double tolerance = 1e-6;
// Parts of the speed by which a command may differ from the law's and still count as executed: single precision, and frames.
constexpr double singlePrecision = 1.2e-7, rounding = 1e-12;

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
 * verified plan is there, vpPlanMotion goes on as verified before. In ff-dtg vpPlanFeedback keeps the camera on the plan.
 */
class vpServoPlanLaw : public vpServoLaw
{
public:
  vpServoPlanLaw(const char *id, const vpServoGains &gains, const vpServoMotionLimits &motion, bool feedback)
    : vpServoLaw(id, gains, vpPlanFeedback::angularGain), m_hasFeedback(feedback), m_motionLimits(motion),
      m_limits(motion), m_share(feedback ? parts(planLinear, planAngular) : Vector6::Ones()), m_search(ofPlan(motion)),
      m_motion(ofPlan(motion)), m_feedback(gains, ofFeedback(motion))
  {}

  bool plansMotion() const noexcept VP_OVERRIDE { return true; }
  void setMotionCheck(vpServoMotionCheck *check) noexcept VP_OVERRIDE { m_search.setCheck(check); }
  void setSpeedFactor(double factor) noexcept VP_OVERRIDE
  {
    m_wantedFactor = factor >= slowest ? std::min(factor, 1.) : slowest;
  }

  double timeToArrival() const noexcept VP_OVERRIDE
  {
    if (!m_motion.isFollowing() || m_goalMoved) {
      return std::numeric_limits<double>::quiet_NaN();
    }
    return std::max(m_motion.plan().duration() - m_motion.planTime(), 0.);
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
    m_goalMoved = m_isDisturbed = true;
    m_search.close();
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
    const bool isPassedOver = !std::exchange(m_isAsked, false) && !(m_motion.isAtRest() && m_sent.isZero(0.));
    const bool isOther = m_isDisturbed || isPassedOver || !isExecuted(dt);
    if (isOther) {
      restart(rate);
    }
    m_wasOther = isOther;
    m_speed = m_own;
    m_own.setZero(); // until compute()
  }

  vpServoCommand compute(const vpServoMeasurement &measurement, double dt) noexcept VP_OVERRIDE
  {
    m_isAsked = true;
    const bool image = m_object.see(measurement);
    const Pose goal = Pose{m_object.fRo(), m_object.fto()} * vpServoPose::pose(m_goal.cdMo).inverse();
    m_sinceSearch += dt;
    const int work = std::clamp(static_cast<int>(evaluationRate * dt), leastWork, mostWork);
    changePace();
    stayAt(goal);
    m_isWanted = m_isWanted || wantsPlan(goal, image);
    if (m_isWanted && (!m_hasFeedback || m_feedback.isSmall())) {
      openSearch(goal, work, dt);
    }
    m_search.work(work);
    if (m_search.state() == vpPlanSearch::State::Failed) {
      refused();
    }
    const Pose before = m_motion.reference();
    advance(dt);
    m_own = m_motion.twist();
    if (m_hasFeedback) {
      m_own += correction(before, dt);
    }
    return {vpTwistSpline::toTwist(m_own), m_stuck ? vpServoStatus::Degenerate : vpServoStatus::Servoing};
  }

private:
  vpServoMotionLimits ofPlan(const vpServoMotionLimits &all) const { return all.scaled(m_share[0], m_share[3]); }
  static vpServoMotionLimits ofFeedback(const vpServoMotionLimits &all)
  {
    return all.scaled(1. - planLinear, 1. - planAngular);
  }

  Pose camera() const { return {m_object.fRc(), m_object.ftc()}; }

  /*
   * The last command was the law's own. What else brakes the robot may take nearly the same way, and the step from its twist to the
   * law's is one of acceleration and jerk: after another command the difference must be small for these, too, in a cycle.
   */
  bool isExecuted(double dt) const
  {
    const auto most = [&](double speed, double acceleration, double jerk) {
      const double step = std::min(acceleration * dt, jerk * dt * dt);
      return m_wasOther ? std::clamp(tolerance * step, rounding * speed, singlePrecision * speed)
                        : singlePrecision * speed;
    };
    const vpServoMotionLimits &limits = m_motionLimits;
    const Vector6 off = m_sent - m_own;
    return off.head<3>().norm() <= most(limits.linearVelocity, limits.linearAcceleration, limits.linearJerk) &&
           off.tail<3>().norm() <= most(limits.angularVelocity, limits.angularAcceleration, limits.angularJerk);
  }

  // The acceleration, at most that from which braking does not exceed the speed.
  Vector6 withinSpeed(const Vector6 &rate) const
  {
    Vector6 within = rate;
    const auto limit = [&](int part, double speed, double jerk) {
      const Eigen::Vector3d v = m_sent.segment<3>(part), a = rate.segment<3>(part);
      const double left = std::max(speed - v.norm(), 0.); // = h / 2 most + most^2 / (2 jerk)
      const double most = jerk * (std::sqrt(0.25 * h * h + 2. * left / jerk) - 0.5 * h);
      if (v.dot(a) > 0. && a.norm() > most) {
        within.segment<3>(part) *= most / a.norm();
      }
    };
    limit(0, m_motionLimits.linearVelocity, m_motionLimits.linearJerk);
    limit(3, m_motionLimits.angularVelocity, m_motionLimits.angularJerk);
    return within;
  }

  // Something else was commanded than this law asked for: go on from there.
  void restart(const Vector6 &moving)
  {
    const Vector6 rate = withinSpeed(moving);
    const Vector6 value = m_share.cwiseProduct(m_sent), slope = m_share.cwiseProduct(rate);
    m_search.close();
    m_motion.restart(value, slope, camera());
    m_feedback.reset(m_sent - value, rate - slope);
    m_isDisturbed = false;
  }

  void brake()
  {
    m_search.close();
    m_motion.brake();
  }

  // The limits for another factor on the speeds.
  void changePace()
  {
    if (m_search.state() != vpPlanSearch::State::Idle || m_wantedFactor == m_factor) {
      return;
    }
    m_factor = m_wantedFactor;
    m_limits = m_motionLimits.slowed(m_factor);
    m_search.setLimits(ofPlan(m_limits));
    m_feedback.setRest(ofFeedback(m_limits));
  }

  // The speeds that are left of the plan exceed those of a lower factor.
  bool isTooFast() const
  {
    const vpTwistNorms left = m_motion.plan().normsFrom(m_motion.planTime());
    return m_motion.isFollowing() && m_factor < m_planFactor &&
           (left[0] > m_limits.linearVelocity || left[3] > m_limits.angularVelocity);
  }

  // A higher factor makes another plan worthwhile.
  bool isTooSlow() const { return m_factor > quicker * m_planFactor && timeToArrival() > leastCorrection; }

  // After the plan the feedback follows the mean of the measurements, and a goal that is moved a little.
  void stayAt(const Pose &goal)
  {
    if (m_hasFeedback && m_motion.isFollowing() && m_motion.isAtRest() &&
        m_search.state() == vpPlanSearch::State::Idle && !m_isWanted && offBy(goal) <= jump) {
      m_planGoal = goal;
      m_motion.rebase(goal);
    }
  }

  bool wantsPlan(const Pose &goal, bool image)
  {
    if (m_search.state() != vpPlanSearch::State::Idle) {
      return false;
    }
    if (!m_motion.isFollowing() || isTooFast()) {
      return true;
    }
    const double off = offBy(goal);
    if (m_gains.replanPeriod > 0.) {
      return isOther(off) || (m_sinceSearch >= m_gains.replanPeriod && (off > 1. || timeToArrival() > freeze));
    }
    return (image || m_goalMoved) && (off > 1. || isTooSlow());
  }

  bool isOther(double off) const { return m_goalMoved && off > jump; }

  // How far from the goal the plan would end, in units of what is noise.
  double offBy(const Pose &goal) const
  {
    if (m_hasFeedback) {
      const Distance off(goal, m_planGoal);
      return vpPlanFeedback::size(off.shift, off.turn);
    }
    const Distance off(goal, camera() * m_motion.reference().inverse() * m_planGoal);
    const double share = std::max(off.shift / (vpPlanFeedback::zone + lag * m_speed.head<3>().norm()),
                                  off.turn / (vpPlanFeedback::zoneTurn + lag * m_speed.tail<3>().norm()));
    return m_motion.isAtRest() && std::abs(share - m_tried) < worthTrying * m_tried ? 0. : share;
  }

  void openSearch(const Pose &goal, int work, double dt)
  {
    m_isWanted = false;
    m_sinceSearch = 0.;
    const double off = offBy(goal);
    m_fresh = !m_motion.isFollowing() || isTooFast() || isOther(off);
    m_goalMoved = false;
    if (isTooFast()) {
      brake();
    }
    vpPlanSearch::Task task;
    task.origin = vpServoPose::translation(m_goal.cdMo);
    // An object at the goal camera's own origin is in no direction.
    task.gaze = !m_gazeFailed && vpLookAt(task.origin, Eigen::Vector3d::Zero()).defined;
    m_rested = m_motion.isAtRest();
    int points = 0;
    if (!m_rested) {
      const double cycles = std::ceil(m_search.effort(m_expected) / static_cast<double>(work)) + 1.;
      points = static_cast<int>(std::clamp(std::ceil(cycles * dt / h), 1., 1. * vpPlanSearch::maxDelay));
    }
    const Pose place = m_motion.decide(points, task);
    const double left = m_motion.left(); // when the new plan begins
    task.floor = m_fresh || isTooSlow() ? 0. : off > 1. ? std::max(left, leastCorrection) : std::max(left, 0.);
    m_startPose = m_hasFeedback ? place : camera() * m_motion.reference().inverse() * place;
    task.isAtRest = m_rested;
    task.isFresh = m_fresh;
    if (!m_fresh && !m_rested && task.floor > 0. && m_motion.plan().looksAtObject() == task.gaze) {
      task.base = &m_motion.plan();
      task.since = task.base->duration() - left;
    }
    task.start = {goal.inverse() * m_startPose, 0.5 * (task.before + task.last), (task.last - task.before) / h};
    m_searchGoal = goal;
    m_search.open(task);
  }

  // No plan was found. Towards another goal, braking is better than going on to the old one.
  void refused()
  {
    m_search.close();
    if (m_fresh && m_motion.isFollowing()) {
      brake();
    }
    m_planFactor = m_factor; // a plan that is slower than necessary stays
    m_stuck = m_stuck || (m_rested && m_gazeFailed);
    m_gazeFailed = m_rested && !m_gazeFailed;
  }

  void adopt()
  {
    m_motion.follow(m_search.found(), m_startPose);
    m_search.close();
    ++m_plans;
    m_planGoal = m_searchGoal;
    m_expected = 1.2 * m_motion.plan().duration();
    m_planFactor = m_factor;
    m_stuck = m_gazeFailed = false;
    if (m_rested) {
      const Distance way(m_startPose, m_planGoal);
      m_tried = vpPlanFeedback::size(way.shift, way.turn);
    }
  }

  // At a knot without decided control points: the plan begins here that was found for it.
  void takeFound()
  {
    if (m_search.state() == vpPlanSearch::State::Found) {
      adopt();
    }
    else if (m_search.state() != vpPlanSearch::State::Idle && !m_rested) { // too late for its start
      m_search.close();
      m_expected *= 2.;
      m_goalMoved = m_goalMoved || (m_fresh && m_motion.isFollowing());
    }
  }

  void advance(double dt)
  {
    for (bool isKnot = m_motion.pass(dt); isKnot; isKnot = m_motion.pass(0.)) {
      m_search.pass();
      if (!m_motion.hasDecided()) {
        takeFound();
      }
      m_motion.pushNext();
    }
  }

  // Twist that leads the camera back to the commanded motion, which moved it from \e before to reference() in a cycle:
  // its middle is where a camera is that executes the last twist of each cycle for all of it.
  Vector6 correction(const Pose &before, double dt)
  {
    const Pose now = camera(), after = m_motion.reference();
    const Eigen::Matrix3d toCamera = now.R.transpose();
    const Eigen::Vector3d shift = toCamera * (0.5 * (before.t + after.t) - now.t);
    const Eigen::Vector3d turn = 0.5 * (vpSO3::log(toCamera * before.R) + vpSO3::log(toCamera * after.R));
    const bool mustBeSmall = m_isWanted || !m_motion.isFollowing() || m_search.state() != vpPlanSearch::State::Idle;
    return m_feedback.step(shift, turn, m_own, m_motion.isAtRest(), room(dt), mustBeSmall, dt);
  }

  // What the rest of the plan leaves to the feedback, from two cycles ago on. Along a plan this only grows, and the shaper is
  // never faster than its fastest input; another plan is looked for once the feedback is within what every plan leaves.
  vpTwistNorms room(double dt) const
  {
    const vpTwistNorms rest = vpTwistExcess::normsOf(ofFeedback(m_limits));
    if (!m_motion.isFollowing()) {
      return rest;
    }
    const double since = std::max(m_motion.planTime() - 2. * dt, 0.);
    return rest.max(vpTwistExcess::normsOf(m_limits) - m_motion.plan().normsFrom(since));
  }

  bool m_hasFeedback;
  vpServoMotionLimits m_motionLimits, m_limits; // as given, and with the factor on the speeds
  double m_wantedFactor = 1., m_factor = 1., m_planFactor = 1.;
  Vector6 m_share; // of the limits for the plan
  vpObjectAverage m_object;
  vpPlanSearch m_search;

  vpPlanMotion m_motion;
  Pose m_planGoal;
  int m_plans = 0;

  // The search.
  Pose m_startPose, m_searchGoal;
  bool m_goalMoved = true, m_isWanted = false, m_fresh = true, m_rested = true;
  bool m_gazeFailed = false, m_stuck = false;
  double m_sinceSearch = 0., m_expected = 3., m_tried = 0.;

  // Feedback and what was executed.
  vpPlanFeedback m_feedback;
  bool m_isDisturbed = false; // the commands do not go on as planned
  bool m_isAsked = false;     // compute() made the last command
  bool m_wasOther = false;    // the command before the last one was not the law's
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
