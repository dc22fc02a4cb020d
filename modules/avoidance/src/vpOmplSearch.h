/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpOmplSearch.h
 * \brief Searches by planners of OMPL.
 */
#ifndef vpOmplSearch_h
#define vpOmplSearch_h

#include "vpPathSearch.h"

#include <memory>
#include <string>

BEGIN_VISP_NAMESPACE

//! One of OMPL's own planners: RRT, RRTConnect, RRTstar, PRM, BITstar or KPIECE.
std::shared_ptr<ompl::base::Planner> vpMakeOmplPlanner(const std::string &name,
                                                       const std::shared_ptr<ompl::base::SpaceInformation> &space,
                                                       const vpPathPlannerSpec &spec);
//! A search by the planner that the maker makes for each. \throw vpException (notImplementedError) without OMPL, naming it.
std::unique_ptr<vpPathSearch> vpMakeOmplSearch(vpMotionCheck &check, const std::string &name,
                                               const vpPathPlanner::Maker &maker);

END_VISP_NAMESPACE
#endif
