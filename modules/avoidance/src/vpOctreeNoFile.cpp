/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// In the place of vpOctreeFile.cpp when there is no octomap.
#include <visp3/avoidance/vpOctree.h>
#include <visp3/core/vpException.h>

BEGIN_VISP_NAMESPACE

vpOctree vpOctree::load(const std::string &file)
{
  throw vpException(vpException::fatalError, "%s: octrees are not read, the module was built without octomap",
                    file.c_str());
}

END_VISP_NAMESPACE
