/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpServoPlantOfTests.h
 * \brief A camera with lag, friction and noisy vision, for the tests of the laws in a closed loop.
 */
#ifndef vpServoPlantOfTests_h
#define vpServoPlantOfTests_h

#include "vpServoScene.h"

namespace vpServoPlantOfTests
{
using namespace vpServoScene;

constexpr double degree = M_PI / 180.;

//! Robot and vision of plants B and D of the comparison, as seen by the law: 100 Hz loop, vision error updated at
//! 10 Hz, velocity lag 30 ms, and a rotational deadband for friction.
class Plant
{
public:
  Plant(const vpHomogeneousMatrix &start, double deadband, std::uint64_t seed)
    : m_cMo(start), m_deadband(deadband), m_rng(seed)
  {}

  double rotationNoise = 0.05 * degree; //!< Standard deviation of the angle, rad, about a random axis.
  double positionNoise = 3e-4;          //!< Standard deviation of the position, m.

  const vpHomogeneousMatrix &cMo() const { return m_cMo; }

  //! \e bias : A rotation added by the vision in this frame.
  void measure(const std::vector<Eigen::Vector3d> &points, vpServoMeasurement &measurement,
               const Eigen::Matrix3d &bias = Eigen::Matrix3d::Identity())
  {
    if (m_cycle++ % 10 == 0) {
      std::normal_distribution<double> gauss;
      m_error =
          pose(turn(rotationNoise * gauss(m_rng), direction(m_rng)), positionNoise * gauss(m_rng) * direction(m_rng));
    }
    vpServoScene::measure(pose(bias, Eigen::Vector3d::Zero()) * m_error * m_cMo, points, measurement);
  }

  void run(const vpTwist &v)
  {
    for (std::size_t k = 0; k < 6; ++k) {
      const double w = k < 3 ? v[k] : std::copysign(std::max(std::abs(v[k]) - m_deadband, 0.), v[k]);
      m_actual[k] += (w - m_actual[k]) * (1. - std::exp(-0.01 / 0.03));
    }
    m_cMo = move(m_cMo, m_actual, 0.01);
  }

private:
  vpHomogeneousMatrix m_cMo, m_error;
  double m_deadband;
  std::mt19937_64 m_rng;
  vpTwist m_actual;
  int m_cycle = 0;
};

//! Camera at (x, 0, z) of the first pose, facing the object, which is 0.47 m in front of that.
inline vpHomogeneousMatrix facing(double x, double z)
{
  const Eigen::Matrix3d R = turn(std::atan2(-x, 0.47 - z), Eigen::Vector3d::UnitY());
  return pose(R, {x, 0., z}).inverse() * pose(Eigen::Matrix3d::Identity(), {0., 0., 0.47});
}
} // namespace vpServoPlantOfTests

#endif
