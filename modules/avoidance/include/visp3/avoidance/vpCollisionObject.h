/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpCollisionObject.h
 * \brief An obstacle: shape, pose, velocity and uncertainty.
 */
#ifndef vpCollisionObject_h
#define vpCollisionObject_h

#include <visp3/avoidance/vpCollisionShape.h>
#include <visp3/direct_core/vpTwist.h>
#include <visp3/manipulator/vpArmTypes.h>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_avoidance
 * \brief One obstacle in the base frame of the arm; validated by vpCollisionScene.
 *
 * At time t it is at p + v t, rotated by exp(w t) about its own origin.
 */
struct VISP_EXPORT vpCollisionObject {
  std::string name;                                        //!< Name, unique in the scene; not empty.
  vpCollisionShape shape = vpCollisionShape::sphere(0.05); //!< Shape in the object's frame.
  vpRigidTransform pose;                                   //!< fMo: the object's frame in the base, m.
  vpTwist velocity;      //!< Velocity of the object's origin, m/s, and angular velocity, rad/s; axes of the base.
  double inflation = 0.; //!< Uncertainty of position and extent, m, >= 0: the shape is inflated by it.

  //! Pose at time \e t (s) from now, extrapolated by the velocity. Does not allocate.
  [[nodiscard]] vpRigidTransform poseAt(double t) const noexcept;
};

END_VISP_NAMESPACE
#endif
