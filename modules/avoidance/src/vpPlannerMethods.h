/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#ifndef vpPlannerMethods_h
#define vpPlannerMethods_h

#include <visp3/avoidance/vpAvoidanceMethod.h>

#include <memory>

BEGIN_VISP_NAMESPACE

//! Creates a vpPlannedMotion. \throw vpException (notImplementedError) if built without OMPL.
[[nodiscard]] std::unique_ptr<vpAvoidanceMethod> makePlannedMotion(const vpCollisionScene &scene, bool onTheFly,
                                                                   const vpAvoidanceMethodSpec &spec);

END_VISP_NAMESPACE
#endif
