/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "film.h"

#include "appMain.h"
#include "armCanvas.h"
#include "numberText.h"
#include "videoFile.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace avoidObstacle
{
namespace
{
using vpApp::ArmView;

const cv::Scalar FOUND(60, 220, 255), WARNING(60, 60, 235), WHITE(245, 245, 245), PAPER(250, 250, 250); // BGR
const cv::Scalar OBSTACLE(90, 120, 220), KNOWN(190, 190, 190), BELIEVED(40, 40, 200), ARM(140, 110, 70),
    TRACE(40, 40, 214), INK(60, 60, 60);
constexpr int VIEW_HEIGHT = 480, SIDE_WIDTH = 400;
constexpr int SUBPIXEL = 4; // bits

void write(cv::Mat &picture, const std::string &text, const cv::Point &at, const cv::Scalar &colour, double size = 0.55)
{
  cv::putText(picture, text, at, cv::FONT_HERSHEY_SIMPLEX, size, cv::Scalar::all(0), 3, cv::LINE_AA);
  cv::putText(picture, text, at, cv::FONT_HERSHEY_SIMPLEX, size, colour, 1, cv::LINE_AA);
}

//! \brief An orthographic view of arm and obstacles, always with the same scale.
class SideView
{
public:
  SideView(const vpAvoidanceRun &run, ArmView view, cv::Size size) : m_run(&run), m_view(view), m_size(size)
  {
    Eigen::Vector2d low = Eigen::Vector2d::Constant(-0.15), high = Eigen::Vector2d::Constant(0.15);
    const auto include = [&](const Eigen::Vector2d &p) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    };
    for (const vpAvoidanceSample &s : run.samples) {
      if (&s == &run.samples.front() || &s == &run.samples.back()) {
        for (const vpPlacedCapsule &capsule : vpApp::placeArm(*run.spec.arm, s.q).capsules) {
          include(vpApp::project(capsule.from, view));
          include(vpApp::project(capsule.to, view));
        }
      }
      include(vpApp::project(s.tool, view));
    }
    for (const vpMovingObstacle &obstacle : run.spec.obstacles) {
      for (const vpApp::Polygon &polygon : vpApp::outline(obstacle.object, view)) {
        std::for_each(polygon.begin(), polygon.end(), include);
      }
    }
    constexpr double room = 0.1; // m
    m_low = low.array() - room;
    const Eigen::Vector2d extent = high - low + Eigen::Vector2d::Constant(2. * room);
    m_scale = std::min(size.width / extent.x(), size.height / extent.y());
  }

  [[nodiscard]] cv::Mat draw(const vpAvoidanceSample &s, const std::vector<vpCollisionObject> &believed) const
  {
    cv::Mat picture(m_size, CV_8UC3, PAPER);
    for (const vpCollisionObject &object : m_run->spec.scene.objects) {
      fill(picture, object, KNOWN);
    }
    for (const vpMovingObstacle &obstacle : m_run->spec.obstacles) {
      vpCollisionObject object = obstacle.object;
      obstacle.stateAt(s.time, object.pose, object.velocity);
      if (obstacle.isThere(s.time)) {
        fill(picture, object, OBSTACLE);
      }
    }
    drawArm(picture, s);
    for (const vpCollisionObject &object : believed) {
      for (const vpApp::Polygon &polygon : vpApp::outline(object, m_view)) {
        cv::polylines(picture, points(polygon), true, BELIEVED, 1, cv::LINE_AA, SUBPIXEL);
      }
    }
    write(picture, m_view == ArmView::Top ? "from above" : "from the side", cv::Point(8, 18), WHITE, 0.45);
    return picture;
  }

private:
  [[nodiscard]] cv::Point pixel(const Eigen::Vector2d &p) const
  {
    const double u = (p.x() - m_low.x()) * m_scale, v = m_size.height - (p.y() - m_low.y()) * m_scale;
    return {cvRound(u * (1 << SUBPIXEL)), cvRound(v * (1 << SUBPIXEL))};
  }
  [[nodiscard]] std::vector<cv::Point> points(const vpApp::Polygon &polygon) const
  {
    std::vector<cv::Point> result;
    for (const Eigen::Vector2d &p : polygon) {
      result.push_back(pixel(p));
    }
    return result;
  }
  void fill(cv::Mat &picture, const vpCollisionObject &object, const cv::Scalar &colour) const
  {
    for (const vpApp::Polygon &polygon : vpApp::outline(object, m_view)) {
      cv::fillPoly(picture, std::vector<std::vector<cv::Point>>{points(polygon)}, colour, cv::LINE_AA, SUBPIXEL);
    }
  }
  void drawArm(cv::Mat &picture, const vpAvoidanceSample &now) const
  {
    for (const vpPlacedCapsule &capsule : vpApp::placeArm(*m_run->spec.arm, now.q).capsules) {
      const int width = std::max(1, cvRound(2. * capsule.radius * m_scale));
      cv::line(picture, pixel(vpApp::project(capsule.from, m_view)), pixel(vpApp::project(capsule.to, m_view)), ARM,
               width, cv::LINE_AA, SUBPIXEL);
    }
    std::vector<cv::Point> way;
    for (const vpAvoidanceSample &s : m_run->samples) {
      if (s.time <= now.time) {
        way.push_back(pixel(vpApp::project(s.tool, m_view)));
      }
    }
    cv::polylines(picture, way, false, TRACE, 2, cv::LINE_AA, SUBPIXEL);
    cv::circle(picture, pixel(vpApp::project(now.goal, m_view)), 5 << SUBPIXEL, INK, 2, cv::LINE_AA, SUBPIXEL);
  }

  const vpAvoidanceRun *m_run;
  ArmView m_view;
  cv::Size m_size;
  Eigen::Vector2d m_low;
  double m_scale = 1.;
};

const vpAvoidanceSample &sampleAt(const vpAvoidanceRun &run, double time)
{
  const auto after = std::lower_bound(run.samples.begin(), run.samples.end(), time - 1e-9,
                                      [](const vpAvoidanceSample &s, double t) { return s.time < t; });
  return after == run.samples.end() ? run.samples.back() : *after;
}

//! Even numbers, as videos require.
cv::Mat evened(const cv::Mat &picture)
{
  cv::Mat result;
  cv::copyMakeBorder(picture, result, 0, picture.rows % 2, 0, picture.cols % 2, cv::BORDER_CONSTANT);
  return result;
}
} // namespace

