/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpTargetSearch.h
 * \brief Internal: data of one frame shared by all targets, computed once; tracking of the known targets in it, and the
 * search for the others with a bounded effort per frame.
 */
#ifndef vpTargetSearch_h
#define vpTargetSearch_h

#include "vpKeypoints.h"

#include <visp3/planar_target/vpPlanarTarget.h>

#include <cstdint>
#include <map>
#include <vector>

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
   * \param spec : Number and kind of the keypoints.
   * \param pixelAspect : Height of a pixel over its width, px / py of the camera. Keypoints are extracted from an image
   *   with square pixels, as detectors and descriptors assume.
   */
  vpTargetFrame(const vpPlanarTargetSpec &spec, double pixelAspect);

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

  vpPlanarTargetSpec m_spec;
  double m_stretchX, m_stretchY; // from the frame to square pixels
  cv::Mat m_image, m_square;     // m_square: with square pixels, empty until asked for
  vpKeypointSet m_part;
  std::vector<cv::Mat> m_pyramid;
  std::map<vpKeypointType, Keypoints> m_keypoints;
};

/*!
 * Per frame with a lost target, see vpPlanarTargetEffort:
 *
 * -# One extraction of keypoints: of the frame with the configured detector, or, every third time, of a part of it with
 *    the fallback (AKAZE takes five times as long).
 * -# The most telling keypoints of lost targets are compared with it, for as many targets as a fixed number of comparisons
 *    allows, those first that have waited longest. The score is the number of matches.
 * -# Thorough searches, with all keypoints, in the order of (score + 1/2)^2 times the frames since the last one: who seems to
 *    be there comes at once, a look-alike does not keep the others waiting, and everyone gets a turn. The first search in
 *    vain ends the frame.
 *
 * With more than a few lost targets a frame either compares, and then searches for those that seem to be there, or searches
 * only, by the last scores: both in one frame would take too long.
 */
class vpTargetSearch
{
public:
  //! \param targets : The same ones in the same order at each call; new ones may be appended; all of one configuration.
  void process(vpTargetFrame &frame, const std::vector<vpPlanarTarget::Impl *> &targets);
  //! Effort of the last process().
  [[nodiscard]] const vpPlanarTargetEffort &effort() const { return m_effort; }

private:
  static constexpr std::size_t mostDetectors = 2;
  struct Turns {
    std::uint64_t probed[mostDetectors] = {0, 0}, searched[mostDetectors] = {0, 0}; // frame of the last one
    double score = 0.; // when it was compared last, with the detector of the settings
    bool justLost = false;
  };
  struct Candidate {
    std::size_t target;
    double priority;
  };

  void follow(vpTargetFrame &frame, const std::vector<vpPlanarTarget::Impl *> &targets);
  void look(vpTargetFrame &frame, const std::vector<vpPlanarTarget::Impl *> &targets);

  std::vector<Turns> m_turns; // one for each target
  std::vector<std::size_t> m_lost;
  std::vector<Candidate> m_candidates;
  std::uint64_t m_frame = 0;
  unsigned int m_looks = 0, m_part = 0;
  bool m_blind = false; // the next frame with the detector of the settings compares nothing
  vpPlanarTargetEffort m_effort;
};

END_VISP_NAMESPACE
#endif
