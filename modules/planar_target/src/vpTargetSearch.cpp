/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpTargetSearch.h"

#include "vpPlanarTargetImpl.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr std::size_t maxLevels = 5;
constexpr double smoothing = 1.;   // px; against noise, and so that the reference can be made as soft as the frame
constexpr int minSideToHalve = 48; // a smaller level could not contain the coarsest template

constexpr unsigned int fallbackEvery = 3; // frames; so that its nine parts take 27, less than a second at 30 Hz
constexpr std::uint64_t waited = 30;      // frames, of a target just lost: soon, but not before all others
// Of 128 telling keypoints 0 to 7 match in views without the target, by chance, and 11 or more in most that show it.
constexpr double enoughMatches = 8.;
constexpr std::size_t few =
    3; // lost targets, for which comparing and searching blindly in the same frame takes no time
constexpr std::size_t mostComparisons =
    20'000'000; // 64-bit words; 6 ms. 130 keypoints of ORB with 1500 take 0.8 million
} // namespace

vpTargetFrame::vpTargetFrame(const vpPlanarTargetSpec &spec, double pixelAspect)
  : m_spec(spec), m_stretchX(1. / std::sqrt(pixelAspect)), m_stretchY(std::sqrt(pixelAspect))
{
  constexpr double nearlySquare = 0.02;
  if (std::abs(pixelAspect - 1.) < nearlySquare) {
    m_stretchX = m_stretchY = 1.;
  }
}

void vpTargetFrame::assign(const vpImage<unsigned char> &image)
{
  for (auto &entry : m_keypoints) {
    entry.second.valid = false;
  }
  if (m_pyramid.empty()) {
    m_pyramid.emplace_back();
  }
  pixelsOf(image).copyTo(m_image);
  m_square.release();
  cv::GaussianBlur(m_image, m_pyramid[0], cv::Size(5, 5), smoothing, 0., cv::BORDER_REPLICATE);
  std::size_t levels = 1;
  while (levels < maxLevels && std::min(m_pyramid[levels - 1].cols, m_pyramid[levels - 1].rows) >= minSideToHalve) {
    if (m_pyramid.size() == levels) {
      m_pyramid.emplace_back();
    }
    cv::pyrDown(m_pyramid[levels - 1], m_pyramid[levels]);
    ++levels;
  }
  m_pyramid.resize(levels);
}

vpKeypointExtractor &vpTargetFrame::extractor(vpKeypointType type)
{
  Keypoints &entry = m_keypoints[type];
  if (!entry.extractor) {
    entry.extractor = makeKeypointExtractor(type, m_spec);
  }
  return *entry.extractor;
}

// In a part of the image with square pixels; positions are in the frame.
void vpTargetFrame::extract(vpKeypointType type, const cv::Rect &where, vpKeypointSet &set)
{
  extractor(type).extract(m_square(where), set);
  for (cv::Point2f &point : set.points) {
    point.x = static_cast<float>((point.x + where.x + 0.5) / m_stretchX - 0.5);
    point.y = static_cast<float>((point.y + where.y + 0.5) / m_stretchY - 0.5);
  }
}

void vpTargetFrame::makeSquare()
{
  if (!m_square.empty()) {
    return;
  }
  if (m_stretchX == 1.) {
    m_square = m_image;
  }
  else {
    cv::resize(m_image, m_square, cv::Size(), m_stretchX, m_stretchY, cv::INTER_LINEAR);
  }
}

const vpKeypointSet &vpTargetFrame::keypoints(vpKeypointType type)
{
  Keypoints &entry = m_keypoints[type];
  if (!entry.valid) {
    makeSquare();
    extract(type, cv::Rect(0, 0, m_square.cols, m_square.rows), entry.set);
    entry.valid = true;
  }
  return entry.set;
}

const vpKeypointSet &vpTargetFrame::keypointsOfPart(vpKeypointType type, unsigned int part)
{
  makeSquare();
  const int column = static_cast<int>(part % 3U), row = static_cast<int>(part / 3U % 3U);
  const cv::Size size(m_square.cols / 2, m_square.rows / 2);
  extract(type, cv::Rect(cv::Point(column * m_square.cols / 4, row * m_square.rows / 4), size), m_part);
  return m_part;
}

