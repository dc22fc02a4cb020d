/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/avoidance/vpStopSupervisor.h>

#include "vpFieldCheck.h"
#include "vpStopPlan.h"

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr vpFieldCheck fields("the stop supervisor");
constexpr double sameTime = 1e-9; // of a period
constexpr double slack = 1e-4;    // m: tolerated loss of clearance between periods during a retreat
} // namespace

double roomAhead(const vpArmModel &arm, int joint, double q, double velocity) noexcept
{
  const double limit = velocity > 0. ? arm.upper()(joint) : arm.lower()(joint);
  const double room = velocity > 0. ? limit - q : q - limit;
  return std::isfinite(limit) ? room + 1e-9 * std::max(1., std::fabs(limit)) : room;
}

vpJointVector brakeOnce(const vpArmModel &arm, const vpJointVector &velocity, double period) noexcept
{
  vpJointVector next(velocity.size());
  for (int j = 0; j < next.size(); ++j) {
    next(j) = std::copysign(std::max(0., std::fabs(velocity(j)) - period * arm.acceleration()(j)), velocity(j));
  }
  return next;
}

bool planStop(const vpArmModel &arm, const vpJointVector &q, const vpJointVector &velocity, double keep,
              vpTrajectoryPlan &plan) noexcept
{
  const int n = arm.size();
  double together = 0.;
  for (int j = 0; j < n; ++j) {
    together = std::max(together, std::fabs(velocity(j)) / arm.acceleration()(j));
  }
  bool good = std::isfinite(together);
  plan.clear();
  for (int j = 0; j < n; ++j) {
    const double v = velocity(j), alone = std::fabs(v) / arm.acceleration()(j);
    // v (keep + braking / 2) <= room
    const double most = v == 0. ? together : 2. * (roomAhead(arm, j, q(j), v) / std::fabs(v) - keep);
    const double braking = std::max(alone, std::min(together, most));
    good = good && (v == 0. || braking <= most);
    plan.begin(j, q(j), vpTrajectoryForm::Direct);
    plan.append(j, {0., v * keep}, keep);
    plan.append(j, {0., v * braking, -0.5 * v * braking}, braking);
    plan.finish(j, {q(j) + v * (keep + 0.5 * braking), 0., 0., 0.});
  }
  return good;
}

void vpStopSupervisorSpec::validate() const
{
  fields.in("period", period, vpFieldRange::positive(1.), "s");
  fields.notNegative("margin", margin, "m");
  fields.notNegative("latency", latency, "s");
  fields.positive("resolution", resolution, "m");
  fields.in("attempts", attempts, {1, 16});
  fields.in("looks", looks, {60});
}

const char *vpSupervisedVelocity::message() const noexcept
{
  switch (status) {
  case vpSupervision::Passed:
    return "The arm moves as wished.";
  case vpSupervision::Limited:
    return "The arm moves as wished, within the limits of its joints.";
  case vpSupervision::Slowed:
    return "The arm moves slower than wished, so that it can stop in time.";
  case vpSupervision::Stopping:
    return "The arm brakes: no motion towards the wish could be stopped in time.";
  case vpSupervision::Standing:
    return "The arm stands: no motion towards the wish could be stopped in time.";
  case vpSupervision::Unsafe:
    return "The arm brakes, but something has come into its way to rest.";
  case vpSupervision::InvalidInput:
    break;
  }
  return "The configuration or the wish is not finite, out of range or of a wrong size; the arm brakes.";
}

vpStopSupervisor::vpStopSupervisor(const vpCollisionScene &scene, const vpStopSupervisorSpec &spec)
  : m_scene(&scene), m_spec(spec), m_certificate(scene, {0., spec.resolution > 0. ? spec.resolution : 1e-4}),
    m_candidate(scene.arm().size()), m_stop(scene.arm().size())
{
  spec.validate();
  scene.arm().requireMotionLimits("a stop supervisor");
  reset();
}

void vpStopSupervisor::reset() noexcept
{
  m_moving = false;
  m_command = vpJointVector::Zero(m_scene->arm().size());
}

// The stop of the last period, one period later: the mean of its ramp.
vpJointVector vpStopSupervisor::braking() const noexcept
{
  vpJointVector velocity = vpJointVector::Zero(m_scene->arm().size());
  for (int j = 0; j < velocity.size() && m_moving; ++j) {
    velocity(j) = (m_stop.at(j, m_time + m_spec.period)[0] - m_stop.at(j, m_time)[0]) / m_spec.period;
  }
  return velocity;
}

