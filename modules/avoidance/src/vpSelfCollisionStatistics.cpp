/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/avoidance/vpSelfCollisionStatistics.h>
#include <visp3/core/vpException.h>

#include <algorithm>
#include <random>

BEGIN_VISP_NAMESPACE

std::vector<vpSelfPairStatistics> vpSampleSelfPairs(const vpCollisionScene &scene, int samples, unsigned int seed)
{
  if (samples <= 0) {
    throw vpException(vpException::badValue, "number of samples is %d, must be > 0", samples);
  }
  std::vector<vpSelfPairStatistics> all;
  for (const vpSelfPair &pair : scene.selfPairs()) {
    all.push_back({pair, samples, 0, std::numeric_limits<double>::infinity()});
  }
  constexpr double pi = 3.14159265358979323846;
  std::mt19937_64 generator(seed);
  std::uniform_real_distribution<double> share(0., 1.);
  const vpArmModel &arm = scene.arm();
  vpCollisionData data;
  vpJointVector q(arm.size());
  for (int k = 0; k < samples; ++k) {
    for (int j = 0; j < arm.size(); ++j) {
      const double low = arm.isContinuous(j) ? -pi : arm.lower()(j), high = arm.isContinuous(j) ? pi : arm.upper()(j);
      q(j) = low + share(generator) * (high - low);
    }
    scene.place(q, data);
    for (vpSelfPairStatistics &one : all) {
      const double clearance = scene.selfPair(data, one.pair.first, one.pair.second).distance;
      one.touching += clearance <= 0. ? 1 : 0;
      one.least = std::min(one.least, clearance);
    }
  }
  return all;
}

END_VISP_NAMESPACE
