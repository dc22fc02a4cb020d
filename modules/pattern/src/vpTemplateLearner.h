/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// What a cell looks like, learned from the images: a robust mean of cells that were shifted onto each other.
#ifndef vpTemplateLearner_h
#define vpTemplateLearner_h

#include <visp3/core/vpImage.h>
#include <visp3/direct_core/vpDirectCompat.h>

#include <vector>

BEGIN_VISP_NAMESPACE

class vpTemplateLearner
{
public:
  //! Room for windows of \e maxPixels pixels.
  explicit vpTemplateLearner(std::size_t maxPixels);

  //! Start anew with windows of 2 halfWidth + 1 by 2 halfHeight + 1 px. False when they do not fit into the room.
  bool begin(int halfWidth, int halfHeight);
  //! Take in the cell with this centre, px. False when its window is not completely inside the image.
  bool add(const vpImage<unsigned char> &image, double x, double y);
  int count() const { return m_count; }
  //! Finish: the centre of point symmetry and the coefficients of the spline are computed. False: no symmetric cell.
  bool finish();
  //! After finish(): take in what the template leaves over at this cell. Shifting blurs the mean a little, and more at
  //! half a pixel than at none; the residuals bring back what was lost (iterative back-projection).
  bool addResidual(const vpImage<unsigned char> &image, double x, double y);
  //! Number of windows taken in by addResidual().
  int residuals() const { return m_residuals; }
  //! Add the residuals to the template and finish it again.
  bool refine();

  int halfWidth() const { return m_hw; }
  int halfHeight() const { return m_hh; }
  //! Value, and derivatives with respect to x and y, on the window of pixels when the centre is at (px, py), |p| <= 1,
  //! from the middle pixel. Row by row, (2 halfWidth + 1) columns.
  void evaluate(double px, double py, float *value, float *dx, float *dy) const;

private:
  static constexpr int extra = 2;       // pixels around the window that must be right, too: the spline looks at them
  static constexpr int margin = 5;      // pixels around the window in all, for shifts
  static constexpr int medianCount = 5; // windows whose median starts the mean
  int columns() const { return 2 * (m_hw + margin) + 1; }
  int rows() const { return 2 * (m_hh + margin) + 1; }
  void evaluateOn(int halfWidth, int halfHeight, double px, double py, float *value, float *dx, float *dy) const;
  void resample(const vpImage<unsigned char> &image, int ix, int iy, double fx, double fy);
  void normalise();
  void mix();
  void makeCoefficients();
  bool makeSpline();

  std::size_t m_capacity;
  int m_hw = 0, m_hh = 0, m_count = 0, m_residuals = 0;
  double m_centreX = 0., m_centreY = 0.; // of symmetry, from the middle of the grid
  double m_level = 0., m_contrast = 1.;  // of the first window, to which the others are brought
  float m_spread = 1.F;                  // mean absolute deviation from the mean
  std::vector<float> m_window, m_rowPass, m_mean, m_first, m_correction;
  std::vector<float> m_coefficients; // of the spline through the mean
  mutable std::vector<float> m_scratch;
};

END_VISP_NAMESPACE
#endif
