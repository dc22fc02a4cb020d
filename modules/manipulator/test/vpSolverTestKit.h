/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Inputs of the solver for tests.
#ifndef vpSolverTestKit_h
#define vpSolverTestKit_h

#include "vpArmTestKit.h"

#include <visp3/manipulator/vpRedundancySolver.h>

namespace vpSolverTestKit
{
using namespace vpArmTestKit;
using Vector6 = Eigen::Matrix<double, 6, 1>;

// Limits so wide that they do not matter.
inline vpArmModel unlimited(const vpArmModel &model)
{
  vpArmSpec spec = model.spec();
  for (vpArmJointSpec &joint : spec.joints) {
    joint.velocity = joint.acceleration = 1e6;
    joint.lower -= 100.;
    joint.upper += 100.;
  }
  return vpArmModel(spec);
}

inline vpRedundancyInput input(int n, const Vector6 &twist, vpArmFrame frame = vpArmFrame::Base)
{
  vpRedundancyInput in;
  in.twist = vpTwist(twist(0), twist(1), twist(2), twist(3), twist(4), twist(5));
  in.frame = frame;
  in.previous = vpJointVector::Zero(n);
  return in;
}

inline Vector6 randomTwist(std::mt19937_64 &rng)
{
  Vector6 v;
  for (int i = 0; i < 6; ++i) {
    v(i) = uniform(rng, -0.3, 0.3);
  }
  return v;
}

inline vpArmData at(const vpArmModel &model, const vpJointVector &q)
{
  vpArmData data;
  vpArmKinematics::update(model, q, data);
  return data;
}

inline vpJointVector randomWeights(int n, std::mt19937_64 &rng)
{
  vpJointVector w(n);
  for (int i = 0; i < n; ++i) {
    w(i) = std::exp(uniform(rng, -2., 2.));
  }
  return w;
}
} // namespace vpSolverTestKit
#endif
