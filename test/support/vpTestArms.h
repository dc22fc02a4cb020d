/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Arms of the data folder and random configurations, for the tests of all modules that move arms.
#ifndef vpTestArms_h
#define vpTestArms_h

#include <visp3/manipulator/vpArmJson.h>
#include <visp3/manipulator/vpArmUrdf.h>

#include <random>
#include <string>

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
