/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpStopPlan.h"

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

void planStop(const vpArmModel &arm, const vpJointVector &q, const vpJointVector &velocity, double keep,
              vpTrajectoryPlan &plan) noexcept
{
  const int n = arm.size();
  double braking = 0.;
  for (int j = 0; j < n; ++j) {
    braking = std::max(braking, std::fabs(velocity(j)) / arm.acceleration()(j));
  }
  plan.clear();
  for (int j = 0; j < n; ++j) {
    const double v = velocity(j);
    plan.begin(j, q(j), vpTrajectoryForm::Direct);
    plan.append(j, {0., v * keep}, keep);
    plan.append(j, {0., v * braking, -0.5 * v * braking}, braking);
    plan.finish(j, {q(j) + v * (keep + 0.5 * braking), 0., 0., 0.});
  }
}

END_VISP_NAMESPACE
