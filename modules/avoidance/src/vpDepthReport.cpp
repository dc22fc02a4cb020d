/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/avoidance/vpDepthOctomap.h>

BEGIN_VISP_NAMESPACE

const char *vpDepthReport::message() const noexcept
{
  switch (status) {
  case vpDepthStatus::Ok:
    return "the depth image was used";
  case vpDepthStatus::NoPoint:
    return "the depth image has no depth in range that is not the arm";
  default:
    return "the camera's pose is no rotation and place in range, or its focal lengths are 0";
  }
}

END_VISP_NAMESPACE
