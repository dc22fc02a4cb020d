/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file sweep.h
 * \brief Many independent cases on the cores of all ranks. The results do not depend on the number of ranks or threads.
 */
#ifndef vpApp_sweep_h
#define vpApp_sweep_h

#include "appMain.h"
#include "archive.h"
#include "jobs.h"
#include "progress.h"
#include "ranks.h"

#include <functional>
#include <iostream>
#include <string>
#include <vector>

namespace vpApp
{
//! \brief Cases 0 .. count - 1. The functions must give the same on every rank.
struct Sweep {
  std::string title;                         //!< For the progress bar: "running 42 motions".
  std::size_t count = 0;                     //!< Number of cases.
  std::function<double(std::size_t)> effort; //!< Expected effort of a case in any unit, > 0; null: all the same.
  //! Cases that rank 0 must run itself, because more is kept of them than their result; null: none.
  std::function<bool(std::size_t)> onFirst;
};

//! Indices of the cases of each rank: the longest first, each to the rank with the least effort so far.
[[nodiscard]] std::vector<std::vector<std::size_t>> shareOut(const Sweep &sweep, int ranks);

/*!
 * Run every case once.
 * \param jobs : Threads of each rank; 0: its share of the cores.
 * \param work : `Result work(std::size_t index, const std::function<void(double)> &done)`, safe to call at the same time
 * for different cases; may report the fraction done, 0..1.
 * \return On rank 0 the results of all cases, elsewhere those of its own share; results pass between ranks by
 * exchange(), see archive.h.
 * \throw Interrupted after Ctrl-C; whatever \e work throws.
 */
template <class Result, class Work>
std::vector<Result> runSweep(const Ranks &ranks, const Sweep &sweep, unsigned int jobs, const Work &work)
{
  const auto effort = [&sweep](std::size_t index) { return sweep.effort ? sweep.effort(index) : 1.; };
  const auto shares = shareOut(sweep, ranks.size());
  const std::vector<std::size_t> &mine = shares[static_cast<std::size_t>(ranks.rank())];
  double total = 0.;
  for (const std::size_t index : mine) {
    total += effort(index);
  }
  Progress progress(sweep.title, total > 0. ? total : 1., std::cerr,
                    ranks.isFirst() ? Progress::detect() : Progress::Style::Silent);
  std::vector<Result> results(sweep.count);
  runJobs(mine.size(), ranks.threads(jobs), [&](std::size_t k) {
    throwIfInterrupted();
    const std::size_t index = mine[k];
    double shown = 0.;
    const std::function<void(double)> done = [&](double share) {
      share = share > 1. ? 1. : share;
      if (share > shown) {
        progress.add((share - shown) * effort(index));
        shown = share;
      }
    };
    results[index] = work(index, done);
    done(1.);
  });
  throwIfInterrupted();
  Writer writer;
  for (std::size_t k = 0; k < mine.size() && !ranks.isFirst(); ++k) {
    writer(results[mine[k]]);
  }
  const std::vector<std::string> texts = ranks.gather(writer.text());
  for (std::size_t rank = 1; rank < texts.size(); ++rank) {
    Reader reader(texts[rank]);
    for (const std::size_t index : shares[rank]) {
      reader(results[index]);
    }
  }
  return results;
}
} // namespace vpApp

#endif
