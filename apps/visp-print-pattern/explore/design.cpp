/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "design.h"

#include "numberText.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <tuple>

namespace printExplore
{
namespace
{
auto tied(const Design &d)
{
  return std::tie(d.frameRate, d.width, d.height, d.pixelSize, d.exposure, d.controller, d.dropVelocity, d.speedUp);
}

constexpr unsigned int firstPoint = 20; // the first points in the larger bases lie on a line

//! Radical inverse: digits of the index, mirrored at the point.
double radicalInverse(unsigned int index, unsigned int base)
{
  double value = 0., place = 1.;
  for (; index > 0; index /= base) {
    place /= base;
    value += place * (index % base);
  }
  return value;
}

std::size_t indexAt(double share, std::size_t count)
{
  return std::min(count - 1, static_cast<std::size_t>(share * static_cast<double>(count)));
}
} // namespace

Design Design::thesis(vpPrintController controller)
{
  Design design;
  design.controller = controller;
  return design;
}

bool Design::operator==(const Design &other) const { return tied(*this) == tied(other); }

std::string nameOf(vpPrintController controller)
{
  switch (controller) {
  case vpPrintController::Pid:
    return "pid";
  case vpPrintController::PidFeedforward:
    return "pid-ff";
  case vpPrintController::Observer:
    break;
  }
  return "observer";
}

std::string textOf(const Design &design)
{
  using vpApp::number;
  return vpApp::fixed(design.frameRate, 0) + " Hz, " + std::to_string(design.width) + " x " +
         std::to_string(design.height) + " px, " + number(design.pixelSize, 3) + " um/px, " +
         number(design.exposure, 3) + " us, " + nameOf(design.controller) + ", " + number(design.dropVelocity, 4) +
         " mm/s at the centres and " + number(design.dropVelocity * design.speedUp, 4) + " on average";
}

Axis Axis::list(const std::vector<double> &values)
{
  Axis axis;
  axis.values = values;
  return axis;
}

Axis Axis::range(double from, double to, int steps, bool logarithmic)
{
  Axis axis;
  axis.from = from;
  axis.to = to;
  axis.logarithmic = logarithmic;
  for (int i = 0; i < steps; ++i) {
    axis.values.push_back(i == 0 ? from : i == steps - 1 ? to : axis.at(static_cast<double>(i) / (steps - 1)));
  }
  return axis;
}

double Axis::at(double share) const
{
  if (!(from < to)) {
    return values[indexAt(share, values.size())];
  }
  return logarithmic ? from * std::pow(to / from, share) : from + share * (to - from);
}

double DesignSpace::gridSize() const
{
  double size = 1.;
  for (const std::size_t count :
       {frameRate.values.size(), images.size(), pixelSize.values.size(), exposure.values.size(), controllers.size(),
        dropVelocity.values.size(), speedUp.values.size()}) {
    size *= static_cast<double>(count);
  }
  return size;
}

std::vector<Design> DesignSpace::grid() const
{
  std::vector<Design> designs(1);
  const auto times = [&](const auto &values, auto set) {
    std::vector<Design> longer;
    for (const Design &design : designs) {
      for (const auto &value : values) {
        longer.push_back(design);
        set(longer.back(), value);
      }
    }
    designs = std::move(longer);
  };
  times(frameRate.values, [](Design &d, double value) { d.frameRate = value; });
  times(images, [](Design &d, const std::array<unsigned int, 2> &size) {
    d.width = size[0];
    d.height = size[1];
  });
  times(pixelSize.values, [](Design &d, double value) { d.pixelSize = value; });
  times(exposure.values, [](Design &d, double value) { d.exposure = value; });
  times(controllers, [](Design &d, vpPrintController value) { d.controller = value; });
  times(dropVelocity.values, [](Design &d, double value) { d.dropVelocity = value; });
  times(speedUp.values, [](Design &d, double value) { d.speedUp = value; });
  return designs;
}

std::vector<Design> DesignSpace::samples(unsigned int count, unsigned int seed) const
{
  constexpr std::array<unsigned int, 7> bases{{2, 3, 5, 7, 11, 13, 17}};
  std::mt19937_64 random(seed);
  std::array<double, 7> shift{};
  for (double &s : shift) {
    s = static_cast<double>(random() >> 11U) *
        0x1p-53; // identical on every machine, unlike a standard library distribution
  }
  std::vector<Design> designs(count);
  for (unsigned int i = 0; i < count; ++i) {
    std::array<double, 7> share{};
    for (std::size_t k = 0; k < bases.size(); ++k) {
      const double moved = radicalInverse(firstPoint + i, bases[k]) + shift[k];
      share[k] = moved - std::floor(moved);
    }
    Design &d = designs[i];
    d.frameRate = frameRate.at(share[0]);
    d.pixelSize = pixelSize.at(share[1]);
    const std::array<unsigned int, 2> &image = images[indexAt(share[2], images.size())];
    d.width = image[0];
    d.height = image[1];
    d.exposure = exposure.at(share[3]);
    d.dropVelocity = dropVelocity.at(share[4]);
    d.controller = controllers[indexAt(share[5], controllers.size())];
    d.speedUp = speedUp.at(share[6]);
  }
  return designs;
}
} // namespace printExplore
