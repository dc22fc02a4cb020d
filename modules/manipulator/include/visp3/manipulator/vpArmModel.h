/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpArmModel.h
 * \brief Validated, immutable model of an arm.
 */
#ifndef vpArmModel_h
#define vpArmModel_h

#include <visp3/manipulator/vpArmSpec.h>

#include <array>

BEGIN_VISP_NAMESPACE

/*!
 * \class vpArmModel
 * \ingroup group_manipulator
 * \brief Immutable serial arm of 1 to vpArmMaxJoints joints; results of a control cycle are kept in vpArmData.
 *
 * Created from a vpArmSpec, by vpLoadArmJson() or by vpLoadArmUrdf(). Copy it during set-up, not in a control loop.
 */
class VISP_EXPORT vpArmModel
{
public:
  /*!
   * \throw vpException (badValue) naming the arm or its file, the joint, link or body, and the value: no joint or more
   * than vpArmMaxJoints, empty or duplicate names, limits that are not lower < upper, velocity, acceleration or torque
   * limits not > 0, masses not > 0, physically impossible inertias, invalid rotations, bodies, shapes and capsules of a
   * link or body that does not exist or with a size that is not > 0 (of a mesh: 0), a mesh without a file, pairs of
   * bodies that do not exist; positions, links, shapes and capsules beyond 10 km, other numbers beyond vpArmLargest.
   */
  explicit vpArmModel(const vpArmSpec &spec);

  //! Number of joints n.
  [[nodiscard]] int size() const noexcept { return m_size; }
  //! The specification of the arm.
  [[nodiscard]] const vpArmSpec &spec() const noexcept { return m_spec; }
  //! The source file, or the name if there is none.
  [[nodiscard]] const std::string &label() const noexcept
  {
    return m_spec.source.empty() ? m_spec.name : m_spec.source;
  }
  //! True if joint \e i (0..n-1) is prismatic.
  [[nodiscard]] bool isPrismatic(int i) const noexcept { return m_prismatic[static_cast<std::size_t>(i)]; }
  //! True if joint \e i (0..n-1) is continuous: rotates without limits.
  [[nodiscard]] bool isContinuous(int i) const noexcept { return m_continuous[static_cast<std::size_t>(i)]; }
  //! Lower position limits, rad or m; -infinity for a continuous joint.
  [[nodiscard]] const vpJointVector &lower() const noexcept { return m_lower; }
  //! Upper position limits, rad or m; infinity for a continuous joint.
  [[nodiscard]] const vpJointVector &upper() const noexcept { return m_upper; }
  //! Velocity limits, rad/s or m/s; may be infinite.
  [[nodiscard]] const vpJointVector &velocity() const noexcept { return m_velocity; }
  //! Acceleration limits, rad/s^2 or m/s^2; may be infinite.
  [[nodiscard]] const vpJointVector &acceleration() const noexcept { return m_acceleration; }
  //! Torque or force limits, Nm or N; may be infinite.
  [[nodiscard]] const vpJointVector &torque() const noexcept { return m_torque; }
  //! Home configuration, rad or m: that of the spec, else mid-range of each joint (0 for a continuous joint).
  [[nodiscard]] const vpJointVector &home() const noexcept { return m_home; }
  //! True if every link has a mass.
  [[nodiscard]] bool hasMasses() const noexcept { return m_hasMasses; }
  /*!
   * Checks a configuration against the position limits, with the tolerance common to all limits (vpLimit).
   * \param q : Configuration, n numbers, rad or m.
   * \return Empty if within the limits; else the violation, with enough digits to distinguish value and limit: "joint
   * elbow at 3.2, outside its limits -3.1 and 3.1". NaN is never within.
   */
  [[nodiscard]] std::string outsideLimits(const vpJointVector &q) const;
  /*!
   * Requires velocity and acceleration limits of all joints.
   * \param user : Name of the caller, for the message ("the redundancy solver").
   * \throw vpException (badValue) naming the first joint whose velocity or acceleration limit is infinite.
   */
  void requireMotionLimits(const char *user) const;

  //! Offset of joint \e i, added to its coordinate, rad or m.
  [[nodiscard]] double offset(int i) const noexcept { return m_offset[static_cast<std::size_t>(i)]; }
  //! Frame of joint \e i at q_i + offset = 0 in the moving frame of joint i - 1 (of the base for i = 0).
  [[nodiscard]] const vpRigidTransform &step(int i) const noexcept { return m_step[static_cast<std::size_t>(i)]; }
  //! Frame of the last link in the moving frame of the last joint, times the tool.
  [[nodiscard]] const vpRigidTransform &toolStep() const noexcept { return m_toolStep; }

private:
  vpArmSpec m_spec;
  int m_size = 0;
  bool m_hasMasses = false;
  std::array<bool, vpArmMaxJoints> m_prismatic{};
  std::array<bool, vpArmMaxJoints> m_continuous{};
  std::array<double, vpArmMaxJoints> m_offset{};
  std::array<vpRigidTransform, vpArmMaxJoints> m_step;
  vpRigidTransform m_toolStep;
  vpJointVector m_lower, m_upper, m_velocity, m_acceleration, m_torque, m_home;
};

END_VISP_NAMESPACE
#endif
