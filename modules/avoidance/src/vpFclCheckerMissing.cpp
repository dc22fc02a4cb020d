/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpMissingLibrary.h"

#include <visp3/avoidance/vpFclChecker.h>

BEGIN_VISP_NAMESPACE

struct vpFclChecker::Bodies {
};

vpFclChecker::vpFclChecker(const vpCollisionScene &) { vpMissingLibrary("vpFclChecker", "FCL"); }
vpFclChecker::~vpFclChecker() = default;
bool vpFclChecker::inCollision(const vpJointVector &, double) { return true; }
vpClearance vpFclChecker::clearance(const vpJointVector &, double) { return {}; }

END_VISP_NAMESPACE
