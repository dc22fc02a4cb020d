/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The template at all sub-pixel phases, ready for Gauss-Newton: one orthonormal basis per phase.
#ifndef vpTemplateBank_h
#define vpTemplateBank_h

#include "vpTemplateLearner.h"

#include <array>
#include <cstdint>

BEGIN_VISP_NAMESPACE

/*!
 * A cell at the phase p plus a small d looks like  c + s (T - dx Tx - dy Ty) + g1 x + g2 y + g3 xT + g4 yT: brightness
 * c, contrast s and slopes g of the illumination. With the columns 1, T, Tx, Ty, x, y, xT, yT, B = Q R and z = Q' I,
 * the rows of R give the unknowns, and |I|^2 - |z|^2 is the residual. The slopes are the same for all cells and change
 * slowly; estimated for each cell they would double the variance of y.
 *
 * Q is kept as 16-bit integers: eight products in one instruction of any x86-64.
 */
class vpTemplateBank
{
public:
  static constexpr int basisSize = 8;
  //! Phases per axis. Gauss-Newton covers the rest of a quarter of a pixel without loss; with 8 the bases would not
  //! stay in the cache: half as fast and no better.
  static constexpr int finest = 4;
  static constexpr int maxPhases = finest * finest;

  struct Phase {
    const std::int16_t *q = nullptr;                          // basisSize rows of stride()
    std::array<float, basisSize> scale{};                     // z = scale * sum of integers
    std::array<double, 4> inverse{};                          // of the first numbers on the diagonal of r
    double xx = 0., yy = 0.;                                  // variances of x and y for contrast and noise of 1
    std::array<std::array<double, basisSize>, basisSize> r{}; // upper triangle
  };
  //! Position of a cell: middle pixel of its window, and phase.
  struct Place {
    int x, y, phase;
    double px, py; // position of the phase, px
  };

  explicit vpTemplateBank(std::size_t maxPixels);

  //! Take over the learned template; no phase is ready yet.
  void begin(const vpTemplateLearner &learner);
  //! Prepare the next phases; true when all are ready.
  bool prepare(const vpTemplateLearner &learner, int count);
  //! Prepare a part of a phase, small enough to run beside the tracking of an image; true when all are ready.
  bool preparePiece(const vpTemplateLearner &learner);
  bool isReady() const { return m_phases > 0 && m_ready == m_phases; }
  void clear() { m_phases = m_ready = m_piece = 0; }

  Place place(double x, double y) const;
  const Phase &phase(int index) const { return m_phase[static_cast<std::size_t>(index)]; }
  //! Maximum distance of a cell from its phase, px, along each axis; with the finest phases the third order of the
  //! template is below 0.002 px there.
  double reach() const { return 0.8 / m_perAxis; }
  int halfWidth() const { return m_hw; }
  int halfHeight() const { return m_hh; }
  //! Difference between the brightest and the darkest pixel of the template, grey values.
  double range() const { return m_range; }
  int pixels() const { return (2 * m_hw + 1) * (2 * m_hh + 1); }
  int stride() const { return (pixels() + 31) / 32 * 32; } // whole cache lines

private:
  static constexpr int piecesPerPhase = 4;
  void fillBasis(const vpTemplateLearner &learner, int index);
  void orthogonalise(int index, std::size_t from, std::size_t end);
  void quantise(int index);
  float *column(std::size_t k) { return &m_basis[k * m_capacity]; }

  int m_hw = 0, m_hh = 0, m_perAxis = finest, m_phases = 0, m_ready = 0;
  int m_piece = 0; // of the phase in preparation
  double m_range = 0.;
  std::size_t m_capacity;
  std::array<Phase, maxPhases> m_phase;
  std::size_t m_room; // numbers in m_q
  std::vector<std::int16_t> m_q;
  std::vector<float> m_basis; // basisSize rows
};

END_VISP_NAMESPACE
#endif
