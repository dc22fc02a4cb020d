/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file cameraView.h
 * \brief Camera view at one instant of a run, with the goal overlaid.
 */
#ifndef servoCompare_cameraView_h
#define servoCompare_cameraView_h

#include "plan.h"

#include <visp3/rendering/vpPlaneRenderer.h>

#include <opencv2/core.hpp>

namespace servoCompare
{
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
} // namespace servoCompare

#endif
