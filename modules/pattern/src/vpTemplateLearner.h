/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Appearance of a cell, learned from the images: a robust mean of cells shifted onto each other.
#ifndef vpTemplateLearner_h
#define vpTemplateLearner_h

#include <visp3/core/vpImage.h>
#include <visp3/direct_core/vpDirectCompat.h>

#include <array>
#include <vector>

BEGIN_VISP_NAMESPACE

class vpTemplateLearner
{
public:
  //! Capacity for windows of \e maxPixels pixels.
  explicit vpTemplateLearner(std::size_t maxPixels);

  //! Restart with windows of 2 halfWidth + 1 by 2 halfHeight + 1 px. False when they exceed the capacity.
  bool begin(int halfWidth, int halfHeight);
  //! Add the cell with this centre, px. False when its window is not completely inside the image.
  bool add(const vpImage<unsigned char> &image, double x, double y);
  int count() const { return m_count; }
  //! Finish: the centre of point symmetry and the coefficients of the spline are computed. False: no symmetric cell.
  bool finish();
  //! After finish(): add the residual of the template at this cell. Shifting blurs the mean a little, and more at half
  //! a pixel than at none; the residuals restore the loss (iterative back-projection).
  bool addResidual(const vpImage<unsigned char> &image, double x, double y);
  //! Number of windows added by addResidual().
  int residuals() const { return m_residuals; }
  //! Add the residuals to the template and finish it again.
  bool refine();

  //! Residuals are clipped to this, grey values; at first three deviations of the windows from their mean.
  void setLimit(double limit) { m_limit = static_cast<float>(limit); }
  //! Mean square of the mean residual on the window, times their number: their variance when the template fits, more
  //! when it does not.
  double misfit() const;
  //! refine() in parts, with a share of the residuals only: begin, then refinePiece() until it returns true.
  void beginRefine(double share);
  bool refinePiece();
  //! After the last piece: the cell is still symmetric about a centre near the old one.
  bool isGood() const { return m_good; }
  //! Restore the template before beginRefine(), also in parts.
  void beginRestore();

  int halfWidth() const { return m_hw; }
  int halfHeight() const { return m_hh; }
  //! Value, and derivatives with respect to x and y, on the window of pixels when the centre is at (px, py), |p| <= 1,
  //! from the middle pixel. Row by row, (2 halfWidth + 1) columns.
  void evaluate(double px, double py, float *value, float *dx, float *dy) const;

private:
  static constexpr int extra = 2;       // pixels around the window that must be correct, too: the spline uses them
  static constexpr int margin = 5;      // pixels around the window in total, for shifts
  static constexpr int medianCount = 5; // windows whose median starts the mean
  int columns() const { return 2 * (m_hw + margin) + 1; }
  int rows() const { return 2 * (m_hh + margin) + 1; }
  void evaluateOn(int halfWidth, int halfHeight, double px, double py, float *value, float *dx, float *dy) const;
  void resample(const vpImage<unsigned char> &image, int ix, int iy, double fx, double fy);
  void normalise();
  void mix();
  std::size_t used() const { return static_cast<std::size_t>(columns()) * static_cast<std::size_t>(rows()); }
  void forgetResiduals();
  void beginSpline(int rounds);
  bool splinePiece();
  bool makeSpline();
  void coefficientsAlongRows(bool lower);
  void coefficientsAlongColumns();
  void addSymmetry(bool lower);
  void centreOnSymmetry();

  std::size_t m_capacity;
  int m_hw = 0, m_hh = 0, m_count = 0, m_residuals = 0;
  double m_centreX = 0., m_centreY = 0.; // of symmetry, from the middle of the grid
  double m_level = 0., m_contrast = 1.;  // of the first window, to which the others are normalised
  float m_spread = 1.F;                  // mean absolute deviation from the mean
  float m_limit = 3.F;                   // of residuals
  int m_rounds = 0, m_piece = 0;         // remaining rounds of makeSpline(); part of this round
  bool m_good = false;
  static constexpr std::size_t unknowns = 6; // shift, slopes of the light
  std::array<std::array<double, unknowns>, unknowns> m_normal{};
  std::array<double, unknowns> m_right{};
  double m_oldCentreX = 0., m_oldCentreY = 0.;
  std::vector<float> m_window, m_rowPass, m_mean, m_first, m_correction, m_old;
  std::vector<float> m_coefficients; // of the spline through the mean
  mutable std::vector<float> m_scratch;
};

END_VISP_NAMESPACE
#endif
