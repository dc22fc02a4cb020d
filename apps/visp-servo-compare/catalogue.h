/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file catalogue.h
 * \brief Display data of each law and plant: name, description, colour.
 */
#ifndef servoCompare_catalogue_h
#define servoCompare_catalogue_h

#include <visp3/simulation/vpServoPlant.h>

#include <string>
#include <vector>

VISP_DIRECT_USING_NAMESPACE

namespace servoCompare
{
//! Groups of comparable laws: those of one group reduce the rotation error equally fast.
enum class GainGroup {
  Single,   //!< Rotation gain lambda.
  Double,   //!< Effective rotation gain 2 lambda near the goal.
  Integral, //!< Rotation gain 2 lambda and an integral term.
  Own       //!< Laws of plug-ins: not known.
};

//! Title of a group, for tables.
[[nodiscard]] const char *titleOf(GainGroup group);

//! \brief Display data of a law.
struct LawInfo {
  std::string id;       //!< Id as in vpServoLaw::ids(), with `+cbf` if filtered.
  std::string name;     //!< Name in legends.
  std::string sentence; //!< Description for --list and the report.
  std::string colour;   //!< #rrggbb, the same in every figure.
  GainGroup group = GainGroup::Single;
};

//! Display data of a law; `+cbf` adds the filter to name and sentence.
[[nodiscard]] LawInfo lawInfo(const std::string &id);
//! All ids of vpServoLaw::ids(), as `"a, b, c"`.
[[nodiscard]] std::string knownLaws();
//! The id without `+cbf`.
[[nodiscard]] std::string withoutFilter(const std::string &id);
//! True if the id ends in `+cbf`.
[[nodiscard]] bool isFiltered(const std::string &id);

//! Names of the plants of the comparison: A, B, D.
[[nodiscard]] const std::vector<std::string> &standardPlants();
//! A plant in one sentence, from its parameters. \param onArm : The arm's joints replace lag and deadband.
[[nodiscard]] std::string sentenceOf(const vpServoPlant &plant, bool onArm = false);
} // namespace servoCompare

#endif
