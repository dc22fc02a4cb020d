/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The arms of the tests as vpArmModel, and random configurations.
#ifndef vpArmTestKit_h
#define vpArmTestKit_h

#include "vpTestArms.h"

#include <visp3/manipulator/vpArmKinematics.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <vector>

VISP_DIRECT_USING_NAMESPACE

namespace vpArmTestKit
{
using namespace vpTestArms;

inline std::string dataFile(const std::string &name) { return std::string(VISP_DIRECT_DATA_DIR) + "/robot/" + name; }

//! Revolute, prismatic, revolute, prismatic, in skew frames: for cases not covered by the two arms.
inline const vpArmModel &mixed()
{
  static const vpArmModel model = [] {
    vpArmSpec spec;
    spec.name = "mixed";
    for (int i = 0; i < 4; ++i) {
      vpArmJointSpec joint = vpArmJointSpec::standardDH(0.2 - 0.05 * i, 0.7 + 0.4 * i, 0.1 * i, 0.3);
      joint.before.R = Eigen::AngleAxisd(0.4 * i, Eigen::Vector3d(1., 2., -1.).normalized()).toRotationMatrix();
      joint.name = "m" + std::to_string(i);
      joint.type = i % 2 == 1 ? vpJointType::Prismatic : vpJointType::Revolute;
      joint.lower = -0.8;
      joint.upper = 1.;
      joint.velocity = 1.;
      joint.acceleration = 5.;
      spec.joints.push_back(joint);
      vpArmLinkSpec link;
      link.name = "l" + std::to_string(i);
      link.hasMass = true;
      link.mass = 1. + i;
      link.com << 0.03 * i, -0.05, 0.02;
      link.inertia = Eigen::Vector3d(0.02, 0.03, 0.025).asDiagonal();
      spec.links.push_back(link);
    }
    spec.tool.p << 0.02, 0.03, 0.1;
    spec.camera.p << 0.05, 0., -0.02;
    spec.camera.R = Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitY()).toRotationMatrix();
    return vpArmModel(spec);
  }();
  return model;
}

//! The three fixed arms, and random ones with followers, end effector and camera on any link.
inline std::vector<vpArmModel> fixedAndLinkedArms(std::mt19937_64 &rng)
{
  std::vector<vpArmModel> arms = {amor(), sixAxes(), mixed()};
  for (int i = 0; i < 50; ++i) {
    arms.push_back(randomLinkedArm(rng));
  }
  return arms;
}

inline vpJointVector vector(std::initializer_list<double> values)
{
  vpJointVector v(static_cast<Eigen::Index>(values.size()));
  Eigen::Index i = 0;
  for (const double value : values) {
    v(i++) = value;
  }
  return v;
}

//! The note's home of AMOR.
inline vpJointVector home() { return vector({.246, .868, -1.237, -2.390, -2.591, -1.099, .324}); }

//! Pose error of b seen from a, in the base: position (m), then rotation vector (rad) by the closed form of small
//! angles.
inline double difference(const vpRigidTransform &a, const vpRigidTransform &b)
{
  return std::max((a.p - b.p).cwiseAbs().maxCoeff(), (a.R - b.R).cwiseAbs().maxCoeff());
}
} // namespace vpArmTestKit
#endif
