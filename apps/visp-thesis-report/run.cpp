/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "run.h"

#include "appMain.h"
#include "jobs.h"
#include "progress.h"

#include <algorithm>
#include <chrono>
#include <numeric>

namespace thesisReport
{
namespace
{
double secondsSince(std::chrono::steady_clock::time_point start)
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

//! The wanted items in the order of the part's entries; each must be there and compare something.
std::vector<Item> sorted(const Part &part, const Setting &setting, std::vector<Item> items)
{
  std::vector<Item> result;
  for (const Entry &entry : part.entries) {
    if (!setting.wants(entry.id)) {
      continue;
    }
    const auto found = std::find_if(items.begin(), items.end(), [&](const Item &item) { return item.id == entry.id; });
    if (found == items.end() || verdictOf(*found) == Verdict::NoValue) {
      throw std::runtime_error(entry.id + ": its part compared nothing with the thesis");
    }
    result.push_back(std::move(*found));
  }
  return result;
}

bool needed(const Part &part, const Setting &setting)
{
  return std::any_of(part.entries.begin(), part.entries.end(),
                     [&](const Entry &entry) { return setting.wants(entry.id); });
}
} // namespace

std::vector<Played> playAll(const Options &options)
{
  Setting common;
  common.seed = options.seed;
  common.wanted.insert(options.only.begin(), options.only.end());
  std::vector<Played> all;
  double total = 0.;
  for (const Part &part : catalogue()) {
    if (needed(part, common)) {
      all.push_back({&part, {}, 0.});
      total += part.cost;
    }
  }
  std::vector<std::size_t> order(all.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return all[a].part->cost > all[b].part->cost; });
  vpApp::Progress progress("repeating " + std::to_string(common.wanted.size()) + " figures and tables", total);
  vpApp::runJobs(order.size(), options.jobs, [&](std::size_t i) {
    Played &played = all[order[i]];
    const auto start = std::chrono::steady_clock::now();
    double shown = 0.;
    Setting setting = common;
    setting.progress = [&](double share) {
      vpApp::throwIfInterrupted();
      const double now = std::clamp(share, shown, 1.);
      progress.add((now - shown) * played.part->cost);
      shown = now;
    };
    try {
      played.items = sorted(*played.part, setting, played.part->play(setting));
    }
    catch (const vpApp::Interrupted &) {
      throw;
    }
    catch (const std::exception &error) {
      throw std::runtime_error(played.part->entries.front().id + " and what goes with it: " + vpApp::sentenceOf(error));
    }
    setting.progress(1.);
    played.seconds = secondsSince(start);
  });
  vpApp::throwIfInterrupted();
  return all;
}
} // namespace thesisReport
