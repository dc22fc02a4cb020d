/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpViaProblems.h
 * \brief Random motions of seven axes through vias whose times are not given, and those along a spline as their peer.
 */
#ifndef vpViaProblems_h
#define vpViaProblems_h

#include "vpTimeOptimalPath.h"

#include <visp3/trajectory/vpTrajectoryInput.h>

#include <random>

namespace vpViaProblems
{
VISP_DIRECT_USING_NAMESPACE

constexpr int axes = 7;

//! From rest to rest through \e vias points between -1 and 1 rad, within 2 rad/s and 5 rad/s^2.
inline vpTrajectoryInput<axes> random(std::mt19937_64 &rng, int vias)
{
  std::uniform_real_distribution<double> place(-1., 1.);
  vpTrajectoryInput<axes> input;
  input.maxVelocity.setConstant(2.);
  input.maxAcceleration.setConstant(5.);
  input.vias.resize(static_cast<std::size_t>(vias));
  for (int i = 0; i < axes; ++i) {
    input.start.q[i] = place(rng);
    input.goal.q[i] = place(rng);
    for (auto &via : input.vias) {
      via.q[i] = place(rng);
    }
  }
  return input;
}

//! Duration of the time-optimal motion along the spline through the same points, s.
inline double peerDuration(const vpTrajectoryInput<axes> &input, int intervals)
{
  const auto vias = static_cast<Eigen::Index>(input.vias.size());
  Eigen::MatrixXd points(vias + 2, axes);
  points.row(0) = input.start.q.transpose();
  for (Eigen::Index k = 0; k < vias; ++k) {
    points.row(k + 1) = input.vias[static_cast<std::size_t>(k)].q.transpose();
  }
  points.row(vias + 1) = input.goal.q.transpose();
  return vpTimeOptimalPath::duration(vpTimeOptimalPath::Spline(points), input.maxVelocity, input.maxAcceleration,
                                     intervals);
}

//! tau in proportion to the way, as a user would guess.
inline void setTimesByWay(vpTrajectoryInput<axes> &input)
{
  std::vector<double> way;
  double passed = 0.;
  vpAxisVector<axes> last = input.start.q;
  for (const auto &via : input.vias) {
    way.push_back(passed += (via.q - last).norm());
    last = via.q;
  }
  for (std::size_t k = 0; k < way.size(); ++k) {
    input.vias[k].tau = way[k] / (passed + (input.goal.q - last).norm());
  }
}
} // namespace vpViaProblems

#endif
