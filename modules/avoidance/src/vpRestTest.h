/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpRestTest.h
 * \brief Internal: does a point move, or is it only noise?
 */
#ifndef vpRestTest_h
#define vpRestTest_h

#include <visp3/direct_core/vpDirectCompat.h>

#include <Eigen/Core>

#include <array>

BEGIN_VISP_NAMESPACE

/*!
 * \brief The last measurements of a vector, and whether a constant explains them.
 *
 * A Kalman filter that follows manoeuvres has a noisy velocity. A straight line through many measurements has a better
 * one, so rest is decided by that. Does not allocate.
 */
class vpRestTest
{
public:
  //! What counts as rest.
  struct Limits {
    double sigmas; //!< Slope below so many of its standard deviations; 0: never at rest.
    double speed;  //!< Only as many measurements as tell this speed from 0 can tell.
  };

  //! Forgets everything.
  void clear() { *this = vpRestTest(); }
  //! The next measurement. \param variance : Of each of its components.
  void add(double time, const Eigen::Vector3d &value, double variance, const Limits &limits);
  //! True when the last measurements are those of something that does not move.
  [[nodiscard]] bool isResting() const { return m_resting > 0; }
  //! Where it rests.
  [[nodiscard]] const Eigen::Vector3d &place() const { return m_line.mean; }
  //! Variance of each component of place() at \e time, for all that is known of its slope.
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
  int m_resting = 0; // so many of the newest
  Line m_line;       // through these
};

END_VISP_NAMESPACE
#endif
