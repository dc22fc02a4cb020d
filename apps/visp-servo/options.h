/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file options.h
 * \brief The command line of visp-servo.
 */
#ifndef visualServo_options_h
#define visualServo_options_h

#include "recorded.h"

#include "robotOptions.h"

#include <visp3/core/vpHomogeneousMatrix.h>
#include <visp3/feedforward/vpServoController.h>
#include <visp3/servoing/vpVisualServo.h>

#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

VISP_DIRECT_USING_NAMESPACE

namespace visualServo
{
//! \brief What sees.
struct CameraOptions {
  std::string source = "sim";              //!< "sim", "N" or "/dev/videoN", "aravis" or "aravis:ID", else files.
  double rate = 0.;                        //!< Images per second; 0: that of the camera or the video, else 25.
  std::string xml;                         //!< Intrinsics, as ViSP's calibration writes them; empty: assumed.
  std::string name;                        //!< Name of the camera in that file; empty: the only one.
  double latency = 0.04;                   //!< Latency of the rendered camera, s.
  double noise = 3.;                       //!< Noise of the rendered camera, standard deviation in grey levels.
  std::optional<vpHomogeneousMatrix> pose; //!< Pose of the rendered object in the camera at the start.
  bool isFixed = false;                    //!< In the robot's base; the target is on the end effector.
  std::string fMc; //!< File of the fixed camera in the base; empty: by #pose, for the rendered camera.
};

//! \brief What is looked at.
struct TargetOptions {
  std::string photo; //!< Photograph of a plane; empty: klimt.jpg of the data folder, where nothing else is given.
  double width = 0., height = 0.;       //!< Its size, m; height 0: by the photograph's shape.
  std::string reference;                //!< Image taken at the goal, of something flat of unknown size; empty: none.
  double nearest = 0.2, farthest = 1.2; //!< Range of the distance of its plane from the goal, m.
  std::string tagFamily;                //!< Family of AprilTags ("36h11"); empty: none.
  int tagId = 0;
  std::string goalFile;                        //!< Written by --teach; empty: none.
  std::optional<vpHomogeneousMatrix> goalPose; //!< cdMo; none: that of the file, else in front of the target.
};

//! \brief What moves.
struct MotionOptions {
  vpApp::RobotOptions robot;                     //!< Simulated robot, or model of a real one.
  std::string plugin;                            //!< Library with a robot; empty: none.
  std::string arguments;                         //!< Passed to the plug-in or to the robot of ViSP.
  std::string eMc;                               //!< File of the camera in the end effector; empty: by the robot.
  std::string scene;                             //!< File of obstacles before which the arm stops; empty: none.
  double margin = vpStopSupervisorSpec().margin; //!< Clearance from them and of the arm from itself, m.
  bool dryRun = false;
  bool start = false; //!< A real robot moves at once.
};

//! What the program is asked to do.
enum class Task { Servo, Teach, Replay, List };

//! \brief User options.
struct Options {
  Task task = Task::Servo;
  CameraOptions camera;
  TargetOptions target;
  MotionOptions motion;
  std::vector<std::string> laws{"ff-lookat-pi+cbf"}; //!< The first one is used; others by a key.
  vpServoControllerSpec law;
  vpVisualServoSpec servo;
  double controlRate = 200.; //!< Hz.
  double duration = 0.;      //!< s; 0: until the goal is reached, or the images end.
  bool stay = false;         //!< Goes on at the goal.
  bool realTime = false;
  bool display = false;
  bool list = false;
  unsigned int seed = 1;
  std::string teach;  //!< Goal file, or reference image, to write; empty: none.
  std::string replay; //!< Folder of a recording; empty: none.
  std::string out = "out/servo";

  //! True for a robot that can hurt nobody.
  [[nodiscard]] bool isSimulated() const;
  //! False: #teach is a reference image alone.
  [[nodiscard]] bool teachesGoal() const;
  //! True if there is a model of the arm: joint velocities are commanded.
  [[nodiscard]] bool hasModel() const;
};

/*!
 * Read the command line.
 * \return False when the program has nothing left to do (`--help`, `--version`).
 * \throw vpApp::UsageError naming the option and its value; std::runtime_error if the recording of --replay cannot be read.
 */
[[nodiscard]] bool readOptions(int argc, const char *const *argv, Options &options);

/*!
 * The settings that another run on the same images needs, for SETTINGS_FILE: files are named as they lie in the folder of the result.
 * \param goal : Pose of the object at the goal.
 */
[[nodiscard]] Settings settingsOf(const Options &options, const vpHomogeneousMatrix &goal);

/*!
 * The recorded settings that \e arguments do not replace, and after them \e arguments.
 * \throw std::runtime_error if the recording in \e folder cannot be read.
 */
[[nodiscard]] std::vector<std::string> withRecorded(const std::string &folder,
                                                    const std::vector<std::string> &arguments);

//! Six numbers X,Y,Z,RX,RY,RZ (m, degrees, theta u) as a pose. \throw vpApp::UsageError naming the option.
[[nodiscard]] vpHomogeneousMatrix poseIn(const std::string &option, const std::string &text);
} // namespace visualServo

#endif
