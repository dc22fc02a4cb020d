/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The simulated arm without ViSP's interface and without a clock: advanced by control periods.
#ifndef vpSimulatedArmCore_h
#define vpSimulatedArmCore_h

#include <visp3/simulation/vpSimulatedArm.h>

#include <visp3/manipulator/vpArmMotion.h>

BEGIN_VISP_NAMESPACE

//! \throw vpRobotException naming the joint that is outside its limits.
void vpRequireInside(const vpArmModel &model, const vpJointVector &q);

class vpSimulatedArmCore
{
public:
  vpSimulatedArmCore(const vpArmModel &arm, const vpSimulatedArmSpec &armSpec);

  //! One control period; no allocation, no exception.
  void tick() noexcept;
  //! Sets the time until which the velocity command of motion() is valid, s.
  void commandUntil(double deadline);
  //! Brakes and clears errors.
  void stop();
  //! True if the joint commands are zero and no motion is requested.
  [[nodiscard]] bool atRest() const noexcept;

  [[nodiscard]] vpSimulatedArmState state() const;
  [[nodiscard]] std::string message() const;
  [[nodiscard]] double time() const noexcept { return m_periods * m_motion.period(); }
  [[nodiscard]] double period() const noexcept { return m_motion.period(); }
  [[nodiscard]] vpArmMotion &motion() noexcept { return m_motion; }
  [[nodiscard]] const vpArmDrives &drives() const noexcept { return m_drives; }
  [[nodiscard]] vpSimulatedArmStatus status() const noexcept { return m_status; }
  //! Kinematics of the true configuration.
  [[nodiscard]] vpArmData kinematics() const;
  //! Kinematics of the measured configuration.
  [[nodiscard]] vpArmData measuredKinematics() const;

  const vpArmModel model;
  const vpSimulatedArmSpec spec;

private:
  void superviseDrives() noexcept;
  [[nodiscard]] vpSimulatedArmStatus judge() const noexcept;

  vpArmMotion m_motion;
  vpArmDrives m_drives;
  long m_periods = 0;
  double m_deadline = 0.; // of the velocity command, s
  vpSimulatedArmStatus m_status = vpSimulatedArmStatus::Stopped;
  vpJointShortfall m_lost; // joint that did not follow
};

END_VISP_NAMESPACE
#endif
