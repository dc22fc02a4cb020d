/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpRestTest.h
 * \brief Internal: distinguishes motion of a point from noise.
 */
#ifndef vpRestTest_h
#define vpRestTest_h

#include <visp3/direct_core/vpDirectCompat.h>

#include <Eigen/Core>

#include <array>

BEGIN_VISP_NAMESPACE

/*!
 * \brief Tests whether a constant explains the last measurements of a vector.
 *
 * A Kalman filter that follows manoeuvres has a noisy velocity. A straight line through many measurements is more
 * accurate, so it decides on rest. Does not allocate.
 */
class vpRestTest
{
public:
  //! Criteria for rest.
  struct Limits {
    double sigmas; //!< Maximum slope in standard deviations; 0: never at rest.
    double speed;  //!< Only enough measurements to distinguish this speed from 0 decide.
  };

  //! Clears all measurements.
  void clear() { *this = vpRestTest(); }
  //! Adds a measurement. \param variance : Variance of each component.
  void add(double time, const Eigen::Vector3d &value, double variance, const Limits &limits);
  //! True if the last measurements are those of a resting object.
  [[nodiscard]] bool isResting() const { return m_resting > 0; }
  //! Rest position.
  [[nodiscard]] const Eigen::Vector3d &place() const { return m_line.mean; }
  //! Variance of each component of place() at \e time, including that of the slope.
  [[nodiscard]] double variance(double time) const;
  //! Variance of each component of the slope.
  [[nodiscard]] double slopeVariance() const { return 1. / m_line.spread; }

private:
  static constexpr int capacity = 32;
  struct Sample {
    double time = 0.;
    Eigen::Vector3d value = Eigen::Vector3d::Zero();
    double weight = 0.;
  };
  struct Line {
    double weight = 0., time = 0., spread = 0.; // sum of weights, mean time, sum of weighted squares about it
    Eigen::Vector3d mean = Eigen::Vector3d::Zero(), slope = Eigen::Vector3d::Zero();
    double scatter = 0.; // sum of weighted squares about the mean: chi-square of 3 (count - 1) when at rest
  };
  [[nodiscard]] const Sample &newest(int k) const
  {
    return m_samples[static_cast<std::size_t>((m_next + capacity - 1 - k) % capacity)];
  }
  [[nodiscard]] Line fit(int count) const;
  [[nodiscard]] int enough(const Limits &limits) const;
  [[nodiscard]] static bool isConstant(const Line &line, int count, double slopeSigmas, double scatterSigmas);

  std::array<Sample, capacity> m_samples;
  int m_count = 0, m_next = 0;
  int m_resting = 0; // number of newest measurements at rest
  Line m_line;       // line through these
};

END_VISP_NAMESPACE
#endif
