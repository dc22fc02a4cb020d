/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "design.h"

#include "numberText.h"

#include <tuple>

namespace printExplore
{
namespace
{
auto tied(const Design &d)
{
  return std::tie(d.frameRate, d.width, d.height, d.pixelSize, d.exposure, d.controller, d.dropVelocity, d.speedUp);
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
} // namespace printExplore
