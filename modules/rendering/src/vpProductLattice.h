/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpProductLattice.h
 * \brief Positions and defects of the cells of an endless product.
 */
#ifndef vpProductLattice_h
#define vpProductLattice_h

#include "vpOpeningTemplate.h"

#include <optional>
#include <vector>

BEGIN_VISP_NAMESPACE

/*!
 * \brief Positions and defects of cells by row and column, from the specification alone.
 */
class vpProductLattice
{
public:
  //! \brief One cell in the image.
  struct Cell {
    int row, column;
    double u, v;                            // centre, px
    std::optional<vpOpeningDamage> opening; // none: missing
  };

  //! \param spec : Valid.
  explicit vpProductLattice(const vpProductPatternSpec &spec);

  /*!
   * Cells whose centre is in the image or up to (\e marginX, \e marginY) px outside, by row, then by column.
   * The image covers -0.5 <= u < width - 0.5, v likewise. \param x, y : Displacement of the product, px.
   */
  [[nodiscard]] std::vector<Cell> cellsNear(double x, double y, double marginX, double marginY) const;

private:
  [[nodiscard]] Cell cell(int row, int column, double x, double y) const;

  vpProductPatternSpec m_spec;
  double m_cos, m_sin;
  double m_phaseX, m_phaseY; // of the flexible pitch, rad
};

END_VISP_NAMESPACE
#endif
