/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpTargetFrame.h
 * \brief Internal: data of one frame shared by all targets, computed once.
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
  /*!
   * \param maxKeypoints : As in vpPlanarTargetSpec.
   * \param pixelAspect : Height of a pixel over its width, px / py of the camera. Keypoints are extracted from an image
   *   with square pixels, as detectors and descriptors assume.
   */
  vpTargetFrame(unsigned int maxKeypoints, double pixelAspect);

  //! Set a new frame (the pixels are copied) and forget the previous keypoints.
  void assign(const vpImage<unsigned char> &image);

  //! The frame as given.
  [[nodiscard]] const cv::Mat &image() const { return m_image; }
  [[nodiscard]] const std::vector<cv::Mat> &pyramid() const { return m_pyramid; }
  //! Keypoints of one kind, extracted at the first call.
  const vpKeypointSet &keypoints(vpKeypointType type);
  /*!
   * Keypoints of a part of half the width and half the height, extracted now; valid until the next call.
   * \param part : Index, modulo 9, of nine parts that overlap by half, row by row.
   */
  const vpKeypointSet &keypointsOfPart(vpKeypointType type, unsigned int part);

private:
  struct Keypoints {
    std::unique_ptr<vpKeypointExtractor> extractor;
    vpKeypointSet set;
    bool valid = false;
  };
  void makeSquare();
  vpKeypointExtractor &extractor(vpKeypointType type);
  void extract(vpKeypointType type, const cv::Rect &where, vpKeypointSet &set);

  unsigned int m_maxKeypoints;
  double m_stretchX, m_stretchY; // from the frame to square pixels
  cv::Mat m_image, m_square;     // m_square: with square pixels, empty until asked for
  vpKeypointSet m_part;
  std::vector<cv::Mat> m_pyramid;
  std::map<vpKeypointType, Keypoints> m_keypoints;
};

END_VISP_NAMESPACE
#endif
