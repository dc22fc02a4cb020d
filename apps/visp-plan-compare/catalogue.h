/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file catalogue.h
 * \brief Names and descriptions of methods and scenes.
 */
#ifndef planCompare_catalogue_h
#define planCompare_catalogue_h

#include <string>
#include <vector>

namespace planCompare
{
//! \brief Description of a method.
struct MethodInfo {
  std::string id;       //!< Id for makeAvoidanceMethod().
  std::string number;   //!< "(iii)".
  std::string name;     //!< Short, for tables.
  std::string sentence; //!< Description.
  std::string colour;   //!< #rrggbb
};

//! Description of any method; an unknown method is named by its id.
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
} // namespace planCompare

#endif
