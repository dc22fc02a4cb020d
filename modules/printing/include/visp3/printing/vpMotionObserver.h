/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpMotionObserver.h
 * \brief Current state of a driven axis from delayed positions and known commands.
 */
#ifndef vpMotionObserver_h
#define vpMotionObserver_h

#include <visp3/printing/vpFrictionModel.h>
#include <visp3/printing/vpMotionReadingResult.h>

#include <Eigen/Core>

#include <array>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_printing
 * \brief Parameters of a vpMotionObserver: length L (px), time T (frame), force F.
 */
struct VISP_EXPORT vpMotionObserverSpec {
  vpFrictionModel model;          //!< Mass and friction of the axis.
  double lag = 0.3;               //!< Time constant from command to force, T, >= 0.
  double delay = 0.;              //!< Dead time of the command, T, in [0, 16].
  double velocityNoise = 1e-5;    //!< Density of the unmodelled acceleration, L^2/T^3, >= 0.
  double disturbanceNoise = 1e-6; //!< Random-walk density of the friction error, F^2/T, > 0.
  //! Rate of sudden friction changes, by about sigmaDisturbance: changes per measurement, in [0, 1]; 0: never.
  double changeRate = 0.;
  double gate = 6.;               //!< Measurements off by more standard deviations are rejected, > 0, may be infinite.
  double sigmaPosition = 1.;      //!< Initial standard deviation of the position, L, > 0.
  double sigmaVelocity = 1e-3;    //!< Initial sigma of the velocity, L/T, > 0; small: at rest.
  double sigmaDisturbance = 0.03; //!< Initial sigma of the friction error, and of its sudden changes, F, > 0.
  //! Maximum lead of measurements, commands and extrapolations over the newest measurement, T, in (0, 1000]; bounds the
  //! work of a step.
  double maxGap = 1000.;

  //! \throw vpException (badValue) naming the field that is out of range, and its value.
  void validate() const;
};

//! \ingroup group_printing
//! \brief State of the axis at an instant.
struct VISP_EXPORT vpObservedMotion {
  bool asAsked = true;       //!< False: the requested time is out of range; #time is the time of this state.
  double time = 0.;          //!< Time of the state, T.
  double position = 0.;      //!< Position, L.
  double velocity = 0.;      //!< Velocity, L/T.
  double acceleration = 0.;  //!< Acceleration, L/T^2.
  double force = 0.;         //!< Acting force, after the lag, F.
  double disturbance = 0.;   //!< Friction beyond the model, positive against positive motion, F.
  double sigmaPosition = 0.; //!< Standard deviation of the position, L.
  double sigmaVelocity = 0.; //!< Standard deviation of the velocity, L/T.
};

/*!
 * \class vpMotionObserver
 * \ingroup group_printing
 * \brief Kalman filter on m v' = f - F(v) - d, lag f' = u - f, d' = noise, with the model's friction F.
 *
 * The filter state is at the time of the newest measurement, one camera delay ago. From there at() integrates the model
 * to any later time with the commands given since: to the present, or to when the next command will act. So the
 * camera's delay costs accuracy but no phase. Friction unknown to the model goes into the disturbance d.
 *
 * A filter with little noise, as a coarse sensor needs, is slow to follow sudden friction changes. With a changeRate,
 * each of the last measurements carries the hypothesis that the friction changed there; the evidence of the later
 * innovations, with rate and size as priors, corrects the state at once, and permanently when the odds are 50 to 1
 * (generalised likelihood ratio with priors, after \cite Willsky76). Any model error that the sensor can resolve is
 * taken for a change: use changeRate 0 with a sensor that resolves the model errors.
 *
 * The standard deviations are those of the spec and of the measurements, carried along: they hold as far as these do, and
 * the friction model. The gate keeps out what contradicts them; it is no test of the fit.
 *
 * The third measurement in a row beyond the gate is taken to be right and the belief to be wrong.
 *
 * Times more than maxGap ahead are rejected, because one wrong time stamp would make all later ones too late. After a
 * longer gap, or when the clock was reset, call reset() with the current time. The observer starts at time 0: call
 * reset() first when the clock does not.
 *
 * The functions of the control loop do not allocate, throw, lock or print.
 *
 * \code
 * vpMotionObserverSpec spec;
 * spec.model = {1., 0.02, 0.08, 0.12, 0.3}; // mass 1, friction, px and frames
 * vpMotionObserver observer(spec);
 * for (double frame = 2.; frame < 50.; ++frame) {
 *   const double position = encoders()(0); // as the camera saw it 1.28 frames ago, px
 *   if (observer.measure(frame - 1.28, position, 0.01) != vpMotionReadingResult::Used) {
 *     std::cerr << "position " << position << " is not used" << std::endl;
 *   }
 *   const vpObservedMotion present = observer.at(frame);
 *   const double force = 0.3 * (5. - present.velocity); // to 5 px/frame
 *   observer.command(frame, force);
 *   send(force);
 * }
 * \endcode
 */
