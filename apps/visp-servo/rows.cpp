/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "rows.h"

#include <algorithm>
#include <cmath>

namespace visualServo
{
std::array<double, 6> deviationsOf(const vpPoseCovariance &covariance) noexcept
{
  std::array<double, 6> sigma{};
  for (std::size_t i = 0; i < 6; ++i) {
    sigma[i] = covariance.known ? std::sqrt(covariance(i, i)) : NOTHING;
  }
  return sigma;
}

CycleRow rowOf(const vpVisualServo &servo, const vpServoRobotState &state, bool tellsPose, double time,
               double stepTime) noexcept
{
  const vpVisualServoOutput &out = servo.output();
  const vpServoMeasurement &seen = servo.measurement();
  CycleRow row;
  row.time = time;
  row.status = out.status;
  row.servo = out.servo;
  row.message = out.message;
  row.obstacle = out.obstacle;
  row.hasPose = seen.valid;
  row.sigma.fill(NOTHING);
  if (seen.valid) {
    row.cMo = vpRigidTransform::fromHomogeneous(seen.cMo);
    row.sigma = deviationsOf(seen.covariance);
  }
  row.positionError = out.positionError;
  row.rotationError = out.rotationError;
  row.age = out.age;
  row.speedFactor = out.speedFactor;
  row.distance = out.distance;
  row.distanceSigma = out.distanceSigma;
  row.twist = out.twist;
  row.joints = static_cast<int>(std::min(out.velocity.size(), state.q.size()));
  std::copy_n(state.q.data(), row.joints, row.q.begin());
  std::copy_n(out.velocity.data(), row.joints, row.velocity.begin());
  row.hasCamera = tellsPose && state.valid && row.joints == 0;
  row.fMc = state.pose;
  row.stepTime = stepTime;
  return row;
}
} // namespace visualServo
