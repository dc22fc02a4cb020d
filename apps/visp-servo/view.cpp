/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "view.h"

#include "numberText.h"

#include <visp3/core/vpMath.h>
#include <visp3/core/vpMeterPixelConversion.h>

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace visualServo
{
namespace
{
const cv::Scalar FOUND(80, 220, 60), WANTED(255, 150, 60), TRAIL(60, 220, 240), TEXT(235, 235, 235),
    FAINT(150, 150, 150), WARNING(70, 90, 255), BACK(40, 36, 32);
constexpr double SMALLEST_WIDTH = 640., TRAIL_TIME = 3.;       // px, s
constexpr int PANEL = 120, LINE = 22, MARGIN = 10, BARS = 190; // px
constexpr std::size_t MOST_CORNERS = 8;                        // more are drawn as points

void write(cv::Mat &picture, int x, int y, const std::string &text, const cv::Scalar &colour, double size = 0.45)
{
  cv::putText(picture, text, {x, y}, cv::FONT_HERSHEY_SIMPLEX, size, colour, 1, cv::LINE_AA);
}

void dashed(cv::Mat &picture, const cv::Point2d &from, const cv::Point2d &to, const cv::Scalar &colour)
{
  const double length = cv::norm(to - from);
  for (double at = 0.; at < length; at += 12.) {
    const cv::Point2d unit = (to - from) / length;
    cv::line(picture, from + at * unit, from + std::min(at + 7., length) * unit, colour, 2, cv::LINE_AA);
  }
}

bool isInside(const cv::Point2d &p) { return std::fabs(p.x) < 1e5 && std::fabs(p.y) < 1e5; }
} // namespace

View::View(const vpCameraParameters &camera, unsigned int width, unsigned int height, const vpServoMotionLimits &limits)
  : m_camera(camera), m_scale(std::max(1., std::ceil(SMALLEST_WIDTH / width))), m_limits(limits)
{
  // Even, as video needs it.
  m_size = cv::Size(static_cast<int>(m_scale * width) / 2 * 2, static_cast<int>(m_scale * height) / 2 * 2);
}

std::vector<cv::Point2d> View::pixelsOf(const std::vector<vpServoPoint> &points) const
{
  std::vector<cv::Point2d> pixels;
  for (const vpServoPoint &point : points) {
    double u = 0., v = 0.;
    vpMeterPixelConversion::convertPoint(m_camera, point.x, point.y, u, v);
    pixels.emplace_back(m_scale * (u + 0.5) - 0.5, m_scale * (v + 0.5) - 0.5);
  }
  return pixels;
}

void View::outline(cv::Mat &picture, const std::vector<vpServoPoint> &points, const cv::Scalar &colour,
                   bool isDashed) const
{
  const std::vector<cv::Point2d> pixels = pixelsOf(points);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const cv::Point2d &a = pixels[i], &b = pixels[(i + 1) % pixels.size()];
    if (!isInside(a) || !isInside(b)) {
      continue;
    }
    if (pixels.size() > MOST_CORNERS || pixels.size() < 3) {
      cv::circle(picture, a, 3, colour, isDashed ? 1 : cv::FILLED, cv::LINE_AA);
    }
    else if (isDashed) {
      dashed(picture, a, b, colour);
    }
    else {
      cv::line(picture, a, b, colour, 2, cv::LINE_AA);
    }
  }
}

void View::trail(cv::Mat &picture, const ImageRow &seen)
{
  if (seen.found && seen.outline.size() <= MOST_CORNERS && (m_trail.empty() || seen.capture > m_trail.back().time)) {
    m_trail.push_back({seen.capture, pixelsOf(seen.outline)});
  }
  while (!m_trail.empty() && m_trail.front().time < seen.capture - TRAIL_TIME) {
    m_trail.pop_front();
  }
  for (std::size_t i = 1; i < m_trail.size(); ++i) {
    const std::vector<cv::Point2d> &a = m_trail[i - 1].points, &b = m_trail[i].points;
    for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k) {
      if (isInside(a[k]) && isInside(b[k])) {
        cv::line(picture, a[k], b[k], TRAIL, 1, cv::LINE_AA);
      }
    }
  }
}

