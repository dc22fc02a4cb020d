/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file designSpace.h
 * \brief Designs from lists and ranges of the variables: a full grid, or a sequence that fills the space evenly.
 */
#ifndef printExplore_designSpace_h
#define printExplore_designSpace_h

#include "design.h"

#include <array>

namespace printExplore
{
//! \brief Values of a variable: a list, or a range.
struct Axis {
  std::vector<double> values; //!< For a grid; at least one.
  double from = 0.;           //!< Of a range, else unused.
  double to = 0.;             //!< Its end, > from; equal: #values are a list.
  bool logarithmic = false;   //!< Even factors instead of even steps; from > 0.

  //! A list.
  [[nodiscard]] static Axis list(const std::vector<double> &values);
  //! A range of \e steps values, both ends among them.
  [[nodiscard]] static Axis range(double from, double to, int steps, bool logarithmic);
  //! The value at a share 0..1: anywhere in a range, one of a list.
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
  //! Every combination; the variable that is last here changes fastest.
  [[nodiscard]] std::vector<Design> grid() const;
  /*!
   * Halton's sequence in the bases 2, 3, 5, 7, 11, 13, 17, from its 20th point on, shifted by the seed (Cranley and Patterson 1976).
   * Any beginning of it fills the space evenly, so more samples only add designs.
   */
  [[nodiscard]] std::vector<Design> samples(unsigned int count, unsigned int seed) const;
};
} // namespace printExplore

#endif
