/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpArmDrives.h
 * \brief The drives of an arm: they follow commanded joint velocities, exactly or with torques on a vpArmPlant.
 */
#ifndef vpArmDrives_h
#define vpArmDrives_h

#include <visp3/manipulator/vpJointPositionControl.h>
#include <visp3/manipulator/vpJointVelocityEstimator.h>
#include <visp3/simulation/vpArmPlant.h>

#include <optional>
#include <random>
#include <string>

BEGIN_VISP_NAMESPACE

//! \ingroup group_simulation
//! \brief What a commanded velocity is added to, to get the desired configuration of a drive.
enum class vpDriveReference {
  Integrated, //!< The last desired configuration: open loop. At rest friction leaves an error of at most F_c / K_p.
  Measured    //!< The measured configuration, (3.18): friction suppresses small velocities, see vpArmDrives.
};

//! \ingroup group_simulation
//! \brief Parameters of vpArmDrives.
struct VISP_EXPORT vpArmDriveSpec {
  bool ideal = false;              //!< True: the arm follows its commands exactly; the fields below are unused.
  double period = 0.001;           //!< Longest cycle of joint control and plant, s, 1e-6 to 1.
  double frictionScale = 1.;       //!< Friction of the plant relative to the arm model, >= 0.
  bool compensateFriction = false; //!< The controller adds the friction of the arm model (not scaled).
  double encoderNoise = 0.; //!< Noise sigma of measured positions, rad or m, >= 0; if > 0 velocities are estimated.
  unsigned int seed = 1;    //!< Seed of the noise.
  //! Position gains of (3.19), n numbers; empty: those of the arm model, else derived from its inertia.
  vpJointVector kp;
  vpJointVector kd;                                          //!< Velocity gains of (3.19), likewise.
  vpDriveReference reference = vpDriveReference::Integrated; //!< Unused when ideal.

  //! \throw vpException (badValue) naming the field that is out of range, and its value.
  void validate(const vpArmModel &model) const;
};

/*!
 * \ingroup group_simulation
 * \brief A joint whose drive could not do what a command takes, and the torque that is missing.
 */
struct VISP_EXPORT vpJointShortfall {
  int joint = -1;     //!< Index of the joint, from 0; -1: none.
  double needed = 0.; //!< Torque that the command takes, see vpArmDrives::needed(), Nm or N.
  double given = 0.;  //!< Torque of the drive, Nm or N.

  //! Torque that is missing, Nm or N: |needed| minus the given torque in its direction; 0 if it suffices.
  [[nodiscard]] double missing() const noexcept;
  //! The torques in words: "the motion takes 26 Nm, the drive gives 12 Nm of at most 12 Nm, 14 Nm are missing".
  [[nodiscard]] std::string message(const vpArmModel &model) const;
};

/*!
 * \class vpArmDrives
 * \ingroup group_simulation
 * \brief Joint control of section 8.2.3: the commanded velocity is integrated to a desired configuration, PD control
 * with gravity compensation (3.19) gives torques within the limits, and vpArmPlant moves.
 *
 * vpDriveReference::Integrated: the error of a joint that sticks grows until the torque moves it, if the torque limit
 * allows. vpDriveReference::Measured: each move() with a velocity v other than zero starts from the measured
 * configuration, as in (3.18) with the duration T of move(). Against friction there is then a torque of at most
 * K_p v T + K_d v: a resting joint with Coulomb friction F_c does not move unless |v| > F_c / (K_p T + K_d), with exact
 * gravity compensation. A move() with zero velocity of all joints holds the last desired configuration.
 *
 * Gains missing in the arm model are derived from the diagonal of M, largest over random configurations: natural
 * frequency at least 12 rad/s, position error at most 1/300 rad by Coulomb friction, and |v| / (200/s) by viscous
 * friction at a velocity v (as with AMOR's gains), critically damped. They are reduced where the cycle or the
 * estimation of velocities would make them unstable with the least inertia that a joint sees; errors by friction are
 * larger then.
 *
 * \code
 * vpArmDrives drives(arm);
 * drives.reset(arm.home());
 * for (int i = 0; i < 100; ++i) {
 *   if (!drives.move(vpJointVector::Constant(arm.size(), 0.1), 0.005)) { // rad/s, s
 *     std::cerr << "a number is out of range" << std::endl;
 *   }
 * }
 * std::cout << "off by " << (drives.q() - drives.wanted()).norm() << " rad"
 *           << (drives.saturated() != 0 ? ", at a torque limit" : "") << std::endl;
 * \endcode
 */
