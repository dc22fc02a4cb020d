/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPlaneTracker.h
 * \brief Points of a textured plane, found again in frames to a fraction of a pixel; neither size nor camera need be
 * known.
 */
#ifndef vpPlaneTracker_h
#define vpPlaneTracker_h

#include <visp3/planar_target/vpPlaneMatcher.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

BEGIN_VISP_NAMESPACE

//! \ingroup group_planar_target
//! \brief Points of a reference view in one frame.
struct VISP_EXPORT vpPlaneTrack {
  bool found = false;                              //!< True if enough points agree on one homography.
  std::string message = "No image was given yet."; //!< One sentence for users.
  std::vector<vpImagePoint>
      points;                //!< In the order of vpPlaneTracker::reference(), px; outside #visible by the homography.
  std::vector<char> visible; //!< True for a point that was found and agrees.
  unsigned int count = 0;    //!< Number of visible points.
  double sigma = 0.;         //!< Standard deviation of a coordinate of the visible points about the homography, px.
  std::array<double, 9> homography{}; //!< Row-major: reference pixels to frame pixels, H(2,2) = 1.
};

/*!
 * \class vpPlaneTracker
 * \ingroup group_planar_target
 * \brief Follows corners of a reference view by their grey values (pyramidal Lucas-Kanade), in the frame warped to the
 * reference.
 *
 * The frame is warped by a homography that is nearly right, so that windows of the reference are found again by a
 * shift, at any scale, rotation and tilt; gain and bias of the light are matched first. Points that do not agree with
 * one homography (not on the plane, or occluded) count as not visible. The same corners are found in each frame, with independent
 * errors of about 0.1 px: keypoints, which are detected in each frame again, err by several tenths.
 *
 * \code
 * vpPlaneTracker tracker(reference);
 * for (int i = 0; i < 100; ++i) {
 *   grabber.acquire(image);
 *   const std::array<double, 9> last = tracker.result().homography;
 *   const vpPlaneTrack &track = tracker.result().found ? tracker.track(image, last) : tracker.acquire(image);
 *   for (std::size_t k = 0; track.found && k < track.points.size(); ++k) {
 *     if (track.visible[k]) {
 *       std::cout << tracker.reference()[k] << " is at " << track.points[k] << " +- " << track.sigma << " px\n";
 *     }
 *   }
 * }
 * \endcode
 */
class VISP_EXPORT vpPlaneTracker
{
public:
  /*!
   * \param reference : Reference view, at least 32x32 px.
   * \param points : Maximum number of corners, 20..2000. \param spec : Keypoints and limits, see vpPlaneMatcher; its
   *   minInliers is also the minimum number of visible points.
   * \throw vpException (dimensionError, badValue) as vpPlaneMatcher, or naming \e points.
   */
  explicit vpPlaneTracker(const vpImage<unsigned char> &reference, unsigned int points = 200,
                          const vpPlanarTargetSpec &spec = {});
  ~vpPlaneTracker();
  vpPlaneTracker(vpPlaneTracker &&) noexcept;            //!< Moves.
  vpPlaneTracker &operator=(vpPlaneTracker &&) noexcept; //!< Moves.

  //! Finds the plane anywhere, by keypoints.
  const vpPlaneTrack &acquire(const vpImage<unsigned char> &image);
  /*!
   * Finds the plane near a guess.
   * \param image : The frame. \param guess : Homography as vpPlaneTrack::homography, right to some 30 px of the reference.
   */
  const vpPlaneTrack &track(const vpImage<unsigned char> &image, const std::array<double, 9> &guess);
  //! The corners of the reference view, px.
  [[nodiscard]] const std::vector<vpImagePoint> &reference() const;
  //! The last result.
  [[nodiscard]] const vpPlaneTrack &result() const;

private:
  class Impl;
  std::unique_ptr<Impl> m_impl;
};

END_VISP_NAMESPACE
#endif
