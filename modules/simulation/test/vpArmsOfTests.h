/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The arms of the tests: AMOR, six axes by URDF, and a single joint whose motion is known in closed form.
#ifndef vpArmsOfTests_h
#define vpArmsOfTests_h

#include <visp3/manipulator/vpArmJson.h>
#include <visp3/manipulator/vpArmUrdf.h>

#include <random>
#include <string>

VISP_DIRECT_USING_NAMESPACE

namespace vpArmsOfTests
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
    vpArmUrdfOptions options;
    options.tip = "tool";
    options.camera = "camera";
    options.acceleration = 12.;
    return vpLoadArmUrdf(std::string(VISP_DIRECT_DATA_DIR) + "/robot/generic-6r.urdf", options);
  }();
  return model;
}

//! Turns about the vertical: no gravity, no coupling. Inertia 0.5 kg m^2, viscous 0.8 Nm s/rad, Coulomb 0.6 Nm.
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

inline double uniform(std::mt19937_64 &rng, double from, double to)
{
  return std::uniform_real_distribution<double>(from, to)(rng);
}

//! Within the limits, away from them by a share of the range.
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
} // namespace vpArmsOfTests
#endif
