/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpPlannerMethods.h"

#include <visp3/avoidance/vpPlannedMotion.h>

BEGIN_VISP_NAMESPACE

std::unique_ptr<vpAvoidanceMethod> makePlannedMotion(const vpCollisionScene &scene, bool onTheFly,
                                                     const vpAvoidanceMethodSpec &spec)
{
  vpPlannedMotionSpec full;
  full.common = spec;
  full.replanning = onTheFly ? vpReplanning::OnTheFly : vpReplanning::FromRest;
  return std::make_unique<vpPlannedMotion>(scene, full);
}

END_VISP_NAMESPACE
