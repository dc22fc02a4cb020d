/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpFclMotionCheck.h"

#include <visp3/avoidance/vpFclChecker.h>

BEGIN_VISP_NAMESPACE

std::unique_ptr<vpCollisionChecker> vpFclMotionCheck::makeChecker(const vpCollisionScene &scene)
{
  return std::make_unique<vpFclChecker>(scene);
}

END_VISP_NAMESPACE
