/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "fields.h"

#include <cctype>
#include <cstdio>
#include <stdexcept>

namespace generatePattern
{
std::string shortNumber(double value)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

const std::vector<Field> &fields()
{
  using Spec = vpProductPatternSpec;
  static const std::vector<Field> all = {
      {"image", "width", "PX", "Columns", &Spec::width},
      {"image", "height", "PX", "Rows", &Spec::height},
      {"image", "pixelSize", "UM", "Size of a pixel on the product; noted, changes no picture", &Spec::pixelSize},
      {"cells", "pitchX", "PX", "From cell to cell along a row", &Spec::pitchX},
      {"cells", "pitchY", "PX", "From row to row", &Spec::pitchY},
      {"cells", "openingX", "PX", "Length of an opening along its row", &Spec::openingX},
      {"cells", "openingY", "PX", "Length of an opening across its row", &Spec::openingY},
      {"cells", "cornerRadius", "PX", "Radius of the corners of a rounded opening", &Spec::cornerRadius},
      {"flexible", "jitter", "PX", "Standard deviation of each cell's place, each axis", &Spec::jitter},
      {"flexible", "flexAmplitudeX", "PX", "Cells lie up to this far off their place along the row",
       &Spec::flexAmplitudeX},
      {"flexible", "flexAmplitudeY", "PX", "The same across the rows", &Spec::flexAmplitudeY},
      {"flexible", "flexPeriodX", "CELLS", "Period of that deviation, a sine, along the row", &Spec::flexPeriodX},
      {"flexible", "flexPeriodY", "CELLS", "The same across the rows", &Spec::flexPeriodY},
      {"camera", "dark", "GREY", "Grey value between the openings, 0..255", &Spec::dark},
      {"camera", "bright", "GREY", "Grey value of the openings, 0..255", &Spec::bright},
      {"camera", "illuminationX", "SHARE", "Light varies by this share to either side, left to right",
       &Spec::illuminationX},
      {"camera", "illuminationY", "SHARE", "The same, top to bottom", &Spec::illuminationY},
      {"camera", "psf", "PX", "Standard deviation of the blur of the optics", &Spec::psf},
      {"camera", "noise", "SCALE", "ns of the variance ns^2 (0.36 + I/157); 4: the camera of the thesis", &Spec::noise},
      {"camera", "exposure", "SHARE", "Part of a frame's time in which motion blurs, 0..1", &Spec::exposure},
      {"defects", "dust", "COUNT", "Specks per 100 x 100 px", &Spec::dust},
      {"defects", "cracks", "COUNT", "Cracks per 100 x 100 px", &Spec::cracks},
      {"defects", "missing", "SHARE", "Cells without an opening", &Spec::missing},
      {"defects", "damaged", "SHARE", "Cells of which a part is closed", &Spec::damaged},
      {"random", "seed", "N", "Another seed is another product and another noise", &Spec::seed},
  };
  return all;
}

std::string Field::nameWith(char separator) const
{
  std::string text;
  for (const char *c = name; *c != '\0'; ++c) {
    const auto letter = static_cast<unsigned char>(*c);
    text +=
        std::isupper(letter) != 0 ? std::string{separator, static_cast<char>(std::tolower(letter))} : std::string{*c};
  }
  return text;
}

vpProductShape shapeOf(const std::string &name)
{
  for (const vpProductShape shape : {vpProductShape::Rectangle, vpProductShape::Rounded, vpProductShape::Dot}) {
    if (vpToString(shape) == name) {
      return shape;
    }
  }
  throw std::runtime_error(name + ", must be rectangle, rounded or dot");
}
} // namespace generatePattern
