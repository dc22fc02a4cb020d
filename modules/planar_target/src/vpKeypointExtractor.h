/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpKeypointExtractor.h
 * \brief Internal: common interface of the keypoint detectors of OpenCV and dlib.
 */
#ifndef vpKeypointExtractor_h
#define vpKeypointExtractor_h

#include <visp3/planar_target/vpPlanarTarget.h>

#include <opencv2/core.hpp>

#include <cstdint>
#include <memory>
#include <vector>

BEGIN_VISP_NAMESPACE

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
 * \param maxKeypoints : Maximum number of keypoints; the strongest are kept.
 * \throw vpException (fatalError) if \e type is SURF and this build has no dlib.
 */
std::unique_ptr<vpKeypointExtractor> makeKeypointExtractor(vpKeypointType type, unsigned int maxKeypoints);

//! SURF, in surf/: by dlib, or an exception that tells how to get it.
std::unique_ptr<vpKeypointExtractor> makeSurfExtractor(unsigned int maxKeypoints);

END_VISP_NAMESPACE
#endif
