/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file recorded.h
 * \brief Reads what a Recording wrote.
 */
#ifndef visualServo_recorded_h
#define visualServo_recorded_h

#include "rows.h"

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace visualServo
{
//! Settings of a run as options of the command line, each with its value; a flag with an empty one.
using Settings = std::vector<std::pair<std::string, std::string>>;

//! \brief A cycle of a recording, as far as it is needed again.
struct RecordedCycle {
  double time = 0.; //!< s
  bool isIdle = false;
  bool hasCamera = false;
  vpRigidTransform fMc; //!< Camera in the base; of a fixed camera's run the end effector.
  vpTwist twist;        //!< Of the same, in its frame.
  double positionError = NOTHING, rotationError = NOTHING; //!< m, rad.
};

//! \brief An image of a recording.
struct RecordedImage {
  std::size_t index = 0;          //!< In the video.
  double capture = 0., seen = 0.; //!< s
  bool found = false;
  vpHomogeneousMatrix cMo;
};

//! File of the settings.
constexpr const char *SETTINGS_FILE = "recording.json";
//! File of a fixed camera's pose, for vpLoadPose().
constexpr const char *FIXED_CAMERA_FILE = "fMc.txt";
//! The settings of the recording in a folder. \throw std::runtime_error naming the file.
[[nodiscard]] Settings readSettings(const std::filesystem::path &folder);
//! Content of SETTINGS_FILE.
[[nodiscard]] std::string settingsText(const Settings &settings);

/*!
 * Calls \e take with each cycle of log.csv, in order.
 * \throw std::runtime_error naming file, line and what is wrong. A cut last line, of a program that was killed, is left out.
 */
void readCycles(const std::filesystem::path &folder, const std::function<void(const RecordedCycle &)> &take);
//! Those images of images.csv that are in the video. \throw As readCycles().
[[nodiscard]] std::vector<RecordedImage> readImages(const std::filesystem::path &folder);
} // namespace visualServo

#endif
