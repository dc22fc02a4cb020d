/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// A plug-in with an avoidance method that does what "dtg" does, which the test compares.
#include <visp3/avoidance/vpAvoidanceMethods.h>
#include <visp3/direct_core/vpPlugin.h>

VISP_DIRECT_USING_NAMESPACE

extern "C" void vispDirectPlugin()
{
  vpAddAvoidanceMethod("again", "does what dtg does, from a plug-in",
                       [](const vpCollisionScene &scene, const vpAvoidanceMethodSpec &spec) {
                         return vpMakeAvoidanceMethod("dtg", scene, spec);
                       });
}
