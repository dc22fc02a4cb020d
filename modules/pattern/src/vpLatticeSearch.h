/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The basis of the lattice among spots with outliers and gaps.
#ifndef vpLatticeSearch_h
#define vpLatticeSearch_h

#include "vpLatticeSpots.h"

#include <visp3/pattern/vpDotLattice.h>

#include <Eigen/Core>

BEGIN_VISP_NAMESPACE

struct vpLatticeFound {
  vpDotLatticeKind kind = vpDotLatticeKind::None;
  Eigen::Vector2d a = Eigen::Vector2d::Zero(), b = Eigen::Vector2d::Zero();
  double score = 0., occupancy = 0., rms = 0.;
  const char *why = "there are fewer than four spots of like size"; // when there is none
  std::vector<std::size_t> spots;                                   // on the lattice
  std::vector<int> rows, columns;                                   // of each of those
};

// Rows and columns; middle: where a and b are determined, px.
[[nodiscard]] vpLatticeFound vpSearchLattice(const std::vector<vpLatticeSpot> &spots, const Eigen::Vector2d &middle);
// One row: the line with most spots, then the period that most of them share; gaps do not matter.
[[nodiscard]] vpLatticeFound vpSearchRow(const std::vector<vpLatticeSpot> &spots);
// Smallest possible step: at least the width of a spot.
[[nodiscard]] double vpLeastStep(const std::vector<vpLatticeSpot> &spots);

END_VISP_NAMESPACE
#endif
