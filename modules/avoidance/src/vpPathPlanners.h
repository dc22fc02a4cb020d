/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPathPlanners.h
 * \brief The planners that vpPathPlanner makes by name.
 */
#ifndef vpPathPlanners_h
#define vpPathPlanners_h

#include "vpRegistry.h"

#include <visp3/avoidance/vpPathPlanner.h>

#include <memory>
#include <string>

BEGIN_VISP_NAMESPACE

//! All planners, ours first.
vpRegistry<vpPathPlanner::Maker> &vpPathPlanners();
//! One of ours. \throw vpException (notImplementedError) without OMPL.
std::shared_ptr<ompl::base::Planner> vpOwnPathPlanner(const std::string &name,
                                                      const std::shared_ptr<ompl::base::SpaceInformation> &space,
                                                      const vpPathPlannerSpec &spec);

END_VISP_NAMESPACE
#endif
