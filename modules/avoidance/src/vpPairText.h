/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#ifndef vpPairText_h
#define vpPairText_h

#include <visp3/avoidance/vpCollisionScene.h>

#include <cmath>
#include <cstdio>
#include <string>

BEGIN_VISP_NAMESPACE

//! A number with \e digits significant digits; 17 distinguish any two numbers.
inline std::string vpDigits(double value, int digits)
{
  char result[40];
  std::snprintf(result, sizeof(result), "%.*g", digits, value);
  return result;
}

//! "link 5 and object pillar are 9.85 mm apart, the margin is 10 mm"; "touch" if they do; with the object's inflation.
//! Different numbers stay distinguishable.
inline std::string vpPairText(const vpCollisionScene &scene, const vpClearance &pair, double margin)
{
  std::string who = scene.describe(pair);
  if (pair.kind == vpCollisionKind::Object && scene.object(pair.other).inflation > 0.) { // that may not touch in truth
    who += ", inflated by " + vpDigits(1e3 * scene.object(pair.other).inflation, 3) + " mm,";
  }
  if (!std::isfinite(pair.distance)) {
    return who;
  }
  if (pair.distance <= 0.) {
    return who + " touch";
  }
  const double apart = 1e3 * pair.distance, kept = 1e3 * margin; // mm
  int digits = 3;
  while (digits < 17 && apart != kept && vpDigits(apart, digits) == vpDigits(kept, digits)) {
    ++digits;
  }
  return who + " are " + vpDigits(apart, digits) + " mm apart, the margin is " + vpDigits(kept, digits) + " mm";
}

END_VISP_NAMESPACE
#endif
