/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "ranks.h"

#include "appMain.h"
#include "jobs.h"

#include <algorithm>
#include <memory>

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
} // namespace vpApp
