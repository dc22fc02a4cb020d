/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file camera.h
 * \brief The camera of the options: its images and its intrinsics.
 */
#ifndef visualServo_camera_h
#define visualServo_camera_h

#include "liveRobot.h"
#include "options.h"

#include "imageSource.h"

#include <visp3/core/vpCameraParameters.h>

#include <memory>

namespace visualServo
{
//! \brief How a camera sees.
struct Eye {
  vpCameraParameters intrinsics;
  unsigned int width = 0, height = 0; //!< px
  double rate = 25.;                  //!< Images per second, as far as it is known.
  bool isAssumed = false;             //!< There is no calibration.
  vpRigidTransform fMc;               //!< Of a fixed camera: its pose in the robot's base.
};

//! \brief A camera, open.
struct Camera {
  std::unique_ptr<vpApp::ImageSource> source;
  Eye eye;
};

//! The file's pose of a fixed camera. \throw As vpLoadPose().
[[nodiscard]] vpRigidTransform fixedCamera(const CameraOptions &options);
//! Intrinsics of the file of the options, or assumed. \throw As openCamera().
[[nodiscard]] vpCameraParameters intrinsicsOf(const CameraOptions &options, unsigned int width, unsigned int height);

/*!
 * Open the camera of the options and read one image, for its size; a file begins with that image.
 * \param robot : Carries a rendered camera, or what a fixed one sees; must outlive the camera.
 * \throw std::runtime_error or vpException naming the camera or the file.
 */
[[nodiscard]] Camera openCamera(const Options &options, const Robot &robot);
} // namespace visualServo

#endif
