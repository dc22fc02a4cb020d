/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpArmPlant.h
 * \brief Torque-driven arm: inertia, gravity, stiction, end stops.
 */
#ifndef vpArmPlant_h
#define vpArmPlant_h

#include <visp3/manipulator/vpArmDynamics.h>
#include <visp3/manipulator/vpJointFriction.h>

BEGIN_VISP_NAMESPACE

/*!
 * \class vpArmPlant
 * \ingroup group_simulation
 * \brief Simulates M(q) q'' + C(q, q') q' + g(q) + friction + stops = tau in steps of about 1 ms.
 *
 * Dynamics by vpArmDynamics. Viscous friction is integrated implicitly. Coulomb friction and end stops are
 * impulses that at most bring a joint to rest (projected Gauss-Seidel): a joint whose load is below its friction does
 * not move at all, where an explicit sgn would chatter. A joint that reaches its position limit stops without
 * bouncing.
 *
 * \code
 * vpArmPlant plant(arm);
 * plant.reset(arm.home());
 * vpArmDynamics dynamics(arm);
 * vpJointVector torque; // Nm
 * for (int i = 0; i < 1000; ++i) {
 *   if (!dynamics.gravity(plant.q(), torque) || !plant.step(torque, 0.001)) { // s
 *     std::cerr << "a number is out of range" << std::endl;
 *   }
 * }
 * std::cout << plant.velocity().transpose() << " rad/s" << std::endl; // 0: held by gravity compensation and friction
 * \endcode
 */
class VISP_EXPORT vpArmPlant
{
public:
  static constexpr double longestStep = 1.; //!< Longest step, s.

  /*!
   * \param model : The arm; referenced, must outlive the plant. Defines friction, masses and limits.
   * \param frictionScale : Factor on viscous and Coulomb friction, >= 0.
   * \throw vpException (badValue) naming the first link without mass, or frictionScale and its value.
   */
  explicit vpArmPlant(const vpArmModel &model, double frictionScale = 1.);

  //! Resets to rest at \e q, n numbers, rad or m.
  void reset(const vpJointVector &q);
  /*!
   * One step; no allocation, no exception.
   * \param torque : Torques of the drives, Nm or N, n numbers.
   * \param dt : Step, s, 1e-9 to #longestStep; designed for 1 ms.
   * \return False if \e dt is out of range, or a torque or the resulting motion is not finite or beyond vpArmLargest,
   * or a torque is missing; nothing has moved then.
   */
  bool step(const vpJointVector &torque, double dt) noexcept;

  //! Configuration, rad or m.
  [[nodiscard]] const vpJointVector &q() const noexcept { return m_q; }
  //! Velocities, rad/s or m/s; exactly 0 for a joint that sticks.
  [[nodiscard]] const vpJointVector &velocity() const noexcept { return m_velocity; }
  //! Friction of the plant.
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
