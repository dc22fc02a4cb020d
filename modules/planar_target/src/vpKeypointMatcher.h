/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpKeypointMatcher.h
 * \brief Internal: matches two keypoint sets: pairs that are each other's best and clearly better than the second.
 */
#ifndef vpKeypointMatcher_h
#define vpKeypointMatcher_h

#include "vpKeypointExtractor.h"

#include <utility>

BEGIN_VISP_NAMESPACE

/*!
 * Pairs (index in \e reference, index in \e current). Each is the mutual nearest neighbour, and nearer than \e ratio
 * times the second nearest in the current image (Lowe). One pass over the distances serves both tests.
 */
std::vector<std::pair<int, int>> matchKeypoints(const vpKeypointSet &reference, const vpKeypointSet &current,
                                                float ratio);

/*!
 * The most distinctive keypoints of a reference, at most \e most of them: half the strongest, half those of the strong
 * ones that are least similar to any other of the image, which pass the ratio test of matchKeypoints().
 */
vpKeypointSet tellingKeypoints(const vpKeypointSet &set, std::size_t most);

END_VISP_NAMESPACE
#endif
