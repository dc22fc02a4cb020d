/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file replicas.h
 * \brief Reproducible figures of thesis chapter 8.
 */
#ifndef avoidObstacle_replicas_h
#define avoidObstacle_replicas_h

#include "options.h"

#include "lab/avoidance/vpAvoidanceExperiment.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <vector>

namespace avoidObstacle
{
//! \brief One value of the thesis beside ours.
struct Comparison {
  std::string what;
  std::string thesis;
  std::string ours;
  bool agrees = true; //!< False: differs, and a sentence of the replica explains why.
};

//! \brief A reproduced figure.
struct Replica {
  std::string name;                  //!< "fig8.7"
  std::string title;                 //!< Content of the figure.
  std::vector<std::string> findings; //!< Results; the first sentence is the main one.
  std::vector<std::string> choices;  //!< Choices made where the thesis leaves values open.
  std::vector<Comparison> comparisons;
  std::vector<std::pair<std::string, std::string>> tables; //!< Names and content of CSV files.
  nlohmann::ordered_json numbers;                          //!< Results for summary.json.
  std::optional<vpAvoidanceRun> run;                       //!< Of the arm; none where a point moves.
};

//! Names for --replica: "fig8.6" to "fig8.13".
[[nodiscard]] const std::vector<std::string> &replicaNames();
//! Content of a figure, in one sentence. \throw std::out_of_range for an unknown name.
[[nodiscard]] const std::string &replicaTitle(const std::string &name);
//! Reproduce the figure of that name.
[[nodiscard]] Replica playReplica(const Options &options);

// The figures by method; each takes one of its names.
[[nodiscard]] Replica playFieldReplica(const Options &options); //!< 8.6
[[nodiscard]] Replica playPointReplica(const Options &options); //!< 8.7, 8.9, 8.13
[[nodiscard]] Replica playArmReplica(const Options &options);   //!< 8.8, 8.10, 8.11, 8.12
/*!
 * Figure 8.8 or 8.10 with the image sensor: a box with a photograph appears, at a time by the seed, and the change comes
 * when the camera in the hand has found it, not with the clock of the figure.
 * \return metrics, seen, appears_s, seen_after_s, via_distance_m.
 */
[[nodiscard]] nlohmann::ordered_json playSeenArmReplica(const Options &options);
//! Figure 8.6 by the arm, whose camera sees the obstacle. \return strict and mild as playFieldReplica().
[[nodiscard]] nlohmann::ordered_json playSeenFieldReplica(const Options &options);
} // namespace avoidObstacle

#endif
