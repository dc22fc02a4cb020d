/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/avoidance/vpMotionResult.h>

BEGIN_VISP_NAMESPACE

const char *vpMotionResult::message() const noexcept
{
  switch (status) {
  case vpMotionStatus::Free:
    return "the motion is free";
  case vpMotionStatus::Collision:
    return "the motion collides";
  case vpMotionStatus::Undecided:
    return "the motion comes so near to the margin that it cannot be decided";
  default:
    return "a configuration has the wrong size, is not finite or is out of all range";
  }
}

END_VISP_NAMESPACE
