/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file robot.h
 * \brief Loads the robot of the command line: its model, and the capsules that cover its meshes.
 */
#ifndef vpApp_robot_h
#define vpApp_robot_h

#include "robotOptions.h"

#include <visp3/avoidance/vpArmCover.h>
#include <visp3/manipulator/vpArmModel.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

VISP_DIRECT_USING_NAMESPACE

namespace vpApp
{
//! Acceleration limit that is assumed for joints of a URDF without one, rad/s^2 or m/s^2.
constexpr double assumedAcceleration = 10.;

//! \brief A robot for collision checks.
struct Robot {
  std::shared_ptr<const vpArmModel> arm; //!< With covers. vpArmSpec::uncovered holds ignored bodies and #unseen ones.
  std::vector<vpBodyCover> covers;       //!< Bodies that capsules were fitted to.
  std::vector<std::string> ignored;      //!< Bodies that the user ignores.
  std::vector<std::string> unseen;       //!< Bodies that collision checks would miss; empty in a usable robot.
  std::vector<std::string> warnings;     //!< One sentence each.
};

/*!
 * The model, with the limits and the home of the options; no covers.
 * \throw UsageError for an option that does not suit the file or its number of joints; vpException naming the file and
 * the element.
 */
[[nodiscard]] vpArmModel loadArm(const RobotOptions &options);
/*!
 * The model with covers, from the cover file where it has them. Where neither an SRDF nor the user says which pairs of bodies
 * need no check, those of findSelfPairs() do not.
 * \throw As loadArm(); UsageError for an ignored link that the arm does not have.
 */
[[nodiscard]] Robot loadRobot(const RobotOptions &options);

//! What is wrong with a robot for collision checks, and the options that help; empty: nothing.
[[nodiscard]] std::string unseenSentence(const Robot &robot);
//! Joints that do not move the frame that a link carries, since they come after it. \param link : vpArmModel::toolLink() or cameraLink().
[[nodiscard]] std::vector<std::string> jointsBehind(const vpArmModel &arm, int link);
/*!
 * Adds the sentence which joints do not move the frame that a program moves; none if all do.
 * \param frame : Its name. \param link : The link that carries it, vpArmModel::toolLink() or cameraLink().
 */
void warnOfJointsBehind(const vpArmModel &arm, const std::string &frame, int link, std::vector<std::string> &warnings);
//! The first joint without velocity or acceleration limit, and the options that supply it; empty: there is none.
[[nodiscard]] std::string missingLimitSentence(const vpArmModel &arm);
/*!
 * Which checked bodies have their capsules within keptClearance in at least a share of random configurations, and the options that help;
 * empty: none.
 */
[[nodiscard]] std::string crowdedSentence(const vpArmModel &arm, double share);
/*!
 * A robot for programs that move it among obstacles; crowdedSentence() for nearly all configurations is a warning.
 * \throw As loadRobot(); std::runtime_error with unseenSentence(), missingLimitSentence(), or crowdedSentence() for all
 * configurations.
 */
[[nodiscard]] Robot loadUsableRobot(const RobotOptions &options);

//! The file of the cover: that of the options, else NAME.covers.json in the user's cache folder; empty: there is none.
[[nodiscard]] std::filesystem::path coverFileOf(const RobotOptions &options, const std::string &name);
//! Print one line for each warning on stderr.
void printWarnings(const std::string &program, const std::vector<std::string> &warnings);
} // namespace vpApp

#endif
