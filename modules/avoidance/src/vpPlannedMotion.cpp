/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/avoidance/vpPlannedMotion.h>

#include "vpFieldCheck.h"
#include "vpStopPlan.h"

#include <visp3/avoidance/vpGoalConfiguration.h>
#include <visp3/trajectory/vpDirectTrajectory.h>

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr vpFieldCheck fields("the planned motion");
constexpr double ending = 0.5;       // s: the last part of a motion is not changed, to keep its smooth end
constexpr double quicker = 0.9;      // of the remaining time: faster new motions replace it
constexpr double slack = 1e-4;       // m: reduction of the margin when proving the rest of a motion again
constexpr std::size_t mostPlans = 6; // stops after which a path is looked for, in one look

vpPathPlannerSpec plannerSpec(const vpPlannedMotionSpec &spec, double clearance)
{
  spec.validate();
  vpPathPlannerSpec result;
  result.planner = spec.planner;
  result.validation = spec.validation;
  result.margin = spec.common.margin + clearance;
  result.shortenTime = spec.shortenTime;
  result.seed = spec.common.seed;
  return result;
}

bool moves(const vpCollisionScene &scene)
{
  for (int i = 0; i < scene.objectCount(); ++i) {
    for (int k = 0; k < 6; ++k) {
      if (scene.object(i).velocity[k] != 0.) {
        return true;
      }
    }
  }
  return false;
}
} // namespace

void vpPlannedMotionSpec::validate() const
{
  common.validate();
  fields.notNegative("clearance", clearance, "m");
  fields.positive("startTime", startTime, "s");
  fields.positive("replanTime", replanTime, "s");
  fields.notNegative("shortenTime", shortenTime, "s");
}

vpPlannedMotion::vpPlannedMotion(const vpCollisionScene &scene, const vpPlannedMotionSpec &spec)
  : m_scene(&scene), m_spec(spec), m_view(scene), m_wide(m_view, plannerSpec(spec, spec.clearance)),
    m_near(m_view, plannerSpec(spec, 0.)), m_now(scene, {spec.common.margin, 1e-4}),
    m_later(m_view, {spec.common.margin, 1e-4})
{
  scene.arm().requireMotionLimits("a planned motion");
}

vpAxisState vpPlannedMotion::at(int joint, double t) const noexcept
{
  if (m_parts.empty()) {
    return {m_hold(joint), 0., 0., 0.};
  }
  std::size_t i = m_parts.size() - 1;
  while (i > 0 && m_parts[i].begin > t) {
    --i;
  }
  return m_parts[i].plan.at(joint, t - m_parts[i].begin);
}

vpPlannedMotion::State vpPlannedMotion::state(double t) const
{
  const int n = m_scene->arm().size();
  State result{vpJointVector(n), vpJointVector(n), vpJointVector(n)};
  for (int j = 0; j < n; ++j) {
    const vpAxisState x = at(j, std::min(t, m_duration));
    result.q(j) = x[0];
    result.v(j) = t >= m_duration ? 0. : x[1];
    result.a(j) = t >= m_duration ? 0. : x[2];
  }
  return result;
}

// Predicts the scene; objects may have been added or removed since the last time.
void vpPlannedMotion::predict(double time)
{
  if (m_view.revision() != m_scene->revision()) {
    m_view = *m_scene;
  }
  for (int i = 0; i < m_scene->objectCount(); ++i) {
    const vpCollisionObject &object = m_scene->object(i);
    m_view.moveObject(i, object.poseAt(time));
    m_view.setVelocity(i, object.velocity);
    m_view.setInflation(i, object.inflation);
  }
}

vpAvoidanceStatus vpPlannedMotion::start(const vpJointVector &q, const vpAvoidanceGoal &goal)
{
  m_parts.clear();
  m_duration = m_clock = 0.;
  m_toGoal = false;
  m_hold = q;
  m_status = vpAvoidanceStatus::InvalidInput;
  m_command = vpJointVector::Zero(m_scene->arm().size());
  vpCollisionData placed;
  m_scene->place(q, placed);
  if (!placed.placed || !goal.fits(m_scene->arm())) {
    return m_status;
  }
  m_wish = m_goal = goal;
  m_goalChanged = true;
  m_status = vpAvoidanceStatus::Waiting;
  m_tries = 0;
  m_planningTime = m_spec.startTime;
  look();
  m_planningTime = m_spec.replanTime;
  return m_status;
}

