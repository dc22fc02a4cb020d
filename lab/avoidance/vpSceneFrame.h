/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpSceneFrame.h
 * \brief Size and place of an arm's workspace, to which scenes are fitted.
 */
#ifndef vpSceneFrame_h
#define vpSceneFrame_h

#include <visp3/avoidance/vpCollisionScene.h>

BEGIN_VISP_NAMESPACE

/*!
 * \brief Scenes are designed for AMOR, in its base frame; this is what they become for another arm. For AMOR, and all
 * arms of similar reach that stand in their base frame, nothing changes. Speeds and clearances are not scaled, so an arm of
 * half AMOR's reach or less may find no scene S1 or S3.
 */
struct vpSceneFrame {
  double reach = 1.; //!< Largest distance of the tool from the first revolute axis in 4096 random configurations, m.
  double scale = 1.; //!< Factor of lengths: 1 for a reach of 0.6 to 1.4 m, else the reach over AMOR's.
  Eigen::Vector3d centre = Eigen::Vector3d::Zero(); //!< Origin of the first revolute joint at home, base frame, m.
  int firstLink = 3;  //!< First link that is checked against the ground: 3, or the last of a shorter arm.
  double ground = 0.; //!< Height of the ground, m: 0, or below a centre that is itself below the base frame's origin.

  //! The frame of an arm; the same for the same arm.
  [[nodiscard]] static vpSceneFrame of(const vpArmModel &arm);
  //! The ground; links before #firstLink stand on it.
  [[nodiscard]] vpHalfSpace floor() const;
  //! A place designed for AMOR. \param p : In its base frame, m.
  [[nodiscard]] Eigen::Vector3d place(const Eigen::Vector3d &p) const
  {
    return {centre.x() + scale * p.x(), centre.y() + scale * p.y(), ground + scale * p.z()};
  }
};

/*!
 * The scene with all bodies of vpArmSpec::uncovered among its ignored ones. In the laboratory these are bodies that a user
 * ignores: the programs refuse an arm with others.
 */
[[nodiscard]] vpCollisionSceneSpec vpIgnoreUncovered(const vpArmModel &arm, vpCollisionSceneSpec spec = {});

/*!
 * Share of random configurations within the limits in which the arm touches itself, 0..1.
 * \param configurations : Their number, > 0.
 */
[[nodiscard]] double vpSelfTouchShare(const vpCollisionScene &scene, int configurations);

END_VISP_NAMESPACE
#endif
