/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/printing/vpMotionKalmanFilter.h>

#include "vpPrintingCheck.h"

#include <algorithm>

BEGIN_VISP_NAMESPACE

using namespace vpPrintingCheck;

namespace
{
enum Index { Place, Velocity, Acceleration, Moved, Offset, Scale };
constexpr int patience = 3;           // consecutive readings beyond the gate that are no outliers
constexpr double largestState = 1e30; // beyond it the state is invalid: its squares would soon overflow
// Each element of a covariance has a few rounding errors relative to its terms. Noise of that size on the diagonal
// keeps it positive, whatever the ratio of the deviations of the state and of the readings.
constexpr double rounding = 1e-14;

// Rounding can make a zero variance slightly negative.
double deviation(double variance) { return std::sqrt(std::max(0., variance)); }
} // namespace

void vpMotionKalmanSpec::validate() const
{
  const char *const owner = "motion filter";
  positive("processNoise", owner, processNoise);
  positive("sigmaPosition", owner, sigmaPosition);
  positive("sigmaVelocity", owner, sigmaVelocity);
  positive("sigmaAcceleration", owner, sigmaAcceleration);
  bound("gate", owner, gate);
  notNegative("maxDelay", owner, maxDelay);
  notNegative("encoderScaleSigma", owner, encoderScaleSigma);
  notNegative("encoderOffsetSigma", owner, encoderOffsetSigma);
  notNegative("encoderSlip", owner, encoderSlip);
  positive("maxGap", owner, maxGap);
}

vpMotionKalmanFilter::vpMotionKalmanFilter(const vpMotionKalmanSpec &spec) : m_spec(spec)
{
  spec.validate();
  reset(0.);
}

void vpMotionKalmanFilter::reset(double time, double position, double velocity) noexcept
{
  if (!vpIsPlausible(time) || !vpIsPlausible(position) || !vpIsPlausible(velocity)) {
    return;
  }
  m_settled = Belief();
  m_settled.time = time;
  m_settled.x[Place] = position;
  m_settled.x[Velocity] = velocity;
  m_settled.P(Place, Place) = m_spec.sigmaPosition * m_spec.sigmaPosition;
  m_settled.P(Velocity, Velocity) = m_spec.sigmaVelocity * m_spec.sigmaVelocity;
  if (m_spec.model == vpMotionModel::ConstantAcceleration) {
    m_settled.P(Acceleration, Acceleration) = m_spec.sigmaAcceleration * m_spec.sigmaAcceleration;
  }
  m_settled.P(Offset, Offset) = m_spec.encoderOffsetSigma * m_spec.encoderOffsetSigma;
  m_settled.P(Scale, Scale) = m_spec.encoderScaleSigma * m_spec.encoderScaleSigma;
  m_newest = m_settled;
  m_count = 0;
  m_outliers = 0;
}

// White acceleration or jerk, integrated exactly. The displacement since the mark changes with the position.
void vpMotionKalmanFilter::predict(Belief &b, double time) const noexcept
{
  const double t = time - b.time;
  if (!(t > 0.)) {
    return;
  }
  const bool accelerated = m_spec.model == vpMotionModel::ConstantAcceleration;
  Matrix F = Matrix::Identity();
  Matrix Q = Matrix::Zero();
  const double q = m_spec.processNoise;
  const double t2 = t * t, t3 = t2 * t;
  for (const Index i : {Place, Moved}) {
    F(i, Velocity) = t;
    F(i, Acceleration) = accelerated ? 0.5 * t2 : 0.;
    Q(i, Velocity) = Q(Velocity, i) = accelerated ? q * t2 * t2 / 8. : q * t2 / 2.;
    Q(i, Acceleration) = Q(Acceleration, i) = accelerated ? q * t3 / 6. : 0.;
    for (const Index j : {Place, Moved}) {
      Q(i, j) = accelerated ? q * t2 * t3 / 20. : q * t3 / 3.;
    }
  }
  Q(Velocity, Velocity) = accelerated ? q * t3 / 3. : q * t;
  if (accelerated) {
    F(Velocity, Acceleration) = t;
    Q(Velocity, Acceleration) = Q(Acceleration, Velocity) = q * t2 / 2.;
    Q(Acceleration, Acceleration) = q * t;
  }
  Q(Offset, Offset) = m_spec.encoderSlip * t;
  Q.diagonal() += rounding * (F.cwiseAbs2() * b.P.diagonal());
  b.x = (F * b.x).eval();
  b.P = (F * b.P * F.transpose() + Q).eval();
  if (!b.marked) {
    clearMoved(b);
  }
  b.time = time;
}

