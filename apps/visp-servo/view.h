/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file view.h
 * \brief Draws what the camera sees, what was found, where it should be, and what the robot does.
 */
#ifndef visualServo_view_h
#define visualServo_view_h

#include "servoRun.h"

#include <visp3/core/vpCameraParameters.h>
#include <visp3/core/vpImage.h>

#include <opencv2/core.hpp>

#include <deque>
#include <string>
#include <vector>

namespace visualServo
{
/*!
 * \brief Pictures for the window and the video, in BGR: the image with the outline of the target (green), that of the goal (blue) and the
 * trails of its points (yellow), above lines of text.
 */
class View
{
public:
  //! \param camera : Projects what is found. \param width, height : Size of the images, px. \param limits : Lengths of the speed bars.
  View(const vpCameraParameters &camera, unsigned int width, unsigned int height, const vpServoMotionLimits &limits);
  //! Outline of the goal until an image brings another.
  void setGoal(const std::vector<vpServoPoint> &points) { m_goal = points; }
  //! \param isLive : With the keys.
  [[nodiscard]] cv::Mat draw(const Moment &moment, bool isLive);

private:
  [[nodiscard]] std::vector<cv::Point2d> pixelsOf(const std::vector<vpServoPoint> &points) const;
  void outline(cv::Mat &picture, const std::vector<vpServoPoint> &points, const cv::Scalar &colour,
               bool isDashed) const;
  void trail(cv::Mat &picture, const ImageRow &seen);
  void panel(cv::Mat &picture, const Moment &moment, bool isLive) const;
  void bar(cv::Mat &picture, int row, const std::string &label, double value, double limit,
           const std::string &text) const;

  vpCameraParameters m_camera;
  cv::Size m_size; // of the picture's upper part
  double m_scale;
  vpServoMotionLimits m_limits;
  std::vector<vpServoPoint> m_goal;
  struct Trace {
    double time;
    std::vector<cv::Point2d> points;
  };
  std::deque<Trace> m_trail;
};
} // namespace visualServo

#endif
