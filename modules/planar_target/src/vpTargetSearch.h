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
 * -# The most distinctive keypoints of lost targets are compared with it, for as many targets as a fixed number of
 *    comparisons allows, those first that have waited longest. The score is the number of matches.
 * -# Thorough searches, with all keypoints, in the order of (score + 1/2)^2 times the frames since the last one: likely
 *    targets come at once, a look-alike does not block the others, and every target is searched eventually. The first
 *    failed search ends the frame.
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
  vpPlanarTargetEffort m_effort;
};

END_VISP_NAMESPACE
#endif
