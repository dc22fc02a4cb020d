/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpUrdfGroups.h
 * \brief What the groups and states of an SRDF say on the chain of a URDF. Not installed.
 */
#ifndef vpUrdfGroups_h
#define vpUrdfGroups_h

#include "vpUrdfTree.h"

#include <visp3/manipulator/vpArmUrdf.h>
#include <visp3/manipulator/vpSrdf.h>

BEGIN_VISP_NAMESPACE

/*!
 * Completes the base and tip of a specification: by its group, the root above the tip, the only leaf.
 * \throw vpFileError if the tip is not unique or the group is no chain.
 */
void vpCompleteEnds(const vpUrdfTree &tree, const vpSrdf &srdf, vpArmUrdfSpec &spec, vpWarningList &warnings);

/*!
 * Coordinates of the home state by joint: the one named in the specification, else that of vpArmUrdfSpec::homeState
 * which gives all joints of the chain; empty if there is none.
 * \param chain : Moving joints of the chain. \throw vpFileError if the named state is missing or lacks one of them.
 */
std::map<std::string, double> vpHomeState(const vpUrdfTree &tree, const vpSrdf &srdf, const vpArmUrdfSpec &spec,
                                          const std::vector<std::string> &chain, std::string &name);

END_VISP_NAMESPACE
#endif
