/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Arms for tests: AMOR, six axes from URDF, and a single joint with a closed-form motion.
#ifndef vpArmsOfTests_h
#define vpArmsOfTests_h

#include "vpTestArms.h"

VISP_DIRECT_USING_NAMESPACE

namespace vpArmsOfTests
{
using namespace vpTestArms;

//! Rotates about the vertical: no gravity, no coupling. Inertia 0.5 kg m^2, viscous 0.8 Nm s/rad, Coulomb 0.6 Nm.
inline const vpArmModel &turntable()
{
  static const vpArmModel model = [] {
    vpArmSpec spec;
    spec.name = "turntable";
    vpArmJointSpec joint;
    joint.name = "table";
    joint.lower = -2.;
    joint.upper = 2.;
    joint.velocity = 3.;
    joint.acceleration = 10.;
    joint.rotorInertia = 0.3;
    joint.viscous = 0.8;
    joint.coulomb = 0.6;
    spec.joints.push_back(joint);
    vpArmLinkSpec link;
    link.name = "plate";
    link.hasMass = true;
    link.mass = 1.;
    link.inertia = Eigen::Vector3d(0.15, 0.15, 0.2).asDiagonal();
    spec.links.push_back(link);
    return vpArmModel(spec);
  }();
  return model;
}

} // namespace vpArmsOfTests
#endif
