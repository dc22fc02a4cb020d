/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPlaneMatcher.h
 * \brief Two views of a textured plane in, their homography out; neither size nor camera need be known.
 */
#ifndef vpPlaneMatcher_h
#define vpPlaneMatcher_h

#include <visp3/planar_target/vpPlanarTarget.h>
#include <visp3/vision/vpHomography.h>

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

BEGIN_VISP_NAMESPACE

//! \ingroup group_planar_target
//! \brief What two views have in common.
struct VISP_EXPORT vpPlaneMatch {
  //! Acquired; Extrapolated when a corner of the reference image is uncertain by more than three inlier thresholds; NoTexture or TooFewInliers when there is no homography; NoFrame before the first frame.
  vpPlanarTargetStatus status = vpPlanarTargetStatus::NoFrame;
  std::string message;                //!< One sentence for a person.
  std::array<double, 9> homography{}; //!< Row by row: pixels of the reference to pixels of the frame, H(2,2) = 1.
  std::vector<std::pair<vpImagePoint, vpImagePoint>> inliers; //!< Agreeing matches: in the reference, in the frame; px.
  std::size_t referenceKeypoints = 0; //!< Found in the reference view; known before the first frame.
  std::size_t frameKeypoints = 0;     //!< Found in the frame; 0 when it is too small to look.
  std::size_t matches = 0;            //!< Mutual best pairs before the homography; the inliers are among them.
  double sigma = 0.;                  //!< Standard deviation of an inlier from the homography, px in each axis.
  double cornerDeviation = 0.;        //!< The largest deviation() at the corners of the reference image, px.
  unsigned int referenceWidth /*!< px. */ = 0, referenceHeight /*!< px. */ = 0;
  /*!
   * Of the first eight elements, row by row, of G = H B / (H B)(2,2), where B takes ((u - width/2)/S, (v - height/2)/S, 1),
   * S = width/2, to the pixel (u, v) of the reference: sigma^2 (sum J^T J)^-1, row by row, from the inliers. Infinite when
   * these lie nearly on a line.
   *
   * The inliers were chosen for agreeing, so on real photographs the true errors are larger: it tells where the homography
   * extrapolates, not how good it is where the matches are.
   */
  std::array<double, 64> covariance{};

  /*!
   * How uncertain the place in the frame is that the homography gives a pixel of the reference: root of the sum of both
   * variances, px. Infinite without a homography.
   */
  [[nodiscard]] double deviation(const vpImagePoint &reference) const;
  //! True if there is a homography, be it for the whole image or, Extrapolated, for where the inliers are.
  [[nodiscard]] bool hasHomography() const { return found() || status == vpPlanarTargetStatus::Extrapolated; }
  //! True if there is a homography that holds in the whole reference image.
  [[nodiscard]] bool found() const { return status == vpPlanarTargetStatus::Acquired; }
  /*!
   * The Euclidean homography K^-1 H K, as vpTwoViewDecomposition takes it.
   * \param camera : Of both views, without distortion.
   */
  [[nodiscard]] vpHomography euclidean(const vpCameraParameters &camera) const;
  //! The inliers in the reference view in normalised coordinates, as vpTwoViewDecomposition takes them.
  [[nodiscard]] std::vector<std::pair<double, double>> referencePoints(const vpCameraParameters &camera) const;
};

/*!
 * \class vpPlaneMatcher
 * \ingroup group_planar_target
 * \brief Keypoints, mutual best matches and a robust homography (OpenCV's USAC_MAGSAC) between a reference view and frames.
 *
 * The homography is that of least squares over the inliers, with its covariance. Keypoints that agree may lie in a corner of
 * the image; what they say of the rest is a guess then, and the status Extrapolated.
 *
 * A frame takes one extraction of keypoints and one comparison of at most maxKeypoints^2 pairs, whatever it shows. Both
 * views must have pixels of the same shape, best square ones.
 *
 * For a plane of which nothing is known but one picture. With vpTwoViewDecomposition it gives the camera's motion up to
 * scale (thesis 4.3); where the metric size is known, vpPlanarTarget gives more and is far more precise.
 */
class VISP_EXPORT vpPlaneMatcher
{
public:
  /*!
   * \param reference : Reference view, at least 32x32 px. \param config : Its keypoints, maxKeypoints, minInliers and
   * inlierThreshold are used.
   * \throw vpException (dimensionError, badValue) naming what is wrong: image too small, too few keypoints, bad setting.
   */
  explicit vpPlaneMatcher(const vpImage<unsigned char> &reference, const vpPlanarTargetConfig &config = {});
  ~vpPlaneMatcher();
  vpPlaneMatcher(vpPlaneMatcher &&) noexcept;            //!< Moves.
  vpPlaneMatcher &operator=(vpPlaneMatcher &&) noexcept; //!< Moves.

  //! Compare a frame with the reference view.
  const vpPlaneMatch &match(const vpImage<unsigned char> &image);
  //! The last result.
  [[nodiscard]] const vpPlaneMatch &result() const;

private:
  class Impl;
  std::unique_ptr<Impl> m_impl;
};

END_VISP_NAMESPACE
#endif
