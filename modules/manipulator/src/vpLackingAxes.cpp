/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpLackingAxes.h"

#include <Eigen/LU>

#include <algorithm>
#include <random>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr int samples = 4;
constexpr unsigned int allAxes = 63;

int rankOf(const vpArmJacobian &J, unsigned int axes)
{
  vpArmJacobian rows = J;
  for (int k = 0; k < 6; ++k) {
    if ((axes >> k & 1U) == 0U) {
      rows.row(k).setZero();
    }
  }
  Eigen::FullPivLU<vpArmJacobian> lu(rows);
  lu.setThreshold(1e-9);
  return static_cast<int>(lu.rank());
}

int bits(unsigned int axes)
{
  int count = 0;
  for (; axes != 0U; axes &= axes - 1U) {
    ++count;
  }
  return count;
}
} // namespace

vpLackTable vpLackingAxes(const vpArmModel &model)
{
  vpLackTable lack{};
  std::array<int, 192> rank{};
  std::mt19937_64 rng(1);
  for (int sample = 0; sample < samples; ++sample) {
    vpJointVector q(model.size());
    for (int i = 0; i < model.size(); ++i) {
      const double lower = model.isContinuous(i) ? -3. : model.lower()(i);
      const double upper = model.isContinuous(i) ? 3. : model.upper()(i);
      q(i) = lower + std::uniform_real_distribution<double>(0., 1.)(rng) * (upper - lower);
    }
    vpArmData data;
    vpArmKinematics::update(model, q, data);
    bool isFull = true; // in all frames: the end effector and the camera may be on different links
    for (const vpArmFrame frame : {vpArmFrame::Base, vpArmFrame::EndEffector, vpArmFrame::Camera}) {
      const vpArmJacobian J = vpArmKinematics::geometric(model, data, frame);
      int *const most = &rank[64U * static_cast<unsigned int>(frame)];
      if (rankOf(J, allAxes) == 6) {
        for (unsigned int axes = 0; axes <= allAxes; ++axes) {
          most[axes] = bits(axes);
        }
        continue;
      }
      isFull = false;
      for (unsigned int axes = 0; axes <= allAxes; ++axes) {
        most[axes] = std::max(most[axes], rankOf(J, axes));
      }
    }
    if (isFull) {
      return lack;
    }
  }
  for (unsigned int i = 0; i < lack.size(); ++i) {
    lack[i] = static_cast<std::uint8_t>(bits(i & allAxes) - rank[i]);
  }
  return lack;
}

END_VISP_NAMESPACE
