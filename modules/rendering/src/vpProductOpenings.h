/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpProductOpenings.h
 * \brief The openings of an endless product: outline, blurred picture, positions and defects.
 */
#ifndef vpProductOpenings_h
#define vpProductOpenings_h

#include <visp3/core/vpImage.h>
#include <visp3/rendering/vpProductPatternSpec.h>

#include <optional>
#include <vector>

BEGIN_VISP_NAMESPACE

//! \brief Which part of an opening is closed.
enum class vpOpeningDamage { None, Left, Right, Upper, Lower };

/*!
 * \brief An opening about its centre, rotated with the product. A damaged one has two fifths closed on one side.
 */
class vpOpeningOutline
{
public:
  //! \param spec : Valid. \param damage : Which side is closed.
  vpOpeningOutline(const vpProductPatternSpec &spec, vpOpeningDamage damage);

  //! Half the size of the bounding box of the rotated opening along the image's axes, px.
  [[nodiscard]] double halfX() const { return m_halfX; }
  [[nodiscard]] double halfY() const { return m_halfY; }
  //! Open fraction of the square of side \e h around (x, y), px from the centre.
  [[nodiscard]] double coverage(double x, double y, double h) const;

private:
  vpProductShape m_shape;
  double m_a, m_b; // half lengths
  double m_radius; // of the corners
  double m_cos, m_sin;
  double m_left, m_right, m_upper, m_lower; // bounds of the open part, product axes
  double m_halfX, m_halfY;
};

/*!
 * \brief Fraction of light that a pixel gets from one opening: its outline, rotated with the product, convolved with
 * the Gaussian of the optics and the pixel's area, on a fine table.
 */
class vpOpeningTemplate
{
public:
  //! \param spec : Valid. \param damage : Two fifths of the opening are closed on this side (of the rotated product).
  vpOpeningTemplate(const vpProductPatternSpec &spec, vpOpeningDamage damage);

  //! Extent of the blurred opening from its centre, px.
  [[nodiscard]] double reachX() const { return m_x.reach; }
  [[nodiscard]] double reachY() const { return m_y.reach; }

  //! Adds \e weight times the opening with its centre at (u, v), px, to \e image, clipped to it.
  void add(double u, double v, double weight, vpImage<float> &image) const;

private:
  // One axis of the table: node n lies at (n - middle) / m_steps px from the centre.
  struct Axis {
    double reach;
    int size;   // px
    int middle; // node
  };
  // Table access by the pixels of an axis: pixel k interpolates between four nodes, each in the sub-table of
  // its phase, whose entries are one pixel apart.
  struct Taps {
    int first, last; // pixels affected, last is one beyond
    int phase[4];
    int shift[4]; // entry = pixel + shift
    double weight[4];
  };
  [[nodiscard]] Taps tapsFor(const Axis &axis, double centre, int imageSize) const;
  [[nodiscard]] const float *row(int phaseY, int phaseX, int entryY) const;

  int m_steps; // nodes per px
  Axis m_x, m_y;
  std::vector<float> m_table; // [phase y][phase x][entry y][entry x]
};

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
