/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpMissingLibrary.h"
#include "vpPathPlanners.h"

#include <visp3/avoidance/vpPathPlanner.h>

BEGIN_VISP_NAMESPACE

std::shared_ptr<ompl::base::Planner>
vpOwnPathPlanner(const std::string &, const std::shared_ptr<ompl::base::SpaceInformation> &, const vpPathPlannerSpec &)
{
  vpMissingLibrary("vpPathPlanner", "OMPL");
}

class vpPathPlanner::Impl
{
};

vpPathPlanner::vpPathPlanner(const vpCollisionScene &, const vpPathPlannerSpec &)
{
  vpMissingLibrary("vpPathPlanner", "OMPL");
}
vpPathPlanner::~vpPathPlanner() = default;
vpPathPlanner::vpPathPlanner(vpPathPlanner &&) noexcept = default;
vpPathPlanner &vpPathPlanner::operator=(vpPathPlanner &&) noexcept = default;
vpPathResult vpPathPlanner::plan(const vpJointVector &, const vpJointVector &) { return {}; }
void vpPathPlanner::setTimeLimit(double) noexcept {}
void vpPathPlanner::setSeed(unsigned int) noexcept {}
const vpPathPlannerSpec &vpPathPlanner::spec() const noexcept
{
  static const vpPathPlannerSpec none; // no object can exist
  return none;
}

END_VISP_NAMESPACE
