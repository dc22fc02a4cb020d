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

#include "vpPathSearch.h"
#include "vpRegistry.h"

BEGIN_VISP_NAMESPACE

//! All planners, ours first.
vpRegistry<vpPathSearchMaker> &vpPathPlanners();

END_VISP_NAMESPACE
#endif
