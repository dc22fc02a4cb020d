/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file cameraView.h
 * \brief What the camera sees at one instant of a run, with the goal drawn over it.
 */
#ifndef servoCompare_cameraView_h
#define servoCompare_cameraView_h

#include "plan.h"

#include <visp3/rendering/vpPlaneRenderer.h>

#include <opencv2/core.hpp>

namespace servoCompare
{
/*!
 * \brief Renders logged poses as pictures: the photo as the camera sees it, the outline of the object (yellow) and of
 * where the goal wants it (cyan), and a warning when a corner is out of the image.
 *
 * Not to be used by two threads at a time.
 */
class CameraView
{
public:
  //! \param plan : Task and photo. \param width : Width of the pictures, px; their height follows from the camera's.
  CameraView(const Plan &plan, int width);

  //! The view of a sample, 8-bit BGR.
  [[nodiscard]] cv::Mat draw(const vpServoSample &sample);
  //! The view below a strip of text: law, plant, time, segment. Width and height are even, as videos need it.
  [[nodiscard]] cv::Mat drawWithTitle(const vpServoRun &run, const vpServoSample &sample, const std::string &title);

private:
  void drawOutline(cv::Mat &picture, const vpHomogeneousMatrix &cMo, const cv::Scalar &colour) const;

  vpServoTask m_task;
  double m_scale; //!< Pixels of the picture for one of the camera.
  vpCameraParameters m_camera;
  cv::Size m_size;
  vpPlaneRenderer m_renderer;
  vpImage<unsigned char> m_grey;
};
} // namespace servoCompare

#endif
