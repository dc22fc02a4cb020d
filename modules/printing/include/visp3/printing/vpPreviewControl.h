/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPreviewControl.h
 * \brief Control with preview: each command is computed for the time at which it acts.
 */
#ifndef vpPreviewControl_h
#define vpPreviewControl_h

#include <visp3/printing/vpFrictionModel.h>
#include <visp3/trajectory/vpMotionFamily.h>

#include <limits>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_printing
 * \brief Parameters of a vpPreviewControl: length L (px), time T (frame), force F.
 */
struct VISP_EXPORT vpPreviewControlSpec {
  vpFrictionModel model;     //!< Mass and friction of the axis.
  double positionGain = 0.;  //!< Force per position error, F/L, >= 0. 0: velocity control only.
  double velocityGain = 0.3; //!< Force per velocity error, F T/L, >= 0.
  double lag = 0.3;          //!< Time constant from command to force, T, >= 0.
  double delay = 0.;         //!< Dead time of the command, T, >= 0.
  double period = 1.;        //!< Hold time of a command, T, > 0.
  double maxForce = std::numeric_limits<double>::infinity(); //!< |command| <= maxForce, F, > 0.

  //! \throw vpException (badValue) naming the field that is out of range, and its value.
  void validate() const;
};

/*!
 * \class vpPreviewControl
 * \ingroup group_printing
 * \brief Feedforward (7.26) and state feedback, both computed for the time at which the command acts.
 *
 * A command given now acts from now + delay for one period, through the lag: its feedforward is that of the reference
 * in the middle of this time, actsAt(), with the lag inverted, u = F + lag F'. Its feedback uses the state predicted
 * for feedbackAt(), when it begins to act. Stateless: the same input gives the same output.
 *
 * \code
 * vpMotionObserver observer;  // gets what the camera sees and what is commanded
 * vpPrintReference reference; // leads from cell to cell
 * const vpPreviewControl control;
 * const double frame = 10.;
 * const vpObservedMotion motion = observer.at(control.feedbackAt(frame));
 * const vpPreviewControl::Output command =
 *     control.command({reference.at(control.actsAt(frame)), reference.at(control.feedbackAt(frame)), motion.position,
 *                      motion.velocity, motion.disturbance});
 * if (command.valid) { // and not command.saturated
 *   observer.command(frame, command.force);
 *   send(command.force);
 * }
 * \endcode
 */
class VISP_EXPORT vpPreviewControl
{
public:
  //! \brief Input of a step; all values must satisfy vpIsPlausible().
  struct Input {
    vpAxisState reference{};         //!< Position, velocity, acceleration, jerk at actsAt(now).
    vpAxisState referenceFeedback{}; //!< Position, velocity, acceleration, jerk at feedbackAt(now).
    double position = 0.;            //!< Position predicted for feedbackAt(now), L.
    double velocity = 0.;            //!< Velocity predicted for feedbackAt(now), L/T.
    double disturbance = 0.;         //!< Friction beyond the model, F.
  };
  //! \brief Output of a step.
  struct Output {
    double force = 0.;      //!< Command, F, within maxForce.
    bool saturated = false; //!< The command was limited.
    bool valid = false; //!< False: a number of the input is not finite or beyond vpPrintingLargest; the command is 0.
  };

  //! \throw vpException (badValue) naming the field of \e spec that is out of range, and its value.
  explicit vpPreviewControl(const vpPreviewControlSpec &spec = vpPreviewControlSpec());
  //! Mean time at which a command given at \e now acts.
  [[nodiscard]] double actsAt(double now) const noexcept { return now + m_spec.delay + 0.5 * m_spec.period; }
  //! Time at which it begins to act.
  [[nodiscard]] double feedbackAt(double now) const noexcept { return now + m_spec.delay; }
  //! Compute the command. Does not throw or allocate.
  [[nodiscard]] Output command(const Input &input) const noexcept;
  //! Specification as given.
  [[nodiscard]] const vpPreviewControlSpec &spec() const { return m_spec; }

private:
  vpPreviewControlSpec m_spec;
};

END_VISP_NAMESPACE
#endif