void vpMotionKalmanFilter::clearMoved(Belief &b) noexcept
{
  b.x[Moved] = 0.;
  b.P.row(Moved).setZero();
  b.P.col(Moved).setZero();
}

void vpMotionKalmanFilter::mark(Belief &b) noexcept
{
  clearMoved(b);
  b.marked = true;
}

// Finite, and a valid covariance as far as pairs of states show.
bool vpMotionKalmanFilter::isSound(const Belief &b) noexcept
{
  if (!(b.x.array().abs() <= largestState).all() || !(b.P.array().abs() <= largestState * largestState).all()) {
    return false;
  }
  for (int i = 0; i < states; ++i) {
    for (int j = 0; j <= i; ++j) {
      if (!(b.P(i, j) * b.P(i, j) <= (1. + 1e-6) * b.P(i, i) * b.P(j, j)) || !(b.P(i, i) >= 0.)) {
        return false;
      }
    }
  }
  return true;
}

// When rounding corrupts the covariance, repeat without correlations: n diag(P) >= P. A reading after which the state
// would be invalid even so is rejected.
vpMotionReadingResult vpMotionKalmanFilter::correct(Belief &b, const vpMotionReading &reading) const noexcept
{
  const Belief before = b;
  for (const bool correlated : {true, false}) {
    if (!correlated) {
      b = before;
      b.P = (states * before.P.diagonal().cwiseMax(0.)).asDiagonal();
    }
    const vpMotionReadingResult result = resultOf(b, reading);
    if (result != vpMotionReadingResult::Invalid && isSound(b)) {
      return result;
    }
  }
  b = before;
  return vpMotionReadingResult::Invalid;
}

vpMotionReadingResult vpMotionKalmanFilter::resultOf(Belief &b, const vpMotionReading &reading) const noexcept
{
  predict(b, reading.time);
  if (reading.kind == vpMotionReadingKind::Mark) {
    mark(b);
    return vpMotionReadingResult::Used;
  }
  Vector H = Vector::Zero();       // a row
  double expected = 0., bent = 0.; // variance due to the curvature of the measurement
  switch (reading.kind) {
  case vpMotionReadingKind::Displacement:
    if (!b.marked) {
      mark(b);
      return vpMotionReadingResult::NoMark;
    }
    H[Moved] = 1.;
    expected = b.x[Moved];
    break;
  case vpMotionReadingKind::Encoder: // the product of scale and position: mean and variance to second order
    H[Place] = 1. + b.x[Scale];
    H[Offset] = 1.;
    H[Scale] = b.x[Place];
    expected = b.x[Place] * (1. + b.x[Scale]) + b.P(Place, Scale) + b.x[Offset];
    bent = b.P(Place, Place) * b.P(Scale, Scale) + b.P(Place, Scale) * b.P(Place, Scale);
    break;
  default:
    H[Place] = 1.;
    expected = b.x[Place];
  }
  const double variance = reading.sigma * reading.sigma + std::max(0., bent);
  const double innovation = reading.value - expected;
  Vector PH = b.P * H;
  double S = H.dot(PH) + variance;
  const bool beyond = !(innovation * innovation <= m_spec.gate * m_spec.gate * S);
  int &refused = b.refused[static_cast<std::size_t>(reading.kind)];
  refused = beyond ? refused + 1 : 0;
  if (refused == patience) { // not outliers: the state is wrong, about the encoder or about the motion
    if (reading.kind == vpMotionReadingKind::Encoder) {
      b.P(Offset, Offset) += innovation * innovation;
    }
    else {
      b.P.topLeftCorner<3, 3>() *= 1. + innovation * innovation / S;
    }
    refused = 0;
    PH = b.P * H;
    S = H.dot(PH) + variance;
  }
  if (!(S > 0.)) {
    return vpMotionReadingResult::Invalid;
  }
  vpMotionReadingResult result = vpMotionReadingResult::Outlier;
  if (innovation * innovation <= m_spec.gate * m_spec.gate * S) {
    const Vector K = PH / S;
    b.x += K * innovation;
    // Joseph's form stays positive definite.
    const Matrix rest = Matrix::Identity() - K * H.transpose();
    const Vector lost = rounding * b.P.diagonal();
    b.P = (rest * b.P * rest.transpose() + variance * K * K.transpose()).eval();
    b.P.diagonal() += lost;
    result = vpMotionReadingResult::Used;
  }
  if (reading.kind == vpMotionReadingKind::Displacement) {
    mark(b); // the next displacement starts here, used or not
  }
  return result;
}

