/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The centre of a spot from its edges: half maximum, and Algorithm 7.4 as printed and corrected.
#ifndef vpCellEdges_h
#define vpCellEdges_h

#include "vpRunLabels.h"

#include <visp3/pattern/vpPatternTrackerSpec.h>

BEGIN_VISP_NAMESPACE

//! Crossings of the grey value with \e level on all four sides. False when a side has no crossing.
bool vpHalfMaximumCentre(const vpImage<unsigned char> &image, double level, vpPatternSpot &spot);
//! Algorithm 7.4 as printed: (7.12) with the width of the box, parabola (7.14), crossing of the diagonals (7.17).
bool vpThesisCentre(const vpImage<unsigned char> &image, vpPatternDerivative derivative, vpPatternSpot &spot);
//! Algorithm 7.4 with w - 1 for w in (7.12), a guarded parabola, and the left and right edges measured too.
bool vpThesisCentreFixed(const vpImage<unsigned char> &image, vpPatternDerivative derivative, vpPatternSpot &spot);

END_VISP_NAMESPACE
#endif
