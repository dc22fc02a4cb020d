/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "run.h"

#include "appMain.h"
#include "sweep.h"

#include <algorithm>
#include <cctype>
#include <chrono>

namespace thesisReport
{
// What ranks send, see sweep.h.
template <class Archive> void exchange(Archive &archive, Quantity &q)
{
  archive(q.name, q.unit, q.thesis, q.ours, q.tolerance, q.good, q.reason, q.note);
}
template <class Archive> void exchange(Archive &archive, Figure &figure)
{
  archive(figure.name, figure.title, figure.caption, figure.picture, figure.mime);
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

const std::vector<Part> &catalogue()
{
  static const std::vector<Part> all = [] {
    std::vector<Part> parts;
    for (const auto make : {keypointParts, servoParts, trajectoryParts, patternParts, printingParts, avoidanceParts,
                            armParts, minimumJerkParts}) {
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

std::vector<Played> playAll(const Options &options, const vpApp::Ranks &ranks)
{
  Setting common;
  common.seed = options.seed;
  common.wanted.insert(options.only.begin(), options.only.end());
  std::vector<const Part *> parts;
  for (const Part &part : catalogue()) {
    if (needed(part, common)) {
      parts.push_back(&part);
    }
  }
  vpApp::Sweep sweep;
  sweep.title = "repeating " + std::to_string(common.wanted.size()) + " figures and tables";
  sweep.count = parts.size();
  sweep.effort = [&parts](std::size_t i) { return parts[i]->cost; };
  const auto play = [&](std::size_t i, const std::function<void(double)> &done) {
    const Part &part = *parts[i];
    const auto start = std::chrono::steady_clock::now();
    Setting setting = common;
    setting.progress = [&done](double share) {
      vpApp::throwIfInterrupted();
      done(share);
    };
    Played played;
    try {
      played.items = sorted(part, setting, part.play(setting));
    }
    catch (const vpApp::Interrupted &) {
      throw;
    }
    catch (const std::exception &error) {
      throw std::runtime_error(part.entries.front().id + " and what goes with it: " + vpApp::sentenceOf(error));
    }
    played.seconds = secondsSince(start);
    return played;
  };
  std::vector<Played> all = vpApp::runSweep<Played>(ranks, sweep, options.jobs, play);
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i].part = parts[i];
  }
  return all;
}
} // namespace thesisReport
