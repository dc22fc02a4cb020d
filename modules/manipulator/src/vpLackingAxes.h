/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpLackingAxes.h
 * \brief By how much an arm lacks joints for a task, in every configuration.
 */
#ifndef vpLackingAxes_h
#define vpLackingAxes_h

#include <visp3/manipulator/vpArmKinematics.h>

#include <array>
#include <cstdint>

BEGIN_VISP_NAMESPACE

/*!
 * Number of rows minus the largest rank of the Jacobian's rows over all configurations. Index: frame * 64 + bits of the
 * commanded axes. Zero everywhere for an arm that can command all six axes.
 *
 * The rank is that at a few random configurations within the limits: it is smaller than the largest one only on a set
 * of measure zero.
 */
using vpLackTable = std::array<std::uint8_t, 192>;
[[nodiscard]] vpLackTable vpLackingAxes(const vpArmModel &model);

END_VISP_NAMESPACE
#endif
