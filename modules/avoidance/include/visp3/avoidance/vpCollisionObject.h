/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpCollisionObject.h
 * \brief An obstacle: a shape somewhere, perhaps moving, known with an uncertainty.
 */
#ifndef vpCollisionObject_h
#define vpCollisionObject_h

#include <visp3/avoidance/vpCollisionShape.h>
#include <visp3/direct_core/vpTwist.h>
#include <visp3/manipulator/vpArmTypes.h>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_avoidance
 * \brief One obstacle in the frame of the arm's base. vpCollisionScene checks it.
 *
 * At time t it stands at p + v t, turned by exp(w t) about its own origin.
 */
struct VISP_EXPORT vpCollisionObject {
  std::string name;                                        //!< Not empty, only once in a scene.
  vpCollisionShape shape = vpCollisionShape::sphere(0.05); //!< In its own frame.
  vpRigidTransform pose;                                   //!< fMo: the object's frame in the base, m.
  vpTwist velocity;      //!< Of the object's origin (m/s), and angular (rad/s); axes of the base.
  double inflation = 0.; //!< Uncertainty of its place and extent, m, >= 0: the shape counts as that much thicker.

  //! Pose at time \e t (s) from now, by the velocity. Does not allocate.
  [[nodiscard]] vpRigidTransform poseAt(double t) const noexcept;
};

END_VISP_NAMESPACE
#endif