void vpPlannedMotion::setGoal(const vpAvoidanceGoal &goal) noexcept
{
  if (!goal.fits(m_scene->arm()) || m_status == vpAvoidanceStatus::InvalidInput) {
    return;
  }
  const bool same = goal.q.size() == m_wish.q.size() && (goal.q.size() == 0 || goal.q == m_wish.q) &&
                    goal.position == m_wish.position;
  m_goalChanged = m_goalChanged || !same;
  m_wish = goal;
}

void vpPlannedMotion::look()
{
  if (m_status == vpAvoidanceStatus::InvalidInput) {
    return;
  }
  if (m_goalChanged) {
    m_goal = m_wish;
    const State here = state(m_clock);
    if (m_goal.q.size() == 0) {
      // One in collision is planned to all the same: the planner says GoalInCollision until what is there has gone.
      m_goal.q = vpFindGoalConfiguration(*m_scene, here.q, m_goal.position, m_spec.common.margin + m_spec.clearance).q;
    }
    m_goalChanged = false;
    m_toGoal = false;
  }
  if (m_goal.q.size() == 0) {
    brake();
    m_status = vpAvoidanceStatus::Unreachable;
    return;
  }
  if (m_toGoal && (isAtRest() || restIsFree(m_spec.common.margin))) {
    if (m_duration - m_clock > ending && m_spec.replanning == vpReplanning::OnTheFly) {
      hasten();
    }
    return;
  }
  if (isAtRest()) {
    planFromRest();
  }
  else if (m_spec.replanning == vpReplanning::FromRest || !planOnTheFly()) {
    // A stop within the margin goes on as long as it touches nothing.
    if (m_toGoal || !restIsFree(m_status == vpAvoidanceStatus::Unsafe ? 0. : m_spec.common.margin)) {
      brake();
    }
  }
}

bool vpPlannedMotion::restIsFree(double margin)
{
  m_now.setMargin(std::max(0., margin - slack));
  for (const vpTimedPath::Part &part : m_parts) {
    const double end = part.begin + part.plan.duration();
    if (end < m_clock) {
      continue;
    }
    const double from = std::max(0., m_clock - part.begin);
    const vpTrajectoryClearance verdict =
        m_now.check(part.plan, from, part.plan.duration(), std::max(0., part.begin - m_clock));
    if (!verdict.isFree()) {
      m_pair = verdict.pair;
      return false;
    }
  }
  return true;
}

// Remaining points of the path, from the current state of the motion.
vpJointPath vpPlannedMotion::restOfPath() const
{
  vpJointPath path;
  path.points.push_back(state(m_clock).q);
  const double soon = m_clock + 2. * m_spec.common.period;
  for (const vpTimedPath::Part &part : m_parts) {
    for (int k = 0; k < part.plan.vias(); ++k) {
      if (part.begin + part.plan.viaTime(k) > soon) {
        path.points.push_back(state(part.begin + part.plan.viaTime(k)).q);
      }
    }
    const double end = part.begin + part.plan.duration();
    if (end > soon) {
      path.points.push_back(state(end).q);
    }
  }
  return path;
}

// First with clearance, then with the margin alone; never twice with the same seed.
vpPathResult vpPlannedMotion::findPath(const vpJointVector &from, double time)
{
  predict(time);
  vpPathResult result;
  for (vpPathPlanner *planner : {&m_wide, &m_near}) {
    planner->setSeed(m_spec.common.seed + m_tries++);
    planner->setTimeLimit(m_planningTime);
    result = planner->plan(from, m_goal.q);
    if (result.status == vpPathStatus::Solved) {
      break;
    }
  }
  return result;
}

std::optional<vpPlannedMotion::Parts> vpPlannedMotion::timed(const vpJointPath &path, const State &from, double begin,
                                                             double speed, double margin)
{
  vpTimedPathSpec spec;
  spec.margin = margin;
  spec.startVelocity = from.v;
  spec.startAcceleration = from.a;
  predict(begin);
  spec.toolVelocity = m_spec.common.maxVelocity;
  spec.toolAcceleration = m_spec.common.maxAcceleration;
  spec.speed = speed;
  const vpTimedPath motion(m_view, path, spec, m_later);
  if (!motion.isFree()) {
    return std::nullopt;
  }
  Parts parts = motion.parts();
  for (vpTimedPath::Part &part : parts) {
    part.begin += begin;
  }
  return parts;
}

void vpPlannedMotion::follow(Parts parts, bool toGoal, vpAvoidanceStatus status)
{
  m_hold = state(m_clock).q;
  m_parts = std::move(parts);
  m_duration = m_parts.empty() ? 0. : m_parts.back().begin + m_parts.back().plan.duration();
  m_clock = 0.;
  m_stopping = 0.;
  m_toGoal = toGoal;
  m_status = status;
  if (toGoal) {
    m_pair = vpClearance();
  }
}

