/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "run.h"

#include "appMain.h"
#include "dataFile.h"
#include "sweep.h"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <map>
#include <regex>

namespace vpApp
{
template <class Archive> void exchange(Archive &archive, PlotCurve &curve)
{
  archive(curve.label, curve.colour, curve.style, curve.width, curve.x, curve.y);
}
template <class Archive> void exchange(Archive &archive, PlotMark &mark) { archive(mark.x, mark.label); }
template <class Archive> void exchange(Archive &archive, Plot &plot)
{
  archive(plot.title, plot.xLabel, plot.yLabel, plot.curves, plot.marks, plot.categories, plot.xRange, plot.fromZero,
          plot.equalAxes, plot.logX, plot.logY, plot.height);
}
} // namespace vpApp

namespace thesisReport
{
// What ranks send, see sweep.h. Judgements are added on the first rank.
template <class Archive> void exchange(Archive &archive, Quantity &q)
{
  archive(q.name, q.unit, q.thesis, q.ours, q.tolerance, q.good, q.reason, q.note, q.never);
}
template <class Archive> void exchange(Archive &archive, Figure &figure)
{
  archive(figure.name, figure.title, figure.caption, figure.panels, figure.picture, figure.suffix);
}
template <class Archive> void exchange(Archive &archive, DataFile &file) { archive(file.name, file.content); }
template <class Archive> void exchange(Archive &archive, Item &item)
{
  archive(item.id, item.quantities, item.figures, item.data, item.parameters, item.remarks);
}
template <class Archive> void exchange(Archive &archive, Played &played) { archive(played.items, played.seconds); }

namespace
{
double secondsSince(std::chrono::steady_clock::time_point start)
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

//! The wanted items in the order of the part's entries; each must be there and have a row.
std::vector<Item> sorted(const Part &part, const Setting &setting, std::vector<Item> items)
{
  std::vector<Item> result;
  for (const Entry &entry : part.entries) {
    if (!setting.wants(entry.id)) {
      continue;
    }
    const auto found = std::find_if(items.begin(), items.end(), [&](const Item &item) { return item.id == entry.id; });
    if (found == items.end() || found->quantities.empty()) {
      throw std::runtime_error(entry.id + ": its part has no row of it");
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

const std::vector<Part> &catalogue()
{
  static const std::vector<Part> all = [] {
    std::vector<Part> parts;
    for (const auto make :
         {keypointParts, referenceParts, stabilityParts, servoParts, plannedServoParts, trajectoryParts, patternParts,
          printingParts, avoidanceParts, armParts, recommendationParts, minimumJerkParts}) {
      for (Part &part : make()) {
        parts.push_back(std::move(part));
      }
    }
    return parts;
  }();
  return all;
}

std::string chapterName(const Part &part)
{
  std::string name;
  for (const char c : part.chapter.substr(0, part.chapter.find(':'))) {
    if (c != ' ') {
      name += name.empty() ? static_cast<char>(std::tolower(static_cast<unsigned char>(c))) : c;
    }
  }
  return name;
}

std::vector<std::string> allIds()
{
  std::vector<std::string> ids;
  for (const Part &part : catalogue()) {
    for (const Entry &entry : part.entries) {
      ids.push_back(entry.id);
    }
  }
  return ids;
}

namespace
{
constexpr unsigned int SEED_STEP = 1000; // a part may use the seeds in between

//! A part with one seed.
struct Case {
  const Part *part;
  unsigned int seed;
};

//! Every wanted part with every seed, the seeds of a part one after another.
std::vector<Case> casesOf(const Options &options, const Setting &common)
{
  std::vector<Case> cases;
  for (const Part &part : catalogue()) {
    for (unsigned int k = 0; needed(part, common) && k < (part.random ? options.seeds : 1U); ++k) {
      cases.push_back({&part, options.seed + k * SEED_STEP});
    }
  }
  return cases;
}

//! Figures and tables are those of the first seed.
Played playCase(const Case &one, Setting setting, bool first)
{
  const auto start = std::chrono::steady_clock::now();
  setting.seed = one.seed;
  Played played;
  try {
    played.items = sorted(*one.part, setting, one.part->play(setting));
  }
  catch (const vpApp::Interrupted &) {
    throw;
  }
  catch (const std::exception &error) {
    throw std::runtime_error(one.part->entries.front().id + " and what goes with it: " + vpApp::sentenceOf(error));
  }
  for (Item &item : played.items) {
    if (!first) {
      item.figures.clear();
      item.data.clear();
    }
  }
  played.seconds = secondsSince(start);
  return played;
}

//! The seeds of a part as one, each row with its judgement.
Played merged(const std::vector<Played> &seeds, const Judgements &judgements)
{
  Played played = seeds.front();
  played.seconds = 0.;
  for (const Played &one : seeds) {
    played.seconds += one.seconds;
  }
  for (std::size_t i = 0; i < played.items.size(); ++i) {
    std::vector<Item> items;
    for (const Played &one : seeds) {
      items.push_back(one.items[i]);
    }
    played.items[i] = seedsMerged(std::move(items));
    for (Quantity &quantity : played.items[i].quantities) {
      if (quantity.thesis) {
        quantity.judgement = judgements.of(played.items[i].id, quantity.name);
      }
    }
  }
  return played;
}
} // namespace

std::vector<std::pair<std::string, std::string>> rowsNamedIn(const std::string &support)
{
  static const std::regex place(R"re(rows? of ([a-z]+A?[0-9.]+)((?:[^";]*"[^"]+")+))re"), quoted(R"re("([^"]+)")re");
  std::vector<std::pair<std::string, std::string>> rows;
  for (std::sregex_iterator i(support.begin(), support.end(), place), end; i != end; ++i) {
    const std::string names = (*i)[2];
    for (std::sregex_iterator k(names.begin(), names.end(), quoted); k != end; ++k) {
      rows.emplace_back((*i)[1], (*k)[1]);
    }
  }
  return rows;
}

namespace
{
//! Calls use(item, quantity) for each row.
template <class Use> void eachRow(const std::vector<Played> &parts, Use use)
{
  for (const Played &played : parts) {
    for (const Item &item : played.items) {
      for (const Quantity &quantity : item.quantities) {
        use(item, quantity);
      }
    }
  }
}

/*!
 * The rows that a support names must be there, as far as their figure or table was asked for.
 * \throw std::runtime_error naming the row and what its support names.
 */
void requireNamedRows(const std::vector<Played> &parts)
{
  std::map<std::string, std::vector<std::string>> rows; // names by id
  eachRow(parts, [&](const Item &item, const Quantity &quantity) { rows[item.id].push_back(quantity.name); });
  const auto missing = [&](const std::string &id, const std::string &name) {
    return rows.count(id) != 0 &&
           std::none_of(rows[id].begin(), rows[id].end(), [&](const std::string &row) { return isLike(row, name); });
  };
  eachRow(parts, [&](const Item &item, const Quantity &quantity) {
    for (const auto &[id, name] : rowsNamedIn(quantity.judgement.support)) {
      if (missing(id, name)) {
        throw std::runtime_error(item.id + ": the support of \"" + quantity.name + "\" names \"" + name +
                                 "\", but there is no such row of " + id);
      }
    }
  });
}
} // namespace

std::vector<Played> playAll(const Options &options, const vpApp::Ranks &ranks)
{
  const Judgements judgements(vpApp::dataFile("thesis/rows.json"));
  Setting common;
  common.wanted.insert(options.only.begin(), options.only.end());
  const std::vector<Case> cases = casesOf(options, common);
  vpApp::Sweep sweep;
  sweep.title = "repeating " + std::to_string(common.wanted.size()) + " figures and tables";
  sweep.count = cases.size();
  sweep.effort = [&cases](std::size_t i) { return cases[i].part->cost; };
  std::vector<Played> all =
      vpApp::runSweep<Played>(ranks, sweep, options.jobs, [&](std::size_t i, const std::function<void(double)> &done) {
        Setting setting = common;
        setting.progress = [&done](double share) {
          vpApp::throwIfInterrupted();
          done(share);
        };
        return playCase(cases[i], setting, cases[i].seed == options.seed);
      });
  std::vector<Played> parts;
  for (std::size_t i = 0, end = 0; ranks.isFirst() && i < cases.size(); i = end) {
    while (end < cases.size() && cases[end].part == cases[i].part) {
      ++end;
    }
    const auto from = all.begin() + static_cast<std::ptrdiff_t>(i);
    parts.push_back(merged({from, all.begin() + static_cast<std::ptrdiff_t>(end)}, judgements));
    parts.back().part = cases[i].part;
  }
  requireNamedRows(parts);
  return parts;
}
} // namespace thesisReport
