/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "report.h"

#include "htmlReport.h"
#include "numberText.h"

#include <algorithm>
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

using vpApp::HtmlCell;
using vpApp::HtmlTable;
using vpApp::number;

constexpr int DIGITS = 4;

const char *styleOf(Verdict verdict)
{
  return verdict == Verdict::Better ? "best left" : verdict == Verdict::Differs ? "worst left" : "left";
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
                           : "(" + id.substr(2) + ")";
}

//! Reasons for the difference of an item, from its quantities.
std::string whyOf(const Item &item)
{
  std::vector<std::string> reasons;
  for (const Quantity &q : item.quantities) {
    if (verdictOf(q) == verdictOf(item) && verdictOf(q) != Verdict::Agrees && !remarkOf(q).empty() &&
        std::find(reasons.begin(), reasons.end(), q.reason) == reasons.end()) {
      reasons.push_back(q.reason);
    }
  }
  std::string text;
  for (const std::string &reason : reasons) {
    text += (text.empty() ? "" : " ") + reason;
  }
  return text;
}

//! Links to the items, with their verdicts.
std::string overview(const std::vector<Played> &all)
{
  std::string html = "<div class=\"scroll\"><table><thead><tr><th>in the thesis</th><th>what it shows</th>"
                     "<th>verdict</th><th>where it differs or is better, why</th></tr></thead><tbody>\n";
  for (const Played &played : all) {
    for (const Item &item : played.items) {
      const Verdict verdict = verdictOf(item);
      html += "<tr><td class=\"left\"><a href=\"#" + item.id + "\">" + labelOf(item.id) +
              "</a></td><td class=\"left\">" + vpApp::escapeHtml(titleOf(played, item)) + "</td><td class=\"" +
              styleOf(verdict) + "\">" + vpToString(verdict) + "</td><td class=\"left wrap\">" +
              vpApp::escapeHtml(whyOf(item)) + "</td></tr>\n";
    }
  }
  return html + "</tbody></table></div>\n";
}

HtmlTable tableOf(const Item &item)
{
  HtmlTable table;
  table.header = {{HtmlCell("quantity"), HtmlCell("unit"), HtmlCell("thesis"), HtmlCell("ours"), HtmlCell("ratio"),
                   HtmlCell("tolerance"), HtmlCell("verdict"), HtmlCell("note")}};
  for (const Quantity &q : item.quantities) {
    const Verdict verdict = verdictOf(q);
    const auto ratio = ratioOf(q);
    table.rows.push_back({HtmlCell(q.name, "left wrap"), HtmlCell(q.unit == "1" ? "" : q.unit, "left"),
                          HtmlCell(q.thesis ? number(*q.thesis, DIGITS) : "-"), HtmlCell(number(q.ours, DIGITS)),
                          HtmlCell(ratio ? number(*ratio, 3) : ""),
                          HtmlCell(q.thesis ? q.tolerance.text() : "", "left"),
                          HtmlCell(vpToString(verdict), styleOf(verdict)), HtmlCell(remarkOf(q), "left wrap")});
  }
  return table;
}

void addItem(const Played &played, const Item &item, vpApp::HtmlReport &page)
{
  page.raw("<h3 id=\"" + item.id + "\">" + labelOf(item.id) + ": " + vpApp::escapeHtml(titleOf(played, item)) +
           "</h3>\n");
  for (const std::string &remark : item.remarks) {
    page.paragraph(remark);
  }
  page.table(tableOf(item), "");
  for (const Figure &figure : item.figures) {
    page.picture(vpApp::dataUri(figure.mime, figure.picture), figure.title, figure.title + ". " + figure.caption);
  }
  if (!item.parameters.empty()) {
    page.facts(item.parameters, "Parameters of " + labelOf(item.id) + ".");
  }
}

std::vector<std::string> answer(const std::vector<Played> &all)
{
  const auto counts = countVerdicts(all);
  int total = 0;
  for (const auto &count : counts) {
    total += count.second;
  }
  return {"Of " + std::to_string(total) + " figures and tables " + std::to_string(counts.at(Verdict::Agrees)) +
              " agree with the thesis in all that was compared, " + std::to_string(counts.at(Verdict::Better)) +
              " are better in some value and worse in none, and " + std::to_string(counts.at(Verdict::Differs)) +
              " differ in at least one value.",
          "Everything here is simulated; the thesis measured on a camera, a stage and an arm. Tolerances stand beside "
          "the values. A claim without a number became one: that a curve lies below another is a ratio of at most 1."};
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

std::string reportPage(const std::vector<Played> &all, const std::string &commandLine, double wallTime)
{
  vpApp::HtmlReport page("The thesis again", "Every figure and table with results of \"Direct Methods for Vision-Based "
                                             "Robot Control\", and what comes out here");
  page.highlight(answer(all));
  page.section("Overview");
  page.raw(overview(all));
  std::string chapter;
  for (const Played &played : all) {
    if (played.part->chapter != chapter) {
      chapter = played.part->chapter;
      page.section(chapter);
    }
    for (const Item &item : played.items) {
      addItem(played, item, page);
    }
  }
  page.section("How this was made");
  page.facts({{"command", commandLine},
              {"version", VISP_DIRECT_VERSION},
              {"time", number(wallTime, 3) + " s"},
              {"data", "results.json has every row of the tables above, data/ what is behind the pictures"}},
             "");
  return page.html();
}
} // namespace thesisReport
