/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/printing/vpFrictionModel.h>

#include "vpPrintingCheck.h"

BEGIN_VISP_NAMESPACE

using namespace vpPrintingCheck;

double vpFrictionModel::friction(double velocity) const noexcept
{
  if (velocity == 0.) {
    return 0.;
  }
  const double ratio = velocity / stribeckVelocity;
  return viscous * velocity + std::copysign(coulomb + (stiction - coulomb) * std::exp(-ratio * ratio), velocity);
}

double vpFrictionModel::force(double velocity, double acceleration) const noexcept
{
  return mass * acceleration + friction(velocity);
}

void vpFrictionModel::validate(const char *owner) const
{
  positive("mass", owner, mass);
  notNegative("viscous", owner, viscous);
  notNegative("coulomb", owner, coulomb);
  notNegative("stiction", owner, stiction);
  positive("stribeckVelocity", owner, stribeckVelocity);
}

END_VISP_NAMESPACE
