/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "results.h"

#include <cmath>

namespace thesisReport
{
namespace
{
using Json = nlohmann::ordered_json;

Json numberOrNull(const std::optional<double> &value)
{
  return value && std::isfinite(*value) ? Json(*value) : Json(nullptr);
}
} // namespace

Json resultsJson(const std::vector<Played> &all)
{
  Json rows = Json::array();
  for (const Played &played : all) {
    for (const Item &item : played.items) {
      for (const Quantity &q : item.quantities) {
        rows.push_back({{"id", item.id},
                        {"quantity", q.name},
                        {"unit", q.unit},
                        {"thesis", numberOrNull(q.thesis)},
                        {"ours", numberOrNull(q.ours)},
                        {"ratio", numberOrNull(ratioOf(q))},
                        {"tolerance", q.thesis ? Json(q.tolerance.text()) : Json(nullptr)},
                        {"verdict", vpToString(verdictOf(q))},
                        {"note", remarkOf(q)}});
      }
    }
  }
  return rows;
}

std::map<Verdict, int> countVerdicts(const std::vector<Played> &all)
{
  std::map<Verdict, int> counts = {{Verdict::Agrees, 0}, {Verdict::Better, 0}, {Verdict::Differs, 0}};
  for (const Played &played : all) {
    for (const Item &item : played.items) {
      ++counts[verdictOf(item)];
    }
  }
  return counts;
}

Json summaryJson(const std::vector<Played> &all, const Options &options, const std::string &commandLine,
                 double wallTime)
{
  Json verdicts = Json::object(), seconds = Json::object(), counts = Json::object();
  for (const auto &count : countVerdicts(all)) {
    counts[vpToString(count.first)] = count.second;
  }
  for (const Played &played : all) {
    for (const Item &item : played.items) {
      verdicts[item.id] = vpToString(verdictOf(item));
    }
    seconds[played.part->entries.front().id] = played.seconds;
  }
  return {{"version", VISP_DIRECT_VERSION}, {"command", commandLine},
          {"seed", options.seed},           {"items", counts},
          {"verdicts", verdicts},           {"seconds_of_parts", seconds},
          {"jobs", options.jobs},           {"wall_time_s", wallTime}};
}
} // namespace thesisReport