class VISP_EXPORT vpMotionObserver
{
public:
  static constexpr int capacity = 64; //!< Commands stored; steps since the oldest pending measurement.

  //! \throw vpException (badValue) naming the field of \e spec that is out of range, and its value.
  explicit vpMotionObserver(const vpMotionObserverSpec &spec = vpMotionObserverSpec());

  /*!
   * Add a command given at a time and held until the next one.
   * \param time : T; not before the last command. \param force : F.
   * \return False when it was ignored: too late, implausible (see the class), not finite or beyond vpPrintingLargest.
   */
  bool command(double time, double force) noexcept;
  /*!
   * Add a position measured at \e time.
   * \param time : T; not before the last measurement. \param position : L. \param sigma : Standard deviation of the
   *   position, L, > 0.
   * \return Used, Outlier, TooLate, ImplausibleTime or Invalid.
   */
  vpMotionReadingResult measure(double time, double position, double sigma) noexcept;
  /*!
   * The state at a time. After the last command: with that command held; before the last measurement, or for NaN: the
   * state at that measurement; more than maxGap after it: the state that far ahead.
   */
  [[nodiscard]] vpObservedMotion at(double time) const noexcept;
  //! Reset to rest at a position and time. Ignored for numbers that are not finite or beyond vpPrintingLargest.
  void reset(double time = 0., double position = 0.) noexcept;
  //! Specification as given.
  [[nodiscard]] const vpMotionObserverSpec &spec() const { return m_spec; }

private:
  //! \brief Estimate at a time: position, velocity, force, disturbance.
  struct Belief {
    double time = 0.;
    Eigen::Vector4d x = Eigen::Vector4d::Zero();
    Eigen::Matrix4d P = Eigen::Matrix4d::Zero();
  };
  struct Command {
    double time = 0., force = 0.;
  };
  //! \brief Hypothesis of a friction change at an instant, and its evidence.
  struct Change {
    Eigen::Vector4d response = Eigen::Vector4d::Zero(); // response of the estimation error to a unit change
    double information = 0., score = 0.;                // about the size, from the innovations since
    double evidence = 0.;                               // odds of this change against none
  };
  static constexpr int window = 24; // maximum age of a change, in measurements
  [[nodiscard]] bool isSound() const noexcept;
  [[nodiscard]] vpMotionReadingResult take(double time, double position, double sigma) noexcept;
  void advance(Belief &belief, double time, Eigen::Matrix4d *transition = nullptr) const noexcept;
  void part(Belief &belief, double command, double h, Eigen::Matrix4d *transition) const noexcept;
  void lookForChange(double innovation, double S, const Eigen::Vector4d &K) noexcept;
  void takeChange() noexcept;
  [[nodiscard]] double commandAt(double time, double &until) const noexcept;
  [[nodiscard]] double acceleration(const Eigen::Vector4d &x) const noexcept;

  vpMotionObserverSpec m_spec;
  Belief m_belief;
  std::array<Command, capacity> m_commands; // in order of time, oldest first
  int m_count = 0;
  std::array<Change, window> m_changes; // oldest first
  int m_changeCount = 0;
  Eigen::Vector4d m_lean = Eigen::Vector4d::Zero(); // contribution of uncertain changes to the mean estimate
  int m_refused = 0;                                // consecutive measurements beyond the gate
};

END_VISP_NAMESPACE
#endif
