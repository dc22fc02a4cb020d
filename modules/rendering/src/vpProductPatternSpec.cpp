/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/rendering/vpProductPatternSpec.h>

#include <visp3/core/vpException.h>

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
void require(bool good, const char *field, double value, const char *unit, const std::string &range)
{
  if (!good || !std::isfinite(value)) {
    throw vpException(vpException::badValue, "%s is %.10g%s, must be %s", field, value, unit, range.c_str());
  }
}

void requireBetween(const char *field, double value, const char *unit, double low, double high)
{
  char range[64];
  std::snprintf(range, sizeof range, "%.7g..%.7g", low, high);
  require(value >= low && value <= high, field, value, unit, range);
}

// Neighbouring openings must not touch at any displacement.
void requireGap(const char *field, double opening, double pitch, double jitter, double amplitude, double period)
{
  const double room = pitch - 6. * jitter - 2. * amplitude * std::sin(M_PI / period);
  char range[96];
  std::snprintf(range, sizeof range, "< %.7g px, what pitch, jitter and flexible pitch leave", room);
  require(opening < room, field, opening, " px", range);
}
} // namespace

std::string vpToString(vpProductShape shape)
{
  switch (shape) {
  case vpProductShape::Rectangle:
    return "rectangle";
  case vpProductShape::Rounded:
    return "rounded";
  case vpProductShape::Dot:
    return "dot";
  }
  return "unknown";
}

void vpProductPatternSpec::validate() const
{
  constexpr double largest = 1e5; // px
  requireBetween("width", width, " px", 8., 16384.);
  requireBetween("height", height, " px", 8., 16384.);
  require(pixelSize > 0., "pixelSize", pixelSize, " um", "> 0");
  requireBetween("pitchX", pitchX, " px", 2., largest);
  requireBetween("pitchY", pitchY, " px", 2., largest);
  requireBetween("openingX", openingX, " px", 1., 1024.);
  requireBetween("openingY", openingY, " px", 1., 1024.);
  if (shape == vpProductShape::Rounded) {
    requireBetween("cornerRadius", cornerRadius, " px", 0., std::min(openingX, openingY) / 2.);
  }
  requireBetween("rotation", rotation, " rad", -M_PI, M_PI);
  requireBetween("dark", dark, "", 0., 255.);
  requireBetween("bright", bright, "", 0., 255.);
  requireBetween("illuminationX", illuminationX, "", -1., 1.);
  requireBetween("illuminationY", illuminationY, "", -1., 1.);
  require(std::fabs(illuminationX) + std::fabs(illuminationY) < 1., "illuminationY", illuminationY, "",
          "such that |illuminationX| + |illuminationY| < 1");
  requireBetween("psf", psf, " px", 0., 5.);
  requireBetween("noise", noise, "", 0., 50.);
  requireBetween("exposure", exposure, "", 0., 1.);
  requireBetween("jitter", jitter, " px", 0., largest);
  requireBetween("flexAmplitudeX", flexAmplitudeX, " px", 0., largest);
  requireBetween("flexAmplitudeY", flexAmplitudeY, " px", 0., largest);
  requireBetween("flexPeriodX", flexPeriodX, " cells", 4., 1e6);
  requireBetween("flexPeriodY", flexPeriodY, " cells", 4., 1e6);
  requireGap("openingX", openingX, pitchX, jitter, flexAmplitudeX, flexPeriodX);
  requireGap("openingY", openingY, pitchY, jitter, flexAmplitudeY, flexPeriodY);
  requireBetween("dust", dust, "", 0., 100.);
  requireBetween("cracks", cracks, "", 0., 100.);
  requireBetween("missing", missing, "", 0., 1.);
  requireBetween("damaged", damaged, "", 0., 1.);
  requireBetween("missing + damaged", missing + damaged, "", 0., 1.);
}

END_VISP_NAMESPACE
