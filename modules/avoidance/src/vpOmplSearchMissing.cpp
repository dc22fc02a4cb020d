/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpMissingLibrary.h"
#include "vpOmplSearch.h"

BEGIN_VISP_NAMESPACE

std::shared_ptr<ompl::base::Planner>
vpMakeOmplPlanner(const std::string &, const std::shared_ptr<ompl::base::SpaceInformation> &, const vpPathPlannerSpec &)
{
  return nullptr; // no search calls it
}

std::unique_ptr<vpPathSearch> vpMakeOmplSearch(vpMotionCheck &, const std::string &name, const vpPathPlanner::Maker &)
{
  vpMissingLibrary(("path planner " + name).c_str(), "OMPL");
}

END_VISP_NAMESPACE
