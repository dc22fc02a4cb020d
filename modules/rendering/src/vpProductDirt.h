/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpProductDirt.h
 * \brief Dust and cracks on an endless product.
 */
#ifndef vpProductDirt_h
#define vpProductDirt_h

#include <visp3/core/vpImage.h>
#include <visp3/rendering/vpProductPatternSpec.h>

#include <array>
#include <vector>

BEGIN_VISP_NAMESPACE

/*!
 * \brief Specks and cracks, from a hash of the 100 x 100 px tile of the product in which they lie (cracks: begin).
 */
class vpProductDirt
{
public:
  //! \brief A displacement of the product during the exposure and its fraction of the time.
  struct Instant {
    double x, y, share; // px
  };

  //! \param spec : Valid.
  explicit vpProductDirt(const vpProductPatternSpec &spec);

  /*!
   * Multiplies the image by the transmission of dust and cracks.
   * \param instants : The exposure, fractions add up to 1. \param image : Of the size in the specification.
   */
  void darken(const std::vector<Instant> &instants, vpImage<float> &image) const;

private:
  static constexpr int pieces = 4; // of a crack
  //! \brief A polyline of width 2 * half through the corners; a speck is an ellipse about the first corner.
  struct Mark {
    bool crack;
    std::array<double, pieces + 1> x, y; // px, product at (0, 0)
    double half;                         // width or semi-axis, px
    double stretch, cosine, sine;        // of a speck: ratio of second to first semi-axis, direction
    double opacity;
  };
  [[nodiscard]] std::vector<Mark> marksOf(int tileX, int tileY) const;
  [[nodiscard]] double shade(const Mark &mark, double x, double y) const;
  void darken(const Mark &mark, const std::vector<Instant> &instants, vpImage<float> &image) const;

  vpProductPatternSpec m_spec;
  double m_sigma; // blur of an edge by optics and pixel, px
};

END_VISP_NAMESPACE
#endif
