/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpArmPlant.h
 * \brief An arm that torques move: inertia, gravity, friction that sticks, end stops.
 */
#ifndef vpArmPlant_h
#define vpArmPlant_h

#include <visp3/manipulator/vpArmDynamics.h>
#include <visp3/manipulator/vpJointFriction.h>

BEGIN_VISP_NAMESPACE

/*!
 * \class vpArmPlant
 * \ingroup group_simulation
 * \brief M(q) q'' + C(q, q') q' + g(q) + friction + stops = tau in steps of about 1 ms.
 *
 * Dynamics by vpArmDynamics (Orocos KDL). Viscous friction is taken implicitly. Coulomb friction and end stops are
 * impulses that at most bring a joint to rest (projected Gauss-Seidel): a joint whose load is below its friction does
 * not move at all, where an explicit sgn would chatter. A joint that runs into its position limit stops without
 * bouncing.
 */
class VISP_EXPORT vpArmPlant
{
public:
  static constexpr double longestStep = 1.; //!< s.

  /*!
   * \param model : Is referred to; must outlive the plant. Friction, masses and limits are its.
   * \param frictionScale : Factor on viscous and Coulomb friction, >= 0.
   * \throw vpException (badValue) naming the first link without mass, or frictionScale and its value.
   */
  explicit vpArmPlant(const vpArmModel &model, double frictionScale = 1.);

  //! At rest in \e q, n numbers.
  void reset(const vpJointVector &q);
  /*!
   * One step; no allocation, no exception.
   * \param torque : Of the drives, Nm or N, n numbers.
   * \param dt : s, 1e-9 to #longestStep; 1 ms is what it is made for.
   * \return False when \e dt is out of its range, a torque is missing, not finite or beyond vpArmLargest, or the motion would
   * be; nothing has moved then.
   */
  bool step(const vpJointVector &torque, double dt) noexcept;

  //! Configuration, rad or m.
  [[nodiscard]] const vpJointVector &q() const noexcept { return m_q; }
  //! Velocities, rad/s or m/s; exactly 0 for a joint that sticks.
  [[nodiscard]] const vpJointVector &velocity() const noexcept { return m_velocity; }
  //! Friction that it has.
  [[nodiscard]] const vpJointFriction &friction() const noexcept { return m_friction; }

private:
  bool move(const vpJointVector &torque, double dt) noexcept;
  void holdBack(const vpJointMatrix &compliance, double dt) noexcept;

  const vpArmModel *m_model;
  vpArmDynamics m_dynamics;
  vpJointFriction m_friction;
  vpJointVector m_q, m_velocity, m_impulse, m_stop;
};

END_VISP_NAMESPACE
#endif
