/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file results.h
 * \brief The finished runs, with lookup.
 */
#ifndef servoCompare_results_h
#define servoCompare_results_h

#include "plan.h"
#include "ranks.h"

#include "lab/servo/vpServoExperiment.h"

#include <functional>

namespace servoCompare
{
//! Command to the robot: the law's twist unchanged, or shaped (Plan::shaped).
enum class Command { Raw, Shaped };

//! \brief All runs in the order of Plan::runs.
class Results
{
public:
  explicit Results(std::vector<vpServoRun> runs) : m_runs(std::move(runs)) {}
  [[nodiscard]] const std::vector<vpServoRun> &runs() const { return m_runs; }

  //! The run with the first seed, with its samples; nullptr if it was not requested.
  [[nodiscard]] const vpServoRun *find(const std::string &law, const std::string &plant, const std::string &measure,
                                       Command command = Command::Raw) const;

private:
  std::vector<vpServoRun> m_runs;
};

/*!
 * Run everything, the slow runs first, with a progress bar.
 * \param plan : What to run. \param targetFile : The photo as an image file that ViSP reads.
 * \param jobs : Parallel runs of each rank; 0: its share of the cores.
 * \param finished : Called with each finished run of the first seed, from several threads. The samples of all other
 * seeds are dropped to save memory; on several ranks, rank 0 makes those of the first seed.
 */
[[nodiscard]] Results runAll(const Plan &plan, const std::string &targetFile, const vpApp::Ranks &ranks,
                             unsigned int jobs, const std::function<void(const vpServoRun &)> &finished);
} // namespace servoCompare

#endif
