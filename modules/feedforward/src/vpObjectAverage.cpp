/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpServoCheck.h"

#include <visp3/feedforward/vpObjectAverage.h>

#include <visp3/core/vpException.h>

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
// An image is an outlier beyond this multiple of the scatter, and these distances (m, rad): so many in a row show that
// the object was moved. The scatter is known from a few images on.
constexpr double outlierDeviations = 5., outlierLeast = 0.01, outlierLeastTurn = 0.03;
constexpr int outliersInARow = 3, imagesForScatter = 4;
} // namespace

vpObjectAverage::vpObjectAverage(int window) : m_window(window)
{
  if (window < 1) {
    throw vpException(vpException::badValue, "the window of the object average is %d images, must be >= 1", window);
  }
}

void vpObjectAverage::reset() noexcept { *this = vpObjectAverage(m_window); }

void vpObjectAverage::move(const vpTwist &twist, double dt) noexcept
{
  const vpServoPose::Pose next =
      vpServoPose::moved({m_fRc, m_ftc}, vpServoPose::linear(twist), vpServoPose::angular(twist), dt);
  if (next.R.allFinite() && next.t.allFinite()) {
    m_fRc = next.R;
    m_ftc = next.t;
  }
}

bool vpObjectAverage::see(const vpServoMeasurement &measurement) noexcept
{
  if (!measurement.valid || !vpServoCheck::isPose(measurement.cMo) ||
      (m_seen && measurement.time == m_time && m_time != 0.)) {
    return false;
  }
  m_seen = true;
  m_time = measurement.time;
  const vpServoPose::Pose seen = vpServoPose::Pose{m_fRc, m_ftc} * vpServoPose::pose(measurement.cMo);
  const Eigen::Vector3d shift = seen.t - m_fto, turn = vpSO3::log(m_fRo.transpose() * seen.R);
  const double beyond = std::max(shift.norm() / std::max(outlierDeviations * std::sqrt(m_spread), outlierLeast),
                                 turn.norm() / std::max(outlierDeviations * std::sqrt(m_turnSpread), outlierLeastTurn));
  m_outliers = m_count >= imagesForScatter && beyond > 1. ? m_outliers + 1 : 0;
  if (m_count == 0 || m_outliers >= outliersInARow) {
    m_fRo = seen.R;
    m_fto = seen.t;
    m_spread = m_turnSpread = 0.;
    m_outliers = 0;
    m_count = 1;
    return true;
  }
  if (m_outliers == 0) {
    const double gain = 1. / std::min(m_count + 1, m_window), share = 1. / std::min(m_count, m_window);
    m_fto += gain * shift;
    m_fRo = Eigen::Quaterniond(m_fRo * vpSO3::exp(gain * turn)).normalized().toRotationMatrix();
    m_spread += share * (shift.squaredNorm() - m_spread);
    m_turnSpread += share * (turn.squaredNorm() - m_turnSpread);
    m_count = std::min(m_count + 1, 1000000);
  }
  return true;
}

void vpObjectAverage::predict(vpServoMeasurement &measurement) const noexcept
{
  if (!measurement.valid || m_count == 0) {
    return;
  }
  const vpServoPose::Pose cMo = vpServoPose::Pose{m_fRc, m_ftc}.inverse() * vpServoPose::Pose{m_fRo, m_fto};
  for (unsigned int r = 0; r < 3; ++r) {
    for (unsigned int c = 0; c < 3; ++c) {
      measurement.cMo[r][c] = cMo.R(r, c);
    }
    measurement.cMo[r][3] = cMo.t[r];
  }
}

END_VISP_NAMESPACE
