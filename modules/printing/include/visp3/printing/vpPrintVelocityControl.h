/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPrintVelocityControl.h
 * \brief Velocity control of one axis: PI or PID with mass and friction feedforward.
 */
#ifndef vpPrintVelocityControl_h
#define vpPrintVelocityControl_h

#include <visp3/printing/vpFrictionModel.h>

#include <limits>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_printing
 * \brief Parameters of a vpPrintVelocityControl; units as in vpFrictionModel, gains per period.
 */
struct VISP_EXPORT vpPrintVelocityControlSpec {
  double kp = 0.038;        //!< Force per velocity error, F T/L, >= 0.
  double ki = 0.0011;       //!< Force per sum of velocity errors (one each step), F T/L, >= 0.
  double kd = 0.;           //!< Force per change of the velocity error from step to step, F T/L, >= 0. (3.20) has none.
  bool feedforward = false; //!< Add (7.26).
  vpFrictionModel model;    //!< Model of the axis, for the feedforward.
  double maxForce = std::numeric_limits<double>::infinity(); //!< |command| <= maxForce, F, > 0.

  //! A PID without feedforward, as in figure 7.13, for the stage of vpXYStageSpec::thesis(): 0.038, 0.0011, 0.
  [[nodiscard]] static vpPrintVelocityControlSpec thesisPid();
  //! The same with feedforward, as in figure 7.14: 0.177, 0.0003, 0.12 (mass 1, viscous 0.02, Coulomb 0.08).
  [[nodiscard]] static vpPrintVelocityControlSpec thesisFeedforward();
  //! \throw vpException (badValue) naming the field that is out of range, and its value.
  void validate() const;
};

/*!
 * \class vpPrintVelocityControl
 * \ingroup group_printing
 * \brief Force from velocity errors, thesis (3.20), (7.25), (7.26). (3.20) is a PI law although the text calls it PID;
 * the D part acts on the difference of errors.
 *
 * Anti-windup: while the command is at its bound, the integral changes only in the direction that leads away from it.
 * step() does not allocate, throw, lock or print.
 *
 * \code
 * vpPrintVelocityControl control(vpPrintVelocityControlSpec::thesisFeedforward());
 * const vpPrintVelocityControl::Output out = control.step({5., 0.1, 4.8}); // reference and measured, px/frame
 * if (out.valid) {                                                         // and not out.saturated
 *   send(out.force);
 * }
 * \endcode
 */
class VISP_EXPORT vpPrintVelocityControl
{
public:
  //! \brief Input of a step.
  struct Input {
    double velocity = 0.;     //!< Reference velocity, L/T.
    double acceleration = 0.; //!< Reference acceleration, L/T^2; for the feedforward.
    double measured = 0.;     //!< Measured velocity, filtered or not, L/T.
  };
  //! \brief Output of a step.
  struct Output {
    double force = 0.;       //!< Command, F.
    double feedback = 0.;    //!< PID part before the bound, F.
    double feedforward = 0.; //!< Feedforward (7.26), F.
    bool saturated = false;  //!< The command was limited.
    //! False: a number of the input is not finite or beyond vpPrintingLargest. Without velocities the last error and
    //! the integral are kept; without a reference there is no feedforward.
    bool valid = true;
  };

  //! \throw vpException (badValue) naming the field of \e spec that is out of range, and its value.
  explicit vpPrintVelocityControl(const vpPrintVelocityControlSpec &spec = vpPrintVelocityControlSpec());
  //! One period.
  Output step(const Input &input) noexcept;
  //! Reset the errors.
  void reset() noexcept;
  //! Sum of errors so far, L.
  [[nodiscard]] double integral() const { return m_integral; }
  //! Specification as given.
  [[nodiscard]] const vpPrintVelocityControlSpec &spec() const { return m_spec; }

private:
  vpPrintVelocityControlSpec m_spec;
  double m_integral = 0.;
  double m_error = 0.;
};

END_VISP_NAMESPACE
#endif
