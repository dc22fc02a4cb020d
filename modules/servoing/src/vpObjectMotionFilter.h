/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpObjectMotionFilter.h
 * \brief Velocity of an object from its poses.
 */
#ifndef vpObjectMotionFilter_h
#define vpObjectMotionFilter_h

#include <visp3/direct_core/vpPoseCovariance.h>
#include <visp3/direct_core/vpTwist.h>
#include <visp3/manipulator/vpArmTypes.h>

#include <Eigen/Core>

BEGIN_VISP_NAMESPACE

//! Velocity of an object in the base frame: of its origin, and angular.
struct vpObjectMotion {
  bool isKnown = false;
  Eigen::Vector3d v = Eigen::Vector3d::Zero(), w = Eigen::Vector3d::Zero(); // m/s, rad/s
  double vSigma = 0., wSigma = 0.; // standard deviations: square roots of the traces of the covariances
};

/*!
 * \brief Two Kalman filters of constant velocity, for position and orientation, whose velocity is a random walk.
 * Measurements that do not fit are left out; two of them in a row restart the filter.
 */
class vpObjectMotionFilter
{
public:
  //! \param linearChange, angularChange : Standard deviation of the change of the velocity in one second, m/s and rad/s.
  //! \param longestGap : After a longer time without a pose it restarts, s.
  vpObjectMotionFilter(double linearChange, double angularChange, double longestGap);

  void reset() noexcept { m_hasPose = false; }
  //! A measured pose. \param fMc : Camera in the base. \param cMo : Object in the camera. \param covariance : Of cMo; where
  //! it is not known the filter estimates the noise from what it could not predict.
  void add(const vpRigidTransform &fMc, const vpRigidTransform &cMo, const vpPoseCovariance &covariance, double time);
  [[nodiscard]] const vpObjectMotion &motion() const noexcept { return m_motion; }

private:
  // Three coordinates and their rates, with the covariance of their errors.
  struct Channel {
    double change = 0.;   // see the constructor
    double variance = 0.; // of a measured coordinate, where no covariance is known
    Eigen::Vector3d rate = Eigen::Vector3d::Zero();
    Eigen::Matrix<double, 6, 6> P = Eigen::Matrix<double, 6, 6>::Zero();

    void restart(const Eigen::Matrix3d &noise, double rateSigma) noexcept;
    void predict(double dt) noexcept;
    [[nodiscard]] double misfit(const Eigen::Vector3d &residual, const Eigen::Matrix3d &noise) const noexcept;
    [[nodiscard]] Eigen::Vector3d correct(const Eigen::Vector3d &residual, const Eigen::Matrix3d &noise) noexcept;
    void learnNoise(const Eigen::Vector3d &residual) noexcept;
  };
  void restart(const vpRigidTransform &fMo, const Eigen::Matrix3d &position, const Eigen::Matrix3d &rotation) noexcept;

  Channel m_position, m_rotation;
  double m_longestGap;
  vpRigidTransform m_pose; // fMo
  vpObjectMotion m_motion;
  double m_time = 0.;
  bool m_hasPose = false, m_missed = false;
};

END_VISP_NAMESPACE
#endif
