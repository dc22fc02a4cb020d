/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "figures.h"

#include "film.h"
#include "numberText.h"
#include "runPicture.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace avoidObstacle
{
namespace
{
constexpr const char *TOOL_COLOUR = "#d62728";
constexpr int VIEWS = 6, VIEW_COLUMNS = 3, VIEW_WIDTH = 320;
} // namespace

Figure drawWay(const vpAvoidanceRun &run, const std::string &title, const std::vector<vpCollisionObject> &believed)
{
  vpApp::ArmPicture picture = vpApp::runPicture(run, title);
  picture.faint = believed;
  picture.traces = {vpApp::toolTrace(run, "tool", TOOL_COLOUR)};
  picture.traces.push_back({{run.samples.front().tool, run.samples.back().goal}, "#777777", true, "straight"});
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
  vpApp::ArmAnimation animation = vpApp::runAnimation(run, title);
  animation.traces = {vpApp::toolTrace(run, "tool", TOOL_COLOUR)};
  Figure figure;
  figure.name = "animation";
  figure.title = "The same as an animation";
  figure.caption = "Press Play or move the slider.";
  figure.html = vpApp::armAnimationHtml(*run.spec.arm, animation, "way");
  return figure;
}

namespace
{
//! Mostly images in which something was seen, and the last one.
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
  const std::vector<Frame> &frames = episode.sensorLog.frames;
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
