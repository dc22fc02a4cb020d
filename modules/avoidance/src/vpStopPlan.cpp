/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpStopPlan.h"

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

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

END_VISP_NAMESPACE
