/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPhotometry.h
 * \brief Internal: the reference image as a pyramid of samples, computed once; the grey values of a frame at the
 * samples, and their fit.
 */
#ifndef vpPhotometry_h
#define vpPhotometry_h

#include "vpGreyLanes.h"
#include "vpGreyMedian.h"
#include "vpPlaneGeometry.h"

#include <opencv2/core.hpp>

#include <array>

BEGIN_VISP_NAMESPACE

//! One level of the reference.
struct vpPhotometricLevel {
  int cols = 0, rows = 0;          //!< number of samples, without the border of the level
  double firstX = 0., firstY = 0.; //!< first sample in the plane, in vpPhotometricModel::unit()
  double pitchX = 0., pitchY = 0.; //!< distance of samples, same units
  int stride = 0;                  //!< length of a row with padding, see vpGreyPadded()
  std::vector<float> values;       //!< grey values, row by row; the padding of all is 0
  std::vector<float> dx, dy; //!< derivatives with respect to the plane coordinates, per vpPhotometricModel::unit()
  std::vector<float> slope2; //!< squared gradient length, (grey levels per sample)^2
  float textured = 0.f;      //!< smallest slope2 of a sample with texture

  //! Number of samples.
  [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(cols) * static_cast<std::size_t>(rows); }
  //! Calls visit(index) for every \e step-th sample.
  template <class Visit> void everyFew(int step, const Visit &visit) const
  {
    for (int row = 0, col = 0; row < rows;) {
      visit(static_cast<std::size_t>(row * stride + col));
      for (col += step; col >= cols; col -= cols) {
        ++row;
      }
    }
  }
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

//! Accepted residuals: e^2 < noise2 + shift2 * (slope of the sample)^2, the bound of Tukey's weight.
struct vpPhotometricBound {
  float noise2;
  float shift2;
};

//! Fit of the grey values of a frame to the reference at a pose.
struct vpPhotometricFit {
  double correlation =
      0.;              //!< Normalised correlation over the samples that are seen and not rejected, blockwise zero-mean.
  double inImage = 0.; //!< Fraction of the samples inside the image.
  double visible = 0.; //!< Fraction of the samples inside the image and not rejected.
};

/*!
 * Values of one frame at the samples of one level, with frame = gain * reference + bias. Gain and bias are kept from
 * frame to frame. The work space is allocated by the constructor.
 */
class vpPhotometry
{
public:
  static constexpr std::size_t fewestSamples = 100; //!< to fit six parameters of a pose and two of the light
  static constexpr double smallestGain = 0.05;      //!< below it, the frame shows nothing of the reference
  static constexpr double smallestShift = 0.1;      //!< samples; equivalent error of blur and interpolation

  //! \e model must outlive this object.
  vpPhotometry(const vpPhotometricModel &model, const vpPinhole &camera);

  //! Pixels of the frame between two samples of a level.
  [[nodiscard]] double pixelsPerSample(std::size_t level, const vpRigidPose &pose) const;
  //! Read the frame at the samples of a level; returns how many are in the image.
  std::size_t sample(const std::vector<cv::Mat> &pyramid, std::size_t index, const vpRigidPose &pose);

  //! Gain and bias of the last frame or from medians, whichever fits better, then fit().
  void start(const vpPhotometricLevel &level);
  //! Gain and bias at the current samples, reweighted until convergence; returns the robust deviation of the residuals.
  double fit(const vpPhotometricLevel &level);
  //! Robust deviation of the residuals at the current samples, gain and bias.
  [[nodiscard]] double deviation(const vpPhotometricLevel &level) { return deviation(level, 0.f); }
  /*!
   * The same where the reference has texture. Blank areas fit to the noise, whatever the pose
   * and the softness; their deviation would reject misfitting edges and leave a pose confirmed only by blank areas.
   */
  double textureDeviation(const vpPhotometricLevel &level);
  void addToLight(double gain, double bias);

  /*!
   * \param sigma : Standard deviation of the residuals from noise. \param shift : Possible pose error in samples, or
   *   the equivalent error of blur and interpolation. With sigma alone, dominated by the flat parts of an image, every
   *   misplaced edge would count as an occlusion, and edges determine the pose.
   */
  [[nodiscard]] vpPhotometricBound bound(double sigma, double shift) const;
  //! Correlation and fractions at the current samples, after fit() gave \e sigma.
  [[nodiscard]] vpPhotometricFit judge(const vpPhotometricLevel &level, double sigma) const;

  [[nodiscard]] double gain() const { return m_gain; }
  [[nodiscard]] double bias() const { return m_bias; }
  //! The samples for the loops over them, with the bound for \e sigma and \e shift.
  [[nodiscard]] vpGreySamples samples(const vpPhotometricLevel &level, double sigma, double shift) const;

private:
  double deviation(const vpPhotometricLevel &level, float slope2);

  const vpPhotometricModel &m_model;
  vpPinhole m_camera;
  double m_gain = 1., m_bias = 0.;
  std::vector<float> m_values; //!< of the frame at each sample, < 0 outside
  const vpGreyLanes &m_loops = vpChosenGreyLanes();
  vpGreyMedian m_median{16};
};

END_VISP_NAMESPACE
#endif
