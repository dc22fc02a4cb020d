/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file catalogue.h
 * \brief The laws and plants that are known, a sentence each.
 */
#ifndef servoCompare_catalogue_h
#define servoCompare_catalogue_h

#include <visp3/simulation/vpServoPlant.h>

#include <string>
#include <vector>

VISP_DIRECT_USING_NAMESPACE

namespace servoCompare
{
//! A law in a sentence; with `+cbf` also its filter.
[[nodiscard]] std::string sentenceOf(const std::string &law);
//! All ids of vpServoLaw::ids(), as `"a, b, c"`.
[[nodiscard]] std::string knownLaws();
//! The id without `+cbf`.
[[nodiscard]] std::string withoutFilter(const std::string &id);

//! Names of the plants of the comparison: A, B, D.
[[nodiscard]] const std::vector<std::string> &standardPlants();
//! A plant in one sentence, from its parameters. \param onArm : The arm's joints replace lag and deadband.
[[nodiscard]] std::string sentenceOf(const vpServoPlant &plant, bool onArm = false);
} // namespace servoCompare

#endif
