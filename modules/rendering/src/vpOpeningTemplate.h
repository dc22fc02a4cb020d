/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpOpeningTemplate.h
 * \brief An opening, blurred by optics and pixel, for any sub-pixel position.
 */
#ifndef vpOpeningTemplate_h
#define vpOpeningTemplate_h

#include <visp3/core/vpImage.h>
#include <visp3/rendering/vpProductPatternSpec.h>

#include <vector>

BEGIN_VISP_NAMESPACE

//! \brief Which part of an opening is closed.
enum class vpOpeningDamage { None, Left, Right, Upper, Lower };

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

END_VISP_NAMESPACE
#endif
