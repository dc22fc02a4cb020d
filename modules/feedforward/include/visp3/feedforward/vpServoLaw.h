/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpServoLaw.h
 * \brief Common interface of all servo laws.
 */
#ifndef vpServoLaw_h
#define vpServoLaw_h

#include <visp3/direct_core/vpField.h>
#include <visp3/feedforward/vpServoCommand.h>
#include <visp3/feedforward/vpServoMeasurement.h>
#include <visp3/feedforward/vpServoMotionCheck.h>
#include <visp3/feedforward/vpServoMotionLimits.h>

#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_feedforward
 * \brief Gains of the laws. One set for all laws, so that comparisons tune none individually.
 */
struct VISP_EXPORT vpServoGains {
  double lambda = 1.;         //!< Gain on the translation and on image errors, 1/s, > 0, <= 1000000.
  double rotation = 1.;       //!< Factor on the gain of the rotation, beside the law's own, > 0, <= 1000000.
  double kappa = 1.;          //!< Weight of the image term of `ff-sum`, 0..1000000.
  double saturation = 0.5;    //!< Bound c of c tanh(D/c) in `ff-sum`, rad, > 0, <= 1000000.
  double integral = 1.;       //!< Gain on the integral of the rotation error in `ff-lookat-pi`, 1/s^2, 0..1000000.
  double integralLimit = 0.5; //!< Largest angular velocity contributed by the integral, rad/s, > 0, <= 1000000.
  double replanPeriod = 0.;   //!< Replanning period of `dtg` and `ff-dtg` (0: at events only), s, 0..1000000.

  //! The gains with their ranges and units.
  [[nodiscard]] static const vpFields<vpServoGains> &fields();
  //! \throw vpException (badValue) naming the gain and its value when one is out of its range.
  void validate() const;
};

/*!
 * \class vpServoLaw
 * \ingroup group_feedforward
 * \brief A servo law: measurement and goal in, camera twist out.
 *
 * Set-up (create(), setGoal()) validates and throws. The step step() never throws and never allocates for the laws of
 * this module; invalid input gives a status and zero twist. The `ff-*` laws implement FF-PBVS, feedforward
 * position-based visual servoing.
 *
 * \code
 * auto law = vpServoLaw::create("ff-lookat-pi", vpServoGains());
 * law->setGoal(goal);
 * vpServoCommand command;
 * do {
 *   command = law->step(measurement, dt);
 *   robot.setVelocity(vpRobot::CAMERA_FRAME, command.v.toColVector());
 * } while (vpIsWorking(command.status) && !closeEnough(measurement));
 * if (!vpIsWorking(command.status)) {
 *   std::cerr << vpMessage(command.status) << std::endl;
 * }
 * robot.setRobotState(vpRobot::STATE_STOP);
 * \endcode
 */
class VISP_EXPORT vpServoLaw
{
public:
  virtual ~vpServoLaw() = default;
  vpServoLaw(const vpServoLaw &) = delete;
  vpServoLaw &operator=(const vpServoLaw &) = delete;

  //! Makes a law from valid gains and limits. May throw; may be called by several threads at once.
  using Maker =
      std::function<std::unique_ptr<vpServoLaw>(const vpServoGains &gains, const vpServoMotionLimits &motion)>;

  /*!
   * Make a law by name.
   * \param id : One of ids().
   * \param gains : Gains; validated here.
   * \param motion : Limits of laws that plan their motion; validated here, ignored by the other laws.
   * \throw vpException (badValue) naming the unknown id and listing the known ones, or naming the bad gain or limit; and
   * whatever the maker of the law throws.
   */
  [[nodiscard]] static std::unique_ptr<vpServoLaw> create(const std::string &id, const vpServoGains &gains = {},
                                                          const vpServoMotionLimits &motion = {});
  //! All ids known to create(), in the order used by reports: our own, then those added.
  [[nodiscard]] static std::vector<std::string> ids();
  //! What a law does, one sentence. \throw vpException (badValue) naming the unknown id and listing the known ones.
  [[nodiscard]] static std::string sentence(const std::string &id);
  /*!
   * Adds a law of your own, for create(), vpServoController and all programs. Any thread; cannot be undone, so a library
   * that holds the maker must stay loaded.
   * \param id : A letter and up to 63 more letters, digits, `-` or `_`; create() gives it to the law.
   * \param sentence : What the law does, one printable line.
   * \param maker : Returns a new law each time.
   * \throw vpException (badValue) naming the id, when it is malformed or used already, or the sentence or maker is empty.
   */
  static void add(const std::string &id, const std::string &sentence, Maker maker);

