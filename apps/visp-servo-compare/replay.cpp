/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "replay.h"

#include "appMain.h"
#include "cameraView.h"
#include "catalogue.h"
#include "figures.h"
#include "format.h"
#include "jobs.h"
#include "progress.h"
#include "videoFile.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace servoCompare
{
namespace
{
constexpr double VIDEO_RATE = 10.;    // frames per second
constexpr double VIDEO_DURATION = 8.; // s, about
constexpr int VIDEO_WIDTH = 480;
constexpr int STRIP_VIEW_WIDTH = 220;
constexpr int STRIP_LABEL_WIDTH = 150;
constexpr int STRIP_COLUMNS = 5;

double durationOf(const vpServoTask &task)
{
  double duration = 0.;
  for (const vpServoSegment &segment : task.segments) {
    duration += segment.duration;
  }
  return duration;
}

//! Integer speed-up, easy to read.
double speedUp(const vpServoTask &task) { return std::max(1., std::round(durationOf(task) / VIDEO_DURATION)); }

std::size_t indexAt(const vpServoRun &run, double time)
{
  const auto index = static_cast<std::size_t>(std::lround(time * run.spec.plant.loopRate));
  return std::min(index, run.samples.size() - 1);
}

std::string captionOf(const vpServoRun &run)
{
  const vpServoMetrics &m = run.metrics;
  return lawInfo(run.spec.law).name + ", plant " + run.spec.plant.name + ", " + number(speedUp(run.spec.task), 2) +
         " times as fast: ends " + fixed(m.end_rotation_deg, 1) + " deg off" +
         (m.out_of_view_s > 0. ? ", object partly out of view for " + fixed(m.out_of_view_s, 1) + " s."
                               : ", object always in view.");
}

//! Draws all frames of a run and passes them on; ends early when \e frame returns false.
void replay(const Plan &plan, const vpServoRun &run, const std::function<bool(const cv::Mat &)> &frame)
{
  CameraView view(plan, VIDEO_WIDTH);
  const double step = speedUp(run.spec.task) / VIDEO_RATE;
  const std::string speed = number(speedUp(run.spec.task), 2);
  const std::string title = lawInfo(run.spec.law).name + " - plant " + run.spec.plant.name + " - " + speed + "x speed";
  const auto frames = static_cast<int>(std::lround(run.samples.back().time / step));
  for (int i = 0; i <= frames; ++i) {
    vpApp::throwIfInterrupted();
    if (!frame(view.drawWithTitle(run, run.samples[indexAt(run, i * step)], title))) {
      return;
    }
  }
}
} // namespace

std::vector<ReplayVideo> writeVideos(const Plan &plan, const Results &results, vpApp::OutputFolder &out,
                                     unsigned int jobs, vpApp::PictureWindow *window)
{
  std::vector<const vpServoRun *> runs;
  std::vector<ReplayVideo> videos;
  for (const std::string &law : plan.laws) {
    if (const vpServoRun *run = results.find(law, plan.hardPlant().name, plan.mainMeasure())) {
      runs.push_back(run);
      videos.push_back({"video/" + fileName(law + "-" + run->spec.plant.name) + ".mp4", captionOf(*run), true});
      (void)out.file(videos.back().name); // creates the folder before the threads start
    }
  }
  vpApp::Progress progress("filming " + std::to_string(runs.size()) + " laws", static_cast<double>(runs.size()));
  // A window belongs to one thread.
  vpApp::runJobs(runs.size(), window == nullptr ? jobs : 1, [&](std::size_t i) {
    std::optional<vpApp::VideoFile> video;
    bool watching = window != nullptr;
    replay(plan, *runs[i], [&](const cv::Mat &frame) {
      if (!video) {
        video.emplace(out.file(videos[i].name), frame.cols, frame.rows, VIDEO_RATE);
      }
      video->write(frame);
      watching = watching && window->show(frame, 1. / VIDEO_RATE);
      return true;
    });
    video->close();
    videos[i].forBrowsers = video->isForBrowsers();
    progress.add(1.);
  });
  return videos;
}

FilmStrip drawFilmStrip(const Plan &plan, const Results &results)
{
  FilmStrip strip;
  strip.laws = figureLaws(plan, {"pbvs1", "kyrki-decoupled", "kyrki", "ff-sum", "ff-lookat-pi"});
  const double end = plan.scenario.task.segments.front().duration;
  for (int i = 0; i < STRIP_COLUMNS; ++i) {
    // Dense at first, when motion is fast, then sparse: 0.4, 1.2, 2.8, 5.2 and 8 s of 8 s.
    constexpr double shares[STRIP_COLUMNS] = {0.05, 0.15, 0.35, 0.65, 1.};
    strip.times.push_back(shares[i] * end);
  }
  CameraView view(plan, STRIP_VIEW_WIDTH);
  cv::Mat picture;
  for (const std::string &law : strip.laws) {
    const vpServoRun *run = results.find(law, plan.hardPlant().name, plan.mainMeasure());
    cv::Mat row;
    for (const double time : strip.times) {
      std::size_t index = indexAt(*run, time);
      while (index > 0 && run->samples[index].segment > 0) {
        --index; // the last cycle of the segment
      }
      cv::Mat tile;
      cv::copyMakeBorder(view.draw(run->samples[index]), tile, 2, 2, 2, 2, cv::BORDER_CONSTANT, cv::Scalar::all(255));
      if (row.empty()) {
        row = tile;
      }
      else {
        cv::hconcat(row, tile, row);
      }
    }
    cv::Mat label(row.rows, STRIP_LABEL_WIDTH, CV_8UC3, cv::Scalar::all(255));
    cv::putText(label, law, cv::Point(4, row.rows / 2), cv::FONT_HERSHEY_SIMPLEX, 0.5, cv::Scalar(30, 30, 30), 1,
                cv::LINE_AA);
    cv::hconcat(label, row, row);
    if (picture.empty()) {
      picture = row;
    }
    else {
      cv::vconcat(picture, row, picture);
    }
  }
  cv::Mat times(26, picture.cols, CV_8UC3, cv::Scalar::all(255));
  for (std::size_t i = 0; i < strip.times.size(); ++i) {
    const int x = STRIP_LABEL_WIDTH + static_cast<int>(i) * (STRIP_VIEW_WIDTH + 4) + 4;
    cv::putText(times, "t = " + fixed(strip.times[i], 1) + " s", cv::Point(x, 18), cv::FONT_HERSHEY_SIMPLEX, 0.5,
                cv::Scalar(30, 30, 30), 1, cv::LINE_AA);
  }
  cv::vconcat(times, picture, picture);
  std::vector<unsigned char> bytes;
  cv::imencode(".jpg", picture, bytes, {cv::IMWRITE_JPEG_QUALITY, 88});
  strip.jpeg.assign(bytes.begin(), bytes.end());
  return strip;
}
} // namespace servoCompare
