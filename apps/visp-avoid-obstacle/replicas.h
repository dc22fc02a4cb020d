/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file replicas.h
 * \brief The figures of the thesis that can be repeated.
 */
#ifndef avoidObstacle_replicas_h
#define avoidObstacle_replicas_h

#include <string>
#include <vector>

namespace avoidObstacle
{
//! Names for --replica: "fig8.6" to "fig8.13".
[[nodiscard]] const std::vector<std::string> &replicaNames();
} // namespace avoidObstacle

#endif