void vpMotionKalmanFilter::settleOldest() noexcept
{
  static_cast<void>(correct(m_settled, m_pending[0]));
  std::move(m_pending.begin() + 1, m_pending.begin() + m_count, m_pending.begin());
  --m_count;
}

vpMotionReadingResult vpMotionKalmanFilter::add(const vpMotionReading &reading) noexcept
{
  if (!vpIsPlausible(reading.time) || !vpIsPlausible(reading.value) || !vpIsPlausibleDeviation(reading.sigma)) {
    return vpMotionReadingResult::Invalid;
  }
  const bool full = m_count == capacity;
  if (reading.time < m_settled.time || reading.time < m_newest.time - m_spec.maxDelay ||
      (full && reading.time < m_pending[0].time)) {
    return vpMotionReadingResult::TooLate;
  }
  if (reading.time > m_newest.time + m_spec.maxGap) {
    return vpMotionReadingResult::ImplausibleTime;
  }
  int place = m_count; // after all that are not later
  while (place > 0 && m_pending[static_cast<std::size_t>(place - 1)].time > reading.time) {
    --place;
  }
  Belief next = m_newest;
  vpMotionReadingResult result = vpMotionReadingResult::Used;
  if (place == m_count && m_newest.time <= reading.time) { // the usual case: the newest reading
    result = correct(next, reading);
  }
  else {
    next = m_settled;
    for (int i = 0; i <= m_count; ++i) {
      if (i == place) {
        result = correct(next, reading);
      }
      if (i < m_count) {
        static_cast<void>(correct(next, m_pending[static_cast<std::size_t>(i)]));
      }
    }
  }
  if (result == vpMotionReadingResult::Invalid) {
    return result;
  }
  if (full) {
    settleOldest();
    --place;
  }
  std::move_backward(m_pending.begin() + place, m_pending.begin() + m_count, m_pending.begin() + m_count + 1);
  m_pending[static_cast<std::size_t>(place)] = reading;
  ++m_count;
  m_newest = next;
  m_outliers += result == vpMotionReadingResult::Outlier ? 1 : 0;
  while (m_count > 0 && m_pending[0].time < m_newest.time - m_spec.maxDelay) {
    settleOldest();
  }
  return result;
}

vpMotionEstimate vpMotionKalmanFilter::at(double time) const noexcept
{
  // Between stored readings, only those before the instant count; after the newest, all.
  const bool earlier = time < m_newest.time; // false for NaN
  Belief b = earlier ? m_settled : m_newest;
  if (earlier) {
    for (int i = 0; i < m_count && m_pending[static_cast<std::size_t>(i)].time <= time; ++i) {
      static_cast<void>(correct(b, m_pending[static_cast<std::size_t>(i)]));
    }
  }
  predict(b, std::min(time, m_newest.time + m_spec.maxGap));
  vpMotionEstimate e;
  e.time = b.time;
  e.asAsked = time >= m_settled.time && time <= m_newest.time + m_spec.maxGap;
  e.position = b.x[Place];
  e.velocity = b.x[Velocity];
  e.acceleration = b.x[Acceleration];
  e.covariance = b.P.topLeftCorner<3, 3>();
  e.sigmaPosition = deviation(b.P(Place, Place));
  e.sigmaVelocity = deviation(b.P(Velocity, Velocity));
  e.sigmaAcceleration = deviation(b.P(Acceleration, Acceleration));
  e.encoderOffset = b.x[Offset];
  e.encoderScale = b.x[Scale];
  e.sigmaOffset = deviation(b.P(Offset, Offset));
  e.sigmaScale = deviation(b.P(Scale, Scale));
  return e;
}

END_VISP_NAMESPACE
