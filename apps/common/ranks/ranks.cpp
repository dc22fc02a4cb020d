/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "ranks.h"
#include "sweep.h"

#include <algorithm>
#include <memory>
#include <numeric>

namespace vpApp
{
unsigned int Ranks::threads(unsigned int jobs) const
{
  return jobs != 0 ? jobs : std::max(1u, coreCount() / static_cast<unsigned int>(m_local));
}

int runRanks(const std::string &program, const std::function<void(const Ranks &)> &body)
{
  std::unique_ptr<Ranks> ranks;
  const int status = runMain(program, [&]() -> int {
    ranks = std::make_unique<Ranks>();
    body(*ranks);
    return ExitOk;
  });
  return status == ExitOk || !ranks ? status : ranks->endAll(status);
}

bool readOnFirst(const Ranks &ranks, const std::function<bool()> &read)
{
  if (ranks.isFirst()) {
    const bool goOn = read();
    static_cast<void>(ranks.broadcast(goOn ? "go on" : ""));
    return goOn;
  }
  return !ranks.broadcast("").empty() && read();
}

std::vector<std::vector<std::size_t>> shareOut(const Sweep &sweep, int ranks)
{
  std::vector<double> effort(sweep.count, 1.);
  for (std::size_t i = 0; i < sweep.count && sweep.effort; ++i) {
    effort[i] = sweep.effort(i);
  }
  std::vector<std::size_t> order(sweep.count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return effort[a] > effort[b]; });
  if (sweep.onFirst) {
    std::stable_partition(order.begin(), order.end(), sweep.onFirst);
  }
  std::vector<std::vector<std::size_t>> shares(static_cast<std::size_t>(ranks));
  std::vector<double> load(shares.size(), 0.);
  for (const std::size_t index : order) {
    const bool first = sweep.onFirst && sweep.onFirst(index);
    const auto rank = first ? 0 : static_cast<std::size_t>(std::min_element(load.begin(), load.end()) - load.begin());
    shares[rank].push_back(index);
    load[rank] += effort[index];
  }
  return shares;
}
} // namespace vpApp
