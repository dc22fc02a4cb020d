/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpPairText.h"

#include <cmath>
#include <cstdio>

BEGIN_VISP_NAMESPACE

namespace
{
std::string text(double value, int digits)
{
  char result[40];
  std::snprintf(result, sizeof(result), "%.*g", digits, value);
  return result;
}
} // namespace

std::string vpPairText(const vpCollisionScene &scene, const vpClearance &pair, double margin)
{
  const std::string who = scene.describe(pair);
  if (!std::isfinite(pair.distance)) {
    return who;
  }
  if (pair.distance <= 0.) {
    return who + " touch";
  }
  const double apart = 1e3 * pair.distance, kept = 1e3 * margin; // mm
  int digits = 3;
  while (digits < 17 && apart != kept && text(apart, digits) == text(kept, digits)) {
    ++digits;
  }
  return who + " are " + text(apart, digits) + " mm apart, the margin is " + text(kept, digits) + " mm";
}

END_VISP_NAMESPACE
