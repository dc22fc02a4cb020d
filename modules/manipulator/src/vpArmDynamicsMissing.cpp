/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpMissingLibrary.h"

#include <visp3/manipulator/vpArmDynamics.h>

BEGIN_VISP_NAMESPACE

class vpArmDynamics::Impl
{
};

vpArmDynamics::vpArmDynamics(const vpArmModel &, const Eigen::Vector3d &)
{
  vpMissingLibrary("vpArmDynamics", "orocos-kdl");
}
vpArmDynamics::~vpArmDynamics() = default;
vpArmDynamics::vpArmDynamics(vpArmDynamics &&) noexcept = default;
vpArmDynamics &vpArmDynamics::operator=(vpArmDynamics &&) noexcept = default;
bool vpArmDynamics::inertia(const vpJointVector &, vpJointMatrix &) { return false; }
bool vpArmDynamics::coriolis(const vpJointVector &, const vpJointVector &, vpJointVector &) { return false; }
bool vpArmDynamics::gravity(const vpJointVector &, vpJointVector &) { return false; }
bool vpArmDynamics::acceleration(const vpJointVector &, const vpJointVector &, const vpJointVector &, vpJointVector &)
{
  return false;
}

END_VISP_NAMESPACE
