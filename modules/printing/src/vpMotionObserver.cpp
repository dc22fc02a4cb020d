/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/printing/vpMotionObserver.h>
#include <visp3/printing/vpMotionForecast.h>

#include "vpPrintingCheck.h"

#include <algorithm>
#include <cmath>
#include <limits>

BEGIN_VISP_NAMESPACE

vpAxisState vpEvaluatePieces(const vpTrajectorySegment *pieces, int count, double t) noexcept
{
  if (count <= 0) {
    return {};
  }
  int i = 0;
  while (i + 1 < count && t >= pieces[i + 1].begin) {
    ++i;
  }
  const vpTrajectorySegment &piece = pieces[i];
  const double T = piece.duration;
  const double inside = std::clamp(t - piece.begin, 0., T);
  const std::array<double, 4> jet = piece.p.jet(inside / T);
  vpAxisState x{{jet[0], jet[1] / T, jet[2] / (T * T), jet[3] / (T * T * T)}};
  const double outside = t - piece.begin - inside;
  if (outside != 0.) {
    x = {{x[0] + outside * x[1], x[1], 0., 0.}};
  }
  return x;
}

bool vpMotionForecast::isPlausible() const noexcept
{
  if (!vpIsPlausible(time) || !vpIsPlausible(position) || !vpIsPlausible(velocity) || !vpIsPlausible(acceleration) ||
      !(accelerationTime >= 0.) || !vpIsPlausible(accelerationTime) || !vpIsPlausibleDeviation(errorTime) ||
      pieces < 0 || pieces > maxPieces) {
    return false;
  }
  return std::all_of(plan.begin(), plan.begin() + pieces, [](const vpTrajectorySegment &piece) {
    const double *c = piece.p.data();
    return vpIsPlausible(piece.begin) && vpIsPlausibleDeviation(piece.duration) &&
           std::all_of(c, c + piece.p.degree() + 1, vpIsPlausible);
  });
}

vpAxisState vpMotionForecast::at(double asked) const noexcept
{
  const double dt = std::isnan(asked) ? 0. : std::clamp(asked - time, -longest, longest);
  const double t = time + dt;
  if (pieces <= 0 || pieces > maxPieces) {
    const double accelerated = std::clamp(dt, 0., accelerationTime);
    const double gained = acceleration * accelerated;
    const bool still = dt >= 0. && dt < accelerationTime;
    return {{position + velocity * dt + gained * (dt - 0.5 * accelerated), velocity + gained, still ? acceleration : 0.,
             0.}};
  }
  const vpAxisState from = vpEvaluatePieces(plan.data(), pieces, time);
  vpAxisState x = vpEvaluatePieces(plan.data(), pieces, t);
  const double error = velocity - from[1];
  if (dt >= 0.) {
    const double decay = std::exp(-dt / errorTime);
    x[0] += position - from[0] + error * errorTime * (1. - decay);
    x[1] += error * decay;
    x[2] -= error * decay / errorTime;
  }
  else { // the past, extrapolated back
    x[0] += position - from[0] + error * dt;
    x[1] += error;
  }
  return x;
}

using namespace vpPrintingCheck;

namespace
{
enum Index { Place, Velocity, Force, Disturbance };
constexpr double longestPart = 0.25;  // of an integration step, T: error of the velocity below 1e-4 px/frame
constexpr int patience = 3;           // consecutive measurements beyond the gate that are no outliers
constexpr double largestState = 1e30; // beyond it the state is invalid: its squares would soon overflow
constexpr double rounding = 1e-14;    // relative error of a variance after its correction
constexpr double certainOdds = 50.;   // odds at which a friction change is certain
} // namespace

void vpMotionObserverSpec::validate() const
{
  const char *const owner = "motion observer";
  model.validate(owner);
  notNegative("lag", owner, lag);
  require(delay >= 0. && delay <= 16., "delay", owner, delay, "in [0, 16]");
  notNegative("velocityNoise", owner, velocityNoise);
  positive("disturbanceNoise", owner, disturbanceNoise);
  require(changeRate >= 0. && changeRate <= 1., "changeRate", owner, changeRate, "in [0, 1]");
  bound("gate", owner, gate);
  positive("sigmaPosition", owner, sigmaPosition);
  positive("sigmaVelocity", owner, sigmaVelocity);
  positive("sigmaDisturbance", owner, sigmaDisturbance);
  require(maxGap > 0. && maxGap <= 1000., "maxGap", owner, maxGap, "in (0, 1000]");
}

vpMotionObserver::vpMotionObserver(const vpMotionObserverSpec &spec) : m_spec(spec)
{
  spec.validate();
  reset();
}

void vpMotionObserver::reset(double time, double position) noexcept
{
  if (!vpIsPlausible(time) || !vpIsPlausible(position)) {
    return;
  }
  m_belief = Belief();
  m_refused = 0;
  m_belief.time = time;
  m_belief.x[Place] = position;
  m_belief.P.diagonal() << m_spec.sigmaPosition * m_spec.sigmaPosition, m_spec.sigmaVelocity * m_spec.sigmaVelocity, 0.,
      m_spec.sigmaDisturbance * m_spec.sigmaDisturbance;
  m_count = m_changeCount = 0;
  m_lean.setZero();
}

