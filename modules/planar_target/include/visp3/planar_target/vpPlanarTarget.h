/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPlanarTarget.h
 * \brief Pose of a textured plane from a reference image and camera images.
 */
#ifndef vpPlanarTarget_h
#define vpPlanarTarget_h

#include <visp3/core/vpCameraParameters.h>
#include <visp3/core/vpImage.h>
#include <visp3/planar_target/vpPlanarTargetResult.h>

#include <memory>
#include <string>

BEGIN_VISP_NAMESPACE

//! \ingroup group_planar_target
//! \brief Keypoint detector with its descriptor.
enum class vpKeypointType {
  ORB,   //!< OpenCV; fast, the default.
  SIFT,  //!< OpenCV; most precise before refinement, slow.
  AKAZE, //!< OpenCV; the fallback when ORB finds too few keypoints.
  KAZE,  //!< OpenCV.
  BRISK, //!< OpenCV.
  SURF   //!< dlib (Debian's OpenCV has none).
};

//! \ingroup group_planar_target
//! \brief Name of the detector ("ORB"), static text.
[[nodiscard]] VISP_EXPORT const char *vpToString(vpKeypointType type);
//! \ingroup group_planar_target
//! \throw vpException (badValue) naming an unknown detector and the known ones.
[[nodiscard]] VISP_EXPORT vpKeypointType vpKeypointTypeFromString(const std::string &name);

//! \ingroup group_planar_target
//! \brief Settings of a target. The defaults suit 640x480 images with a target that fills at least a third of the view.
struct VISP_EXPORT vpPlanarTargetSpec {
  vpKeypointType keypoints = vpKeypointType::ORB; //!< Detector for acquisition.
  bool fallback = true;                           //!< Try AKAZE when the detector above gives too few inliers.
  unsigned int maxKeypoints = 1500; //!< More find smaller targets but take longer; detectors without a bound ignore it.
  unsigned int minInliers = 12;     //!< Minimum number of inliers, below it TooFewInliers, >= 8.
  double inlierThreshold = 3.;      //!< Largest reprojection error of an inlier, px, > 0.
  double minCorrelation = 0.6;      //!< Minimum correlation, below it LowCorrelation, 0..1.
  unsigned int refinementSize = 200; //!< Longer side of the reference at the finest level, px; cost: its square.
  unsigned int maxIterations = 30;   //!< Maximum number of refinement iterations, over all levels.
  bool refine = true;                //!< False: keypoints only, for comparison with tables 4.2 and 4.3 of the thesis.
  //! Last stage on the frame's own pixels in every frame: gives the covariance, the choice between two poses, and errors
  //! near the lower bound. False: only until the poses of a target just found are decided; tracking takes about half the
  //! time. Needs refine.
  bool exact = true;
  double surfThreshold = 10.;   //!< SURF: least strength of a keypoint (determinant of dlib's box filters), >= 0.
  unsigned int surfOctaves = 4; //!< SURF: octaves, 1 to 8.
  unsigned int surfLayers = 4;  //!< SURF: scales of an octave in which keypoints are found, 1 to 16.
  bool surfUpright = false;     //!< SURF: without orientation (U-SURF), for views that hardly roll.

  //! \throw vpException (badValue) naming the field and its value.
  void validate() const;
};

//! \ingroup group_planar_target
//! \brief Effort for one frame, bounded so that it fits a loop at the camera's rate.
struct VISP_EXPORT vpPlanarTargetEffort {
  unsigned int followed = 0;    //!< Targets tracked from the previous frame.
  unsigned int extractions = 0; //!< Keypoint extractions, whole frame or part: at most 1, 0 when nothing was lost.
  unsigned int probed = 0;      //!< Lost targets whose most distinctive keypoints were compared with the frame's.
  //! Comparisons of probed targets, in 64-bit words of descriptors: at most 20 million beyond the first target.
  std::size_t comparisons = 0;
  unsigned int searches = 0; //!< Thorough searches for lost targets: all successful ones and at most one failed.
};

/*!
 * \class vpPlanarTarget
 * \ingroup group_planar_target
 * \brief Detects and tracks one textured planar target.
 *
 * process() tracks the target from the previous frame by its grey values (photometric Gauss-Newton with Tukey weights,
 * gain and bias); when there is nothing to track, or tracking fails, it acquires the target by keypoints (OpenCV's
 * USAC_MAGSAC) and then refines the pose. The first frame is searched by all detectors, as by acquire(). A lost target
 * is searched with a bounded effort per frame, see vpPlanarTargetEffort: by the configured detector, and in every third
 * frame instead by the fallback in one of nine parts of the frame that overlap by half. It never returns a pose that
 * the image does not support: see vpPlanarTargetStatus.
 *
 * The last stage fits the predicted image to the frame's own pixels, whose noise is white, with gain, bias and blur of
 * the camera, and excludes occluded areas. It gives the covariance of the pose. Where the perspective is weak, it
 * compares both poses of the plane; the status is Ambiguous until odds of 10,000 and three standard deviations decide,
 * in one frame or in several: evidence decays by a tenth each frame, so a choice can change.
 *
 * \code
 * vpImageIo::read(photo, "data/target/klimt.jpg");
 * vpPlanarTarget target(photo, 0.16, 0.16, camera);         // m
 * const vpPlanarTargetResult &seen = target.process(image); // each frame
 * if (seen.found()) {
 *   std::cout << seen.cMo.getTranslationVector().t() << " +- " << seen.covariance.positionDeviation() << " m\n";
 * }
 * else {
 *   std::cerr << seen.message << std::endl; // also where two poses fit
 * }
 * \endcode
 */
class VISP_EXPORT vpPlanarTarget
{
public:
  /*!
   * \param reference : Fronto-parallel image of the target.
   * \param width, height : Metric size of the area shown in the reference image, m, > 0.
   * \param camera : Intrinsics of the images given to process(). Distortion (perspectiveProjWithDistortion) is removed.
   * \param spec : Settings.
   * \throw vpException (badValue / dimensionError) naming the error: image under 32x32 px, blank image (too little
   *   texture for keypoints and for the refinement), size not positive, invalid setting.
   */
  vpPlanarTarget(const vpImage<unsigned char> &reference, double width, double height, const vpCameraParameters &camera,
                 const vpPlanarTargetSpec &spec = {});
  ~vpPlanarTarget();
  vpPlanarTarget(vpPlanarTarget &&) noexcept;            //!< Moves.
  vpPlanarTarget &operator=(vpPlanarTarget &&) noexcept; //!< Moves.

  //! Track, or acquire when that fails. \param image : Frame of any size of at least 32x32 px.
  const vpPlanarTargetResult &process(const vpImage<unsigned char> &image);
  //! Acquire by keypoints, ignoring the previous state.
  const vpPlanarTargetResult &acquire(const vpImage<unsigned char> &image);
  //! Track only, from the last pose.
  const vpPlanarTargetResult &track(const vpImage<unsigned char> &image);
  //! Track only, from \e cMoGuess.
  const vpPlanarTargetResult &track(const vpImage<unsigned char> &image, const vpHomogeneousMatrix &cMoGuess);
  //! Forget the pose of the target.
  void reset();

  //! The last result.
  [[nodiscard]] const vpPlanarTargetResult &result() const;
  //! Width of the target, m.
  [[nodiscard]] double width() const;
  //! Height of the target, m.
  [[nodiscard]] double height() const;

private:
  friend class vpPlanarTargetDatabase; // shares one frame between many targets
  friend class vpTargetSearch;
  class Impl;
  std::unique_ptr<Impl> m_impl;
};

END_VISP_NAMESPACE
#endif
