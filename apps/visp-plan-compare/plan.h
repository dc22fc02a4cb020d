/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file plan.h
 * \brief Names and descriptions of methods and scenes, and from the user's options to the list of scenes.
 */
#ifndef planCompare_plan_h
#define planCompare_plan_h

#include "options.h"

#include "lab/avoidance/vpAvoidanceScenes.h"

#include <functional>
#include <string>
#include <vector>

namespace planCompare
{
//! \brief Description of a method.
struct MethodInfo {
  std::string id;       //!< Id for vpMakeAvoidanceMethod().
  std::string sentence; //!< Description.
};

//! Description of any method.
[[nodiscard]] MethodInfo methodInfo(const std::string &id);

//! \brief Description of a scene.
struct SceneInfo {
  std::string id;         //!< "S4b".
  std::string name;       //!< Short, for tables.
  std::string sentence;   //!< Description.
  unsigned int seeds = 0; //!< Number of seeds by default.
  unsigned int quick = 0; //!< Number of seeds with --quick.
};

//! S1, S2, S3, S4a, S4b, S6, S7. S5 is not included, as it has no goal.
[[nodiscard]] const std::vector<SceneInfo> &standardScenes();
//! Description of S5.
[[nodiscard]] const char *selfMotionSentence();

//! \brief One scene with one seed; all methods run on it.
struct Problem {
  std::string scene;   //!< Id.
  std::string variant; //!< Variant of the scene besides the seed: "0.3 m/s at 30 Hz"; or empty.
  unsigned int seed = 1;
  bool shown = false;                        //!< First problem of its scene: its logs are kept.
  std::function<vpAvoidanceScenario()> make; //!< Thread-safe.
};

//! \brief All runs to be done, checked.
struct Plan {
  std::shared_ptr<const vpArmModel> arm;
  std::vector<std::string> methods;
  std::vector<SceneInfo> scenes;
  std::vector<Problem> problems;             //!< Scene by scene.
  std::vector<vpCollisionSceneFile> planned; //!< S4: scenes for the table of validators.
  bool selfMotion = false;                   //!< S5.
  std::vector<std::string> remarks;          //!< On the robot, and on scenes that are left out; one sentence each.
  bool quick = false;
};

/*!
 * Resolve and check the user's options.
 * \throw vpApp::UsageError for an unknown scene or method, naming the known ones; std::runtime_error or vpException
 * naming the file for a bad scene or arm.
 */
[[nodiscard]] Plan makePlan(const Options &options);
} // namespace planCompare

#endif
