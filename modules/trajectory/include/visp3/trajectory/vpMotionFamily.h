/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpMotionFamily.h
 * \brief Closed-form motions between boundary values, for every duration at once.
 */
#ifndef vpMotionFamily_h
#define vpMotionFamily_h

#include <visp3/trajectory/vpPolynomial.h>

#include <array>

BEGIN_VISP_NAMESPACE

//! \ingroup group_trajectory
//! \brief Position and its derivatives at one instant of one axis: q, v, a, j in unit, unit/s, unit/s^2, unit/s^3.
using vpAxisState = std::array<double, 4>;

/*!
 * \class vpMotionFamily
 * \ingroup group_trajectory
 * \brief All motions p(s; T), s = t/T, that meet the same boundary values, one for each duration T.
 *
 * Each coefficient of p is a polynomial in T of degree <= 3, because a derivative of order k given in 1/s^k enters as
 * T^k times its value. So at a fixed s every derivative of the motion is also a polynomial in T, which makes the
 * smallest duration an exact computation (see vpMinimumDuration). Positions are relative to the start.
 *
 * \code
 * const vpAxisState from{0., 0.2}, to{0.5}; // m, m/s
 * const vpMotionFamily motion = vpMotionFamily::pointToPoint(from, to, 3); // minimum jerk, for every duration
 * const vpPolynomial p = motion.at(2.);                                    // in 2 s; relative to the start
 * std::cout << "after 1 s " << from[0] + p.value(0.5) << " m, " << p.jet(0.5)[1] / 2. << " m/s" << std::endl;
 * \endcode
 */
class VISP_EXPORT vpMotionFamily
{
public:
  static constexpr int maxDegree = 8; //!< Reached by a via with position, velocity and acceleration.
  static constexpr int maxPower = 3;  //!< A given jerk enters with T^3.

  /*!
   * Point to point. \e order conditions at each end (q, v, a, j in that order): 2 cubic (C1), 3 quintic (C2, the
   * minimum-jerk motion (3.59), (3.62)), 4 septic (C3).
   */
  [[nodiscard]] static vpMotionFamily pointToPoint(const vpAxisState &from, const vpAxisState &to, int order);

  /*!
   * Change of velocity with free final position: \e order conditions at each end, (v), (v, a) or (v, a, j). Only
   * `to[1]...` is read. Order 2 is the quartic ramp of the cruise form.
   */
  [[nodiscard]] static vpMotionFamily velocityStep(const vpAxisState &from, const vpAxisState &to, int order);

  /*!
   * Change of acceleration with free final position and velocity: \e order conditions at each end, (a) or (a, j). Order
   * 1 is the linear ramp of the ramped form.
   */
  [[nodiscard]] static vpMotionFamily accelerationStep(const vpAxisState &from, const vpAxisState &to, int order);

  /*!
   * One via position: the quintic plus one term s^3 (1 - s)^3, degree 6 (thesis (8.7), one T for the whole move).
   * \param from, to : State at the ends.
   * \param via : Position of the via, same origin as \e from.
   * \param tau : Time of the via as a fraction of T, 0 < tau < 1.
   */
  [[nodiscard]] static vpMotionFamily throughPosition(const vpAxisState &from, const vpAxisState &to, double via,
                                                      double tau);

  /*!
   * One via position with less speed there: degree 8. Velocity and acceleration at the via are these shares of those of
   * the motion of degree 6, at every T.
   */
  [[nodiscard]] static vpMotionFamily throughPosition(const vpAxisState &from, const vpAxisState &to, double via,
                                                      double tau, double velocityShare, double accelerationShare);

  //! One via with position, velocity and acceleration: degree 8.
  [[nodiscard]] static vpMotionFamily throughState(const vpAxisState &from, const vpAxisState &to,
                                                   const vpAxisState &via, double tau);

  //! The motion of duration T > 0 as a polynomial in s, relative to the start.
  [[nodiscard]] vpPolynomial at(double T) const noexcept;
  //! Coefficients of at(T), degree() + 1 of them, written to \e c.
  void evaluate(double T, double *c) const noexcept;
  /*!
   * Coefficients in T of the derivative of order \e derivative (0 ... 3) with respect to s, at a fixed \e s:
   * d^k p/ds^k = out[0] + out[1] T + out[2] T^2 + out[3] T^3.
   */
  [[nodiscard]] std::array<double, maxPower + 1> inDuration(double s, int derivative) const noexcept;

  [[nodiscard]] int degree() const { return m_degree; } //!< Degree in s.
  [[nodiscard]] int power() const { return m_power; }   //!< Degree in T.

  /*!
   * True when the derivative of this order is given at both ends (so it cannot violate a limit there).
   */
  [[nodiscard]] bool isGivenAtEnds(int derivative) const
  {
    return derivative >= m_firstGiven && derivative < m_endGiven;
  }

  //! Coefficient of s^k T^m.
  [[nodiscard]] double coefficient(int k, int m) const
  {
    return m_c[static_cast<std::size_t>(k)][static_cast<std::size_t>(m)];
  }

  /*!
   * One segment of a chain whose end conditions are coefficients in the T of the whole move: used by vpViaSpline.
   * \param from, to : Value, first and second derivative of the segment with respect to s, each as coefficients in T.
   * \param share : Duration of the segment as a fraction of T.
   */
  [[nodiscard]] static vpMotionFamily chained(const std::array<std::array<double, 3>, 3> &from,
                                              const std::array<std::array<double, 3>, 3> &to, double share);
  //! Duration of this motion as a fraction of T: 1 unless chained().
  [[nodiscard]] double share() const { return m_share; }

private:
  [[nodiscard]] static vpMotionFamily hermite(const vpAxisState &from, const vpAxisState &to, int level, int order);
  void addBump(double tau, int count, const std::array<std::array<double, maxPower + 1>, 3> &targets);

  std::array<std::array<double, maxPower + 1>, maxDegree + 1> m_c{};
  int m_degree = 0;
  int m_power = 0;
  int m_firstGiven = 0;
  int m_endGiven = 0;
  double m_share = 1.;
};

END_VISP_NAMESPACE
#endif
