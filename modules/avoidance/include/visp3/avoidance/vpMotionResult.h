/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpMotionResult.h
 * \brief Result of checking a straight joint-space motion.
 */
#ifndef vpMotionResult_h
#define vpMotionResult_h

#include <visp3/avoidance/vpCollisionData.h>

BEGIN_VISP_NAMESPACE

//! \ingroup group_avoidance
//! \brief Result of a motion check.
enum class vpMotionStatus {
  Free,      //!< vpCertifiedMotion: proven; vpDiscreteMotion: no sample collides.
  Collision, //!< A configuration with a clearance <= the margin was found.
  Undecided, //!< vpCertifiedMotion only: nearer to the margin than the resolution. Counts as not free.
  BadInput   //!< A configuration of the wrong size, not finite, or out of range (vpReachBounds::holds()).
};

/*!
 * \ingroup group_avoidance
 * \brief Result of a motion check, with position and pair.
 */
struct VISP_EXPORT vpMotionResult {
  vpMotionStatus status = vpMotionStatus::BadInput; //!< Only Free may be executed.
  double s = 0.;     //!< Collision and Undecided: position on the motion, 0 at its start, 1 at its end.
  vpClearance pair;  //!< Collision and Undecided: the pair there, not always the nearest one.
  int evaluated = 0; //!< Number of configurations evaluated.

  //! True if the motion is free.
  [[nodiscard]] bool isFree() const noexcept { return status == vpMotionStatus::Free; }
  //! Status as a sentence.
  [[nodiscard]] const char *message() const noexcept;
};

END_VISP_NAMESPACE
#endif
