/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpJointCheck.h"

#include <visp3/manipulator/vpJointFriction.h>

#include <cmath>

BEGIN_VISP_NAMESPACE

vpJointFriction vpJointFriction::of(const vpArmModel &model)
{
  vpJointFriction friction;
  friction.viscous.resize(model.size());
  friction.coulomb.resize(model.size());
  for (int i = 0; i < model.size(); ++i) {
    friction.viscous(i) = model.spec().joints[static_cast<std::size_t>(i)].viscous;
    friction.coulomb(i) = model.spec().joints[static_cast<std::size_t>(i)].coulomb;
  }
  return friction;
}

bool vpJointFriction::torque(const vpJointVector &velocity, vpJointVector &result) const noexcept
{
  result.setZero(viscous.size());
  if (velocity.size() != viscous.size() || !vpIsPlausibleForArm(velocity)) {
    return false;
  }
  for (int i = 0; i < viscous.size(); ++i) {
    result(i) = viscous(i) * velocity(i) + coulomb(i) * std::tanh(velocity(i) / smoothing);
  }
  if (!result.allFinite()) {
    result.setZero();
    return false;
  }
  return true;
}

void vpJointFriction::validate(int size) const
{
  vpJointCheck::notNegative("viscous", "joint friction", viscous, size);
  vpJointCheck::notNegative("coulomb", "joint friction", coulomb, size);
  vpJointCheck::positive("smoothing", "joint friction", smoothing);
}

END_VISP_NAMESPACE
