/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpMissingLibrary.h"

#include <visp3/manipulator/vpArmUrdf.h>

BEGIN_VISP_NAMESPACE

vpArmModel vpLoadArmUrdf(const std::string &file, const vpArmUrdfSpec &)
{
  vpMissingLibrary((file + ": an arm by URDF").c_str(), "urdfdom");
}

END_VISP_NAMESPACE
