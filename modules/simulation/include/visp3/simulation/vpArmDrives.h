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

BEGIN_VISP_NAMESPACE

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
  vpJointVector kd; //!< Velocity gains of (3.19), likewise.

  //! \throw vpException (badValue) naming the field that is out of range, and its value.
  void validate(const vpArmModel &model) const;
};

/*!
 * \class vpArmDrives
 * \ingroup group_simulation
 * \brief Joint control of section 8.2.3: the commanded velocity is integrated to a desired configuration, PD control
 * with gravity compensation (3.19) gives torques within the limits, and vpArmPlant moves.
 *
 * Gains missing in the arm model are derived from the largest diagonal of M over random configurations: natural
 * frequency at least 12 rad/s, position error by Coulomb friction at most 1/300 rad (as with AMOR's gains), critically
 * damped.
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

  //! Encoder positions, rad or m: the true configuration unless there is noise.
  [[nodiscard]] const vpJointVector &measured() const noexcept { return m_input.q; }
  //! True configuration, rad or m.
  [[nodiscard]] const vpJointVector &q() const noexcept { return m_plant ? m_plant->q() : m_wanted; }
  //! True velocities, rad/s or m/s.
  [[nodiscard]] const vpJointVector &velocity() const noexcept { return m_plant ? m_plant->velocity() : m_command; }
  //! Desired configuration: the integral of the commands, rad or m.
  [[nodiscard]] const vpJointVector &wanted() const noexcept { return m_wanted; }
  //! Last command, rad/s or m/s.
  [[nodiscard]] const vpJointVector &command() const noexcept { return m_command; }
  //! Torques of the last cycle, Nm or N; zero when ideal.
  [[nodiscard]] const vpJointVector &torque() const noexcept { return m_output.torque; }
  //! Bit i: joint i was at its torque limit in the last move().
  [[nodiscard]] unsigned int saturated() const noexcept { return m_saturated; }
  //! Parameters of the drives.
  [[nodiscard]] const vpArmDriveSpec &spec() const noexcept { return m_spec; }

private:
  bool cycle(double dt) noexcept;
  void measure() noexcept;

  const vpArmModel *m_model;
  vpArmDriveSpec m_spec;
  std::optional<vpArmPlant> m_plant;
  std::optional<vpArmDynamics> m_dynamics;
  std::optional<vpJointPositionControl> m_control;
  std::optional<vpJointVelocityEstimator> m_estimator;
  std::mt19937_64 m_random;
  std::normal_distribution<double> m_noise;
  vpJointVector m_wanted, m_command;
  vpJointPositionControl::Input m_input;
  vpJointPositionControl::Output m_output;
  unsigned int m_saturated = 0;
};

END_VISP_NAMESPACE
#endif
