/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpTargetFrame.h
 * \brief Internal: what all targets share of one frame, computed once.
 */
#ifndef vpTargetFrame_h
#define vpTargetFrame_h

#include "vpKeypointExtractor.h"

#include <map>

BEGIN_VISP_NAMESPACE

/*!
 * One frame: its grey-value pyramid and, when asked for, its keypoints. Level 0 of the pyramid is the frame, lightly
 * smoothed; level l is level l-1 smoothed and halved by cv::pyrDown, which keeps pixel centres: pixel u of level 0 is
 * u / 2^l of level l. Keypoints are those of the frame as it is.
 */
class vpTargetFrame
{
public:
  explicit vpTargetFrame(unsigned int maxKeypoints) : m_maxKeypoints(maxKeypoints) {}

  //! Take a new frame (the pixels are copied) and forget the keypoints of the one before.
  void assign(const vpImage<unsigned char> &image);

  //! The frame as it is.
  [[nodiscard]] const cv::Mat &image() const { return m_image; }
  [[nodiscard]] const std::vector<cv::Mat> &pyramid() const { return m_pyramid; }
  //! Keypoints of one kind, extracted at the first call.
  const vpKeypointSet &keypoints(vpKeypointType type);

private:
  struct Keypoints {
    std::unique_ptr<vpKeypointExtractor> extractor;
    vpKeypointSet set;
    bool valid = false;
  };
  unsigned int m_maxKeypoints;
  cv::Mat m_image;
  std::vector<cv::Mat> m_pyramid;
  std::map<vpKeypointType, Keypoints> m_keypoints;
};

END_VISP_NAMESPACE
#endif