void View::bar(cv::Mat &picture, int row, const std::string &label, double value, double limit,
               const std::string &text) const
{
  const int x = picture.cols - BARS - MARGIN, y = m_size.height + row * LINE;
  write(picture, x, y + 14, label, FAINT, 0.4);
  const cv::Rect whole(x + 50, y + 5, 60, 9);
  cv::rectangle(picture, whole, FAINT, 1);
  const double share = std::clamp(value / limit, 0., 1.);
  cv::rectangle(picture, cv::Rect(whole.x, whole.y, static_cast<int>(std::lround(share * whole.width)), whole.height),
                FOUND, cv::FILLED);
  write(picture, x + 118, y + 14, text, TEXT, 0.4);
}

void View::panel(cv::Mat &picture, const Moment &moment, bool isLive) const
{
  if (moment.cycle == nullptr) {
    return;
  }
  const CycleRow &row = *moment.cycle;
  const int top = m_size.height;
  const bool isGood = row.status <= vpVisualServoStatus::Idle;
  const std::string &sentence = moment.sentence;
  // Two lines of text where one is too short.
  const std::size_t room = static_cast<std::size_t>(picture.cols - BARS - 3 * MARGIN) / 8;
  const std::size_t cut = sentence.size() <= room ? sentence.size() : sentence.rfind(' ', room);
  write(picture, MARGIN, top + LINE - 4, sentence.substr(0, cut), isGood ? TEXT : WARNING);
  write(picture, MARGIN, top + 2 * LINE - 4, cut < sentence.size() ? sentence.substr(cut + 1) : "",
        isGood ? TEXT : WARNING);
  const std::string goal = row.hasPose ? "to the goal " + vpApp::fixed(1e3 * row.positionError, 1) + " mm, " +
                                             vpApp::fixed(vpMath::deg(row.rotationError), 2) + " deg"
                                       : "target not seen";
  write(picture, MARGIN, top + 3 * LINE - 4, vpApp::fixed(row.time, 1) + " s   " + goal, TEXT);
  std::string images = std::to_string(moment.images) + " images";
  if (isLive) {
    images += ", " + vpApp::fixed(moment.imageRate, 0) + "/s, " + std::to_string(moment.lost) + " lost";
  }
  write(picture, MARGIN, top + 4 * LINE - 4, moment.law + "   " + images, FAINT);
  if (isLive) {
    write(picture, MARGIN, top + 5 * LINE - 4,
          std::string("space: ") + (moment.isMoving ? "stop" : "START") + "   l: next law   q: quit", FAINT);
  }
  bar(picture, 0, "linear", row.twist.linearNorm(), m_limits.linearVelocity,
      vpApp::fixed(1e3 * row.twist.linearNorm(), 1) + " mm/s");
  bar(picture, 1, "angular", row.twist.angularNorm(), m_limits.angularVelocity,
      vpApp::fixed(vpMath::deg(row.twist.angularNorm()), 1) + " deg/s");
  bar(picture, 2, "image", row.age, 0.5, std::isfinite(row.age) ? vpApp::fixed(1e3 * row.age, 0) + " ms old" : "none");
}

cv::Mat View::draw(const Moment &moment, bool isLive)
{
  cv::Mat picture(m_size.height + PANEL, m_size.width, CV_8UC3, BACK);
  if (moment.image != nullptr) {
    const cv::Mat grey(static_cast<int>(moment.image->getHeight()), static_cast<int>(moment.image->getWidth()), CV_8UC1,
                       moment.image->bitmap);
    cv::Mat scaled, colour;
    cv::resize(grey, scaled, m_size, 0., 0., cv::INTER_LINEAR);
    cv::cvtColor(scaled, colour, cv::COLOR_GRAY2BGR);
    cv::Mat upper = picture.rowRange(0, m_size.height);
    colour.copyTo(upper);
    const ImageRow &seen = *moment.seen;
    m_goal = seen.goal.empty() ? m_goal : seen.goal;
    outline(upper, m_goal, WANTED, true);
    trail(upper, seen);
    if (seen.found) {
      outline(upper, seen.outline, FOUND, false);
    }
    write(upper, MARGIN, LINE, "target", FOUND);
    write(upper, MARGIN + 60, LINE, "goal", WANTED);
  }
  panel(picture, moment, isLive);
  return picture;
}
} // namespace visualServo
