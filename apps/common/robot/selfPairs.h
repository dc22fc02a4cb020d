/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file selfPairs.h
 * \brief Pairs of an arm's bodies that need no check, where neither an SRDF nor the user names them.
 */
#ifndef vpApp_selfPairs_h
#define vpApp_selfPairs_h

#include <visp3/manipulator/vpArmModel.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

VISP_DIRECT_USING_NAMESPACE

namespace vpApp
{
//! \brief Pairs for vpArmSpec::allowedBodies, and sentences that name them.
struct SelfPairs {
  std::vector<std::pair<std::string, std::string>> allowed;
  std::vector<std::string> warnings;
};

/*!
 * Pairs that need no check by 10,000 random configurations: those whose exact shapes touch in at least 95 % of them, and those
 * whose capsules come within 30 mm while the shapes touch in none. The latter is an estimate: below a share of 3e-4, with 95 % confidence.
 * Without exact shapes (FCL is missing, or the arm has none) there are no such pairs.
 * \param arm : With its covers.
 * \param folder : Where statistics are kept, in a file for the geometry and limits of the arm; empty: nowhere. What cannot be
 * written is a warning.
 */
[[nodiscard]] SelfPairs findSelfPairs(const vpArmModel &arm, const std::filesystem::path &folder);
} // namespace vpApp

#endif
