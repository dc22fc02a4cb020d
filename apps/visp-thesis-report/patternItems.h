/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file patternItems.h
 * \brief Functions behind patternParts(), one or several items each.
 */
#ifndef thesisReport_patternItems_h
#define thesisReport_patternItems_h

#include "part.h"

namespace thesisReport
{
[[nodiscard]] std::vector<Item> frameRates(const Setting &setting);   //!< Figure 7.1, (7.2).
[[nodiscard]] std::vector<Item> trackability(const Setting &setting); //!< (7.1).
[[nodiscard]] std::vector<Item> thresholds(const Setting &setting);   //!< Table 7.1.
[[nodiscard]] std::vector<Item> derivatives(const Setting &setting);  //!< Table 7.2.
[[nodiscard]] std::vector<Item> visionTiming(const Setting &setting); //!< Table 7.3.
[[nodiscard]] std::vector<Item> distortion(const Setting &setting);   //!< Figure 7.10.
[[nodiscard]] std::vector<Item> calibrations(const Setting &setting); //!< Table 7.4.
[[nodiscard]] std::vector<Item> detection(const Setting &setting);    //!< Figure 7.11.
} // namespace thesisReport

#endif
