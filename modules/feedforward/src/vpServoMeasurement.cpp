/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/feedforward/vpServoMeasurement.h>

BEGIN_VISP_NAMESPACE

vpServoPoint vpServoGoal::mean() const
{
  vpServoPoint sum{0., 0., 0., false};
  unsigned int count = 0;
  for (const vpServoPoint &point : points) {
    if (point.visible) {
      sum.x += point.x;
      sum.y += point.y;
      sum.Z += point.Z;
      ++count;
    }
  }
  if (count == 0) {
    return {0., 0., 1., false};
  }
  return {sum.x / count, sum.y / count, sum.Z / count, true};
}

END_VISP_NAMESPACE
