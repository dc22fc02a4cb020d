/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpFclMotionCheck.h"

#include <visp3/core/vpException.h>

BEGIN_VISP_NAMESPACE

std::unique_ptr<vpCollisionChecker> vpFclMotionCheck::makeChecker(const vpCollisionScene &)
{
  throw vpException(vpException::notImplementedError,
                    "validation by FCL was asked for, but visp-direct was built without FCL");
}

END_VISP_NAMESPACE
