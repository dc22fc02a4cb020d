/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpTwist.h
 * \brief Velocity of a rigid body as a value: linear part first, then angular.
 */
#ifndef vpTwist_h
#define vpTwist_h

#include <visp3/core/vpColVector.h>
#include <visp3/direct_core/vpDirectCompat.h>

#include <array>
#include <cstddef>

BEGIN_VISP_NAMESPACE

/*!
 * \class vpTwist
 * \ingroup group_direct_core
 * \brief Rigid-body velocity (vx, vy, vz, wx, wy, wz) in m/s and rad/s, stored in place.
 *
 * ViSP passes velocities as a vpColVector, which is allocated on the heap. A real-time step must not allocate, so the
 * laws, filters and trajectories of visp-direct exchange this type and convert at the edge with toColVector().
 * Unless stated otherwise, twists in visp-direct are expressed in the current camera frame.
 *
 * \code
 * vpTwist v(0.3, 0., 0.4, 0., 0., 1.); // m/s and rad/s, in the camera frame
 * v = vpLimitTwist(v, 0.25, 1.5);      // 0.5 m/s is twice too fast: (0.15, 0, 0.2, 0, 0, 0.5)
 * if (v.isFinite()) {
 *   robot.setVelocity(vpRobot::CAMERA_FRAME, v.toColVector());
 * }
 * \endcode
 */
class VISP_EXPORT vpTwist
{
public:
  //! The zero twist.
  constexpr vpTwist() = default;
  //! Linear part (m/s), then angular part (rad/s).
  constexpr vpTwist(double vx, double vy, double vz, double wx, double wy, double wz) : m_data{{vx, vy, vz, wx, wy, wz}}
  {}

  /*!
   * Copy of a 6-vector of ViSP (linear, angular).
   * \throw vpException (dimensionError) if \e v does not have 6 rows.
   */
  static vpTwist fromColVector(const vpColVector &v);
  //! A new vpColVector of 6 rows. Allocates.
  [[nodiscard]] vpColVector toColVector() const;
  //! Write into \e v, which allocates only if it does not have 6 rows yet.
  void copyTo(vpColVector &v) const;

  //! Component \e i: 0-2 linear (m/s), 3-5 angular (rad/s).
  [[nodiscard]] constexpr double operator[](std::size_t i) const { return m_data[i]; }
  //! Component \e i, writable.
  [[nodiscard]] constexpr double &operator[](std::size_t i) { return m_data[i]; }
  //! The six numbers, linear part first.
  [[nodiscard]] const double *data() const { return m_data.data(); }
  //! The six numbers, linear part first, writable.
  [[nodiscard]] double *data() { return m_data.data(); }

  //! Euclidean norm of the linear part, m/s. Does not overflow; NaN if a component is NaN.
  [[nodiscard]] double linearNorm() const;
  //! Euclidean norm of the angular part, rad/s. Does not overflow; NaN if a component is NaN.
  [[nodiscard]] double angularNorm() const;
  //! True if no component is infinite or NaN.
  [[nodiscard]] bool isFinite() const;
  //! The twist with all components multiplied by \e factor.
  [[nodiscard]] vpTwist scaled(double factor) const;

private:
  std::array<double, 6> m_data{};
};

/*!
 * \ingroup group_direct_core
 * Scale the whole twist by one factor so that its linear and angular norms stay within the limits. Direction is kept:
 * clipping component by component would bend the path and break the view constraint.
 * \param twist : Twist to limit.
 * \param maxLinear : Largest linear norm, m/s, > 0.
 * \param maxAngular : Largest angular norm, rad/s, > 0.
 * \return The scaled twist; the input itself when it is within both limits; zero when a component is
 *   not finite or a limit is not > 0.
 */
[[nodiscard]] VISP_EXPORT vpTwist vpLimitTwist(const vpTwist &twist, double maxLinear, double maxAngular);

END_VISP_NAMESPACE
#endif
