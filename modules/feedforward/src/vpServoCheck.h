/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpServoCheck.h
 * \brief Poses as fixed-size Eigen values, and which numbers a law accepts.
 */
#ifndef vpServoCheck_h
#define vpServoCheck_h

#include <visp3/core/vpException.h>
#include <visp3/core/vpHomogeneousMatrix.h>
#include <visp3/direct_core/vpDirectCompat.h>
#include <visp3/direct_core/vpSO3.h>
#include <visp3/direct_core/vpTwist.h>
#include <visp3/feedforward/vpServoMeasurement.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include <cmath>
#include <cstddef>

BEGIN_VISP_NAMESPACE

// ViSP's poses as fixed-size Eigen values: vpHomogeneousMatrix allocates on every product.
namespace vpServoPose
{
inline Eigen::Matrix3d rotation(const vpHomogeneousMatrix &M)
{
  Eigen::Matrix3d R;
  R << M[0][0], M[0][1], M[0][2], M[1][0], M[1][1], M[1][2], M[2][0], M[2][1], M[2][2];
  return R;
}

inline Eigen::Vector3d translation(const vpHomogeneousMatrix &M) { return {M[0][3], M[1][3], M[2][3]}; }

//! A frame in another one. As cdMc it moves by R' = R [w]x and t' = R v under the camera twist (v, w).
struct Pose {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  Eigen::Vector3d t = Eigen::Vector3d::Zero();

  Pose inverse() const { return {R.transpose(), -(R.transpose() * t)}; }
  Pose operator*(const Pose &other) const { return {R * other.R, R * other.t + t}; }
};
using Error = Pose;

inline Pose pose(const vpHomogeneousMatrix &M) { return {rotation(M), translation(M)}; }

//! The pose after a constant twist (own frame) for \e dt. Normalised: hours of small rotations remain a rotation.
inline Pose moved(const Pose &pose, const Eigen::Vector3d &v, const Eigen::Vector3d &w, double dt)
{
  const Eigen::Vector3d e = dt * w;
  return {Eigen::Quaterniond(pose.R * vpSO3::exp(e)).normalized().toRotationMatrix(),
          pose.t + pose.R * (vpSO3::rightJacobian(-e) * (dt * v))};
}

inline Eigen::Vector3d linear(const vpTwist &twist) { return {twist[0], twist[1], twist[2]}; }
inline Eigen::Vector3d angular(const vpTwist &twist) { return {twist[3], twist[4], twist[5]}; }

//! cdMc = cdMo cMo^-1.
inline Error error(const vpHomogeneousMatrix &cdMo, const vpHomogeneousMatrix &cMo)
{
  Error e;
  e.R = rotation(cdMo) * rotation(cMo).transpose();
  e.t = translation(cdMo) - e.R * translation(cMo);
  return e;
}

inline vpTwist twist(const Eigen::Vector3d &v, const Eigen::Vector3d &w)
{
  return {v.x(), v.y(), v.z(), w.x(), w.y(), w.z()};
}
} // namespace vpServoPose

// Valid numbers for a law: finite, and within bounds that no camera or object exceeds. Every comparison is written so
// that NaN fails it.
namespace vpServoCheck
{
constexpr double largest = 1e6;  // m; also of x and y, which is 90 deg off the axis to within 1e-6
constexpr double nearest = 1e-9; // m, smallest depth

inline bool isPoint(const vpServoPoint &point)
{
  return std::abs(point.x) <= largest && std::abs(point.y) <= largest && point.Z >= nearest && point.Z <= largest;
}

inline bool isPose(const vpHomogeneousMatrix &M)
{
  const Eigen::Matrix3d R = vpServoPose::rotation(M);
  return (R * R.transpose() - Eigen::Matrix3d::Identity()).squaredNorm() < 1e-6 && R.determinant() > 0. &&
         vpServoPose::translation(M).cwiseAbs().sum() <= largest;
}

//! True if a measurement has the goal's number of points, and only numbers that are valid for a law.
inline bool isUsable(const vpServoMeasurement &measurement, const vpServoGoal &goal)
{
  if (measurement.points.size() != goal.points.size() || !isPose(measurement.cMo)) {
    return false;
  }
  for (const vpServoPoint &point : measurement.points) {
    if (point.visible && !isPoint(point)) {
      return false;
    }
  }
  return true;
}

//! \throw vpException (badValue) when a point is not valid for a law. \param owner : As in "of the servo goal".
inline void requirePoint(const char *owner, std::size_t index, const vpServoPoint &point)
{
  if (!isPoint(point)) {
    throw vpException(vpException::badValue,
                      "point %u of %s is x = %g, y = %g, Z = %g m, must be finite with Z > 0, and at most 1e6",
                      static_cast<unsigned int>(index), owner, point.x, point.y, point.Z);
  }
}

//! \throw vpException (badValue) when the goal has no points, or a number that is not valid for a law.
inline void requireGoal(const vpServoGoal &goal)
{
  if (goal.points.empty()) {
    throw vpException(vpException::badValue, "the servo goal has 0 points, needs at least 1");
  }
  if (!isPose(goal.cdMo)) {
    throw vpException(vpException::badValue,
                      "the servo goal's cdMo is not a finite rigid motion, its translation is (%g, %g, %g) m",
                      goal.cdMo[0][3], goal.cdMo[1][3], goal.cdMo[2][3]);
  }
  const Eigen::Vector3d origin = vpServoPose::translation(goal.cdMo);
  if (origin.z() <= 0.) {
    throw vpException(vpException::badValue, "the object's origin in the servo goal has depth %g m, must be > 0",
                      origin.z());
  }
  for (std::size_t i = 0; i < goal.points.size(); ++i) {
    requirePoint("the servo goal", i, goal.points[i]);
  }
}
} // namespace vpServoCheck

END_VISP_NAMESPACE
#endif
