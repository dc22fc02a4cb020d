/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "figures.h"

#include "armPicture.h"
#include "film.h"
#include "numberText.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace avoidObstacle
{
namespace
{
constexpr int GHOSTS = 5;
constexpr std::size_t TRACE_POINTS = 300;
constexpr double FRAME = 0.05;  // s of an animation
constexpr double LONGEST = 20.; // s
constexpr int VIEWS = 6, VIEW_COLUMNS = 3, VIEW_WIDTH = 320;

vpCollisionObject objectAt(const vpMovingObstacle &obstacle, double t)
{
  vpCollisionObject object = obstacle.object;
  obstacle.stateAt(t, object.pose, object.velocity);
  return object;
}

//! When the tool has gone so much of its way.
const vpAvoidanceSample &sampleAt(const vpAvoidanceRun &run, double share)
{
  const auto step = [&](std::size_t i) { return (run.samples[i].tool - run.samples[i - 1].tool).norm(); };
  double length = 0., gone = 0.;
  for (std::size_t i = 1; i < run.samples.size(); ++i) {
    length += step(i);
  }
  for (std::size_t i = 1; i < run.samples.size(); ++i) {
    gone += step(i);
    if (gone >= share * length) {
      return run.samples[i];
    }
  }
  return run.samples.back();
}

vpApp::ArmTrace traceOf(const vpAvoidanceRun &run)
{
  vpApp::ArmTrace trace;
  trace.label = "tool";
  trace.colour = "#d62728";
  const std::size_t stride = std::max<std::size_t>(1, run.samples.size() / TRACE_POINTS);
  for (std::size_t i = 0; i < run.samples.size(); i += stride) {
    trace.points.push_back(run.samples[i].tool);
  }
  trace.points.push_back(run.samples.back().tool);
  return trace;
}

std::vector<vpApp::ArmMark> marksOf(const vpAvoidanceRun &run)
{
  return {{run.samples.front().tool, "start"}, {run.samples.back().goal, "goal"}};
}
} // namespace

Figure drawWay(const vpAvoidanceRun &run, const std::string &title, const std::vector<vpCollisionObject> &believed)
{
  vpApp::ArmPicture picture;
  picture.title = title;
  picture.ground = run.spec.scene.ground.has_value();
  picture.objects = run.spec.scene.objects;
  const double middle = sampleAt(run, 0.5).time;
  for (const vpMovingObstacle &obstacle : run.spec.obstacles) {
    picture.objects.push_back(objectAt(obstacle, std::max(middle, obstacle.appears)));
  }
  picture.faint = believed;
  for (int i = 0; i < GHOSTS; ++i) {
    const bool first = i == 0, last = i == GHOSTS - 1;
    const vpAvoidanceSample &s = first ? run.samples.front() : sampleAt(run, i / (GHOSTS - 1.));
    picture.ghosts.push_back({s.q, first ? "#8d99ae" : last ? "#1d3557" : "#5c7c9c", first || last ? 0.55 : 0.16});
  }
  picture.traces = {traceOf(run)};
  picture.traces.push_back({{run.samples.front().tool, run.samples.back().goal}, "#777777", true, "straight"});
  picture.marks = marksOf(run);
  Figure figure;
  figure.name = "way";
  figure.title = "The way of the tool from above and from the side";
  figure.caption = "The arm at the start (grey), at the end (dark) and in between (faint); obstacles where they truly "
                   "are when the tool is half way" +
                   std::string(believed.empty() ? "."
                                                : ", dashed as the track table had them in the end, with their "
                                                  "uncertainty.");
  figure.svg = vpApp::armPictureSvg(*run.spec.arm, picture);
  return figure;
}

Figure animate(const vpAvoidanceRun &run, const std::string &title)
{
  vpApp::ArmAnimation animation;
  animation.title = title;
  animation.ground = run.spec.scene.ground.has_value();
  animation.still = run.spec.scene.objects;
  for (const vpMovingObstacle &obstacle : run.spec.obstacles) {
    animation.objects.push_back(obstacle.object);
  }
  animation.traces = {traceOf(run)};
  animation.marks = marksOf(run);
  double next = 0.;
  for (const vpAvoidanceSample &s : run.samples) {
    if (s.time < next - 1e-9 || s.time > LONGEST) {
      continue;
    }
    next = s.time + FRAME;
    vpApp::ArmFrame frame;
    frame.time = s.time;
    frame.q = s.q;
    for (const vpMovingObstacle &obstacle : run.spec.obstacles) {
      frame.objects.push_back(objectAt(obstacle, s.time).pose);
      frame.visible.push_back(obstacle.isThere(s.time));
    }
    frame.caption = std::string(s.stopping ? "protective stop, " : "") + toString(s.status);
    animation.frames.push_back(frame);
  }
  Figure figure;
  figure.name = "animation";
  figure.title = "The same as an animation";
  figure.caption = "Press Play or move the slider.";
  figure.html = vpApp::armAnimationHtml(*run.spec.arm, animation, "way");
  return figure;
}

namespace
{
//! Most of the pictures from the time when something was seen, and the last one.
std::vector<std::size_t> shownFrames(const std::vector<Frame> &frames)
{
  std::size_t last = frames.size() - 1;
  const auto isEmpty = [](const Frame &frame) {
    return std::none_of(frame.sights.begin(), frame.sights.end(), [](const Sight &sight) { return sight.seen; });
  };
  while (last > 0 && isEmpty(frames[last])) {
    --last;
  }
  last = last > 0 ? last : frames.size() - 1;
  std::vector<std::size_t> shown;
  for (std::size_t i = 0; i + 1 < VIEWS; ++i) {
    shown.push_back(last * i / (VIEWS - 2));
  }
  shown.push_back(frames.size() - 1);
  return shown;
}
} // namespace

Figure drawViews(const Episode &episode)
{
  const std::vector<Frame> &frames = episode.diary.frames;
  const std::vector<std::size_t> shown = frames.empty() ? std::vector<std::size_t>() : shownFrames(frames);
  cv::Mat sheet;
  for (int row = 0; row < VIEWS / VIEW_COLUMNS && !frames.empty(); ++row) {
    cv::Mat line;
    for (int column = 0; column < VIEW_COLUMNS; ++column) {
      const std::size_t i = shown[static_cast<std::size_t>(row * VIEW_COLUMNS + column)];
      cv::Mat view = cameraPicture(frames[i]), tile;
      cv::resize(view, tile, cv::Size(VIEW_WIDTH, VIEW_WIDTH * view.rows / view.cols), 0., 0., cv::INTER_AREA);
      cv::copyMakeBorder(tile, tile, 2, 2, 2, 2, cv::BORDER_CONSTANT, cv::Scalar::all(255));
      line.empty() ? line = tile : (cv::hconcat(line, tile, line), line);
    }
    sheet.empty() ? sheet = line : (cv::vconcat(sheet, line, sheet), sheet);
  }
  Figure figure;
  figure.name = "views";
  figure.title = "What the camera in the hand saw";
  figure.caption = "From the first picture to the last one in which something was seen, and the last of all; what was "
                   "found is outlined.";
  std::vector<unsigned char> bytes;
  cv::imencode(".jpg", sheet, bytes, {cv::IMWRITE_JPEG_QUALITY, 88});
  figure.jpeg.assign(bytes.begin(), bytes.end());
  return figure;
}
} // namespace avoidObstacle
