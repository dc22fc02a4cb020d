/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpMissingLibrary.h"

#include <visp3/avoidance/vpOctree.h>

BEGIN_VISP_NAMESPACE

vpOctree vpOctree::load(const std::string &file) { vpMissingLibrary((file + ": an octree").c_str(), "octomap"); }

END_VISP_NAMESPACE
