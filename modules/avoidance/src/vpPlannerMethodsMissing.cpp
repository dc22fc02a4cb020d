/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpPlannerMethods.h"

#include <visp3/core/vpException.h>

BEGIN_VISP_NAMESPACE

std::unique_ptr<vpAvoidanceMethod> makePlannedMotion(const vpCollisionScene &, bool, const vpAvoidanceMethodSpec &)
{
  throw vpException(vpException::notImplementedError,
                    "there is no method 'planner': OMPL was missing when module avoidance was built");
}

END_VISP_NAMESPACE
