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

#include <visp3/avoidance/vpSelfCollisionStatistics.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

VISP_DIRECT_USING_NAMESPACE

namespace vpApp
{
//! The most that a program keeps from anything, m.
constexpr double keptClearance = 0.03;

//! \brief Pairs for vpArmSpec::allowedBodies, and sentences that name them.
struct SelfPairs {
  std::vector<std::pair<std::string, std::string>> allowed;
  std::vector<std::string> warnings;
};

/*!
 * Pairs of bodies that are checked, and in how many of 1000 random configurations their capsules touch.
 * \param clearance : Capsules nearer than this count as touching, m; 0: only those that do.
 */
[[nodiscard]] vpSelfCollisionStatistics capsuleContacts(const vpArmModel &arm, double clearance);

/*!
 * Pairs that need no check by 10,000 random configurations, of those whose capsules come within keptClearance:
 * - the exact shapes touch in at least 95 % of the configurations;
 * - they touch in none. This is an estimate: below a share of 3e-4, with 95 % confidence;
 * - they touch where all joints are at 0, or at the limit next to it, which MoveIt's assistant takes as meant, too, and the capsules are
 *   within keptClearance in at least 95 %, so that no clearance could be kept.
 *
 * Without exact shapes (FCL is missing, or the arm has none) there are no such pairs.
 * \param arm : With its covers.
 * \param folder : Where statistics are kept, in a file for the geometry and limits of the arm; empty: nowhere. What cannot be
 * written is a warning.
 */
[[nodiscard]] SelfPairs findSelfPairs(const vpArmModel &arm, const std::filesystem::path &folder);
} // namespace vpApp

#endif
