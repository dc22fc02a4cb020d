/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/core/vpException.h>
#include <visp3/manipulator/vpTwistAxes.h>

#include <algorithm>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr std::array<const char *, 6> shortNames{"x", "y", "z", "rx", "ry", "rz"};
} // namespace

std::array<bool, 6> vpFreeAxes(const std::vector<std::string> &names)
{
  std::array<bool, 6> free{};
  for (const std::string &name : names) {
    const auto found = std::find(shortNames.begin(), shortNames.end(), name);
    if (found == shortNames.end()) {
      throw vpException(vpException::badValue, "free axis \"%s\" is unknown, must be x, y, z, rx, ry or rz",
                        name.c_str());
    }
    bool &axis = free[static_cast<std::size_t>(found - shortNames.begin())];
    if (axis) {
      throw vpException(vpException::badValue, "free axis \"%s\" is named twice", name.c_str());
    }
    axis = true;
  }
  if (std::all_of(free.begin(), free.end(), [](bool axis) { return axis; })) {
    throw vpException(vpException::badValue, "all six axes are free, at least one must be commanded");
  }
  return free;
}

std::string vpAxesInWords(unsigned int axes)
{
  std::string words;
  for (std::size_t k = 0; k < 6; ++k) {
    if ((axes >> k & 1U) != 0U) {
      words += (words.empty() ? "" : ", ") + (k < 3 ? std::string("translation along ") + shortNames[k]
                                                    : std::string("rotation about ") + (shortNames[k] + 1));
    }
  }
  return words;
}

std::string vpAxesInWords(const std::array<bool, 6> &free)
{
  unsigned int axes = 0;
  for (std::size_t k = 0; k < 6; ++k) {
    axes |= free[k] ? 1U << k : 0U;
  }
  return vpAxesInWords(axes);
}

END_VISP_NAMESPACE