bool vpMotionObserver::command(double time, double force) noexcept
{
  if (!vpIsPlausible(time) || !vpIsPlausible(force) || time > m_belief.time + m_spec.maxGap ||
      (m_count > 0 && time < m_commands[static_cast<std::size_t>(m_count - 1)].time)) {
    return false;
  }
  if (m_count == capacity) {
    std::move(m_commands.begin() + 1, m_commands.end(), m_commands.begin());
    --m_count;
  }
  m_commands[static_cast<std::size_t>(m_count)] = {time, force};
  ++m_count;
  return true;
}

// The command acting at a time, and its end.
double vpMotionObserver::commandAt(double time, double &until) const noexcept
{
  until = std::numeric_limits<double>::infinity();
  double force = 0.;
  for (int i = m_count - 1; i >= 0; --i) {
    const Command &c = m_commands[static_cast<std::size_t>(i)];
    const double begin = c.time + m_spec.delay;
    if (begin <= time + 1e-12) {
      force = c.force;
      break;
    }
    until = begin;
  }
  return force;
}

double vpMotionObserver::acceleration(const Eigen::Vector4d &x) const noexcept
{
  const double drive = x[Force] - x[Disturbance];
  if (x[Velocity] == 0.) { // held by stiction, or about to move
    const double held = std::max(m_spec.model.stiction, m_spec.model.coulomb);
    return std::fabs(drive) <= held ? 0. : (drive - std::copysign(held, drive)) / m_spec.model.mass;
  }
  return (drive - m_spec.model.friction(x[Velocity])) / m_spec.model.mass;
}

// One part of an integration step: the lag exactly, the rest by the midpoint rule.
void vpMotionObserver::part(Belief &b, double command, double h, Eigen::Matrix4d *transition) const noexcept
{
  const double decay = m_spec.lag > 0. ? std::exp(-h / m_spec.lag) : 0.;
  const double share = m_spec.lag > 0. ? (1. - decay) * m_spec.lag / h : 0.; // mean share of the old force
  const double v = b.x[Velocity];
  Eigen::Vector4d x = b.x;
  x[Force] = command + (b.x[Force] - command) * share; // mean over the part
  const double first = acceleration(x);
  const bool moves = v != 0. || first != 0.;
  Eigen::Vector4d middle = x;
  middle[Velocity] += 0.5 * h * first;
  const bool turned = v != 0. && middle[Velocity] * v <= 0.;
  double next = turned ? 0. : v + h * acceleration(middle);
  if (v != 0. && next * v <= 0.) {
    next = 0.; // comes to rest
  }
  b.x[Place] += 0.5 * h * (v + next);
  b.x[Velocity] = next;
  b.x[Force] = command + (b.x[Force] - command) * decay;

  const double m = m_spec.model.mass;
  const double a = moves ? 1. : 0.; // at rest neither force nor disturbance has an effect
  Eigen::Matrix4d F = Eigen::Matrix4d::Identity();
  F(Place, Velocity) = h;
  F(Place, Force) = a * 0.5 * h * h * share / m;
  F(Place, Disturbance) = -a * 0.5 * h * h / m;
  F(Velocity, Velocity) = std::exp(-h * m_spec.model.viscous / m);
  F(Velocity, Force) = a * h * share / m;
  F(Velocity, Disturbance) = -a * h / m;
  F(Force, Force) = decay;
  b.P = (F * b.P * F.transpose()).eval();
  if (transition != nullptr) {
    *transition = (F * *transition).eval();
  }
  b.P(Velocity, Velocity) += a * m_spec.velocityNoise * h;
  b.P(Disturbance, Disturbance) += m_spec.disturbanceNoise * h;
  b.time += h;
}

void vpMotionObserver::advance(Belief &b, double time, Eigen::Matrix4d *transition) const noexcept
{
  const double end = std::min(time, b.time + m_spec.maxGap);
  while (end - b.time > 1e-12) {
    double until = 0.;
    const double command = commandAt(b.time, until);
    const double span = std::min(end, until) - b.time;
    const int parts = std::max(1, static_cast<int>(std::ceil(span / longestPart)));
    for (int i = 0; i < parts; ++i) {
      part(b, command, span / parts, transition);
    }
  }
  b.time = std::max(b.time, end);
}

vpMotionReadingResult vpMotionObserver::measure(double time, double position, double sigma) noexcept
{
  if (!vpIsPlausible(time) || !vpIsPlausible(position) || !vpIsPlausibleDeviation(sigma)) {
    return vpMotionReadingResult::Invalid;
  }
  if (time < m_belief.time) {
    return vpMotionReadingResult::TooLate;
  }
  if (time > m_belief.time + m_spec.maxGap) {
    return vpMotionReadingResult::ImplausibleTime;
  }
  const vpMotionObserver before = *this;
  const vpMotionReadingResult result = take(time, position, sigma);
  if (!isSound()) { // a measurement that would make the state invalid is rejected
    *this = before;
    return vpMotionReadingResult::Invalid;
  }
  return result;
}

