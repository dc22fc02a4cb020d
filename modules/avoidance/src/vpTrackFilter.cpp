/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpTrackFilter.h"

#include <visp3/direct_core/vpSO3.h>

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr double learning = 0.3;    // fraction of the missing trust gained by a good sighting
constexpr double doubting = 0.6;    // fraction of the trust left after a doubted sighting
constexpr double startTrust = 0.3;  // after the first sighting
constexpr int stubborn = 4;         // factor on the allowed doubts that restarts even if they do not agree
constexpr double rebaseAngle = 0.5; // rad; keeps the rotation vectors of the rest test small enough to add like vectors
// Hysteresis: factor on the thresholds for leaving rest, so that noise does not cause motion.
constexpr double slopeHysteresis = 1.5, scatterHysteresis = 2.;

double square(double x) { return x * x; }

double density(double acceleration, const vpObjectTrackSpec &spec) { return square(acceleration) * spec.persistence; }

vpTwist twist(const Eigen::Vector3d &linear, const Eigen::Vector3d &angular)
{
  return {linear.x(), linear.y(), linear.z(), angular.x(), angular.y(), angular.z()};
}
} // namespace

// Weighted least-squares line through the newest measurements.
vpRestTest::Line vpRestTest::fit(int count) const
{
  Line line;
  for (int k = 0; k < count; ++k) {
    const Sample &s = newest(k);
    line.weight += s.weight;
    line.time += s.weight * (s.time - newest(0).time); // differences: times may be large numbers
    line.mean += s.weight * (s.value - newest(0).value);
  }
  line.time = newest(0).time + line.time / line.weight;
  line.mean = newest(0).value + line.mean / line.weight;
  for (int k = 0; k < count; ++k) {
    const Sample &s = newest(k);
    const double t = s.time - line.time;
    line.spread += s.weight * t * t;
    line.slope += s.weight * t * (s.value - line.mean);
    line.scatter += s.weight * (s.value - line.mean).squaredNorm();
  }
  line.slope /= line.spread;
  return line;
}

bool vpRestTest::isConstant(const Line &line, int count, double slopeSigmas, double scatterSigmas)
{
  const double freedom = 3. * (count - 1);
  return line.slope.squaredNorm() * line.spread <= slopeSigmas * slopeSigmas &&
         line.scatter <= freedom + scatterSigmas * std::sqrt(2. * freedom);
}

// Smallest number of newest measurements with sufficient accuracy of the slope; 0 if all are too few.
int vpRestTest::enough(const Limits &limits) const
{
  for (int count = 3; count <= m_count; ++count) {
    if (limits.sigmas <= limits.speed * std::sqrt(fit(count).spread)) {
      return count;
    }
  }
  return 0;
}

void vpRestTest::add(double time, const Eigen::Vector3d &value, double variance, const Limits &limits)
{
  m_samples[static_cast<std::size_t>(m_next)] = {time, value, 1. / variance};
  m_next = (m_next + 1) % capacity;
  m_count = std::min(m_count + 1, capacity);
  const int count = enough(limits);
  if (count == 0 || !(limits.sigmas > 0.)) {
    m_resting = 0;
    return;
  }
  const Line line = fit(count);
  if (m_resting > 0) {
    // The few newest detect a start quickly, all together detect slow creep.
    m_resting = std::max(std::min(m_resting + 1, capacity), count);
    m_line = fit(m_resting);
    const double slope = slopeHysteresis * limits.sigmas, scatter = scatterHysteresis * limits.sigmas;
    if (isConstant(line, count, slope, scatter) && isConstant(m_line, m_resting, slope, scatter)) {
      return;
    }
    m_resting = 0;
  }
  else if (isConstant(line, count, limits.sigmas, limits.sigmas)) {
    m_resting = count;
    m_line = line;
  }
}

double vpRestTest::variance(double time) const
{
  const double t = time - m_line.time;
  return 1. / m_line.weight + t * t / m_line.spread;
}

