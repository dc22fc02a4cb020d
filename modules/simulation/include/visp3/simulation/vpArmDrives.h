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
//! \brief How good an arm's drives are.
struct VISP_EXPORT vpArmDriveSpec {
  bool ideal = false;              //!< True: the arm is where it is commanded to be; nothing below counts.
  double period = 0.001;           //!< Longest cycle of joint control and plant, s, 1e-6 to 1.
  double frictionScale = 1.;       //!< Of the plant, relative to the arm's file, >= 0.
  bool compensateFriction = false; //!< The control adds the friction of the arm's file (not scaled).
  double encoderNoise =
      0.; //!< Standard deviation of measured positions, rad or m, >= 0; with it velocities are estimated.
  unsigned int seed = 1; //!< Of the noise.
  //! Gain on the position in (3.19), n numbers; empty: those of the arm's file, made from its inertia where it has none.
  vpJointVector kp;
  vpJointVector kd; //!< The same on the velocity.

  //! \throw vpException (badValue) naming the field that is out of range, and its value.
  void validate(const vpArmModel &model) const;
};

/*!
 * \class vpArmDrives
 * \ingroup group_simulation
 * \brief Joint control of section 8.2.3: the commanded velocity is integrated to a wanted configuration, PD with
 * gravity (3.19) makes torques of the difference within the torque limits, and vpArmPlant moves.
 *
 * Gains that the arm's file does not give are made from the largest diagonal of M over random configurations: so stiff
 * that the natural frequency is at least 12 rad/s and Coulomb friction holds back 1/300 rad at most (as AMOR's gains
 * do), critically damped.
 */
class VISP_EXPORT vpArmDrives
{
public:
  static constexpr double longestMove = 100.; //!< s; the work of a move() is bounded by it.

  /*!
   * \param model : Is referred to; must outlive the drives.
   * \param spec : How good the drives are.
   * \throw vpException (badValue), see vpArmDriveSpec::validate(); naming the first link without mass unless ideal.
   */
  explicit vpArmDrives(const vpArmModel &model, const vpArmDriveSpec &spec = {});

  //! At rest in \e q. \throw vpException (badValue) when it does not fit the arm.
  void reset(const vpJointVector &q);
  /*!
   * Let time pass; no allocation, no exception.
   * \param velocity : Commanded, rad/s or m/s. One of a wrong size, not finite or beyond vpArmLargest counts as zero.
   * \param duration : s, > 0 and at most #longestMove, otherwise no time passes; done in equal cycles of at most
   * vpArmDriveSpec::period.
   * \return False when something was not taken as it was given.
   */
  bool move(const vpJointVector &velocity, double duration) noexcept;

  //! Want to be where the encoders are, at rest.
  void holdHere() noexcept;

  //! What the encoders show, rad or m: the true configuration unless there is noise.
  [[nodiscard]] const vpJointVector &measured() const noexcept { return m_input.q; }
  //! True configuration, rad or m.
  [[nodiscard]] const vpJointVector &q() const noexcept { return m_plant ? m_plant->q() : m_wanted; }
  //! True velocities, rad/s or m/s.
  [[nodiscard]] const vpJointVector &velocity() const noexcept { return m_plant ? m_plant->velocity() : m_command; }
  //! Wanted configuration: the integral of the commands, rad or m.
  [[nodiscard]] const vpJointVector &wanted() const noexcept { return m_wanted; }
  //! Last command, rad/s or m/s.
  [[nodiscard]] const vpJointVector &command() const noexcept { return m_command; }
  //! Torques of the last cycle, Nm or N; zero when ideal.
  [[nodiscard]] const vpJointVector &torque() const noexcept { return m_output.torque; }
  //! Bit i: joint i was at its torque limit in the last move().
  [[nodiscard]] unsigned int saturated() const noexcept { return m_saturated; }
  //! How good they are.
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
