/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "film.h"

#include "appMain.h"
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
const cv::Scalar FOUND(60, 220, 255), WARNING(60, 60, 235), WHITE(245, 245, 245); // BGR
constexpr int VIEWS = 40, VIEW_WIDTH = 400, VIEW_QUALITY = 80;

void write(cv::Mat &picture, const std::string &text, const cv::Point &at, const cv::Scalar &colour)
{
  constexpr double size = 0.55;
  cv::putText(picture, text, at, cv::FONT_HERSHEY_SIMPLEX, size, cv::Scalar::all(0), 3, cv::LINE_AA);
  cv::putText(picture, text, at, cv::FONT_HERSHEY_SIMPLEX, size, colour, 1, cv::LINE_AA);
}

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

void writeViews(vpApp::OutputFolder &out, const std::vector<Frame> &frames)
{
  std::string csv = "time_s,file\n";
  const std::size_t count = std::min<std::size_t>(VIEWS, frames.size());
  for (std::size_t i = 0; i < count; ++i) { // the first, the last, and evenly between
    const Frame &frame = frames[count < 2 ? 0 : i * (frames.size() - 1) / (count - 1)];
    cv::Mat picture = cameraPicture(frame);
    cv::resize(picture, picture, cv::Size(VIEW_WIDTH, VIEW_WIDTH * picture.rows / picture.cols), 0., 0.,
               cv::INTER_AREA);
    std::vector<unsigned char> bytes;
    cv::imencode(".jpg", picture, bytes, {cv::IMWRITE_JPEG_QUALITY, VIEW_QUALITY});
    const std::string name = "view/" + std::to_string(i) + ".jpg";
    out.write(name, std::string(bytes.begin(), bytes.end()));
    csv += vpApp::number(frame.time, 7) + "," + name + "\n";
  }
  out.write("views.csv", csv);
}

bool makeFilm(const Episode &episode, const std::string &file, vpApp::PictureWindow *window)
{
  const vpAvoidanceRun &run = episode.run;
  std::optional<vpApp::VideoFile> video;
  for (const Frame &frame : episode.sensorLog.frames) {
    vpApp::throwIfInterrupted();
    const vpAvoidanceSample &s = sampleAt(run, frame.time);
    cv::Mat picture = cameraPicture(frame);
    write(picture, std::string(s.stopping ? "protective stop, " : "") + vpToString(s.status), cv::Point(10, 22), WHITE);
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
