/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The simulated arm without ViSP's interface and without a clock: one control period after the other.
#ifndef vpSimulatedArmCore_h
#define vpSimulatedArmCore_h

#include <visp3/simulation/vpSimulatedArm.h>

#include <visp3/manipulator/vpArmMotion.h>

BEGIN_VISP_NAMESPACE

class vpSimulatedArmCore
{
public:
  vpSimulatedArmCore(const vpArmModel &arm, const vpSimulatedArmSpec &armSpec);

  //! One control period; no allocation, no exception.
  void tick() noexcept;
  //! A velocity has come that is good until a time, s; motion() says which.
  void commandUntil(double deadline);
  //! Brake and forget what was wrong.
  void stop();
  //! Nothing moves and nothing is asked of it.
  [[nodiscard]] bool atRest() const noexcept;

  [[nodiscard]] vpSimulatedArmState state() const;
  [[nodiscard]] std::string sentence() const;
  [[nodiscard]] double time() const noexcept { return m_periods * m_motion.period(); }
  [[nodiscard]] double period() const noexcept { return m_motion.period(); }
  [[nodiscard]] vpArmMotion &motion() noexcept { return m_motion; }
  [[nodiscard]] const vpArmDrives &drives() const noexcept { return m_drives; }
  [[nodiscard]] vpSimulatedArmStatus status() const noexcept { return m_status; }
  //! Kinematics of the true configuration.
  [[nodiscard]] vpArmData kinematics() const;
  //! Kinematics of what the encoders show.
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
  int m_lost = -1; // joint that did not follow
};

END_VISP_NAMESPACE
#endif
