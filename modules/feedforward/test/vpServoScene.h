/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpServoScene.h
 * \brief For the tests: a planar object, a camera that executes the twist exactly, and random poses for both; and a
 * camera with lag, friction and noisy vision, for the laws in a closed loop.
 */
#ifndef vpServoScene_h
#define vpServoScene_h

#include "vpCatch.h"

#include <visp3/core/vpExponentialMap.h>
#include <visp3/feedforward/vpServoLaw.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

VISP_DIRECT_USING_NAMESPACE

namespace vpServoScene
{
//! Camera of the comparison: 640x480 px, f = 800 px.
constexpr double halfWidth = 0.4, halfHeight = 0.3;

inline vpHomogeneousMatrix pose(const Eigen::Matrix3d &R, const Eigen::Vector3d &t)
{
  vpHomogeneousMatrix M;
  for (unsigned int i = 0; i < 3; ++i) {
    for (unsigned int k = 0; k < 3; ++k) {
      M[i][k] = R(i, k);
    }
    M[i][3] = t[i];
  }
  return M;
}

inline Eigen::Matrix3d rotation(const vpHomogeneousMatrix &M)
{
  Eigen::Matrix3d R;
  R << M[0][0], M[0][1], M[0][2], M[1][0], M[1][1], M[1][2], M[2][0], M[2][1], M[2][2];
  return R;
}

inline Eigen::Vector3d translation(const vpHomogeneousMatrix &M) { return {M[0][3], M[1][3], M[2][3]}; }

using vpTestSupport::uniform;

inline Eigen::Vector3d direction(std::mt19937_64 &rng)
{
  std::normal_distribution<double> gauss;
  return Eigen::Vector3d(gauss(rng), gauss(rng), gauss(rng)).normalized();
}

//! A twist of the given speeds in any direction.
inline vpTwist randomTwist(std::mt19937_64 &rng, double linear, double angular)
{
  const Eigen::Vector3d v = linear * direction(rng), w = angular * direction(rng);
  return {v.x(), v.y(), v.z(), w.x(), w.y(), w.z()};
}

inline Eigen::Matrix3d turn(double angle, const Eigen::Vector3d &axis)
{
  return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

//! The laws whose twist follows from the measurement of the cycle alone.
inline std::vector<std::string> lawsWithoutPlan()
{
  std::vector<std::string> ids = vpServoLaw::ids();
  const auto plans = [](const std::string &id) { return vpServoLaw::create(id)->plansMotion(); };
  ids.erase(std::remove_if(ids.begin(), ids.end(), plans), ids.end());
  return ids;
}

//! Object points in the plane z = 0: the corners of a square first, then others; \e size is the side, m.
inline std::vector<Eigen::Vector3d> object(std::mt19937_64 &rng, double size, int count)
{
  std::vector<Eigen::Vector3d> points;
  const double h = 0.5 * size;
  for (const Eigen::Vector2d &corner :
       {Eigen::Vector2d(-h, -h), Eigen::Vector2d(h, -h), Eigen::Vector2d(h, h), Eigen::Vector2d(-h, h)}) {
    points.emplace_back(corner.x(), corner.y(), 0.);
  }
  while (static_cast<int>(points.size()) < count) {
    points.emplace_back(uniform(rng, -h, h), uniform(rng, -h, h), 0.);
  }
  points.resize(count);
  return points;
}

//! Measurement of an ideal camera; points behind it or beyond 80 deg are not visible.
inline void project(const vpHomogeneousMatrix &cMo, const std::vector<Eigen::Vector3d> &object,
                    std::vector<vpServoPoint> &points)
{
  points.resize(object.size());
  const Eigen::Matrix3d R = rotation(cMo);
  for (std::size_t i = 0; i < object.size(); ++i) {
    const Eigen::Vector3d P = R * object[i] + translation(cMo);
    points[i].visible = P.z() > 0.17 * P.norm();
    if (points[i].visible) {
      points[i] = {P.x() / P.z(), P.y() / P.z(), P.z(), true};
    }
  }
}

inline vpServoGoal goal(const vpHomogeneousMatrix &cdMo, const std::vector<Eigen::Vector3d> &object)
{
  vpServoGoal result;
  result.cdMo = cdMo;
  project(cdMo, object, result.points);
  return result;
}

inline void measure(const vpHomogeneousMatrix &cMo, const std::vector<Eigen::Vector3d> &object,
                    vpServoMeasurement &measurement)
{
  measurement.valid = true;
  measurement.cMo = cMo;
  project(cMo, object, measurement.points);
  measurement.outline = measurement.points; // the first four are the corners
  measurement.outline.resize(std::min<std::size_t>(4, measurement.points.size()));
}

//! The pose after moving with a constant twist for \e dt: exponential map, exact.
inline vpHomogeneousMatrix move(const vpHomogeneousMatrix &cMo, const vpTwist &v, double dt)
{
  return vpExponentialMap::direct(v.toColVector(), dt).inverse() * cMo;
}

//! True if all points lie within the borders of the image.
inline bool inView(const std::vector<vpServoPoint> &points)
{
  for (const vpServoPoint &p : points) {
    if (!p.visible || std::abs(p.x) > halfWidth || std::abs(p.y) > halfHeight) {
      return false;
    }
  }
  return true;
}

//! Pose of an object that faces the camera more or less, with its origin at the given distance and bearing.
inline vpHomogeneousMatrix randomPose(std::mt19937_64 &rng, double near, double far, double bearing, double tilt)
{
  const double z = uniform(rng, near, far), azimuth = uniform(rng, 0., 2. * M_PI);
  const double r = z * std::tan(uniform(rng, 0., bearing));
  const Eigen::Vector3d t(r * std::cos(azimuth), r * std::sin(azimuth), z);
  return pose(turn(uniform(rng, 0., tilt), direction(rng)), t);
}

//! Angle of cdMc, rad.
inline double rotationError(const vpHomogeneousMatrix &cdMo, const vpHomogeneousMatrix &cMo)
{
  return Eigen::AngleAxisd(rotation(cdMo) * rotation(cMo).transpose()).angle();
}

//! Length of the translation of cdMc, m.
inline double translationError(const vpHomogeneousMatrix &cdMo, const vpHomogeneousMatrix &cMo)
{
  return translation(cdMo * cMo.inverse()).norm();
}
} // namespace vpServoScene

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
