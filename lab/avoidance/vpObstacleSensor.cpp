/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "lab/avoidance/vpObstacleSensor.h"
#include "vpFieldCheck.h"

#include <visp3/core/vpException.h>
#include <visp3/direct_core/vpSO3.h>

#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr vpFieldCheck fields("the pose sensor");

Eigen::Vector3d noise(std::mt19937_64 &random, double sigma)
{
  std::normal_distribution<double> normal(0., sigma);
  const double x = normal(random), y = normal(random), z = normal(random);
  return {x, y, z};
}
} // namespace

void vpPoseSensorSpec::validate() const
{
  fields.positive("positionNoise", positionNoise, "m");
  fields.positive("angleNoise", angleNoise, "rad");
  fields.positive("range", range, "m");
  fields.in("missed", missed, {0., 1.});
}

vpPoseSensor::vpPoseSensor(const std::vector<std::string> &names, const vpPoseSensorSpec &spec, unsigned int seed)
  : m_spec(spec)
{
  spec.validate();
  for (std::size_t i = 0; i < names.size(); ++i) {
    std::seed_seq sequence{seed, static_cast<unsigned int>(i)};
    m_objects.push_back({names[i], std::mt19937_64(sequence)});
  }
}

void vpPoseSensor::look(const vpCollisionScene &truth, const vpCollisionData &arm, double time,
                        std::vector<vpObjectSighting> &result)
{
  result.clear();
  const Eigen::Vector3d viewpoint =
      m_spec.viewpoint ? *m_spec.viewpoint : vpArmKinematics::camera(truth.arm(), arm.arm).p;
  for (Object &seen : m_objects) {
    // Always drawn: an object's noise does not depend on what was seen before.
    const Eigen::Vector3d shift = noise(seen.random, m_spec.positionNoise);
    const Eigen::Vector3d turn = noise(seen.random, m_spec.angleNoise);
    const bool failed = std::uniform_real_distribution<double>(0., 1.)(seen.random) < m_spec.missed;
    const int i = truth.find(seen.name);
    if (i < 0 || failed || (truth.object(i).pose.p - viewpoint).norm() > m_spec.range) {
      continue;
    }
    vpObjectSighting sighting;
    sighting.name = seen.name;
    sighting.shape = truth.object(i).shape;
    sighting.pose = {truth.object(i).pose.R * vpSO3::exp(turn), truth.object(i).pose.p + shift};
    sighting.time = time;
    sighting.positionSigma = m_spec.positionNoise;
    sighting.angleSigma = m_spec.angleNoise;
    result.push_back(sighting);
  }
}

END_VISP_NAMESPACE
