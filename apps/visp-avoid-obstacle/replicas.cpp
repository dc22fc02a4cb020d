/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "replicas.h"

namespace avoidObstacle
{
const std::vector<std::string> &replicaNames()
{
  static const std::vector<std::string> names = {"fig8.6",  "fig8.7",  "fig8.8",  "fig8.9",
                                                 "fig8.10", "fig8.11", "fig8.12", "fig8.13"};
  return names;
}
} // namespace avoidObstacle
