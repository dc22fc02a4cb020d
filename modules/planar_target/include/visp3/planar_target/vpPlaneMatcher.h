/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPlaneMatcher.h
 * \brief Homography between two views of a textured plane; neither size nor camera need be known.
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
//! \brief Match between two views.
struct VISP_EXPORT vpPlaneMatch {
  //! Acquired; Extrapolated when a corner of the reference image is uncertain by more than three inlier thresholds;
  //! NoTexture or TooFewInliers when there is no homography; NoFrame before the first frame.
  vpPlanarTargetStatus status = vpPlanarTargetStatus::NoFrame;
  std::string message;                //!< One sentence for users.
  std::array<double, 9> homography{}; //!< Row-major: reference pixels to frame pixels, H(2,2) = 1.
  std::vector<std::pair<vpImagePoint, vpImagePoint>> inliers; //!< Inlier matches: reference, frame; px.
  std::size_t referenceKeypoints = 0; //!< Keypoints found in the reference view; known before the first frame.
  std::size_t frameKeypoints = 0;     //!< Keypoints found in the frame; 0 when it is too small.
  std::size_t matches = 0;            //!< Mutual best matches before the homography; includes the inliers.
  double sigma = 0.;                  //!< Standard deviation of the inliers from the homography, px per axis.
  double cornerDeviation = 0.;        //!< Maximum of deviation() over the corners of the reference image, px.
  unsigned int referenceWidth /*!< px. */ = 0, referenceHeight /*!< px. */ = 0;
  /*!
   * Covariance of the first eight elements, row-major, of G = H B / (H B)(2,2), where B maps ((u - width/2)/S, (v -
   * height/2)/S, 1), S = width/2, to the pixel (u, v) of the reference: sigma^2 (sum J^T J)^-1, row-major, from the
   * inliers. Infinite when these are nearly collinear.
   *
   * The inliers were selected for their agreement, so on real photographs the true errors are larger: the covariance
   * shows where the homography extrapolates, not its accuracy near the matches.
   */
  std::array<double, 64> covariance{};

  /*!
   * Uncertainty of the frame position to which the homography maps a reference pixel: square root of the sum of both
   * variances, px. Infinite without a homography.
   */
  [[nodiscard]] double deviation(const vpImagePoint &reference) const;
  //! True if there is a homography, for the whole image or (Extrapolated) for the region of the inliers.
  [[nodiscard]] bool hasHomography() const { return found() || status == vpPlanarTargetStatus::Extrapolated; }
  //! True if there is a homography valid in the whole reference image.
  [[nodiscard]] bool found() const { return status == vpPlanarTargetStatus::Acquired; }
  /*!
   * Euclidean homography K^-1 H K, as expected by vpTwoViewDecomposition.
   * \param camera : Camera of both views, without distortion.
   */
  [[nodiscard]] vpHomography euclidean(const vpCameraParameters &camera) const;
  //! The inliers in the reference view in normalised coordinates, as expected by vpTwoViewDecomposition.
  [[nodiscard]] std::vector<std::pair<double, double>> referencePoints(const vpCameraParameters &camera) const;
};

/*!
 * \class vpPlaneMatcher
 * \ingroup group_planar_target
 * \brief Keypoints, mutual best matches and a robust homography (OpenCV's USAC_MAGSAC) from a reference to frames.
 *
 * The homography is the least-squares fit to the inliers, with its covariance. If all inliers lie in a corner of the
 * image, the rest is extrapolated, and the status is Extrapolated.
 *
 * A frame takes one extraction of keypoints and one comparison of at most maxKeypoints^2 pairs, whatever it shows. Both
 * views must have the same pixel aspect ratio, preferably square pixels.
 *
 * For a plane known from one picture only. With vpTwoViewDecomposition it gives the camera's motion up to scale (thesis
 * 4.3); where the metric size is known, vpPlanarTarget gives more and is far more precise.
 *
 * \code
 * vpPlaneMatcher matcher(reference);
 * const vpPlaneMatch &match = matcher.match(image); // each frame
 * std::cout << match.message << std::endl;
 * if (match.found()) { // and not only near the matches
 *   std::cout << match.inliers.size() << " matches, corners +- " << match.cornerDeviation << " px\n"
 *             << match.euclidean(camera) << std::endl;
 * }
 * \endcode
 */
class VISP_EXPORT vpPlaneMatcher
{
public:
  /*!
   * \param reference : Reference view, at least 32x32 px. \param spec : Its keypoints, maxKeypoints, minInliers and
   * inlierThreshold are used.
   * \throw vpException (dimensionError, badValue) naming the error: small image, too few keypoints, invalid setting.
   */
  explicit vpPlaneMatcher(const vpImage<unsigned char> &reference, const vpPlanarTargetSpec &spec = {});
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
