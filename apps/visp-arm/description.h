/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file description.h
 * \brief What is understood of a robot.
 */
#ifndef armProgram_description_h
#define armProgram_description_h

#include "contacts.h"
#include "robot.h"

#include <optional>

namespace armProgram
{
//! \brief Where the limits of a joint come from.
struct LimitSource {
  std::string position, velocity, acceleration; //!< "file", "--joint-limits"; "assumed"; "unknown".
};

//! \brief What collision checks see of a body.
struct Link {
  std::string name;
  int link = 0;         //!< Link of the arm that carries it, 0: the base.
  std::string geometry; //!< "cover": capsules; "mesh": known but not covered; "ignored"; "none": no shape is known.
  int covers = 0;       //!< Number of capsules.
  std::optional<vpBodyCover> fit; //!< Of fitted capsules.
};

//! \brief Two bodies, and why they are not checked against each other.
struct Pair {
  std::string first, second;
  std::string reason; //!< Empty: they are checked.
};

//! \brief Everything that is printed.
struct Description {
  std::vector<LimitSource> sources; //!< By joint.
  std::vector<Link> links;
  std::vector<Pair> pairs;           //!< Bodies on different links.
  double reach = 0.;                 //!< vpSceneFrame::reach, m.
  std::string coverFile;             //!< Where fitted capsules are kept; empty: there are none.
  std::vector<std::string> problems; //!< Why the robot is not usable, one sentence each.
  std::vector<std::string> warnings; //!< One sentence each.
};

//! The scene of the arm alone, with its ignored bodies; or the given one.
[[nodiscard]] vpCollisionScene sceneOf(const vpApp::Robot &robot, vpCollisionSceneSpec spec = {});
//! Describe a robot. \param options : With which it was loaded.
[[nodiscard]] Description describe(const vpApp::Robot &robot, const vpApp::RobotOptions &options);
} // namespace armProgram

#endif