  /*!
   * Set or change the goal, also every cycle. The integral of `ff-lookat-pi` is kept, except on axes whose direction of
   * rotation changes: there friction has reversed.
   * \throw vpException (badValue) when the goal has no points, or one that is not finite or has no positive depth.
   */
  void setGoal(const vpServoGoal &goal);
  //! Forget the goal and all state (integrals).
  void reset();
  //! The id of the law.
  [[nodiscard]] const std::string &id() const { return m_id; }
  //! Current goal.
  [[nodiscard]] const vpServoGoal &goal() const { return m_goal; }

  /*!
   * Effective gain on the rotation error, 1/s, including all factors. It gives the orientation that a law aims at from
   * its output: R exp(w / rotationGain()), see vpServoController.
   */
  [[nodiscard]] virtual double rotationGain() const noexcept;

  /*!
   * Notify the law that its last twist was not executed as given (limited, filtered, or the target was lost), so that
   * integrals do not wind up. Called by vpServoController.
   */
  virtual void notifyInterrupted() noexcept {}
  /*!
   * Tell the law what came of its last step(). Called by vpServoController, and by step() itself with its own twist;
   * the last call before the next step() counts.
   * \param commanded : Twist that was sent to the robot, after filters and limits: a law that plans continues from it.
   * \param moved : Camera twist that the robot executes, by its encoders, m/s and rad/s; the same where it is not known.
   */
  virtual void notifyExecuted([[maybe_unused]] const vpTwist &commanded, [[maybe_unused]] const vpTwist &moved) noexcept
  {}
  //! True when the twists of this law, one after the other, stay within its vpServoMotionLimits: no shaper is needed.
  [[nodiscard]] virtual bool plansMotion() const noexcept { return false; }
  //! Time until the planned arrival, s; 0 when arrived; NaN for a law without a plan, or while there is none.
  [[nodiscard]] virtual double timeToArrival() const noexcept { return std::numeric_limits<double>::quiet_NaN(); }
  //! Number of plans followed since the law was made; 0 for a law without plans.
  [[nodiscard]] virtual int plans() const noexcept { return 0; }
  /*!
   * Speed limits of the plans from now on, as a factor of vpServoMotionLimits: accelerations times its square, jerks its cube,
   * so that motions from rest are the same, slower. A motion that is too fast for a new factor brakes and is replanned. Ignored
   * by laws that do not plan.
   * \param factor : (0, 1]; below 0.01, and NaN, count as 0.01.
   */
  virtual void setSpeedFactor([[maybe_unused]] double factor) noexcept {}
  //! The robot's own limits, asked about each plan; referenced, nullptr: none. Ignored by laws that do not plan.
  virtual void setMotionCheck(vpServoMotionCheck * /*check*/) noexcept {}

  /*!
   * One cycle.
   * \param measurement : Current measurement. An invalid one gives zero twist and vpServoStatus::Holding; recovery from
   *   a lost target is up to vpTargetLossRecovery. Numbers beyond 1e6 (m; x and y of points) count as not finite.
   * \param dt : Time since the last call, s, > 0; used by integrals only, which use at most 0.5 s per call.
   */
  [[nodiscard]] vpServoCommand step(const vpServoMeasurement &measurement, double dt) noexcept;

protected:
  //! \param id : Id of the law. \param gains : Validated here.
  //! \param rotationFactor : Fixed factor of this law in addition to vpServoGains::rotation; 2 for the ids with
  //!   `-rot2`.
  vpServoLaw(std::string id, const vpServoGains &gains, double rotationFactor = 1.);
  //! Called by setGoal() after validation: precompute data that depend on the goal.
  virtual void goalChanged() {}
  //! Called by reset(): forget internal state.
  virtual void stateReset() {}
  //! Called first in each step(), whatever the measurement: the last twist was executed for \e dt, s.
  virtual void elapsed(double /*dt*/) noexcept {}
  //! The law itself. The measurement is valid, finite, and has the goal's number of points. Must not allocate; an
  //! exception ends the process by std::terminate().
  virtual vpServoCommand compute(const vpServoMeasurement &measurement, double dt) noexcept = 0;

  std::string m_id;        //!< The id of the law.
  vpServoGains m_gains;    //!< Validated gains.
  double m_rotationFactor; //!< Fixed factor of this law on the rotation gain.
  vpServoGoal m_goal;      //!< Current goal; valid if #m_hasGoal.
  bool m_hasGoal = false;  //!< True when a goal is set.
};

END_VISP_NAMESPACE
#endif
