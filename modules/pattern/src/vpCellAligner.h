/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Gauss-Newton alignment of one cell, with masking of pixels that do not fit.
#ifndef vpCellAligner_h
#define vpCellAligner_h

#include "vpTemplateBank.h"

BEGIN_VISP_NAMESPACE

//! Illumination gradients: of x, y, xT and yT, grey values per px and 1 per px. For evenly decreasing illumination they
//! are the same everywhere.
using vpSlopes = std::array<double, 4>;

struct vpCellFit {
  bool ok = false;                     // the window is in the image and the steps converged
  double x = 0., y = 0.;               // centre, px
  double contrast = 0.;                // relative to the template's contrast
  double variance = 0.;                // of the residuals, grey values squared
  double xx = 0., yy = 0.;             // variance of x and y for residuals of variance 1
  bool doubtX = false, doubtY = false; // the visible edge may belong to another object
  bool masked = false;                 // pixels were excluded
  bool hasSlopes = false;              // the slopes were measured
  vpSlopes slopes{};                   // estimated from this cell alone
};

class vpCellAligner
{
public:
  explicit vpCellAligner(std::size_t maxPixels);
  vpCellAligner(const vpCellAligner &) = delete;
  vpCellAligner &operator=(const vpCellAligner &) = delete;

  //! Set the slopes shared by all cells; 0 at first.
  void setSlopes(const vpSlopes &slopes) { m_slopes = slopes; }
  //! Prefetch the window of the next cell: a fresh image is not in the cache.
  static void prefetch(const vpImage<unsigned char> &image, const vpTemplateBank &bank, double x, double y);
  //! Least squares from the start (x, y) over all pixels. Measuring the slopes takes half as long again.
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
