/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpProductPattern.h
 * \brief Renders a moving, repetitive, flexible product, with the true positions of its cells.
 */
#ifndef vpProductPattern_h
#define vpProductPattern_h

#include <visp3/core/vpImage.h>
#include <visp3/rendering/vpProductPatternSpec.h>

#include <memory>
#include <vector>

BEGIN_VISP_NAMESPACE

//! \ingroup group_rendering
//! \brief True position of a cell of the product in the image.
struct VISP_EXPORT vpPatternTruthCell {
  int row = 0;            //!< Index of its row on the product, any sign.
  int column = 0;         //!< Index in its row, any sign.
  double x = 0.;          //!< Centre along the image's rows, px; the origin is the centre of the top left pixel.
  double y = 0.;          //!< Centre along the image's columns, px.
  bool complete = false;  //!< The whole opening is in the image, which covers -0.5..width-0.5 by -0.5..height-0.5.
  bool defective = false; //!< Missing or damaged. Dust and cracks do not count.
};

/*!
 * \class vpProductPattern
 * \ingroup group_rendering
 * \brief Renders an endless product of repetitive cells, for qualifying optics and testing trackers.
 *
 * Cell (0, 0) lies at the centre of the image when the product is at (0, 0), up to its jitter and the flexible pitch.
 * The centre of cell (row, column) is at
 * \verbatim
   p = c + R(theta) (column Px + fx + jx, row Py + fy + jy) + (x, y)
   \endverbatim
 * with the image's centre c = ((width - 1) / 2, (height - 1) / 2), the flexible pitch
 * fx = Ax sin(2 pi column / Nx + phase), its phase from the seed, and the jitter j. Jitter and
 * defects come from a hash of (seed, row, column): the product needs no memory and is reproducible at any position.
 *
 * The grey value of a pixel is the mean over its area and the exposure of: dark or bright by the opening's exact
 * outline, convolved with the Gaussian of the optics (the openings are blurred once on a grid of 1/8 px, 1/4 px for
 * openings over 256 px, and interpolated by cubics). Dust and cracks multiply the image as shadows, with the edge blur
 * of optics and pixel for a straight edge; illumination multiplies it too. Then come independent Gaussian noise of the
 * variance given in vpProductPatternSpec::noise, and rounding to 0..255.
 *
 * All functions are const and may be called from several threads; copies share the prepared data.
 *
 * \code
 * vpProductPatternSpec spec;
 * spec.noise = 4.; // the noise of the thesis
 * const vpProductPattern product(spec);
 * vpImage<unsigned char> I;
 * for (unsigned int frame = 0; frame < 100; ++frame) {
 *   product.render(5. * frame, 0., 5., 0., frame, I); // px, px/frame
 *   for (const vpPatternTruthCell &cell : product.cells(5. * frame, 0.)) {
 *     std::cout << cell.row << " " << cell.column << ": " << cell.x << ", " << cell.y << " px\n";
 *   }
 * }
 * \endcode
 */
class VISP_EXPORT vpProductPattern
{
public:
  //! \throw vpException (badValue), see vpProductPatternSpec::validate().
  explicit vpProductPattern(const vpProductPatternSpec &spec);

  //! Parameters of the product.
  [[nodiscard]] const vpProductPatternSpec &spec() const;

  /*!
   * Renders the image with noise.
   * \param x, y : Displacement of the product at mid-exposure, px, within +-1e8. A cell at position p of the product
   * appears at p + (x, y).
   * \param vx, vy : Its velocity, px/frame. The product moves by exposure * v during the exposure, which is centred, so
   * that motion blur adds no bias; at most 1000 px.
   * \param frame : Frame number. It selects the noise: the same number gives the same noise.
   * \param I : Result, resized if needed.
   * \throw vpException (badValue) naming an argument that is out of range or not finite.
   */
  void render(double x, double y, double vx, double vy, unsigned int frame, vpImage<unsigned char> &I) const;
  //! Renders the image before noise and rounding: the expected grey values. Arguments as for render().
  void expected(double x, double y, double vx, double vy, vpImage<float> &I) const;

  /*!
   * True positions of all cells whose centre is in the image, by row, then by column; missing cells included.
   * \param x, y : Displacement of the product, px, as for render().
   * \throw vpException (badValue) naming an argument that is out of range or not finite.
   */
  [[nodiscard]] std::vector<vpPatternTruthCell> cells(double x, double y) const;

private:
  class Impl;
  std::shared_ptr<const Impl> m_impl;
};

END_VISP_NAMESPACE
#endif
