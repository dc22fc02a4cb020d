/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Arms of the data folder and random configurations, for the tests of all modules that move arms.
#ifndef vpTestArms_h
#define vpTestArms_h

#include <visp3/manipulator/vpArmJson.h>
#include <visp3/manipulator/vpArmUrdf.h>

#include <Eigen/Geometry>

#include <random>
#include <string>
#include <vector>

VISP_DIRECT_USING_NAMESPACE

namespace vpTestArms
{
constexpr double pi = 3.14159265358979323846;

inline const vpArmModel &amor()
{
  static const vpArmModel model = vpLoadArmJson(std::string(VISP_DIRECT_DATA_DIR) + "/robot/amor.json");
  return model;
}

inline const vpArmModel &sixAxes()
{
  static const vpArmModel model = [] {
    vpArmUrdfSpec spec;
    spec.tip = "tool";
    spec.camera = "camera";
    spec.acceleration = 12.;
    return vpLoadArmUrdf(std::string(VISP_DIRECT_DATA_DIR) + "/robot/generic-6r.urdf", spec);
  }();
  return model;
}

inline double uniform(std::mt19937_64 &rng, double from, double to)
{
  return std::uniform_real_distribution<double>(from, to)(rng);
}

inline vpRigidTransform randomTransform(std::mt19937_64 &rng, double size)
{
  vpRigidTransform T;
  const Eigen::Vector3d axis(uniform(rng, -1., 1.), uniform(rng, -1., 1.), uniform(rng, -1., 1.));
  T.R = Eigen::AngleAxisd(uniform(rng, -pi, pi), axis.normalized()).toRotationMatrix();
  T.p << uniform(rng, -size, size), uniform(rng, -size, size), uniform(rng, -size, size);
  return T;
}

/*!
 * An arm of 2 to 5 joints and 1 to 3 followers, of any kind and at any place in skew frames, with end effector and
 * camera on any link; every link has a mass and a capsule.
 */
inline vpArmModel randomLinkedArm(std::mt19937_64 &rng)
{
  const auto below = [&rng](int count) { return std::uniform_int_distribution<int>(0, count - 1)(rng); };
  vpArmSpec spec;
  spec.name = "linked";
  const int joints = 2 + below(4), followers = 1 + below(3), links = joints + followers;
  for (int i = 0; i < joints; ++i) {
    vpArmJointSpec joint;
    joint.name = "j" + std::to_string(i);
    joint.type = below(3) == 0 ? vpJointType::Prismatic : vpJointType::Revolute;
    joint.before = randomTransform(rng, 0.2);
    joint.after = randomTransform(rng, 0.2);
    joint.offset = uniform(rng, -1., 1.);
    joint.lower = joint.type == vpJointType::Prismatic ? -0.3 : -1.5;
    joint.upper = joint.type == vpJointType::Prismatic ? 0.4 : 1.2;
    joint.velocity = 1.;
    joint.acceleration = 5.;
    spec.joints.push_back(joint);
  }
  for (int i = 0; i < followers; ++i) {
    const vpJointType type = below(3) == 0 ? vpJointType::Prismatic : vpJointType::Revolute;
    const double most = type == vpJointType::Prismatic ? 0.3 : 2., ratio = uniform(rng, 0.1, most);
    spec.followers.push_back({"f" + std::to_string(i), type, randomTransform(rng, 0.2), randomTransform(rng, 0.2),
                              below(joints), below(2) == 0 ? ratio : -ratio, uniform(rng, -1., 1.), below(joints + 1)});
  }
  for (int i = 1; i <= links; ++i) {
    vpArmLinkSpec link;
    link.name = "l" + std::to_string(i);
    link.hasMass = true;
    link.mass = uniform(rng, 0.5, 3.);
    link.com = randomTransform(rng, 0.1).p;
    link.inertia = Eigen::Vector3d(0.02, 0.03, 0.025).asDiagonal();
    spec.links.push_back(link);
    spec.capsules.push_back(
        {i, randomTransform(rng, 0.1).p, randomTransform(rng, 0.1).p, uniform(rng, 0.01, 0.05), -1});
  }
  spec.toolLink = below(2) == 0 ? -1 : 1 + below(links);
  spec.tool = randomTransform(rng, 0.1);
  spec.cameraLink = below(3) == 0 ? -1 : 1 + below(links);
  spec.camera = randomTransform(rng, 0.1);
  return vpArmModel(spec);
}

//! Random configuration inside the limits by a fraction of the range; continuous joints within +-pi.
inline vpJointVector configuration(const vpArmModel &model, std::mt19937_64 &rng, double share = 0.)
{
  vpJointVector q(model.size());
  for (int i = 0; i < model.size(); ++i) {
    const double lower = model.isContinuous(i) ? -pi : model.lower()(i);
    const double upper = model.isContinuous(i) ? pi : model.upper()(i);
    q(i) = uniform(rng, lower + share * (upper - lower), upper - share * (upper - lower));
  }
  return q;
}

inline vpJointVector randomVector(int n, std::mt19937_64 &rng)
{
  vpJointVector v(n);
  for (int i = 0; i < n; ++i) {
    v(i) = uniform(rng, -1., 1.);
  }
  return v;
}
} // namespace vpTestArms
#endif
