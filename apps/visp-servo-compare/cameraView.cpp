/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "cameraView.h"

#include "format.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace servoCompare
{
namespace
{
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
} // namespace

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
} // namespace servoCompare
