/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpVelocityRamp.h
 * \brief Time-optimal change of velocity under limits on acceleration and jerk.
 */
#ifndef vpVelocityRamp_h
#define vpVelocityRamp_h

#include <visp3/trajectory/vpMotionFamily.h>

BEGIN_VISP_NAMESPACE

/*!
 * \class vpVelocityRamp
 * \ingroup group_trajectory
 * \brief The fastest transition from (v, a) to (v_target, 0) with |a| <= a_max and |j| <= j_max: at most four pieces of
 * constant jerk.
 *
 * Used to brake from outside the limits and, one cycle at a time, by vpTwistShaper. A start beyond a_max first returns
 * to it at full jerk.
 *
 * \code
 * const vpVelocityRamp ramp(0.4, 0., 0., 1., 10.); // brake from 0.4 m/s with at most 1 m/s^2 and 10 m/s^3
 * const vpAxisState end = ramp.at(0., ramp.duration());
 * std::cout << ramp.duration() << " s, " << end[0] << " m" << std::endl; // 0.5 s, 0.1 m
 * \endcode
 */
class VISP_EXPORT vpVelocityRamp
{
public:
  static constexpr int maxPieces = 4; //!< Maximum number of pieces of a ramp.

  //! A piece of constant jerk.
  struct Piece {
    double duration = 0.; //!< Duration, s, >= 0.
    double jerk = 0.;     //!< Jerk, unit/s^3.
  };

  //! No motion.
  vpVelocityRamp() = default;
  /*!
   * \param v, a : Initial velocity and acceleration.
   * \param target : Velocity to reach with zero acceleration.
   * \param maxAcceleration, maxJerk : Limits, > 0 and finite.
   */
  vpVelocityRamp(double v, double a, double target, double maxAcceleration, double maxJerk) noexcept;

  //! Total duration, s.
  [[nodiscard]] double duration() const { return m_duration; }
  //! Number of pieces, 0 when the target is already reached.
  [[nodiscard]] int count() const { return m_count; }
  //! Piece \e i of count().
  [[nodiscard]] const Piece &piece(int i) const { return m_pieces[static_cast<std::size_t>(i)]; }
  /*!
   * State at time \e t >= 0, starting at position \e q; after the end the velocity is exactly the target.
   */
  [[nodiscard]] vpAxisState at(double q, double t) const noexcept;

private:
  void add(double duration, double jerk);

  std::array<Piece, maxPieces> m_pieces{};
  int m_count = 0;
  double m_v = 0., m_a = 0., m_target = 0., m_duration = 0.;
};

END_VISP_NAMESPACE
#endif
