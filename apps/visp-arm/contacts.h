/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file contacts.h
 * \brief What touches in a configuration.
 */
#ifndef armProgram_contacts_h
#define armProgram_contacts_h

#include <visp3/avoidance/vpCollisionScene.h>

#include <set>
#include <string>
#include <utility>
#include <vector>

namespace armProgram
{
using Names = std::pair<std::string, std::string>;

//! Name of the body of a capsule; else of its link.
[[nodiscard]] std::string bodyOf(const vpArmModel &arm, int capsule);
//! Name of a link (0: "base") of an arm without bodies.
[[nodiscard]] std::string linkName(const vpArmModel &arm, int link);
/*!
 * Checked pairs that touch in a configuration: two bodies, or a body and an object or "ground". Capsules find them; where
 * both sides have exact shapes, these decide.
 */
[[nodiscard]] std::set<Names> touchesAt(const vpCollisionScene &scene, const vpJointVector &q);
} // namespace armProgram

#endif