bool vpMotionObserver::isSound() const noexcept
{
  return (m_belief.x.array().abs() <= largestState).all() && (m_lean.array().abs() <= largestState).all() &&
         (m_belief.P.array().abs() <= largestState * largestState).all() &&
         std::all_of(m_changes.begin(), m_changes.begin() + m_changeCount, [](const Change &change) {
           return (change.response.array().abs() <= largestState).all() && change.information <= largestState &&
                  std::fabs(change.score) <= largestState;
         });
}

vpMotionReadingResult vpMotionObserver::take(double time, double position, double sigma) noexcept
{
  Eigen::Matrix4d transition = Eigen::Matrix4d::Identity();
  advance(m_belief, time, &transition);
  for (int i = 0; i < m_changeCount; ++i) {
    Change &change = m_changes[static_cast<std::size_t>(i)];
    change.response = (transition * change.response).eval();
  }
  const double innovation = position - m_belief.x[Place];
  const double expected2 = m_belief.P(Place, Place) + sigma * sigma;
  if (!(innovation * innovation <= m_spec.gate * m_spec.gate * expected2)) {
    if (++m_refused < patience) {
      return vpMotionReadingResult::Outlier;
    }
    // Not outliers: the model is wrong, for example because friction changed. Inflate the covariance instead.
    m_belief.P(Place, Place) += innovation * innovation;
    m_belief.P(Velocity, Velocity) += innovation * innovation / (patience * patience);
    m_belief.P(Disturbance, Disturbance) += m_spec.sigmaDisturbance * m_spec.sigmaDisturbance;
  }
  m_refused = 0;
  const double S = std::max(0., m_belief.P(Place, Place)) + sigma * sigma;
  const Eigen::Vector4d K = m_belief.P.col(Place) / S;
  m_belief.x += K * innovation;
  Eigen::Matrix4d rest = Eigen::Matrix4d::Identity();
  rest.col(Place) -= K;
  const Eigen::Vector4d lost = rounding * m_belief.P.diagonal();
  m_belief.P = (rest * m_belief.P * rest.transpose() + sigma * sigma * K * K.transpose()).eval();
  m_belief.P.diagonal() += lost;
  lookForChange(innovation, S, K);
  return vpMotionReadingResult::Used;
}

// Friction may have changed at any of the last measurements. Each hypothesis has the response of the estimation error
// to a unit change, and from it the evidence of the later innovations about the size of the change.
void vpMotionObserver::lookForChange(double innovation, double S, const Eigen::Vector4d &K) noexcept
{
  m_lean.setZero();
  if (!(m_spec.changeRate > 0.)) {
    return;
  }
  const double prior = 1. / (m_spec.sigmaDisturbance * m_spec.sigmaDisturbance);
  double odds = 0.; // odds of any change against none
  for (int i = 0; i < m_changeCount; ++i) {
    Change &change = m_changes[static_cast<std::size_t>(i)];
    const double g = change.response[Place];
    change.information += g * g / S;
    change.score += g * innovation / S;
    change.response -= K * g;
    const double certain = change.information + prior;
    const double evidence = m_spec.changeRate * std::sqrt(prior / certain) *
                            std::exp(std::min(300., 0.5 * change.score * change.score / certain));
    odds += evidence;
    m_lean += evidence * change.score / certain * change.response;
    change.evidence = evidence;
  }
  m_lean /= 1. + odds;
  if (odds > certainOdds) {
    takeChange();
  }
  if (m_changeCount == window) {
    std::move(m_changes.begin() + 1, m_changes.end(), m_changes.begin());
    --m_changeCount;
  }
  Change &next = m_changes[static_cast<std::size_t>(m_changeCount++)];
  next = Change();
  next.response[Disturbance] = 1.;
}

// The state takes over the most likely change, and the remaining uncertainty of its size.
void vpMotionObserver::takeChange() noexcept
{
  const Change &change = *std::max_element(m_changes.begin(), m_changes.begin() + m_changeCount,
                                           [](const Change &a, const Change &b) { return a.evidence < b.evidence; });
  const double certain = change.information + 1. / (m_spec.sigmaDisturbance * m_spec.sigmaDisturbance);
  m_belief.x += change.response * (change.score / certain);
  m_belief.P += change.response * change.response.transpose() / certain;
  m_lean.setZero();
  m_changeCount = 0;
}

vpObservedMotion vpMotionObserver::at(double time) const noexcept
{
  Belief b = m_belief;
  b.x += m_lean;
  if (!std::isnan(time)) {
    advance(b, time);
  }
  vpObservedMotion motion;
  motion.time = b.time;
  motion.asAsked = time >= m_belief.time && time <= m_belief.time + m_spec.maxGap;
  motion.position = b.x[Place];
  motion.velocity = b.x[Velocity];
  motion.acceleration = acceleration(b.x);
  motion.force = b.x[Force];
  motion.disturbance = b.x[Disturbance];
  motion.sigmaPosition = std::sqrt(std::max(0., b.P(Place, Place)));
  motion.sigmaVelocity = std::sqrt(std::max(0., b.P(Velocity, Velocity)));
  return motion;
}

END_VISP_NAMESPACE
