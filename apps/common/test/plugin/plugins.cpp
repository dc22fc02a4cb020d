/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Good and bad plug-ins, one library for each KIND.
#include <visp3/direct_core/vpPlugin.h>

#include <cstdlib>
#include <stdexcept>

void notDefinedAnywhere();

#if KIND == 0 // good: leaves a mark that the test sees
extern "C" void vispDirectPlugin() { setenv("VISP_DIRECT_TEST_PLUGIN", "called", 1); }
#elif KIND == 1
extern "C" void vispDirectPlugin() { throw std::runtime_error("the licence has\nexpired"); }
#elif KIND == 2
extern "C" void vispDirectPlugin() { throw 7; }
#elif KIND == 3
extern "C" VISP_EXPORT void otherFunction() {}
#else
extern "C" void vispDirectPlugin() { notDefinedAnywhere(); }
#endif
