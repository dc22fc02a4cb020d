/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "part.h"

#include <cctype>

namespace thesisReport
{
const std::vector<Part> &catalogue()
{
  static const std::vector<Part> all = [] {
    std::vector<Part> parts;
    for (const auto make : {keypointParts, servoParts, trajectoryParts, patternParts, printingParts, avoidanceParts,
                            armTrackingParts, selfMotionParts, minimumJerkParts}) {
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
} // namespace thesisReport