class VISP_EXPORT vpArmDrives
{
public:
  static constexpr double longestMove = 100.; //!< Longest duration of a move(), s; bounds its computing time.

  /*!
   * \param model : The arm; referenced, must outlive the drives.
   * \param spec : Parameters; copied.
   * \throw vpException (badValue), see vpArmDriveSpec::validate(); naming the first link without mass unless ideal.
   */
  explicit vpArmDrives(const vpArmModel &model, const vpArmDriveSpec &spec = {});

  //! Resets to rest at \e q. \throw vpException (badValue) if \e q does not fit the arm.
  void reset(const vpJointVector &q);
  /*!
   * Simulates motion for a duration; no allocation, no exception.
   * \param velocity : Commanded velocities, rad/s or m/s. Wrong size, not finite or beyond vpArmLargest counts as zero.
   * \param duration : s, > 0 and at most #longestMove, otherwise no time passes; split into equal cycles of at most
   * vpArmDriveSpec::period.
   * \return False if an argument was not used as given.
   */
  bool move(const vpJointVector &velocity, double duration) noexcept;

  //! Sets the desired configuration to the measured one, at rest.
  void holdHere() noexcept;
  //! Changes vpArmDriveSpec::reference, from the next move() on.
  void setReference(vpDriveReference reference) noexcept { m_spec.reference = reference; }

  //! Encoder positions, rad or m: the true configuration unless there is noise.
  [[nodiscard]] const vpJointVector &measured() const noexcept { return m_input.q; }
  //! True configuration, rad or m.
  [[nodiscard]] const vpJointVector &q() const noexcept { return m_plant ? m_plant->q() : m_wanted; }
  //! True velocities, rad/s or m/s.
  [[nodiscard]] const vpJointVector &velocity() const noexcept { return m_plant ? m_plant->velocity() : m_command; }
  //! Desired configuration, rad or m: the integral of the commands, see vpDriveReference.
  [[nodiscard]] const vpJointVector &wanted() const noexcept { return m_wanted; }
  //! Last command, rad/s or m/s.
  [[nodiscard]] const vpJointVector &command() const noexcept { return m_command; }
  //! Torques of the last cycle, Nm or N; zero when ideal.
  [[nodiscard]] const vpJointVector &torque() const noexcept { return m_output.torque; }
  /*!
   * Torques that the last command takes, Nm or N: M(q) a + C(q, v) v + g(q) + friction of the plant at v, where v is
   * the command and a its change over the duration of the last move(). Where they exceed the torque limit the joint
   * cannot follow. Zero when ideal, before the first move(), and if they cannot be computed.
   */
  [[nodiscard]] const vpJointVector &needed() const noexcept { return m_needed; }
  //! Bit i: joint i was at its torque limit in the last move().
  [[nodiscard]] unsigned int saturated() const noexcept { return m_saturated; }
  //! Parameters of the drives.
  [[nodiscard]] const vpArmDriveSpec &spec() const noexcept { return m_spec; }

private:
  bool cycle(double dt) noexcept;
  void measure() noexcept;
  void updateNeeded(const vpJointVector &before, double duration) noexcept;

  const vpArmModel *m_model;
  vpArmDriveSpec m_spec;
  std::optional<vpArmPlant> m_plant;
  std::optional<vpArmDynamics> m_dynamics;
  std::optional<vpJointPositionControl> m_control;
  std::optional<vpJointVelocityEstimator> m_estimator;
  std::mt19937_64 m_random;
  std::normal_distribution<double> m_noise;
  vpJointVector m_wanted, m_command, m_needed;
  vpJointPositionControl::Input m_input;
  vpJointPositionControl::Output m_output;
  unsigned int m_saturated = 0;
};

END_VISP_NAMESPACE
#endif
