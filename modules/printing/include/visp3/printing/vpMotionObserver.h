/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpMotionObserver.h
 * \brief State of a driven axis now, from positions that are late and commands that are known.
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
  double disturbanceNoise = 1e-6; //!< Density with which the friction error walks, F^2/T, > 0.
  //! How often friction changes at once, by about sigmaDisturbance: changes per measurement, in [0, 1]; 0: never.
  double changeRate = 0.;
  double gate = 6.;               //!< Measurements off by more standard deviations are not used, > 0, may be infinite.
  double sigmaPosition = 1.;      //!< Standard deviation at the start, L, > 0.
  double sigmaVelocity = 1e-3;    //!< At the start, L/T, > 0; small: at rest.
  double sigmaDisturbance = 0.03; //!< Of the friction error at the start and of its sudden changes, F, > 0.
  //! Measurements and commands farther ahead of the newest measurement are refused, and nobody extrapolates farther, T, in
  //! (0, 1000]: the work of a step is bounded by it.
  double maxGap = 1000.;

  //! \throw vpException (badValue) naming the field that is out of range, and its value.
  void validate() const;
};

//! \ingroup group_printing
//! \brief State of the axis at an instant.
struct VISP_EXPORT vpObservedMotion {
  bool asAsked = true;       //!< False: the time asked for is out of reach; #time tells which state this is.
  double time = 0.;          //!< T.
  double position = 0.;      //!< L.
  double velocity = 0.;      //!< L/T.
  double acceleration = 0.;  //!< L/T^2.
  double force = 0.;         //!< That acts, behind the lag, F.
  double disturbance = 0.;   //!< Friction beyond the model, against positive motion, F.
  double sigmaPosition = 0.; //!< L.
  double sigmaVelocity = 0.; //!< L/T.
};

/*!
 * \class vpMotionObserver
 * \ingroup group_printing
 * \brief Kalman filter on m v' = f - F(v) - d, lag f' = u - f, d' = noise, with the model's friction F.
 *
 * The belief stands at the time of the newest measurement, a camera's delay ago. From there at() integrates the model to
 * any later time with the commands that were given since: to the present, or to when the next command will act. So the
 * delay of the camera costs accuracy but no phase. Friction that the model does not know ends up in the disturbance d.
 *
 * Friction that changes at once is found late by a filter that is quiet enough for a coarse sensor. With a changeRate, each
 * of the last measurements carries the hypothesis that it changed there; what the innovations since say for each of them,
 * with the rate and the size as priors, moves the state at once, and for good when the odds are 50 to 1 (generalised
 * likelihood ratio with priors, after \cite Willsky76). This takes any error of the model for a change that the sensor can
 * resolve: leave it out with a sensor that sees the errors of the model.
 *
 * The standard deviations are those of the spec and of the measurements, carried along: they hold as far as these do, and
 * the friction model. The gate keeps out what contradicts them; it is no test of the fit.
 *
 * The third measurement in a row beyond the gate is taken to be right and the belief to be wrong.
 *
 * Times more than maxGap ahead are refused, for one broken time stamp would make all that follow come too late. After a
 * longer gap, or when the clock was set anew, reset() to the present. The observer starts at time 0: reset() first when the
 * clock does not.
 *
 * Functions of the loop do not allocate, throw, lock or print.
 */
class VISP_EXPORT vpMotionObserver
{
public:
  static constexpr int capacity = 64; //!< Commands remembered; steps since the oldest measurement that is awaited.

  //! \throw vpException (badValue) naming the field of \e spec that is out of range, and its value.
  explicit vpMotionObserver(const vpMotionObserverSpec &spec = vpMotionObserverSpec());

  /*!
   * A command given at a time, held until the next one.
   * \param time : T; not before the last command. \param force : F.
   * \return False when it was ignored: too late, implausible (see the class), not finite or beyond vpPrintingLargest.
   */
  bool command(double time, double force) noexcept;
  /*!
   * A position that was true at \e time.
   * \param time : T; not before the last measurement. \param position : L. \param sigma : Its standard deviation, L, > 0.
   * \return Used, Outlier, TooLate, ImplausibleTime or Invalid.
   */
  vpMotionReadingResult measure(double time, double position, double sigma) noexcept;
  /*!
   * The state at a time. Later than the last command: as if it were held; before the last measurement, or of NaN: there; more
   * than maxGap behind it: the state that far ahead.
   */
  [[nodiscard]] vpObservedMotion at(double time) const noexcept;
  //! Back to rest at a place and time. Numbers that are not finite or beyond vpPrintingLargest change nothing.
  void reset(double time = 0., double position = 0.) noexcept;
  //! As given.
  [[nodiscard]] const vpMotionObserverSpec &spec() const { return m_spec; }

private:
  //! \brief Belief at a time: position, velocity, force, disturbance.
  struct Belief {
    double time = 0.;
    Eigen::Vector4d x = Eigen::Vector4d::Zero();
    Eigen::Matrix4d P = Eigen::Matrix4d::Zero();
  };
  struct Command {
    double time = 0., force = 0.;
  };
  //! \brief Friction that changed at an instant, and what speaks for it.
  struct Change {
    Eigen::Vector4d response = Eigen::Vector4d::Zero(); // of the belief's error to a change by 1
    double information = 0., score = 0.;                // of the innovations since, about the size
    double evidence = 0.;                               // odds of this change to none
  };
  static constexpr int window = 24; // measurements that a change may be back
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
  Eigen::Vector4d m_lean = Eigen::Vector4d::Zero(); // what changes that are not certain yet add to the belief's mean
  int m_refused = 0;                                // measurements beyond the gate in a row
};

END_VISP_NAMESPACE
#endif
