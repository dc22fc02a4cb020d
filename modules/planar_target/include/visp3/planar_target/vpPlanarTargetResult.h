/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPlanarTargetResult.h
 * \brief What is known of a planar target in one frame.
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
//! \brief How a frame went. Only Acquired and Tracked carry a pose, Ambiguous carries two.
enum class vpPlanarTargetStatus {
  Acquired,      //!< Found by keypoints, refined on the grey values.
  Tracked,       //!< Followed from the frame before by its grey values.
  Ambiguous,     //!< Found, but two poses fit and the frames so far do not decide: cMo and vpPlanarTargetResult::rival.
  Extrapolated,  //!< vpPlaneMatcher only: a homography that holds where the matches are, and not in the whole image.
  NoTexture,     //!< The image has too few keypoints.
  TooFewInliers, //!< Keypoints were matched, but too few agree on one homography.
  OutOfView,     //!< The target left the image or is seen from behind or too obliquely.
  LowCorrelation, //!< The grey values do not fit the reference: lost or hidden.
  NoFrame         //!< No image was given yet.
};

//! \ingroup group_planar_target
//! \brief The status as a word ("Tracked"), static text.
[[nodiscard]] VISP_EXPORT const char *toString(vpPlanarTargetStatus status);

//! \ingroup group_planar_target
//! \brief The other pose with nearly the same image, as a plane has one at weak perspective.
struct VISP_EXPORT vpPlanarTargetRival {
  vpHomogeneousMatrix cMo;     //!< As in vpPlanarTargetResult.
  double residual = 0.;        //!< As in vpPlanarTargetResult, of this pose.
  vpPoseCovariance covariance; //!< If this pose is the right one.
};

//! \ingroup group_planar_target
//! \brief Result for one target in one frame.
struct VISP_EXPORT vpPlanarTargetResult {
  vpPlanarTargetStatus status = vpPlanarTargetStatus::NoFrame; //!< How the frame went.
  std::string message;         //!< One sentence for a person, with the numbers that matter.
  vpHomogeneousMatrix cMo;     //!< Pose of the target in the camera, m; the target's plane is z = 0, x right, y down.
  vpPoseCovariance covariance; //!< Of cMo; when Ambiguous, if cMo is the right pose. See vpPlanarTargetConfig::exact.
  std::array<double, 9> homography{}; //!< Row by row: pixels of the reference image to pixels of the frame, H(2,2) = 1.
  std::array<vpImagePoint, 4>
      corners; //!< The reference image's corners in the frame: top left, top right, bottom right, bottom left; px.
  unsigned int inliers = 0; //!< Matches that agree (acquisition).
  double correlation = 0.;  //!< Zero-mean normalised correlation of the visible part with the reference, -1..1.
  double visible = 0.;      //!< Share of the target's samples that are in the image and not rejected as occluded, 0..1.

  double residual = 0.;  //!< Root mean square of the residuals that are not hidden, grey levels; 0 if not known.
  double greySigma = 0.; //!< Noise of a pixel, standard deviation, grey levels; 0 if not known.
  double kappa =
      1.; //!< Factor in covariance for errors that neighbouring pixels share, >= 1: what the model leaves out.
  double hidden = 0.; //!< Share of the target's pixels in the frame that something else covers, 0..1.
  double blur = 0.;   //!< Of the camera, standard deviation of a Gaussian, px; 0 if not known.

  std::optional<vpPlanarTargetRival> rival; //!< Less likely than cMo; only where the two differ by more than the noise.
  double evidence =
      0.; //!< Logarithm of the ratio of the likelihoods of cMo and rival over the last frames; 0 without one.

  //! True if there is one pose.
  [[nodiscard]] bool found() const
  {
    return status == vpPlanarTargetStatus::Acquired || status == vpPlanarTargetStatus::Tracked;
  }
};

END_VISP_NAMESPACE
#endif
