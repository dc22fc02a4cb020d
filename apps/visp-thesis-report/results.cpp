/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "results.h"

#include "numberText.h"

#include <algorithm>
#include <cmath>

namespace thesisReport
{
namespace
{
using Json = nlohmann::ordered_json;

constexpr Verdict VERDICTS[] = {Verdict::Agrees,         Verdict::Better,        Verdict::Differs,
                                Verdict::ByConstruction, Verdict::NotComparable, Verdict::NoValue};

Json numberOrNull(const std::optional<double> &value)
{
  return value && std::isfinite(*value) ? Json(*value) : Json(nullptr);
}

const std::string &titleOf(const Played &played, const Item &item)
{
  const auto &entries = played.part->entries;
  return std::find_if(entries.begin(), entries.end(), [&](const Entry &entry) { return entry.id == item.id; })->title;
}

std::string labelOf(const std::string &id)
{
  const auto begins = [&](const char *with) { return id.rfind(with, 0) == 0; };
  return begins("fig")     ? "Figure " + id.substr(3)
         : begins("table") ? "Table " + id.substr(5)
         : begins("sec")   ? "Section " + id.substr(3)
                           : "(" + id.substr(2) + ")";
}

Json rowOf(const Item &item, const Quantity &q, bool random)
{
  Spread spread;
  for (const double value : q.seeds) {
    spread.add(value);
  }
  const bool several = random && q.seeds.size() > 1;
  return {{"id", item.id},
          {"quantity", q.name},
          {"unit", q.unit},
          {"kind", kindOf(q)},
          {"thesis", numberOrNull(q.thesis)},
          {"where", q.judgement.where},
          {"quote", q.judgement.quote},
          {"ours", numberOrNull(q.ours)},
          {"seeds", q.seeds.size()},
          {"deterministic", !random},
          {"spread", several ? numberOrNull(spread.sigma()) : Json(nullptr)},
          {"least", several ? numberOrNull(spread.quantile(0.)) : Json(nullptr)},
          {"largest", several ? numberOrNull(spread.largest()) : Json(nullptr)},
          {"ratio", numberOrNull(ratioOf(q))},
          {"tolerance", q.thesis ? Json(q.tolerance.text()) : Json(nullptr)},
          {"tolerance_from", q.judgement.tolerance},
          {"verdict", vpToString(verdictOf(q))},
          {"share_of_seeds", shareOfSeeds(q)},
          {"note", q.note},
          {"reason", reasonOf(q)},
          {"support", reasonOf(q).empty() ? "" : q.judgement.support}};
}

const char *vpToString(vpApp::PlotStyle style)
{
  switch (style) {
  case vpApp::PlotStyle::Dashed:
    return "dashed";
  case vpApp::PlotStyle::Dotted:
    return "dotted";
  case vpApp::PlotStyle::Points:
    return "points";
  case vpApp::PlotStyle::Rings:
    return "rings";
  case vpApp::PlotStyle::Solid:
    break;
  }
  return "solid";
}

Json panelOf(const vpApp::Plot &plot)
{
  Json curves = Json::array(), marks = Json::array();
  for (const vpApp::PlotCurve &curve : plot.curves) {
    curves.push_back(
        {{"label", curve.label}, {"colour", curve.colour}, {"style", vpToString(curve.style)}, {"width", curve.width}});
  }
  for (const vpApp::PlotMark &mark : plot.marks) {
    marks.push_back({{"x", mark.x}, {"label", mark.label}});
  }
  Json range = Json::array();
  if (plot.xRange.first < plot.xRange.second) {
    range = {plot.xRange.first, plot.xRange.second};
  }
  return {{"title", plot.title},
          {"x_label", plot.xLabel},
          {"y_label", plot.yLabel},
          {"x_range", range},
          {"log_x", plot.logX},
          {"log_y", plot.logY},
          {"from_zero", plot.fromZero},
          {"equal", plot.equalAxes},
          {"height_px", plot.height},
          {"categories", plot.categories},
          {"marks", marks},
          {"curves", curves}};
}

Json figureOf(const Item &item, const Figure &figure)
{
  Json panels = Json::array();
  for (const vpApp::Plot &panel : figure.panels) {
    panels.push_back(panelOf(panel));
  }
  return {{"name", figure.name},
          {"title", figure.title},
          {"caption", figure.caption},
          {"picture", figure.picture.empty() ? Json(nullptr) : Json(pictureFile(item, figure))},
          {"panels", panels}};
}

void addCurves(const Item &item, const Figure &figure, std::string &csv)
{
  const auto cell = [](double value) { return std::isfinite(value) ? vpApp::number(value, 7) : ""; };
  for (std::size_t p = 0; p < figure.panels.size(); ++p) {
    for (std::size_t c = 0; c < figure.panels[p].curves.size(); ++c) {
      const vpApp::PlotCurve &curve = figure.panels[p].curves[c];
      const std::string head = item.id + "," + figure.name + "," + std::to_string(p) + "," + std::to_string(c) + ",";
      for (std::size_t i = 0; i < std::min(curve.x.size(), curve.y.size()); ++i) {
        csv += head + cell(curve.x[i]) + "," + cell(curve.y[i]) + "\n";
      }
    }
  }
}

template <class Use> void eachItem(const std::vector<Played> &all, Use use)
{
  for (const Played &played : all) {
    for (const Item &item : played.items) {
      use(played, item);
    }
  }
}

//! Rows of a kind that could have failed, by verdict. \param kind : "all" for all kinds.
Json countsOf(const std::vector<Played> &all, const std::string &kind)
{
  std::map<std::string, int> counts = {{"rows", 0}, {"agrees", 0}, {"better", 0}, {"differs", 0}};
  eachItem(all, [&](const Played &, const Item &item) {
    for (const Quantity &q : item.quantities) {
      if (couldFail(q) && (kind == "all" || kindOf(q) == kind)) {
        ++counts["rows"];
        ++counts[vpToString(verdictOf(q))];
      }
    }
  });
  return counts;
}
} // namespace

std::string pictureFile(const Item &item, const Figure &figure)
{
  return "figure/" + item.id + "-" + figure.name + "." + figure.suffix;
}

Json resultsJson(const std::vector<Played> &all)
{
  Json rows = Json::array();
  eachItem(all, [&](const Played &played, const Item &item) {
    for (const Quantity &q : item.quantities) {
      rows.push_back(rowOf(item, q, played.part->random));
    }
  });
  return rows;
}

Json itemsJson(const std::vector<Played> &all)
{
  Json items = Json::array();
  eachItem(all, [&](const Played &played, const Item &item) {
    Json figures = Json::array(), parameters = Json::array();
    for (const Figure &figure : item.figures) {
      figures.push_back(figureOf(item, figure));
    }
    for (const auto &parameter : item.parameters) {
      parameters.push_back({{"name", parameter.first}, {"value", parameter.second}});
    }
    items.push_back({{"id", item.id},
                     {"label", labelOf(item.id)},
                     {"title", titleOf(played, item)},
                     {"chapter", played.part->chapter},
                     {"verdict", vpToString(verdictOf(item))},
                     {"remarks", item.remarks},
                     {"parameters", parameters},
                     {"figures", figures}});
  });
  return items;
}

std::string curvesCsv(const std::vector<Played> &all)
{
  std::string csv = "item,figure,panel,curve,x,y\n";
  eachItem(all, [&](const Played &, const Item &item) {
    for (const Figure &figure : item.figures) {
      addCurves(item, figure, csv);
    }
  });
  return csv;
}

std::map<Verdict, int> countRows(const std::vector<Played> &all)
{
  std::map<Verdict, int> counts;
  for (const Verdict verdict : VERDICTS) {
    counts[verdict] = 0;
  }
  eachItem(all, [&](const Played &, const Item &item) {
    for (const Quantity &q : item.quantities) {
      ++counts[verdictOf(q)];
    }
  });
  return counts;
}

Json summaryJson(const std::vector<Played> &all, const Options &options, const std::string &commandLine,
                 double wallTime)
{
  Json verdicts = Json::object(), seconds = Json::object(), rows = Json::object(), items = Json::object();
  for (const Verdict verdict : VERDICTS) {
    items[vpToString(verdict)] = 0;
  }
  for (const auto &count : countRows(all)) {
    rows[vpToString(count.first)] = count.second;
  }
  eachItem(all, [&](const Played &, const Item &item) {
    const char *const verdict = vpToString(verdictOf(item));
    verdicts[item.id] = verdict;
    items[verdict] = items[verdict].get<int>() + 1;
  });
  for (const Played &played : all) {
    seconds[played.part->entries.front().id] = played.seconds;
  }
  return {{"version", VISP_DIRECT_VERSION},
          {"command", commandLine},
          {"seed", options.seed},
          {"seeds", options.seeds},
          {"rows", rows},
          {"could_fail",
           {{"all", countsOf(all, "all")},
            {"value", countsOf(all, "value")},
            {"bound", countsOf(all, "bound")},
            {"arithmetic", countsOf(all, "arithmetic")}}},
          {"items", items},
          {"verdicts", verdicts},
          {"seconds_of_parts", seconds},
          {"jobs", options.jobs},
          {"wall_time_s", wallTime}};
}
} // namespace thesisReport
