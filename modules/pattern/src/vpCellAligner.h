/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Gauss-Newton alignment of one cell, and what the pixels that do not fit are worth.
#ifndef vpCellAligner_h
#define vpCellAligner_h

#include "vpTemplateBank.h"

BEGIN_VISP_NAMESPACE

//! Slopes of the illumination: of x, y, xT and yT, grey values per px and 1 per px. Where the light falls off evenly they
//! are the same everywhere.
using vpSlopes = std::array<double, 4>;

struct vpCellFit {
  bool ok = false;                     // the window is in the image and the steps converged
  double x = 0., y = 0.;               // centre, px
  double contrast = 0.;                // of the template's, 1 when it is the same
  double variance = 0.;                // of the residuals, grey values squared
  double xx = 0., yy = 0.;             // variance of x and y for residuals of variance 1
  bool doubtX = false, doubtY = false; // the edge that is seen may be that of something else
  bool masked = false;                 // pixels were left out
  bool hasSlopes = false;              // the slopes were measured
  vpSlopes slopes{};                   // as this cell alone shows them
};

class vpCellAligner
{
public:
  explicit vpCellAligner(std::size_t maxPixels);
  vpCellAligner(const vpCellAligner &) = delete;
  vpCellAligner &operator=(const vpCellAligner &) = delete;

  //! The slopes that all cells share; 0 at first.
  void setSlopes(const vpSlopes &slopes) { m_slopes = slopes; }
  //! Ask the memory for the window of a cell that comes next: a fresh image is not in the cache.
  static void prefetch(const vpImage<unsigned char> &image, const vpTemplateBank &bank, double x, double y);
  //! Least squares from the start (x, y); all pixels count. Measuring the slopes takes half as long again.
  vpCellFit align(const vpImage<unsigned char> &image, const vpTemplateBank &bank, double x, double y, bool withSlopes);
  //! The same with the pixels left out whose residual is above 3.5 times \e noise. Where more than half of one side is
  //! hidden the axis is in doubt; where more than half of both opposite sides is, the fit is not ok.
  vpCellFit alignMasked(const vpImage<unsigned char> &image, const vpTemplateBank &bank, double x, double y,
                        double noise);

private:
  void findMask(int n, int columns, float limit);
  void load(const vpImage<unsigned char> &image, const vpTemplateBank &bank, const vpTemplateBank::Place &place);

  vpSlopes m_slopes{};
  std::vector<std::int16_t> m_room;
  std::int16_t *m_window; // in m_room, aligned
  std::vector<float> m_model;
  std::array<double, vpTemplateBank::basisSize> m_sum{};
  std::vector<unsigned char> m_mask;
};

END_VISP_NAMESPACE
#endif
