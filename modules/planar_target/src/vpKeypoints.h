/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpKeypoints.h
 * \brief Internal: common interface of the keypoint detectors of OpenCV and dlib, and the matches of two keypoint
 * sets: pairs that are each other's best and clearly better than the second.
 */
#ifndef vpKeypoints_h
#define vpKeypoints_h

#include <visp3/planar_target/vpPlanarTarget.h>

#include <opencv2/core.hpp>

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

BEGIN_VISP_NAMESPACE

constexpr unsigned int smallestImage = 32; //!< Smallest side of a reference or a frame, px.

//! The pixels of an image, not copied.
[[nodiscard]] inline cv::Mat pixelsOf(const vpImage<unsigned char> &image)
{
  return cv::Mat(static_cast<int>(image.getHeight()), static_cast<int>(image.getWidth()), CV_8UC1, image.bitmap);
}

//! Keypoints of one image, strongest first; row i of the descriptors belongs to point i. Pixel (0,0) is the centre of
//! the top-left pixel.
struct vpKeypointSet {
  std::vector<cv::Point2f> points;
  cv::Mat descriptors; //!< CV_8U (binary, compared by Hamming distance) or CV_32F (Euclidean distance).
  std::vector<std::uint64_t>
      packed; //!< Binary descriptors, word by word: the first of all points, then the second; see
              //!< pack(). Empty for others.

  //! 64-bit words of a descriptor, a multiple of four.
  [[nodiscard]] std::size_t words() const;
  //! Set \e packed from \e descriptors: once per set, for all comparisons.
  void pack();
};

class vpKeypointExtractor
{
public:
  virtual ~vpKeypointExtractor() = default;
  //! Strongest keypoints of a CV_8UC1 image, with descriptors.
  virtual void extract(const cv::Mat &image, vpKeypointSet &keypoints) = 0;
};

/*!
 * \param spec : Its maxKeypoints, the maximum number of keypoints (the strongest are kept), and its settings of SURF.
 * \throw vpException (fatalError) if \e type is SURF and this build has no dlib.
 */
std::unique_ptr<vpKeypointExtractor> makeKeypointExtractor(vpKeypointType type, const vpPlanarTargetSpec &spec);

//! SURF, in surf/: by dlib, or an exception that tells how to get it.
std::unique_ptr<vpKeypointExtractor> makeSurfExtractor(const vpPlanarTargetSpec &spec);

/*!
 * Pairs (index in \e reference, index in \e current). Each is the mutual nearest neighbour, and nearer than
 * 0.8 times the second nearest in the current image (Lowe). One pass over the distances serves both tests.
 */
std::vector<std::pair<int, int>> matchKeypoints(const vpKeypointSet &reference, const vpKeypointSet &current);

/*!
 * The most distinctive keypoints of a reference, at most \e most of them: half the strongest, half those of the strong
 * ones that are least similar to any other of the image, which pass the ratio test of matchKeypoints().
 */
vpKeypointSet tellingKeypoints(const vpKeypointSet &set, std::size_t most);

END_VISP_NAMESPACE
#endif
