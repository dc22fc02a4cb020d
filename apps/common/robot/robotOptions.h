/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file robotOptions.h
 * \brief The robot on the command line, named in the same way in all programs.
 */
#ifndef vpApp_robotOptions_h
#define vpApp_robotOptions_h

#include "commandLine.h"

#include <map>
#include <string>
#include <vector>

namespace vpApp
{
//! \brief A robot, and what its file does not say.
struct RobotOptions {
  std::string robot = "amor";             //!< A word of #words, or a .urdf or .json file.
  std::vector<std::string> words{"amor"}; //!< Robots that need no file.
  std::string option = "FILE";            //!< Name of the option or argument, for messages.
  std::string base;                       //!< First link of a URDF's chain; empty: the root.
  std::string tip;                        //!< Last link; empty: the only leaf.
  std::string camera;                     //!< Camera link; empty: the tool itself.
  std::string tool;                       //!< Link of the tool; empty: the tip.
  std::string srdf;                       //!< SRDF file: pairs that need no check, groups, states; empty: none.
  std::vector<std::string> packagePaths;  //!< Folders in which package:// is searched.
  std::string homeState;                  //!< Home: a group state of the SRDF; empty: #home.
  std::vector<double> home;               //!< Home, rad or m; empty: that of the file.
  std::vector<std::string> ignored;       //!< Bodies that are not checked for collisions.
  std::map<std::string, double> held;     //!< Joints beside the chain that never move, and their values, rad or m.
  bool holdOthers = false;                //!< All joints beside the chain never move.
  std::string jointLimits;                //!< File of limits as MoveIt's joint_limits.yaml; empty: none.
  std::vector<double> velocity;           //!< Velocity limits: one for all joints or one a joint; empty: of the files.
  std::vector<double> acceleration;       //!< The same of acceleration limits.
  std::string allowedPairs;               //!< File of pairs that need no check, written by visp-arm; empty: none.
  int covers = 3;                         //!< Capsules that cover a body at most.
  std::string coverFile;                  //!< Cache of fitted capsules; empty: coverFileOf().
};

/*!
 * Adds the options, in a group of their own. \param sentence : What `--robot` means to the program; empty: the program
 * has no such option, as its argument is the file.
 */
void addRobotOptions(CommandLine &line, RobotOptions &options, const std::string &sentence);
} // namespace vpApp

#endif