void vpPlannedMotion::planFromRest()
{
  const State here = state(m_clock);
  vpPathStatus why = vpPathStatus::Solved;
  for (const double time : {0., 0.5, 1.5}) {
    if (time > 0. && !moves(*m_scene)) {
      break;
    }
    const vpPathResult found = findPath(here.q, time);
    why = time == 0. ? found.status : why;
    if (found.status != vpPathStatus::Solved) {
      continue;
    }
    for (const double share : {1., 0.4}) {
      if (auto parts = timed(found.path, here, 0., share, m_spec.common.margin)) {
        follow(std::move(*parts), true,
               found.path.points.size() > 2 ? vpAvoidanceStatus::Detouring : vpAvoidanceStatus::Moving);
        return;
      }
    }
  }
  switch (why) {
  case vpPathStatus::StartInCollision:
    m_status = vpAvoidanceStatus::StartInCollision;
    break;
  case vpPathStatus::GoalInCollision:
    m_status = vpAvoidanceStatus::GoalInCollision;
    break;
  case vpPathStatus::OutsideLimits:
    m_status = vpAvoidanceStatus::Unreachable;
    break;
  default:
    m_status = vpAvoidanceStatus::Waiting;
    break;
  }
  vpCollisionData data;
  m_scene->place(why == vpPathStatus::GoalInCollision ? m_goal.q : here.q, data);
  m_pair = m_scene->clearance(data);
}

bool vpPlannedMotion::planOnTheFly()
{
  const State here = state(m_clock);
  const auto take = [&](const vpJointPath &path, std::initializer_list<double> speeds) {
    for (const double speed : speeds) {
      if (auto parts = timed(path, here, 0., speed, m_spec.common.margin)) {
        follow(std::move(*parts), true, vpAvoidanceStatus::Detouring);
        return true;
      }
    }
    return false;
  };
  if (m_toGoal && take(restOfPath(), {1., 0.6, 0.35, 0.2})) {
    return true;
  }
  for (const double time : {0., 0.5, 1.5}) {
    if (time > 0. && !moves(*m_scene)) {
      break;
    }
    const vpPathResult found = findPath(here.q, time);
    if (found.status == vpPathStatus::Solved && take(found.path, {1., 0.5})) {
      return true;
    }
  }
  return stopAndPlan();
}

// The obstacle may be gone: tries the rest of the path faster, or straight to the goal.
void vpPlannedMotion::hasten()
{
  const State here = state(m_clock);
  vpJointPath straight;
  straight.points = {here.q, m_goal.q};
  for (const vpJointPath &path : {straight, restOfPath()}) {
    if (auto parts = timed(path, here, 0., 1., m_spec.common.margin)) {
      const double duration = parts->back().begin + parts->back().plan.duration();
      if (duration < quicker * (m_duration - m_clock)) {
        follow(std::move(*parts), true,
               path.points.size() > 2 ? vpAvoidanceStatus::Detouring : vpAvoidanceStatus::Moving);
        return;
      }
    }
  }
}

// A free stop, and a free path after it.
bool vpPlannedMotion::stopAndPlan()
{
  const std::vector<Stop> stops = freeStops(m_spec.common.margin, true);
  for (std::size_t i = 0; i < std::min(stops.size(), mostPlans); ++i) {
    const double duration = stops[i].plan.duration();
    const int n = m_scene->arm().size();
    State rest{vpJointVector(n), vpJointVector::Zero(n), vpJointVector::Zero(n)};
    for (int j = 0; j < n; ++j) {
      rest.q(j) = stops[i].plan.at(j, duration)[0];
    }
    const vpPathResult found = findPath(rest.q, duration);
    if (found.status != vpPathStatus::Solved) {
      continue;
    }
    if (auto parts = timed(found.path, rest, duration, 1., m_spec.common.margin)) {
      parts->insert(parts->begin(), {0., stops[i].plan});
      follow(std::move(*parts), true, vpAvoidanceStatus::Detouring);
      m_stopping = stops[i].isHard ? duration : 0.;
      return true;
    }
  }
  return false;
}

