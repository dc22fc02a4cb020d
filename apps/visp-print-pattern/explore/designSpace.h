/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file designSpace.h
 * \brief Designs from lists and ranges of the variables: a full grid, or a low-discrepancy sequence.
 */
#ifndef printExplore_designSpace_h
#define printExplore_designSpace_h

#include "design.h"

#include <array>

namespace printExplore
{
//! \brief Values of a variable: a list, or a range.
struct Axis {
  std::vector<double> values; //!< Values for a grid; at least one.
  double from = 0.;           //!< Start of a range, else unused.
  double to = 0.;             //!< End of the range, > from; if equal, #values are a list.
  bool logarithmic = false;   //!< Geometric instead of arithmetic steps; from > 0.

  //! Make a list.
  [[nodiscard]] static Axis list(const std::vector<double> &values);
  //! Make a range of \e steps values, including both ends.
  [[nodiscard]] static Axis range(double from, double to, int steps, bool logarithmic);
  //! The value at a fraction 0..1: interpolated in a range, or one of a list.
  [[nodiscard]] double at(double share) const;
};

//! \brief The variables of a Design. Images and controllers are chosen from lists.
struct DesignSpace {
  Axis frameRate = Axis::list({1600.});
  std::vector<std::array<unsigned int, 2>> images{{{160, 100}}};
  Axis pixelSize = Axis::list({4.5});
  Axis exposure = Axis::list({50.});
  std::vector<vpPrintController> controllers{vpPrintController::Observer};
  Axis dropVelocity = Axis::list({28.8});
  Axis speedUp = Axis::list({1.25});

  //! Number of designs of grid().
  [[nodiscard]] double gridSize() const;
  //! Every combination; the last variable here changes fastest.
  [[nodiscard]] std::vector<Design> grid() const;
  /*!
   * Halton sequence in the bases 2, 3, 5, 7, 11, 13, 17, from its 20th point on, shifted by the seed (Cranley and
   * Patterson 1976). Any initial part fills the space evenly, so more samples only add designs.
   */
  [[nodiscard]] std::vector<Design> samples(unsigned int count, unsigned int seed) const;
};
} // namespace printExplore

#endif
