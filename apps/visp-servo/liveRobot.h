/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file liveRobot.h
 * \brief What moves the camera, or the target before a fixed one: a simulated robot, a robot of ViSP, or one of a plug-in.
 */
#ifndef visualServo_liveRobot_h
#define visualServo_liveRobot_h

#include "options.h"

#include <visp3/avoidance/vpCollisionScene.h>
#include <visp3/manipulator/vpArmModel.h>
#include <visp3/servoing/vpVisualServo.h>

#include <memory>
#include <string>
#include <vector>

namespace visualServo
{
/*!
 * \brief A robot with a camera on its end effector, or with the target before a fixed camera. read() and command() are called by the control thread only; they may throw what the
 * driver throws.
 */
class Robot
{
public:
  virtual ~Robot() = default;
  Robot() = default;
  Robot(const Robot &) = delete;
  Robot &operator=(const Robot &) = delete;

  //! Current state. \throw std::exception of the driver.
  [[nodiscard]] virtual vpServoRobotState read() = 0;
  //! Moves until the next command. \param period : Time until then, s. \throw std::exception of the driver.
  virtual void command(const vpVisualServoOutput &motion, double period) = 0;
  //! Makes the robot ready for velocities. \throw std::exception of the driver.
  virtual void begin() {}
  //! Brings it to rest; called also after a failure. \throw std::exception of the driver.
  virtual void end() {}
  //! Model, whose joint velocities are commanded; null: twists of the camera, or of the end effector, are.
  [[nodiscard]] virtual const vpArmModel *arm() const { return nullptr; }
  //! False: read() tells nothing, and the commanded motion counts as executed.
  [[nodiscard]] virtual bool tellsState() const { return true; }
  //! Pose in the base, now, of what moves: the camera, or the end effector before a fixed camera; any thread. Only for robots that
  //! have a rendered camera.
  [[nodiscard]] virtual vpRigidTransform pose() const { return {}; }
  //! "the simulated arm amor".
  [[nodiscard]] virtual std::string description() const = 0;
};

//! \brief A robot of ViSP, by name.
struct VispRobot {
  std::string word;      //!< For --robot.
  std::string className; //!< In ViSP.
  bool isBuilt = false;  //!< The installed ViSP has it.
};
//! The robots of ViSP that this program knows.
[[nodiscard]] const std::vector<VispRobot> &robotsOfVisp();
//! \throw vpApp::UsageError if ViSP has no robot of this name; std::runtime_error if the installed ViSP was built without it.
void requireVispRobot(const std::string &word);

/*!
 * The robot of the options.
 * \throw vpApp::UsageError for options that do not suit it; std::runtime_error or vpException naming the file, the robot, or what its
 * driver says.
 */
[[nodiscard]] std::unique_ptr<Robot> openRobot(const Options &options);
/*!
 * The arm of the options, with the camera of --eMc; among obstacles with all of its bodies covered. What was assumed of it is printed.
 * \throw As openRobot().
 */
[[nodiscard]] vpArmModel loadModel(const Options &options);
/*!
 * The obstacles of the options about the arm of \e robot; null without --scene.
 * \throw vpException naming the file and the element.
 */
[[nodiscard]] std::unique_ptr<const vpCollisionScene> loadObstacles(const MotionOptions &options, const Robot &robot);
//! A robot that is not there: dry run.
[[nodiscard]] std::unique_ptr<Robot> noRobot();
//! The simulated robot of the options.
[[nodiscard]] std::unique_ptr<Robot> simulatedRobot(const Options &options);
//! A robot of ViSP or of a plug-in.
[[nodiscard]] std::unique_ptr<Robot> realRobot(const Options &options);
} // namespace visualServo

#endif
