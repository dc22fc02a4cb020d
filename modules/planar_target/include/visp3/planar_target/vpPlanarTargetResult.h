/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPlanarTargetResult.h
 * \brief Result for a planar target in one frame.
 */
#ifndef vpPlanarTargetResult_h
#define vpPlanarTargetResult_h

#include <visp3/core/vpHomogeneousMatrix.h>
#include <visp3/core/vpImagePoint.h>
#include <visp3/direct_core/vpDirectCompat.h>
#include <visp3/direct_core/vpPoseCovariance.h>

#include <array>
#include <optional>
#include <string>

BEGIN_VISP_NAMESPACE

//! \ingroup group_planar_target
//! \brief Result of a frame. Only Acquired and Tracked have a pose, Ambiguous has two.
enum class vpPlanarTargetStatus {
  Acquired,      //!< Found by keypoints, refined on the grey values.
  Tracked,       //!< Tracked from the previous frame by its grey values.
  Ambiguous,     //!< Found, but two poses fit and the frames so far do not decide: cMo and vpPlanarTargetResult::rival.
  Extrapolated,  //!< vpPlaneMatcher only: the homography is valid near the matches, but not in the whole image.
  NoTexture,     //!< The image has too few keypoints.
  TooFewInliers, //!< Keypoints were matched, but too few agree on one homography.
  OutOfView,     //!< The target left the image, or is seen from behind or too obliquely.
  LowCorrelation, //!< The grey values do not fit the reference: lost or occluded.
  NoFrame         //!< No image was given yet.
};

//! \ingroup group_planar_target
//! \brief Status as a word ("Tracked"), static text.
[[nodiscard]] VISP_EXPORT const char *vpToString(vpPlanarTargetStatus status);

//! \ingroup group_planar_target
//! \brief Second pose with nearly the same image, which a plane has at weak perspective.
struct VISP_EXPORT vpPlanarTargetRival {
  vpHomogeneousMatrix cMo;     //!< Pose, as in vpPlanarTargetResult.
  double residual = 0.;        //!< Residual of this pose, as in vpPlanarTargetResult.
  vpPoseCovariance covariance; //!< Covariance, if this pose is the right one.
};

//! \ingroup group_planar_target
//! \brief Result for one target in one frame.
struct VISP_EXPORT vpPlanarTargetResult {
  vpPlanarTargetStatus status = vpPlanarTargetStatus::NoFrame; //!< Result of the frame.
  std::string message;                                         //!< One sentence for users, with the relevant numbers.
  vpHomogeneousMatrix cMo;     //!< Pose of the target in the camera, m; the target's plane is z = 0, x right, y down.
  vpPoseCovariance covariance; //!< Covariance of cMo, if it is the right pose. See vpPlanarTargetSpec::exact.
  std::array<double, 9> homography{}; //!< Row-major: reference image pixels to frame pixels, H(2,2) = 1.
  //! The reference image's corners in the frame: top left, top right, bottom right, bottom left; px.
  std::array<vpImagePoint, 4> corners;
  unsigned int inliers = 0; //!< Inlier matches (acquisition).
  double correlation = 0.;  //!< Zero-mean normalised correlation of the visible part with the reference, -1..1.
  double visible = 0.;      //!< Fraction of the target's samples in the image and not rejected as occluded, 0..1.

  double residual = 0.;  //!< Root mean square of the residuals of unoccluded pixels, grey levels; 0 if not known.
  double greySigma = 0.; //!< Standard deviation of the pixel noise, grey levels; 0 if not known.
  double kappa = 1.;     //!< Covariance factor for model errors, correlated between neighbouring pixels, >= 1.
  double hidden = 0.;    //!< Fraction of the target's pixels in the frame that are occluded, 0..1.
  double blur = 0.;      //!< Blur of the camera, standard deviation of a Gaussian, px; 0 if not known.

  std::optional<vpPlanarTargetRival> rival; //!< Less likely pose; only if the two differ by more than the noise.
  double evidence = 0.; //!< Log likelihood ratio of cMo and rival over the last frames; 0 without a rival.

  //! True if there is exactly one pose.
  [[nodiscard]] bool found() const
  {
    return status == vpPlanarTargetStatus::Acquired || status == vpPlanarTargetStatus::Tracked;
  }
};

END_VISP_NAMESPACE
#endif