// The velocity nearest to the request within the limits of each joint.
vpJointVector vpStopSupervisor::limited(const vpJointVector &q, const vpJointVector &wish) const noexcept
{
  const vpArmModel &arm = m_scene->arm();
  const double period = m_spec.period;
  vpJointVector velocity(q.size());
  for (int j = 0; j < velocity.size(); ++j) {
    const double fastest = arm.velocity()(j), a = arm.acceleration()(j), last = m_command(j);
    const double low = std::max(-fastest, last - period * a), high = std::min(fastest, last + period * a);
    // v T + v^2 / (2 a) <= room, so that it can brake before its position limit; beyond the limit, no farther.
    const auto towards = [&](double sense) {
      const double room = std::max(0., roomAhead(arm, j, q(j), sense));
      return room < HUGE_VAL ? 2. * room / (period + std::sqrt(period * period + 2. * room / a)) : fastest;
    };
    const double above = std::max(low, towards(1.)), below = std::min(high, -towards(-1.));
    velocity(j) = std::clamp(std::clamp(wish(j), std::min(below, above), above), low, high);
  }
  return velocity;
}

// Time at which an arm commanded by a plan stands: the end of the period in which the plan ends.
double vpStopSupervisor::standing(const vpTrajectoryPlan &plan) const noexcept
{
  return std::ceil(plan.duration() / m_spec.period - sameTime) * m_spec.period;
}

// By how much a clearance of the arm on the chords of a plan may be less than on the plan: e of the proof.
double vpStopSupervisor::offPlan(const vpTrajectoryPlan &plan) const noexcept
{
  const int n = m_scene->arm().size();
  vpJointVector off(n);
  for (int j = 0; j < n; ++j) {
    const int last = plan.segments(j) - 1; // the ramp down to rest
    const double v = std::fabs(plan.at(j, 0.)[1]), braking = last < 0 ? HUGE_VAL : plan.segment(j, last).duration;
    off(j) = m_spec.period * v * std::min(1., 0.125 * m_spec.period / braking);
  }
  double most = 0.;
  for (int link = 1; link <= m_scene->arm().links(); ++link) {
    double sum = 0.;
    for (int j = 0; j < n; ++j) {
      sum += m_certificate.reach().ofLink(link, j) * off(j);
    }
    most = std::max(most, sum);
  }
  return most;
}

vpClearance vpStopSupervisor::clearanceAt(const vpTrajectoryPlan &plan, double time, double cutoff) noexcept
{
  vpJointVector q(m_scene->arm().size());
  for (int j = 0; j < q.size(); ++j) {
    q(j) = plan.at(j, time)[0];
  }
  --m_looks;
  m_scene->place(q, m_data);
  return m_scene->clearance(m_data, cutoff, m_spec.latency + time);
}

// Equal share of the evaluations for a proof, so that a difficult one does not use up all of them; two shares
// are reserved for the stop in force.
int vpStopSupervisor::looksOfProof() const noexcept { return m_spec.looks / (m_spec.attempts + 3); }

vpTrajectoryClearance vpStopSupervisor::prove(const vpTrajectoryPlan &plan, double from, double margin,
                                              int looks) noexcept
{
  m_certificate.setMargin(margin);
  const vpTrajectoryClearance result = m_certificate.verdict(plan, from, std::max(from, standing(plan)), m_spec.latency,
                                                             std::max(1, std::min(m_looks, looks)));
  m_looks -= result.evaluated;
  return result;
}

bool vpStopSupervisor::admit(const vpJointVector &q, const vpJointVector &velocity, vpClearance &pair) noexcept
{
  if (!planStop(m_scene->arm(), q, velocity, m_spec.period, m_candidate)) {
    return false;
  }
  // With the resolution as reserve, so that a proof can be repeated in any later period.
  const double off = offPlan(m_candidate) + m_spec.resolution, margin = m_spec.margin + off;
  // The rest position collides most often, and is checked quickly.
  const vpClearance there = clearanceAt(m_candidate, standing(m_candidate), margin);
  if (there.kind == vpCollisionKind::None) {
    const vpTrajectoryClearance verdict = prove(m_candidate, 0., margin, looksOfProof());
    if (verdict.isFree()) {
      return true;
    }
    pair = verdict.pair;
  }
  else {
    pair = there;
  }
  return isRetreat(q, off);
}

