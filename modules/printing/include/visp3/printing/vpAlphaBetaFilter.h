/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpAlphaBetaFilter.h
 * \brief Filters a noisy value and its rate with two fixed gains.
 */
#ifndef vpAlphaBetaFilter_h
#define vpAlphaBetaFilter_h

#include <visp3/direct_core/vpDirectCompat.h>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_printing
 * \brief Gains of a vpAlphaBetaFilter. Stable exactly for alpha > 0 and 0 < beta < 4 - 2 alpha.
 */
struct VISP_EXPORT vpAlphaBetaGains {
  double alpha = 0.37; //!< Fraction of the residual added to the value, in (0, 2); useful below 1.
  double beta = 0.045; //!< Fraction added to the rate (times the period), in (0, 4 - 2 alpha).

  /*!
   * Critical damping (double pole): beta = 2 - alpha - 2 sqrt(1 - alpha), the fastest response without overshoot.
   * \param alpha : In (0, 1).
   * \throw vpException (badValue) naming alpha and its value.
   */
  [[nodiscard]] static vpAlphaBetaGains criticallyDamped(double alpha);
  /*!
   * Steady state of a Kalman filter with white acceleration, constant over each period (Kalata): beta = 2 (2 - alpha) -
   * 4 sqrt(1 - alpha); twice the beta of critical damping, with some overshoot.
   * \param alpha : In (0, 1).
   * \throw vpException (badValue) naming alpha and its value.
   */
  [[nodiscard]] static vpAlphaBetaGains steadyKalman(double alpha);

  /*!
   * Variance of the filtered value relative to that of the measurements (white noise, steady state):
   * (2 alpha^2 + 2 beta - 3 alpha beta) / (alpha (4 - 2 alpha - beta)).
   */
  [[nodiscard]] double valueVariance() const;
  //! Variance of the rate times period squared, relative to that of the measurements:
  //! 2 beta^2 / (alpha (4 - 2 alpha - beta)).
  [[nodiscard]] double rateVariance() const;
  //! \throw vpException (badValue) naming the gain that makes the filter unstable, and its value.
  void validate() const;
};

/*!
 * \class vpAlphaBetaFilter
 * \ingroup group_printing
 * \brief Alpha-beta filter, thesis (7.23) (missing there) and (7.24).
 *
 * With the period T and the residual r:
 * \verbatim
   x- = x + T v + T^2 u / 2,   v- = v + T u,   r = z - x-,   x = x- + alpha r,   v = v- + beta r / T
   \endverbatim
 * where u is the known acceleration of the value, 0 unless given. The value may be a position (the rate is the
 * velocity) or a measured velocity (the rate is the acceleration). With velocities in px/frame the period is 1.
 *
 * step() does not allocate, throw, lock or print.
 *
 * \code
 * vpAlphaBetaFilter filter(vpAlphaBetaGains::criticallyDamped(0.4));
 * for (const double velocity : {4.9, 5.2, 5.}) { // measured, px/frame
 *   filter.step(velocity);
 * }
 * filter.skip(); // a frame without a measurement
 * std::cout << filter.state().value << " px/frame, in two frames " << filter.predict(2.) << ", noise times "
 *           << std::sqrt(filter.gains().valueVariance()) << std::endl;
 * \endcode
 */
class VISP_EXPORT vpAlphaBetaFilter
{
public:
  //! \brief State and output of the filter.
  struct State {
    double value = 0.;     //!< Filtered value, unit.
    double rate = 0.;      //!< Rate of the value, unit per time.
    double residual = 0.;  //!< Last measurement minus its prediction, unit.
    bool started = false;  //!< True after the first measurement.
    bool measured = false; //!< The last step had a measurement; otherwise it predicted only.
  };

  /*!
   * \param gains : Validated here.
   * \param period : Time between measurements, > 0, frame or s.
   * \throw vpException (badValue) naming what is out of range, and its value.
   */
  explicit vpAlphaBetaFilter(const vpAlphaBetaGains &gains = vpAlphaBetaGains(), double period = 1.);

  /*!
   * One step with a measurement.
   * \param z : Value; the first one initialises the filter with rate 0. When it is not finite or beyond
   *   vpPrintingLargest, the filter predicts only.
   * \param u : Known acceleration of the value since the last step, unit per time squared; when invalid as for \e z, 0
   *   is used.
   */
  const State &step(double z, double u = 0.) noexcept;
  //! One step without a measurement.
  const State &skip(double u = 0.) noexcept;
  //! Value predicted for a time \e dt ahead, (7.24) for dt = 1 and 2 periods; the current value when \e dt is not
  //! finite or beyond vpPrintingLargest.
  [[nodiscard]] double predict(double dt) const noexcept;
  //! Restart from a known value and rate. Ignored for numbers that are not finite or beyond vpPrintingLargest.
  void reset(double value, double rate) noexcept;
  //! Restart from the next measurement.
  void reset() noexcept { m_state = State(); }

  [[nodiscard]] const State &state() const { return m_state; }            //!< State after the last step.
  [[nodiscard]] const vpAlphaBetaGains &gains() const { return m_gains; } //!< Gains as given.

private:
  vpAlphaBetaGains m_gains;
  double m_period;
  State m_state;
};

END_VISP_NAMESPACE
#endif