vpMotionVariance vpMotionVariance::after(double dt, double density) const
{
  vpMotionVariance later;
  later.value = value + dt * (2. * both + dt * (rate + dt * density / 3.));
  later.both = both + dt * (rate + dt * density / 2.);
  later.rate = rate + dt * density;
  return later;
}

void vpMotionVariance::measure(double variance, Eigen::Vector2d &gain)
{
  const double innovation = value + variance;
  gain = Eigen::Vector2d(value, both) / innovation;
  rate -= gain(1) * both;
  both *= variance / innovation;
  value *= variance / innovation;
}

vpTrackFilter::vpTrackFilter(const vpObjectSighting &sighting, const vpObjectTrackSpec &spec)
{
  start(sighting, spec);
  m_trust = startTrust;
}

void vpTrackFilter::start(const vpObjectSighting &sighting, const vpObjectTrackSpec &spec)
{
  m_time = sighting.time;
  m_motion = Motion();
  m_motion.position = sighting.pose.p;
  m_motion.R = sighting.pose.R;
  m_motion.place.value = square(sighting.positionSigma);
  m_motion.place.rate = square(spec.startVelocity);
  m_motion.turn.value = square(sighting.angleSigma);
  m_motion.turn.rate = square(spec.startTurn);
  m_placeTest.clear();
  m_turnTest.clear();
  m_reference = sighting.pose.R;
  testRest(sighting, spec);
  m_sightings = 1;
  m_doubted = m_agreeing = 0;
}

// The object coasts for the allowed time and then stays; possible further motion adds to the variance.
vpTrackFilter::Motion vpTrackFilter::at(double time, const vpObjectTrackSpec &spec) const
{
  const double dt = std::max(0., time - m_time), moves = std::min(dt, spec.coast);
  Motion motion = m_motion;
  motion.place = m_motion.place.after(dt, density(spec.acceleration, spec));
  motion.turn = m_motion.turn.after(dt, density(spec.angularAcceleration, spec));
  if (dt > moves) {
    motion.place.value += square(dt - moves) * m_motion.linear.squaredNorm();
    motion.turn.value += square(dt - moves) * m_motion.angular.squaredNorm();
  }
  motion.position += moves * m_motion.linear;
  motion.R = vpSO3::exp(moves * m_motion.angular) * m_motion.R;
  return motion;
}

bool vpTrackFilter::isPossible(const vpObjectSighting &sighting, const Motion &motion, double gate) const
{
  const double place = motion.place.value + square(sighting.positionSigma);
  const double turn = motion.turn.value + square(sighting.angleSigma);
  return (sighting.pose.p - motion.position).squaredNorm() <= square(gate) * place &&
         vpSO3::log(sighting.pose.R * motion.R.transpose()).squaredNorm() <= square(gate) * turn;
}

bool vpTrackFilter::add(const vpObjectSighting &sighting, const vpObjectTrackSpec &spec)
{
  const Motion motion = at(sighting.time, spec);
  if (!isPossible(sighting, motion, spec.gate)) {
    return doubt(sighting, spec);
  }
  use(sighting, motion, spec);
  ++m_sightings;
  m_trust += learning * (1. - m_trust);
  m_doubted = m_agreeing = 0;
  return true;
}

void vpTrackFilter::use(const vpObjectSighting &sighting, const Motion &motion, const vpObjectTrackSpec &spec)
{
  const Eigen::Vector3d place = sighting.pose.p - motion.position;
  const Eigen::Vector3d turn = vpSO3::log(sighting.pose.R * motion.R.transpose());
  m_motion = motion;
  m_time = sighting.time;
  Eigen::Vector2d gain;
  m_motion.place.measure(square(sighting.positionSigma), gain);
  m_motion.position += gain(0) * place;
  m_motion.linear += gain(1) * place;
  m_motion.turn.measure(square(sighting.angleSigma), gain);
  m_motion.R = vpSO3::exp(gain(0) * turn) * m_motion.R;
  m_motion.angular += gain(1) * turn;
  testRest(sighting, spec);
}