// An arm at or within its margin may move if it is no nearer at the end of any period, and hardly nearer in between.
bool vpStopSupervisor::isRetreat(const vpJointVector &q, double off) noexcept
{
  --m_looks;
  m_scene->place(q, m_data);
  const double near = m_spec.margin + off + slack;
  double last = m_scene->clearance(m_data, near, m_spec.latency).distance;
  const double margin = last - slack;
  if (!(last < near) || !(margin >= off)) {
    return false;
  }
  const double periods = std::round(standing(m_candidate) / m_spec.period);
  if (!(periods < m_looks)) {
    return false;
  }
  for (int k = 1; k <= static_cast<int>(periods); ++k) {
    const double now = clearanceAt(m_candidate, k * m_spec.period, near).distance;
    if (!(now >= std::min(last, near))) {
      return false;
    }
    last = now;
  }
  return prove(m_candidate, 0., margin, looksOfProof()).isFree();
}

bool vpStopSupervisor::tryWish(const vpJointVector &q, const vpJointVector &wish, const vpJointVector &brake,
                               vpSupervisedVelocity &output) noexcept
{
  const vpJointVector most = limited(q, wish);
  const bool asWished = ((most - wish).array().abs() <= 1e-9 * wish.array().abs().max(1.)).all();
  double share = 1.;
  for (int attempt = 0; attempt < m_spec.attempts && m_looks > 0; ++attempt, share *= 0.5) {
    const vpJointVector velocity = brake + share * (most - brake);
    if (admit(q, velocity, output.pair)) {
      std::swap(m_stop, m_candidate);
      m_time = m_spec.period;
      m_moving = velocity.cwiseAbs().maxCoeff() > 0.;
      output.velocity = velocity;
      output.share = share;
      output.status = attempt > 0 ? vpSupervision::Slowed : asWished ? vpSupervision::Passed : vpSupervision::Limited;
      output.pair = attempt > 0 ? output.pair : vpClearance();
      return true;
    }
  }
  return false;
}

// The rest of the stop from the arm's position, if it deviates from the stop.
void vpStopSupervisor::startStopAt(const vpJointVector &q) noexcept
{
  double off = 0.;
  for (int j = 0; j < q.size(); ++j) {
    off = std::max(off, std::fabs(m_stop.at(j, m_time)[0] - q(j)));
  }
  if (off <= 1e-9) {
    return;
  }
  m_candidate.clear();
  for (int j = 0; j < q.size(); ++j) {
    const double v = m_stop.at(j, m_time)[1], left = m_stop.duration(j) - m_time, way = left > 0. ? v * left : 0.;
    m_candidate.begin(j, q(j), vpTrajectoryForm::Direct);
    m_candidate.append(j, {0., way, -0.5 * way}, left);
    m_candidate.finish(j, {q(j) + 0.5 * way, 0., 0., 0.});
  }
  std::swap(m_stop, m_candidate);
  m_time = 0.;
}

void vpStopSupervisor::step(const vpJointVector &q, const vpJointVector &wish, vpSupervisedVelocity &output) noexcept
{
  const int n = m_scene->arm().size(), reserve = 2 * looksOfProof();
  output = vpSupervisedVelocity();
  output.velocity = braking();
  const int mine = m_spec.looks - reserve - 2; // an attempt may evaluate two more than are left
  m_looks = mine;
  const bool placed = m_certificate.reach().holds(q);
  if (placed && wish.size() == n && wish.allFinite()) {
    const bool passed = tryWish(q, wish, vpJointVector(output.velocity), output);
    output.looks = mine - m_looks;
    if (passed) {
      m_command = output.velocity;
      return;
    }
    output.status = m_moving ? vpSupervision::Stopping : vpSupervision::Standing;
  }
  if (m_moving && placed) { // checks the stop again, from the arm's position, with the current objects
    startStopAt(q);
    m_looks = reserve;
    const vpTrajectoryClearance rest = prove(m_stop, m_time, offPlan(m_stop), reserve);
    output.looks += rest.evaluated;
    if (!rest.isFree() && output.status != vpSupervision::InvalidInput) {
      output.status = vpSupervision::Unsafe;
      output.pair = rest.pair;
    }
  }
  m_command = output.velocity;
  m_time += m_spec.period;
  m_moving = m_moving && m_time < m_stop.duration() - sameTime * m_spec.period;
}

END_VISP_NAMESPACE
