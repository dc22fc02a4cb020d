/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#ifndef vpPairText_h
#define vpPairText_h

#include <visp3/avoidance/vpCollisionScene.h>

#include <string>

BEGIN_VISP_NAMESPACE

//! "link 5 and object pillar are 9.85 mm apart, the margin is 10 mm"; "touch" if they do. Different numbers stay
//! distinguishable.
std::string vpPairText(const vpCollisionScene &scene, const vpClearance &pair, double margin);

END_VISP_NAMESPACE
#endif
