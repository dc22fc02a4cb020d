/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// FCL if the module was built with it, otherwise an error.
#ifndef vpFclMotionCheck_h
#define vpFclMotionCheck_h

#include <visp3/avoidance/vpCollisionChecker.h>

#include <memory>

BEGIN_VISP_NAMESPACE

namespace vpFclMotionCheck
{
//! \throw vpException (notImplementedError) if built without FCL.
[[nodiscard]] std::unique_ptr<vpCollisionChecker> makeChecker(const vpCollisionScene &scene);
} // namespace vpFclMotionCheck

END_VISP_NAMESPACE
#endif
