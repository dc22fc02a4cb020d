/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpJointVelocityEstimator.h
 * \brief Estimates joint velocities from noisy joint positions.
 */
#ifndef vpJointVelocityEstimator_h
#define vpJointVelocityEstimator_h

#include <visp3/manipulator/vpArmTypes.h>

BEGIN_VISP_NAMESPACE

/*!
 * \class vpJointVelocityEstimator
 * \ingroup group_manipulator
 * \brief Velocity observer of thesis 8.2.3: integrates instead of differentiating. The integrated model q'' = a is
 * corrected by its position error, with a double pole at exp(-bandwidth period): no steady-state velocity error in a
 * ramp, nor in any motion whose acceleration is given.
 *
 * \code
 * vpJointVelocityEstimator estimator(arm.size(), 0.001, 100.); // period, s; bandwidth, rad/s
 * for (int i = 0; i < 1000; ++i) {
 *   velocity = estimator.step(encoders());
 *   if (!estimator.measured()) {
 *     std::cerr << "no encoders: as in the last period" << std::endl;
 *   }
 * }
 * \endcode
 */
class VISP_EXPORT vpJointVelocityEstimator
{
public:
  /*!
   * \param size : Number of joints, 1..vpArmMaxJoints.
   * \param period : Control period, s, > 0.
   * \param bandwidth : Bandwidth, rad/s, > 0: low is smooth, high is fast.
   * \throw vpException (badValue) naming the parameter that is out of range, and its value.
   */
  vpJointVelocityEstimator(int size, double period, double bandwidth);

  //! Restarts at the next reading, at rest.
  void reset() noexcept;
  /*!
   * One cycle; no allocation, no exception. A reading of the wrong size, not finite or beyond vpArmLargest is ignored
   * and the model alone is integrated, see measured().
   * \param q : Measured positions, unwrapped, rad or m.
   * \param acceleration : Acceleration of the last period if known, rad/s^2 or m/s^2; empty or invalid: zero.
   * \return Current velocities, rad/s or m/s.
   */
  const vpJointVector &step(const vpJointVector &q, const vpJointVector &acceleration = vpJointVector()) noexcept;
  //! Velocities of the last step.
  [[nodiscard]] const vpJointVector &velocity() const noexcept { return m_velocity; }
  //! False if the last step had no valid reading.
  [[nodiscard]] bool measured() const noexcept { return m_measured; }
  //! Smoothed positions of the last step.
  [[nodiscard]] const vpJointVector &position() const noexcept { return m_position; }

private:
  double m_period, m_alpha, m_beta;
  bool m_started = false;
  bool m_measured = false;
  vpJointVector m_position, m_velocity;
};

END_VISP_NAMESPACE
#endif
