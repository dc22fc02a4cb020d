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
enum Index { Place, Velocity, Acceleration, MarkPlace, Offset, Scale };
constexpr int patience = 3; // so many readings beyond the gate in a row are no outliers
} // namespace

void vpMotionKalmanSpec::validate() const
{
  const char *const owner = "motion filter";
  positive("processNoise", owner, processNoise);
  positive("sigmaPosition", owner, sigmaPosition);
  positive("sigmaVelocity", owner, sigmaVelocity);
  positive("sigmaAcceleration", owner, sigmaAcceleration);
  require(gate > 0., "gate", owner, gate, "> 0");
  notNegative("maxDelay", owner, maxDelay);
  notNegative("encoderScaleSigma", owner, encoderScaleSigma);
  notNegative("encoderOffsetSigma", owner, encoderOffsetSigma);
  notNegative("encoderSlip", owner, encoderSlip);
}

vpMotionKalmanFilter::vpMotionKalmanFilter(const vpMotionKalmanSpec &spec) : m_spec(spec)
{
  spec.validate();
  reset(0.);
}

void vpMotionKalmanFilter::reset(double time, double position, double velocity) noexcept
{
  if (!std::isfinite(time) || !std::isfinite(position) || !std::isfinite(velocity)) {
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

// White acceleration or jerk, integrated exactly.
void vpMotionKalmanFilter::predict(Belief &b, double time) const noexcept
{
  const double t = time - b.time;
  if (!(t > 0.)) {
    return;
  }
  const bool accelerated = m_spec.model == vpMotionModel::ConstantAcceleration;
  Matrix F = Matrix::Identity();
  F(Place, Velocity) = t;
  if (accelerated) {
    F(Place, Acceleration) = 0.5 * t * t;
    F(Velocity, Acceleration) = t;
  }
  b.x = (F * b.x).eval();
  b.P = (F * b.P * F.transpose()).eval();
  const double q = m_spec.processNoise;
  const double t2 = t * t, t3 = t2 * t;
  if (accelerated) {
    b.P(Place, Place) += q * t2 * t3 / 20.;
    b.P(Place, Velocity) += q * t2 * t2 / 8.;
    b.P(Velocity, Place) += q * t2 * t2 / 8.;
    b.P(Place, Acceleration) += q * t3 / 6.;
    b.P(Acceleration, Place) += q * t3 / 6.;
    b.P(Velocity, Velocity) += q * t3 / 3.;
    b.P(Velocity, Acceleration) += q * t2 / 2.;
    b.P(Acceleration, Velocity) += q * t2 / 2.;
    b.P(Acceleration, Acceleration) += q * t;
  }
  else {
    b.P(Place, Place) += q * t3 / 3.;
    b.P(Place, Velocity) += q * t2 / 2.;
    b.P(Velocity, Place) += q * t2 / 2.;
    b.P(Velocity, Velocity) += q * t;
  }
  b.P(Offset, Offset) += m_spec.encoderSlip * t;
  b.time = time;
}

// The position is copied, with all its correlations.
void vpMotionKalmanFilter::mark(Belief &b) noexcept
{
  b.x[MarkPlace] = b.x[Place];
  b.P.row(MarkPlace) = b.P.row(Place).eval();
  b.P.col(MarkPlace) = b.P.col(Place).eval();
  b.marked = true;
}

vpMotionReadingResult vpMotionKalmanFilter::correct(Belief &b, const vpMotionReading &reading) const noexcept
{
  predict(b, reading.time);
  if (reading.kind == vpMotionReadingKind::Mark) {
    mark(b);
    return vpMotionReadingResult::Used;
  }
  Vector H = Vector::Zero(); // a row
  double expected = 0.;
  switch (reading.kind) {
  case vpMotionReadingKind::Displacement:
    if (!b.marked) {
      mark(b);
      return vpMotionReadingResult::NoMark;
    }
    H[Place] = 1.;
    H[MarkPlace] = -1.;
    expected = b.x[Place] - b.x[MarkPlace];
    break;
  case vpMotionReadingKind::Encoder: // the product of scale and position is linearised
    H[Place] = 1. + b.x[Scale];
    H[Offset] = 1.;
    H[Scale] = b.x[Place];
    expected = b.x[Place] * (1. + b.x[Scale]) + b.x[Offset];
    break;
  default:
    H[Place] = 1.;
    expected = b.x[Place];
  }
  const double variance = reading.sigma * reading.sigma;
  const double innovation = reading.value - expected;
  Vector PH = b.P * H;
  double S = H.dot(PH) + variance;
  const bool beyond = !(innovation * innovation <= m_spec.gate * m_spec.gate * S);
  int &refused = b.refused[static_cast<std::size_t>(reading.kind)];
  refused = beyond ? refused + 1 : 0;
  if (refused == patience) { // not outliers any more: the belief is wrong, about the encoder or about the motion
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
  vpMotionReadingResult result = vpMotionReadingResult::Outlier;
  if (innovation * innovation <= m_spec.gate * m_spec.gate * S) {
    const Vector K = PH / S;
    b.x += K * innovation;
    // Joseph's form stays positive definite.
    const Matrix rest = Matrix::Identity() - K * H.transpose();
    b.P = (rest * b.P * rest.transpose() + variance * K * K.transpose()).eval();
    result = vpMotionReadingResult::Used;
  }
  if (reading.kind == vpMotionReadingKind::Displacement) {
    mark(b); // the next displacement counts from here, used or not
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
  if (!std::isfinite(reading.time) || !std::isfinite(reading.value) || !std::isfinite(reading.sigma) ||
      !(reading.sigma > 0.)) {
    return vpMotionReadingResult::Invalid;
  }
  if (reading.time < m_settled.time || reading.time < m_newest.time - m_spec.maxDelay) {
    return vpMotionReadingResult::TooLate;
  }
  if (m_count == capacity) {
    if (reading.time < m_pending[0].time) {
      return vpMotionReadingResult::TooLate;
    }
    settleOldest();
  }
  int place = m_count; // behind all that are not later
  while (place > 0 && m_pending[static_cast<std::size_t>(place - 1)].time > reading.time) {
    m_pending[static_cast<std::size_t>(place)] = m_pending[static_cast<std::size_t>(place - 1)];
    --place;
  }
  m_pending[static_cast<std::size_t>(place)] = reading;
  ++m_count;
  vpMotionReadingResult result = vpMotionReadingResult::Used;
  if (place == m_count - 1 && m_newest.time <= reading.time) { // the usual case: the newest of all
    result = correct(m_newest, reading);
  }
  else {
    m_newest = m_settled;
    for (int i = 0; i < m_count; ++i) {
      const vpMotionReadingResult one = correct(m_newest, m_pending[static_cast<std::size_t>(i)]);
      result = i == place ? one : result;
    }
  }
  m_outliers += result == vpMotionReadingResult::Outlier ? 1 : 0;
  while (m_count > 0 && m_pending[0].time < m_newest.time - m_spec.maxDelay) {
    settleOldest();
  }
  return result;
}

vpMotionEstimate vpMotionKalmanFilter::at(double time) const noexcept
{
  // Between readings that are kept, those before the instant count; after the newest, all.
  Belief b = time >= m_newest.time ? m_newest : m_settled;
  if (time < m_newest.time) {
    for (int i = 0; i < m_count && m_pending[static_cast<std::size_t>(i)].time <= time; ++i) {
      static_cast<void>(correct(b, m_pending[static_cast<std::size_t>(i)]));
    }
  }
  predict(b, time);
  vpMotionEstimate e;
  e.time = b.time;
  e.position = b.x[Place];
  e.velocity = b.x[Velocity];
  e.acceleration = b.x[Acceleration];
  e.covariance = b.P.topLeftCorner<3, 3>();
  e.sigmaPosition = std::sqrt(b.P(Place, Place));
  e.sigmaVelocity = std::sqrt(b.P(Velocity, Velocity));
  e.sigmaAcceleration = std::sqrt(b.P(Acceleration, Acceleration));
  e.encoderOffset = b.x[Offset];
  e.encoderScale = b.x[Scale];
  e.sigmaOffset = std::sqrt(b.P(Offset, Offset));
  e.sigmaScale = std::sqrt(b.P(Scale, Scale));
  return e;
}

END_VISP_NAMESPACE
