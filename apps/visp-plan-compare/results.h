/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file results.h
 * \brief The finished runs, and their statistics.
 */
#ifndef planCompare_results_h
#define planCompare_results_h

#include "plan.h"

#include "ranks.h"

#include "lab/avoidance/vpAvoidanceExperiment.h"

#include <optional>
#include <vector>

namespace planCompare
{
//! \brief A run without its log.
struct Record {
  std::string scene;
  std::string variant;
  std::string method;
  unsigned int seed = 1;
  double planTime = 0.;          //!< Wall time of vpAvoidanceMethod::start(), s.
  std::vector<double> lookTimes; //!< Wall times of vpAvoidanceMethod::look(), s.
  vpAvoidanceMetrics metrics;
};
//! See sweep.h.
template <class Archive> void exchange(Archive &archive, Record &record)
{
  vpAvoidanceMetrics &m = record.metrics;
  archive(record.scene, record.variant, record.method, record.seed, record.planTime, record.lookTimes, m.success,
          m.min_clearance_m, m.goal_error_m, m.duration_s, m.peak_v, m.peak_a, m.peak_jerk, m.jerk_integral,
          m.path_length, m.replan_ms_p50, m.replan_ms_p95, m.replan_ms_p99, m.stops, m.false_stops, m.collisions_moving,
          m.collisions_standing, m.joint_v_violations, m.joint_a_violations, m.tool_v_violations, m.tool_a_violations,
          m.status);
}

//! \brief Interval of a proportion, 0..1.
struct Interval {
  double low = 0.;
  double high = 1.;
};

/*!
 * Wilson's score interval without continuity correction, 95 %. \cite Wilson 1927, J. Am. Stat. Assoc. 22, 209-212
 * \param successes : 0..total. \param total : >= 0; for 0 trials the interval is [0, 1].
 */
[[nodiscard]] Interval wilson(int successes, int total);

/*!
 * McNemar's exact test, two-sided: probability of a split at least this uneven if both perform equally well.
 * \param onlyFirst, onlySecond : Pairs in which only one of the two succeeded; >= 0. \return p, 1 when there are none.
 */
[[nodiscard]] double mcNemar(int onlyFirst, int onlySecond);

//! A field of vpAvoidanceMetrics.
using Metric = double vpAvoidanceMetrics::*;
using Count = int vpAvoidanceMetrics::*;

//! \brief The runs of a method on a scene.
struct Cell {
  std::vector<const Record *> runs; //!< By problem.
  [[nodiscard]] int successes() const;
  [[nodiscard]] Interval interval() const { return wilson(successes(), static_cast<int>(runs.size())); }
  //! Metric of all runs, or only of successful ones.
  [[nodiscard]] std::vector<double> values(Metric metric, bool successesOnly) const;
  [[nodiscard]] int sum(Count count) const;
  //! Number of runs in which the count is not 0.
  [[nodiscard]] int runsWith(Count count) const;
  //! All look times, ms.
  [[nodiscard]] std::vector<double> replanTimes() const;
};

//! \brief All records, by problem and then by method.
struct Results {
  std::vector<Record> records;
  std::vector<vpAvoidanceRun> shown;    //!< Runs with logs: the first problem of each scene, by method.
  std::vector<std::string> shownScenes; //!< Scene of each run in #shown.
  double wallTime = 0.;                 //!< s

  [[nodiscard]] Cell cell(const std::string &scene, const std::string &method) const;
  //! Cell of one variant.
  [[nodiscard]] Cell cell(const std::string &scene, const std::string &method, const std::string &variant) const;
  //! Runs of a method over all scenes.
  [[nodiscard]] Cell all(const std::string &method) const;
  //! The variants of a scene in order; those of S3 sorted.
  [[nodiscard]] std::vector<std::string> variants(const std::string &scene) const;
  //! Run of a scene with its log; null when there is none.
  [[nodiscard]] const vpAvoidanceRun *find(const std::string &scene, const std::string &method) const;
};

//! \brief Paired results of two methods on the same problems.
struct Pairing {
  int both = 0, onlyFirst = 0, onlySecond = 0, neither = 0;
  double p = 1.; //!< McNemar's exact test.
};

//! \param scene : Empty for all.
[[nodiscard]] Pairing pairUp(const Results &results, const std::string &scene, const std::string &first,
                             const std::string &second);

//! Pairs of methods whose successes are compared: (v) with (iii) if both were run; else none.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> pairsOf(const Plan &plan);

/*!
 * Run everything, with a progress bar.
 * \param jobs : Problems run in parallel on each rank; 0: its share of the cores.
 * \return All of them on rank 0.
 */
[[nodiscard]] Results runAll(const Plan &plan, const vpApp::Ranks &ranks, unsigned int jobs);
} // namespace planCompare

#endif
