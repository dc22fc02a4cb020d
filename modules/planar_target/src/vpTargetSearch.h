/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpTargetSearch.h
 * \brief Internal: tracks the known targets, and searches for the others with a bounded effort per frame.
 */
#ifndef vpTargetSearch_h
#define vpTargetSearch_h

#include <visp3/planar_target/vpPlanarTarget.h>

#include <cstdint>
#include <vector>

BEGIN_VISP_NAMESPACE

class vpTargetFrame;

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
