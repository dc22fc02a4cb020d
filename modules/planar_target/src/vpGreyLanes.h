/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpGreyLanes.h
 * \brief Internal: the loops over grey values, for registers of different widths.
 */
#ifndef vpGreyLanes_h
#define vpGreyLanes_h

#include <visp3/direct_core/vpDirectCompat.h>

#include <cstddef>
#include <cstdint>

BEGIN_VISP_NAMESPACE

constexpr int vpGreyMostLanes = 16; //!< of all versions; rows of numbers are padded to a multiple of it

//! Length of a row of \e n numbers with its padding.
constexpr int vpGreyPadded(int n) { return (n + vpGreyMostLanes - 1) / vpGreyMostLanes * vpGreyMostLanes; }

//! Samples of a frame: at the image of (first + k next), k = 0, 1, ..., in the camera's frame.
struct vpGreyFrameRow {
  const unsigned char *frame;
  int step;                  //!< bytes of a row
  float lastU, lastV;        //!< last pixel
  float px, py, u0, v0, kud; //!< camera
  float first[3] = {}, next[3] = {};
};

//! Samples of a texture: at what the pixels (first + k, row) show.
struct vpGreyTextureRow {
  static constexpr int scale = 256;        //!< of the stored grey values
  static constexpr int undistortSteps = 4; //!< fixed point; each gains a factor of 3 kud r^2
  const std::uint16_t *texels;
  int step;                  //!< texels of a row
  float lastU, lastV;        //!< largest position
  float toTexel[9];          //!< normalised image coordinates to texels, homogeneous, row-major
  float px, py, u0, v0, kud; //!< camera
  float first = 0.f, row = 0.f;
};

//! Samples of a reference, with padding, and the frame's values there; < 0 outside the frame and in the padding.
struct vpGreySamples {
  const float *values, *reference, *dx, *dy, *slope2;
  float gain, bias;
  float noise2, shift2; //!< accepted: e^2 < noise2 + shift2 * slope2; weight (1 - e^2 / bound)^2
};

//! Positions of the samples in the plane: (firstX + c pitchX, firstY + r pitchY) in column c of row r.
struct vpGreyGrid {
  int rows = 0, stride = 0; //!< stride: columns with padding
  float firstX = 0.f, pitchX = 0.f, firstY = 0.f, pitchY = 0.f;
};

//! Sums over the accepted samples of a block, grey values less 128.
struct vpGreyMoments {
  float inside, count, R, I, RR, II, RI;
};

//! Half a number plane: rows of numbers.
struct vpGreyPlane {
  float *data = nullptr;
  std::ptrdiff_t step = 0; //!< numbers of a row
  [[nodiscard]] float *at(int row, int col) const { return data + row * step + col; }
};

//! A frame's pixels and what is predicted for them; see vpPixelRefiner.
struct vpGreyPixels {
  vpGreyPlane frame, open, residuals, grey, du, dv, dBlur;
};

//! Block of 8x8 pixels and the motion of its middle with the pose; the last two numbers of each row are 0.
struct vpGreyBlock {
  int row, col;
  double motion[2][8];
};

//! Light, weights and kind of the sums.
struct vpGreyWeights {
  enum class Kind { Estimate, Derivative, Score };
  float gain, bias;
  float noise2, shift2; //!< Tukey's bound for e^2: noise2 + shift2 (du^2 + dv^2)
};

//! Sums over the blocks of weight * basis * basis^T and weight * basis * e with the basis J = -gain motion, grey, 1, dBlur.
struct vpGreyNormal {
  double pose[6][8];  //!< J, J
  double light[3][8]; //!< grey, 1, dBlur by J
  double right[8];    //!< J, e
  double sums[24];    //!< of the blocks; see vpGreyLanes::blockSums
};

//! All loops in one version. All versions give the same, except for rounding.
struct vpGreyLanes {
  const char *name;
  //! Bilinear values of \e cols samples, then -1 to the end of the padding; returns how many are inside the frame.
  int (*sampleFrame)(const vpGreyFrameRow &row, int cols, float *values);
  //! Bilinear values of \e count samples, a multiple of vpGreyMostLanes.
  void (*sampleTexture)(const vpGreyTextureRow &row, int count, float *values);
  /*!
   * Adds to sums[10] those of w R R, w R, w, w R e, w e, R the reference, for \e count samples, a multiple of vpGreyMostLanes.
   */
  void (*lightSums)(const vpGreySamples &samples, int count, double *sums);
  /*!
   * Adds w c c^T to the upper triangle of sums[12][12], c = (dx x, dx y, dx, dy x, dy y, dy, -g x, -g y, R, 1, e, 0), g = dx x + dy y,
   * for all samples of the grid.
   */
  void (*normalSums)(const vpGreySamples &samples, const vpGreyGrid &grid, double *sums);
  //! Moments of a block of 16 columns of \e rows rows, \e step numbers apart.
  void (*moments)(const vpGreySamples &samples, int rows, std::ptrdiff_t step, vpGreyMoments &moments);
  /*!
   * Symmetric and antisymmetric filters along a row: mean and curvature of h_i (a_i + b_i) and slope of d_i (a_i - b_i), where a_0, a_1, ...
   * are right[c], left[c + 1], right[c + 1], ..., and b_i left[c], right[c - 1], left[c - 1], ... For \e count columns and up to
   * vpGreyMostLanes - 1 more.
   */
  void (*filterRow)(const float *left, const float *right, const float *const *kernels, int size, int count,
                    float *const *out);
  /*!
   * The same along columns: rows[k][i] is a row of kind k (mean, slope, curvature), below the middle where i is even. To grey, du, dv,
   * dBlur.
   */
  void (*filterColumns)(const float *const *below, const float *const *above, const float *const *kernels, int size,
                        int count, float *const *out);
  //! Residuals frame - bias - gain * (grey - shift . (du, dv) + beta dBlur), shift = motion change.
  void (*residuals)(const vpGreyPixels &pixels, const vpGreyBlock *blocks, std::size_t count, const double *change,
                    float gain, float bias, float beta);
  /*!
   * For each block 24 numbers: upper triangle, row by row, of w b b^T, each row followed by w b e, with b = (du, dv, grey, 1, dBlur); 4 zeros.
   */
  void (*blockSums)(const vpGreyPixels &pixels, const vpGreyBlock *blocks, std::size_t count, vpGreyWeights::Kind kind,
                    const vpGreyWeights &weights, float *sums);
  void (*assemble)(const vpGreyBlock *blocks, const float *sums, std::size_t count, double gain, vpGreyNormal &normal);
  /*!
   * Squares of residuals over their variance, at most \e cap, less \e limit, from begin to end of a row; 0 elsewhere up to \e count.
   */
  void (*misfit)(const float *e, const float *du, const float *dv, int begin, int end, int count,
                 const vpGreyWeights &variance, float cap, float limit, float *out);
};

//! The version for this processor.
const vpGreyLanes &vpChosenGreyLanes();

END_VISP_NAMESPACE
#endif
