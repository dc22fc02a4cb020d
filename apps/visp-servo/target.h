/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file target.h
 * \brief What is looked at, how it is found in images, and the goal.
 */
#ifndef visualServo_target_h
#define visualServo_target_h

#include "camera.h"
#include "options.h"

#include <visp3/core/vpCameraParameters.h>
#include <visp3/core/vpImage.h>
#include <visp3/servoing/vpServoVision.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace visualServo
{
//! \brief A photograph of a plane.
struct Photo {
  vpImage<unsigned char> image;
  std::string file;
  double width = 0., height = 0.; //!< m
};

//! The photograph of the options. \throw std::runtime_error naming the file; vpApp::UsageError without its size.
[[nodiscard]] Photo readPhoto(const TargetOptions &options);

/*!
 * The vision of the options: by photograph, by reference image, or by tag.
 * \throw std::runtime_error or vpException naming the file and what is wrong.
 */
[[nodiscard]] std::unique_ptr<vpServoVision> makeVision(const Options &options, const vpCameraParameters &camera);
//! The reference image of the options. \throw std::runtime_error naming the file.
[[nodiscard]] vpImage<unsigned char> readReference(const TargetOptions &options);
//! "klimt.jpg, 0.12 m x 0.12 m", for reports.
[[nodiscard]] std::string describeTarget(const TargetOptions &options);

//! Pose of the object in the desired camera: of the options, of the goal file, or so that the target fills half of the view.
[[nodiscard]] vpHomogeneousMatrix goalPose(const Options &options, const Eye &eye);

} // namespace visualServo

#endif