cv::Mat cameraPicture(const Frame &frame)
{
  const std::vector<unsigned char> bytes(frame.jpeg.begin(), frame.jpeg.end());
  cv::Mat picture = cv::imdecode(bytes, cv::IMREAD_COLOR);
  for (const Sight &sight : frame.sights) {
    for (std::size_t k = 0; k < 4 && sight.outlined; ++k) {
      const Eigen::Vector2d &a = sight.corners[k], &b = sight.corners[(k + 1) % 4];
      cv::line(picture, cv::Point2d(a.x(), a.y()), cv::Point2d(b.x(), b.y()), FOUND, 2, cv::LINE_AA);
    }
    if (sight.outlined) {
      write(picture, sight.object, cv::Point2d(sight.corners[0].x(), sight.corners[0].y() - 8.), FOUND);
    }
  }
  write(picture, "t = " + vpApp::fixed(frame.time, 2) + " s", cv::Point(10, picture.rows - 12), WHITE);
  if (frame.covered) {
    write(picture, "covered", cv::Point(130, picture.rows - 12), WARNING);
  }
  return picture;
}

bool makeFilm(const Episode &episode, const std::string &file, vpApp::PictureWindow *window)
{
  const vpAvoidanceRun &run = episode.run;
  const SideView top(run, ArmView::Top, {SIDE_WIDTH, VIEW_HEIGHT}), side(run, ArmView::Side, {SIDE_WIDTH, VIEW_HEIGHT});
  std::optional<vpApp::VideoFile> video;
  for (const Frame &frame : episode.sensorLog.frames) {
    vpApp::throwIfInterrupted();
    const vpAvoidanceSample &s = sampleAt(run, frame.time);
    const std::vector<vpCollisionObject> believed = believedAt(episode, frame.time);
    cv::Mat picture = cameraPicture(frame);
    cv::resize(picture, picture, cv::Size(picture.cols * VIEW_HEIGHT / picture.rows, VIEW_HEIGHT));
    write(picture, std::string(s.stopping ? "protective stop, " : "") + vpToString(s.status), cv::Point(10, 22), WHITE);
    const cv::Mat parts[] = {picture, top.draw(s, believed), side.draw(s, believed)};
    cv::hconcat(parts, 3, picture);
    picture = evened(picture);
    if (!file.empty() && !video) {
      video.emplace(file, picture.cols, picture.rows, run.spec.visionRate);
    }
    if (video) {
      video->write(picture);
    }
    if (window != nullptr && !window->show(picture, 1. / run.spec.visionRate)) {
      window = nullptr;
    }
  }
  if (!video) {
    return true;
  }
  video->close();
  return video->isForBrowsers();
}
} // namespace avoidObstacle
