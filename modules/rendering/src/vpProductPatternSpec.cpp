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
// A range that depends on other fields.
void require(bool good, const char *field, double value, const char *unit, const std::string &range)
{
  if (!good) {
    throw vpException(vpException::badValue, "%s is %.10g%s, must be %s", field, value, unit, range.c_str());
  }
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

const vpFields<vpProductPatternSpec> &vpProductPatternSpec::fields()
{
  using Spec = vpProductPatternSpec;
  const vpFieldRange size{8., 16384.}, pitch{2., 1e5}, opening{1., 1024.}, grey{0., 255.}, gradient{-1., 1.};
  const vpFieldRange length{0., 1e5}, period{4., 1e6}, density{0., 100.}, share{0., 1.};
  static const vpFields<Spec> all = {
      {"width", &Spec::width, size, "px", "Columns of the image"},
      {"height", &Spec::height, size, "px", "Rows of the image"},
      {"pixelSize", &Spec::pixelSize, vpFieldRange::positive(), "um",
       "Size of a pixel on the product, for reports only"},
      {"pitchX", &Spec::pitchX, pitch, "px", "Pitch of the cells along a row"},
      {"pitchY", &Spec::pitchY, pitch, "px", "Pitch of the rows"},
      {"openingX", &Spec::openingX, opening, "px", "Length of an opening along its row"},
      {"openingY", &Spec::openingY, opening, "px", "Length of an opening across its row"},
      {"cornerRadius", &Spec::cornerRadius, {0., 512.}, "px", "Corner radius of a rounded opening"},
      {"dark", &Spec::dark, grey, "", "Grey value between the openings"},
      {"bright", &Spec::bright, grey, "", "Grey value of the openings"},
      {"illuminationX", &Spec::illuminationX, gradient, "",
       "Illumination gradient along u: factor 1 - x at the left, 1 + x at the right"},
      {"illuminationY", &Spec::illuminationY, gradient, "",
       "Illumination gradient along v: 1 - y at the top, 1 + y at the bottom"},
      {"psf", &Spec::psf, {0., 5.}, "px", "Standard deviation of the Gaussian blur of the optics"},
      {"noise", &Spec::noise, {0., 50.}, "", "Noise scale ns: variance = ns^2 (0.6^2 + I / 157) at the grey value I"},
      {"exposure", &Spec::exposure, share, "", "Exposure time as a fraction of the frame period"},
      {"jitter", &Spec::jitter, length, "px", "Standard deviation of a cell's position per axis"},
      {"flexAmplitudeX", &Spec::flexAmplitudeX, length, "px",
       "Flexible pitch: amplitude of the displacement along the rows"},
      {"flexAmplitudeY", &Spec::flexAmplitudeY, length, "px",
       "Flexible pitch: amplitude of the displacement across the rows"},
      {"flexPeriodX", &Spec::flexPeriodX, period, "cells", "Period of the sinusoidal displacement over the columns"},
      {"flexPeriodY", &Spec::flexPeriodY, period, "cells", "Period of the sinusoidal displacement over the rows"},
      {"dust", &Spec::dust, density, "", "Dark specks, 2 to 8 px wide, per 100 x 100 px of product, on average"},
      {"cracks", &Spec::cracks, density, "", "Dark crooked lines, 20 to 70 px long, per 100 x 100 px, on average"},
      {"missing", &Spec::missing, share, "", "Fraction of cells without an opening"},
      {"damaged", &Spec::damaged, share, "", "Fraction of cells that are partly closed"},
      {"seed", &Spec::seed, vpFieldRange::notNegative(), "", "Seed of product and noise"},
  };
  return all;
}

void vpProductPatternSpec::validate() const
{
  vpCheckFields(*this, fields(), "");
  if (shape == vpProductShape::Rounded) {
    vpCheckField("cornerRadius", "", cornerRadius, "px", {0., std::min(openingX, openingY) / 2.});
  }
  vpCheckField("rotation", "", rotation, "rad", {-M_PI, M_PI});
  require(std::fabs(illuminationX) + std::fabs(illuminationY) < 1., "illuminationY", illuminationY, "",
          "such that |illuminationX| + |illuminationY| < 1");
  requireGap("openingX", openingX, pitchX, jitter, flexAmplitudeX, flexPeriodX);
  requireGap("openingY", openingY, pitchY, jitter, flexAmplitudeY, flexPeriodY);
  vpCheckField("missing + damaged", "", missing + damaged, "", {0., 1.});
}

END_VISP_NAMESPACE
