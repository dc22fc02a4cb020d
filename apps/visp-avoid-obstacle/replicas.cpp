/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "replicas.h"

#include <map>

namespace avoidObstacle
{
namespace
{
struct Entry {
  std::string title;
  Replica (*play)(const Options &);
};

const std::map<std::string, Entry> &entries()
{
  static const std::map<std::string, Entry> all = {
      {"fig8.6", {"Avoidance on path level by a potential field, strict and mild parameters", playFieldReplica}},
      {"fig8.7", {"Simulated direct trajectory, point to point, interrupted under way", playPointReplica}},
      {"fig8.8", {"Direct trajectory of the arm, point to point, interrupted under way", playArmReplica}},
      {"fig8.9", {"Simulated direct trajectory through a via that appears under way", playPointReplica}},
      {"fig8.10", {"Direct trajectory of the arm through a via that appears under way", playArmReplica}},
      {"fig8.11", {"Snapshots of figure 8.8", playArmReplica}},
      {"fig8.12", {"Snapshots of figure 8.10", playArmReplica}},
      {"fig8.13", {"Simulated direct trajectory to an object that moves", playPointReplica}}};
  return all;
}
} // namespace

const std::vector<std::string> &replicaNames()
{
  static const std::vector<std::string> names = {"fig8.6",  "fig8.7",  "fig8.8",  "fig8.9",
                                                 "fig8.10", "fig8.11", "fig8.12", "fig8.13"};
  return names;
}

const std::string &replicaTitle(const std::string &name) { return entries().at(name).title; }

Replica playReplica(const Options &options) { return entries().at(options.replica).play(options); }
} // namespace avoidObstacle
