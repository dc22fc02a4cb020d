/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file results.h
 * \brief The finished runs, and how to find one among them.
 */
#ifndef servoCompare_results_h
#define servoCompare_results_h

#include "plan.h"

#include "lab/servo/vpServoExperiment.h"

#include <functional>
#include <optional>

namespace servoCompare
{
//! Median, least and largest value over the seeds.
struct Spread {
  double median = 0.;
  double least = 0.;
  double largest = 0.;
};

//! A field of vpServoMetrics.
using Metric = double vpServoMetrics::*;

//! What the robot gets: the law's twist as it is, or shaped (Plan::shaped).
enum class Command { Raw, Shaped };

//! \brief All runs in the order of Plan::runs.
class Results
{
public:
  explicit Results(std::size_t count) : m_runs(count) {}
  //! Put in run number \e index. Safe from several threads for different indices.
  void set(std::size_t index, vpServoRun run) { m_runs[index] = std::move(run); }
  [[nodiscard]] const std::vector<vpServoRun> &runs() const { return m_runs; }

  //! The run with the first seed, which has its samples; nullptr if it was not asked for.
  [[nodiscard]] const vpServoRun *find(const std::string &law, const std::string &plant, const std::string &measure,
                                       Command command = Command::Raw) const;
  //! A metric over all seeds; nothing if the run was not asked for.
  [[nodiscard]] std::optional<Spread> spread(const std::string &law, const std::string &plant,
                                             const std::string &measure, Metric metric,
                                             Command command = Command::Raw) const;
  //! A metric of each seed.
  [[nodiscard]] std::vector<double> values(const std::string &law, const std::string &plant, const std::string &measure,
                                           Metric metric, Command command = Command::Raw) const;

private:
  std::vector<vpServoRun> m_runs;
};

/*!
 * Run everything, the slow runs first, with a progress bar.
 * \param plan : What to run. \param targetFile : The photo as an image file that ViSP reads.
 * \param jobs : Runs at a time.
 * \param finished : Called with each run of the first seed as it ends, from several threads. The samples of all other
 * seeds are dropped to save memory.
 */
[[nodiscard]] Results runAll(const Plan &plan, const std::string &targetFile, unsigned int jobs,
                             const std::function<void(const vpServoRun &)> &finished);
} // namespace servoCompare

#endif