// Stops that are proven free: first those in which the end effector keeps its bounds, along the motion and straight on, the
// shorter ones first; then, on demand, the stops within the joint limits alone.
std::vector<vpPlannedMotion::Stop> vpPlannedMotion::freeStops(double margin, bool withHard)
{
  const vpArmModel &arm = m_scene->arm();
  const State here = state(m_clock);
  std::vector<Stop> result;
  vpJointPath way;
  way.points = {here.q, here.q};
  const auto tryStop = [&](const vpJointVector &end) {
    way.points[1] = end.cwiseMax(arm.lower()).cwiseMin(arm.upper());
    if (const auto parts = timed(way, here, 0., 1., margin)) {
      result.push_back({parts->front().plan, false});
    }
  };
  for (const double ahead : {0.15, 0.25, 0.4, 0.6, 0.9, 1.3}) {
    tryStop(state(m_clock + ahead).q);
    tryStop(here.q + 0.5 * ahead * here.v);
  }
  if (withHard) {
    m_now.setMargin(std::max(0., margin - slack));
    for (const vpTrajectoryPlan &plan : hardStops()) {
      if (m_now.check(plan).isFree()) {
        result.push_back({plan, true});
      }
    }
  }
  return result;
}

// Straight on, and at the next points of the motion: all joints at rest there as soon as possible.
std::vector<vpTrajectoryPlan> vpPlannedMotion::hardStops() const
{
  const vpArmModel &arm = m_scene->arm();
  const State here = state(m_clock);
  std::vector<vpTrajectoryPlan> result;
  vpTrajectoryPlan straight(arm.size());
  planStop(arm, here.q, here.v, 0., straight);
  result.push_back(straight);
  for (const double ahead : {0.08, 0.15, 0.25, 0.4, 0.6}) {
    if (m_clock + ahead > m_duration) {
      break;
    }
    vpTrajectoryInput<Eigen::Dynamic> input(arm.size());
    input.start.q = here.q;
    input.start.v = here.v;
    input.start.a = here.a;
    input.goal.q = state(m_clock + ahead).q;
    input.maxVelocity = arm.velocity();
    input.maxAcceleration = arm.acceleration();
    input.minPosition = arm.lower();
    input.maxPosition = arm.upper();
    vpTrajectoryPlan plan(arm.size());
    if (vpDirectTrajectory<Eigen::Dynamic>::calculate(input, plan).isGood()) {
      result.push_back(plan);
    }
  }
  return result;
}

void vpPlannedMotion::brake()
{
  if (isAtRest()) {
    return;
  }
  // An arm may be within its margin because something was seen to be larger or elsewhere. To brake as hard as possible would
  // not bring it out: a stop that touches nothing will do.
  std::vector<Stop> stops = freeStops(m_spec.common.margin, true);
  const bool safe = !stops.empty();
  for (const double share : {0.5, 0.}) {
    if (stops.empty()) {
      stops = freeStops(share * m_spec.common.margin, false);
    }
  }
  const Stop stop = stops.empty() ? Stop{hardStops().front(), true} : stops.front();
  const vpClearance pair = m_pair;
  follow({{0., stop.plan}}, false, safe ? vpAvoidanceStatus::Waiting : vpAvoidanceStatus::Unsafe);
  m_pair = pair;
  m_stopping = stop.isHard ? m_duration : 0.;
}

void vpPlannedMotion::step(const vpJointVector &q, vpAvoidanceOutput &output) noexcept
{
  const vpArmModel &arm = m_scene->arm();
  const int n = arm.size();
  output.velocity = vpJointVector::Zero(n);
  output.status = vpAvoidanceStatus::InvalidInput;
  output.pair = m_pair;
  output.stopping = false;
  if (m_status == vpAvoidanceStatus::InvalidInput) {
    return;
  }
  if (q.size() != n || !(q.cwiseAbs().array() <= vpLargestCoordinate).all()) {
    output.velocity = m_command = brakeOnce(arm, m_command, m_spec.common.period);
    output.stopping = true;
    return;
  }
  output.stopping = m_clock < m_stopping;
  m_clock = std::min(m_clock + m_spec.common.period, m_duration);
  double scale = 1.;
  vpJointVector wanted(n);
  for (int j = 0; j < n; ++j) {
    wanted(j) = at(j, m_clock)[0];
    output.velocity(j) = (wanted(j) - q(j)) / m_spec.common.period;
    scale = std::max(scale, std::fabs(output.velocity(j)) / arm.velocity()(j));
  }
  output.velocity /= scale;
  m_command = output.velocity;
  vpArmKinematics::forward(arm, wanted, m_data);
  output.wanted = m_data.tool.p;
  output.status = m_toGoal && isAtRest() ? vpAvoidanceStatus::Arrived : m_status;
}

END_VISP_NAMESPACE