void vpTargetSearch::process(vpTargetFrame &frame, const std::vector<vpPlanarTarget::Impl *> &targets)
{
  m_effort = vpPlanarTargetEffort();
  ++m_frame;
  m_turns.resize(targets.size());
  follow(frame, targets);
  if (!m_lost.empty()) {
    look(frame, targets);
  }
}

void vpTargetSearch::follow(vpTargetFrame &frame, const std::vector<vpPlanarTarget::Impl *> &targets)
{
  m_lost.clear();
  for (std::size_t i = 0; i < targets.size(); ++i) {
    m_turns[i].justLost = targets[i]->m_known;
    if (targets[i]->m_known) {
      targets[i]->trackLast(frame);
      ++m_effort.followed;
    }
    if (targets[i]->m_known) {
      continue;
    }
    m_lost.push_back(i);
    if (m_turns[i].justLost) {
      const std::uint64_t before = m_frame > waited ? m_frame - waited : 0;
      std::fill_n(m_turns[i].searched, mostDetectors, before);
      std::fill_n(m_turns[i].probed, mostDetectors, 0);
    }
  }
}

void vpTargetSearch::look(vpTargetFrame &frame, const std::vector<vpPlanarTarget::Impl *> &targets)
{
  const auto &references = targets[m_lost[0]]->m_references;
  const bool fallback = references.size() > 1 && m_looks % fallbackEvery == fallbackEvery - 1;
  ++m_looks;
  const std::size_t detector = fallback ? 1 : 0;
  const vpKeypointType type = references[detector].type;
  const vpKeypointSet &current = fallback ? frame.keypointsOfPart(type, m_part++ % 9) : frame.keypoints(type);
  m_effort.extractions = 1;
  const auto probed = [this, detector](std::size_t i) { return m_turns[i].probed[detector]; };
  std::stable_sort(m_lost.begin(), m_lost.end(),
                   [&probed](std::size_t a, std::size_t b) { return probed(a) < probed(b); });
  // The fallback does not take turns: its nine parts are an odd number.
  const bool isBlind = !fallback && m_lost.size() > few && m_blind, alsoBlind = fallback || m_lost.size() <= few;
  m_blind = fallback ? m_blind : !m_blind;
  m_candidates.clear();
  for (const std::size_t i : m_lost) {
    const double waiting = static_cast<double>(m_frame - m_turns[i].searched[detector]);
    if (isBlind) {
      const double score = m_turns[i].score + 0.5;
      m_candidates.push_back({i, score * score * waiting});
      continue;
    }
    const vpKeypointSet &telling = targets[i]->m_references[detector].telling;
    m_effort.comparisons += telling.points.size() * current.points.size() * current.words();
    if (m_effort.comparisons > mostComparisons && m_effort.probed > 0) {
      break;
    }
    ++m_effort.probed;
    m_turns[i].probed[detector] = m_frame;
    const double matches = static_cast<double>(targets[i]->matchesOf(telling, current));
    if (!fallback) {
      m_turns[i].score = matches;
    }
    if (alsoBlind || matches >= enoughMatches) {
      m_candidates.push_back({i, (matches + 0.5) * (matches + 0.5) * waiting});
    }
  }
  std::stable_sort(m_candidates.begin(), m_candidates.end(),
                   [](const Candidate &a, const Candidate &b) { return a.priority > b.priority; });
  bool found = true;
  for (std::size_t k = 0; k < m_candidates.size() && found; ++k) {
    const std::size_t i = m_candidates[k].target;
    ++m_effort.searches;
    m_turns[i].searched[detector] = m_frame;
    const bool outOfView = m_turns[i].justLost && targets[i]->m_result.status == vpPlanarTargetStatus::OutOfView;
    const vpPlanarTargetResult before = targets[i]->m_result;
    targets[i]->acquireWith(targets[i]->m_references[detector], current, frame);
    found = targets[i]->m_known;
    // Keypoints do not show that the target has just left the view; tracking does.
    if (!found && outOfView) {
      targets[i]->m_result = before;
    }
  }
  for (const std::size_t i : m_lost) {
    if (targets[i]->m_result.status == vpPlanarTargetStatus::NoFrame) {
      targets[i]->fail(vpPlanarTargetStatus::TooFewInliers, "Not looked for yet: lost targets take their turns.");
    }
  }
}

END_VISP_NAMESPACE
