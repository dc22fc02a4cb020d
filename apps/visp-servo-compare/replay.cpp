/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "replay.h"

#include "appMain.h"
#include "format.h"
#include "jobs.h"
#include "progress.h"
#include "videoFile.h"

#include <visp3/rendering/vpPlaneRenderer.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace servoCompare
{
namespace
{
constexpr double VIDEO_RATE = 10.;    // frames per second
constexpr double VIDEO_DURATION = 8.; // s, about
constexpr int VIDEO_WIDTH = 480;
constexpr int STRIP_VIEW_WIDTH = 220;
constexpr int STRIP_LABEL_WIDTH = 190;
constexpr int STRIP_COLUMNS = 5;
constexpr int TITLE_HEIGHT = 44;
const cv::Scalar OBJECT(60, 220, 255); // BGR
const cv::Scalar GOAL(255, 210, 60);
const cv::Scalar WARNING(60, 60, 235);
const cv::Scalar WHITE(245, 245, 245);

// Pixel centres are at whole numbers, so the corner of the image is at (-0.5, -0.5).
vpCameraParameters scaled(const vpCameraParameters &camera, double scale)
{
  vpCameraParameters result;
  result.initPersProjWithoutDistortion(camera.get_px() * scale, camera.get_py() * scale,
                                       (camera.get_u0() + 0.5) * scale - 0.5, (camera.get_v0() + 0.5) * scale - 0.5);
  return result;
}

void write(cv::Mat &picture, const std::string &text, const cv::Point &at, double size, const cv::Scalar &colour)
{
  cv::putText(picture, text, at, cv::FONT_HERSHEY_SIMPLEX, size, cv::Scalar(0, 0, 0), 3, cv::LINE_AA);
  cv::putText(picture, text, at, cv::FONT_HERSHEY_SIMPLEX, size, colour, 1, cv::LINE_AA);
}

/*!
 * \brief Renders logged poses as images: the photo as seen by the camera, the outline of the object (yellow) and its
 * desired image position (cyan), and a warning when a corner is out of the image.
 *
 * Not thread-safe.
 */
class CameraView
{
public:
  //! \param plan : Task and photo. \param width : Width of the images, px; the height follows from the camera.
  CameraView(const Plan &plan, int width);

  //! The view of a sample, 8-bit BGR.
  [[nodiscard]] cv::Mat draw(const vpServoSample &sample);
  //! The view below a line of text: law, plant, time, segment. Width and height are even, as videos require.
  [[nodiscard]] cv::Mat drawWithTitle(const vpServoRun &run, const vpServoSample &sample, const std::string &title);

private:
  void drawOutline(cv::Mat &picture, const vpHomogeneousMatrix &cMo, const cv::Scalar &colour) const;

  vpServoTask m_task;
  double m_scale; //!< Image pixels per camera pixel.
  vpCameraParameters m_camera;
  cv::Size m_size;
  vpPlaneRenderer m_renderer;
  vpImage<unsigned char> m_grey;
};

CameraView::CameraView(const Plan &plan, int width)
  : m_task(plan.scenario.task), m_scale(double(width) / m_task.width), m_camera(scaled(m_task.camera, m_scale)),
    m_size(width, static_cast<int>(std::lround(m_task.height * m_scale))),
    m_renderer(plan.target.photo, m_task.objectWidth, m_task.objectHeight, m_camera, m_size.width, m_size.height)
{}

cv::Mat CameraView::draw(const vpServoSample &sample)
{
  m_renderer.render(sample.cMo, vpCameraFaults(), 0, m_grey);
  const cv::Mat grey(m_size.height, m_size.width, CV_8UC1, m_grey.bitmap);
  cv::Mat picture;
  cv::cvtColor(grey, picture, cv::COLOR_GRAY2BGR);
  drawOutline(picture, m_task.segments[sample.segment].cdMo, GOAL);
  drawOutline(picture, sample.cMo, OBJECT);
  if (!sample.inView) {
    cv::rectangle(picture, cv::Point(0, 0), cv::Point(m_size.width - 1, m_size.height - 1), WARNING, 3);
    write(picture, "OUT OF VIEW", cv::Point(10, m_size.height - 12), std::max(0.55, 0.0016 * m_size.width), WARNING);
  }
  return picture;
}

cv::Mat CameraView::drawWithTitle(const vpServoRun &run, const vpServoSample &sample, const std::string &title)
{
  const cv::Mat view = draw(sample);
  cv::Mat picture((view.rows + TITLE_HEIGHT + 1) / 2 * 2, (view.cols + 1) / 2 * 2, CV_8UC3, cv::Scalar(40, 34, 30));
  view.copyTo(picture(cv::Rect(0, TITLE_HEIGHT, view.cols, view.rows)));
  write(picture, title, cv::Point(8, 17), 0.5, WHITE);
  const std::string &segment = run.spec.task.segments[sample.segment].name;
  write(picture, "t = " + fixed(sample.time, 1) + " s, to pose " + segment, cv::Point(8, 37), 0.45, WHITE);
  write(picture, "object", cv::Point(picture.cols - 118, 37), 0.45, OBJECT);
  write(picture, "goal", cv::Point(picture.cols - 48, 37), 0.45, GOAL);
  return picture;
}

void CameraView::drawOutline(cv::Mat &picture, const vpHomogeneousMatrix &cMo, const cv::Scalar &colour) const
{
  constexpr int SUBPIXEL = 4; // bits
  std::array<cv::Point, 4> corners;
  for (int i = 0; i < 4; ++i) {
    const double x = (i == 0 || i == 3 ? -0.5 : 0.5) * m_task.objectWidth;
    const double y = (i < 2 ? -0.5 : 0.5) * m_task.objectHeight;
    const double Z = cMo[2][0] * x + cMo[2][1] * y + cMo[2][3];
    if (Z < 1e-3) {
      return;
    }
    const double u = m_camera.get_u0() + m_camera.get_px() * (cMo[0][0] * x + cMo[0][1] * y + cMo[0][3]) / Z;
    const double v = m_camera.get_v0() + m_camera.get_py() * (cMo[1][0] * x + cMo[1][1] * y + cMo[1][3]) / Z;
    corners[i] = cv::Point(cvRound(u * (1 << SUBPIXEL)), cvRound(v * (1 << SUBPIXEL)));
  }
  for (int i = 0; i < 4; ++i) {
    cv::line(picture, corners[i], corners[(i + 1) % 4], colour, 1, cv::LINE_AA, SUBPIXEL);
  }
}

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

//! The laws of the film strip: those that the thesis compares, or the first few.
std::vector<std::string> stripLaws(const Plan &plan)
{
  constexpr std::size_t FEW = 5;
  std::vector<std::string> chosen;
  for (const char *law : {"pbvs1", "kyrki-decoupled", "kyrki", "ff-sum", "ff-lookat-pi"}) {
    if (std::find(plan.laws.begin(), plan.laws.end(), law) != plan.laws.end()) {
      chosen.emplace_back(law);
    }
  }
  if (chosen.size() >= 2 && plan.laws.size() > FEW) {
    return chosen;
  }
  return {plan.laws.begin(), plan.laws.begin() + static_cast<std::ptrdiff_t>(std::min(FEW, plan.laws.size()))};
}

//! Draws all frames of a run and passes them on; ends early when \e frame returns false.
void replay(const Plan &plan, const vpServoRun &run, const std::function<bool(const cv::Mat &)> &frame)
{
  CameraView view(plan, VIDEO_WIDTH);
  const double step = speedUp(run.spec.task) / VIDEO_RATE;
  const std::string speed = number(speedUp(run.spec.task), 2);
  const std::string title = run.spec.law + " - plant " + run.spec.plant.name + " - " + speed + "x speed";
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
      videos.push_back(
          {"video/" + fileName(law + "-" + run->spec.plant.name) + ".mp4", law, speedUp(run->spec.task), true});
      (void)out.file(videos.back().file); // creates the folder before the threads start
    }
  }
  vpApp::Progress progress("filming " + std::to_string(runs.size()) + " laws", static_cast<double>(runs.size()));
  // A window belongs to one thread.
  vpApp::runJobs(runs.size(), window == nullptr ? jobs : 1, [&](std::size_t i) {
    std::optional<vpApp::VideoFile> video;
    bool watching = window != nullptr;
    replay(plan, *runs[i], [&](const cv::Mat &frame) {
      if (!video) {
        video.emplace(out.file(videos[i].file), frame.cols, frame.rows, VIDEO_RATE);
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
  strip.laws = stripLaws(plan);
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
