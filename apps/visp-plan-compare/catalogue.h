/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file catalogue.h
 * \brief Names and sentences of methods and scenes.
 */
#ifndef planCompare_catalogue_h
#define planCompare_catalogue_h

#include <string>
#include <vector>

namespace planCompare
{
//! \brief A method in words.
struct MethodInfo {
  std::string id;       //!< For makeAvoidanceMethod().
  std::string number;   //!< "(iii)".
  std::string name;     //!< Short, for tables.
  std::string sentence; //!< What it does.
  std::string colour;   //!< #rrggbb
};

//! Of any method; one that is not known here has its id for a name.
[[nodiscard]] MethodInfo methodInfo(const std::string &id);

//! \brief A scene in words.
struct SceneInfo {
  std::string id;         //!< "S4b".
  std::string name;       //!< Short, for tables.
  std::string sentence;   //!< What it is.
  unsigned int seeds = 0; //!< Of the default job.
  unsigned int quick = 0; //!< Of a quick one.
};

//! S1, S2, S3, S4a, S4b, S6, S7. S5 is none of them: there is no goal to go to.
[[nodiscard]] const std::vector<SceneInfo> &standardScenes();
//! A sentence for S5.
[[nodiscard]] const char *selfMotionSentence();
} // namespace planCompare

#endif
