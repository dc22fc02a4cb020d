/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpKeypoints.h"

#include <visp3/core/vpException.h>

BEGIN_VISP_NAMESPACE

std::unique_ptr<vpKeypointExtractor> makeSurfExtractor(const vpPlanarTargetSpec &)
{
  throw vpException(
      vpException::fatalError,
      "SURF keypoints need dlib, which this build lacks: install libdlib-dev and configure again, or choose "
      "ORB, SIFT, AKAZE, KAZE or BRISK");
}

END_VISP_NAMESPACE