void vpTrackFilter::testRest(const vpObjectSighting &sighting, const vpObjectTrackSpec &spec)
{
  m_placeTest.add(sighting.time, sighting.pose.p, square(sighting.positionSigma), {spec.restSigmas, spec.restSpeed});
  Eigen::Vector3d turn = vpSO3::log(sighting.pose.R * m_reference.transpose());
  if (turn.norm() > rebaseAngle) {
    m_turnTest.clear();
    m_reference = sighting.pose.R;
    turn.setZero();
  }
  m_turnTest.add(sighting.time, turn, square(sighting.angleSigma), {spec.restSigmas, spec.restTurn});
}

// The sighting is not used, unless it and the previous ones agree that the object is elsewhere.
bool vpTrackFilter::doubt(const vpObjectSighting &sighting, const vpObjectTrackSpec &spec)
{
  Motion before;
  before.position = m_doubtedPose.p;
  before.R = m_doubtedPose.R;
  before.place.value = m_doubtedPlaceVariance;
  before.place.rate = square(spec.startVelocity);
  before.turn.value = m_doubtedTurnVariance;
  before.turn.rate = square(spec.startTurn);
  const double dt = sighting.time - m_doubtedTime;
  before.place = before.place.after(dt, density(spec.acceleration, spec));
  before.turn = before.turn.after(dt, density(spec.angularAcceleration, spec));
  m_agreeing = m_doubted > 0 && isPossible(sighting, before, spec.gate) ? m_agreeing + 1 : 1;
  ++m_doubted;
  m_doubtedPose = sighting.pose;
  m_doubtedTime = sighting.time;
  m_doubtedPlaceVariance = square(sighting.positionSigma);
  m_doubtedTurnVariance = square(sighting.angleSigma);
  m_trust *= doubting;
  if (m_agreeing < spec.doubts && m_doubted < stubborn * spec.doubts) {
    return false;
  }
  start(sighting, spec);
  m_trust = std::min(m_trust, startTrust);
  ++m_restarts;
  return true;
}

void vpTrackFilter::predict(double now, const vpObjectTrackSpec &spec, vpObjectTrack &track) const
{
  const double age = std::max(0., now - m_time);
  const bool lost = age > spec.coast;
  const Motion motion = at(now, spec);
  track.pose = {motion.R, motion.position};
  Eigen::Vector3d linear = m_motion.linear, angular = m_motion.angular;
  double place = motion.place.value, turn = motion.turn.value, speed = motion.place.rate;
  track.resting = m_placeTest.isResting();
  if (track.resting) {
    track.pose.p = m_placeTest.place();
    linear.setZero();
    place = m_placeTest.variance(now) + density(spec.restAcceleration, spec) * age * age * age / 3.;
    speed = m_placeTest.slopeVariance();
  }
  if (m_turnTest.isResting()) {
    track.pose.R = vpSO3::exp(m_turnTest.place()) * m_reference;
    angular.setZero();
    // The random angular acceleration at rest is scaled like that of the position.
    const double share = square(spec.angularAcceleration / spec.acceleration);
    turn = m_turnTest.variance(now) + share * density(spec.restAcceleration, spec) * age * age * age / 3.;
  }
  track.velocity = lost || m_sightings < 2 ? vpTwist() : twist(linear, angular);
  track.positionSigma = std::sqrt(place);
  track.angleSigma = std::sqrt(turn);
  track.velocitySigma = std::sqrt(speed);
  track.age = age;
  track.sightings = m_sightings;
  track.restarts = m_restarts;
  track.confidence = age > 0. ? m_trust / (1. + square(age / std::max(spec.coast, 1e-9))) : m_trust;
  const bool fresh = age <= spec.fresh;
  track.status = lost               ? vpTrackStatus::Lost
                 : m_sightings == 1 ? vpTrackStatus::New
                 : fresh            ? vpTrackStatus::Tracked
                                    : vpTrackStatus::Coasting;
}

END_VISP_NAMESPACE
