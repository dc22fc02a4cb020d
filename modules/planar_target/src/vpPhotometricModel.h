/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPhotometricModel.h
 * \brief Internal: the reference image as a pyramid of samples, computed once.
 */
#ifndef vpPhotometricModel_h
#define vpPhotometricModel_h

#include "vpPlaneGeometry.h"

#include <opencv2/core.hpp>

#include <array>

BEGIN_VISP_NAMESPACE

//! One sample of the reference.
struct vpPhotometricSample {
  float value;  //!< grey value
  float dx, dy; //!< derivatives with respect to the plane coordinates, per vpPhotometricModel::unit()
  float slope2; //!< squared gradient length, (grey levels per sample)^2
};

//! One level of the reference.
struct vpPhotometricLevel {
  int cols = 0, rows = 0;                   //!< number of samples, without the border of the level
  double firstX = 0., firstY = 0.;          //!< first sample in the plane, in vpPhotometricModel::unit()
  double pitchX = 0., pitchY = 0.;          //!< distance of samples, same units
  std::vector<vpPhotometricSample> samples; //!< row by row
  float textured = 0.f;                     //!< smallest slope2 of a sample with texture
};

/*!
 * The reference at several resolutions (finest first), each with several degrees of softness.
 *
 * A level is the reference averaged over areas, so that its edges stay the target's edges. The outermost samples are
 * excluded: in a frame they mix with the background. Softness is a Gaussian blur that can be chosen to match the blur
 * of a frame: a mismatch stays in the residuals, where it hides occlusions and biases the pose.
 */
class vpPhotometricModel
{
public:
  //! Gaussian blur of each degree of softness, samples.
  static constexpr std::array<double, 4> softness = {0.7, 1., 1.4, 2.};

  /*!
   * \param reference : CV_8UC1, at least 32x32.
   * \param finestSize : Longer side of the finest level, px; the reference's own when that is smaller.
   */
  vpPhotometricModel(const cv::Mat &reference, const vpTargetPlane &plane, int finestSize);

  //! Number of levels.
  [[nodiscard]] std::size_t levels() const { return m_levels[0].size(); }
  //! A level, 0 the finest; \e soft is an index of softness. Levels of different softness have the same sample
  //! positions.
  [[nodiscard]] const vpPhotometricLevel &level(std::size_t index, std::size_t soft) const
  {
    return m_levels[soft][index];
  }
  //! Unit of the plane coordinates: half the longer side of the target, m.
  [[nodiscard]] double unit() const { return m_unit; }
  //! Standard deviation of the reference's grey values at the finest level.
  [[nodiscard]] double contrast() const { return m_contrast; }

private:
  std::array<std::vector<vpPhotometricLevel>, softness.size()> m_levels;
  double m_unit;
  double m_contrast = 0.;
};

END_VISP_NAMESPACE
#endif
