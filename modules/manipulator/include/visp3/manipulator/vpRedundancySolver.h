/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpRedundancySolver.h
 * \brief From a twist to joint velocities: weighted inverse, self-motion, singularities and limits.
 */
#ifndef vpRedundancySolver_h
#define vpRedundancySolver_h

#include <visp3/direct_core/vpTwist.h>
#include <visp3/manipulator/vpSelfMotionIndex.h>

#include <array>

BEGIN_VISP_NAMESPACE

//! \ingroup group_manipulator
//! \brief What happens when a joint comes to its position limit.
enum class vpLimitPolicy {
  StopJoints, //!< Only that joint is stopped; the others do its share as far as they can.
  ScaleMotion //!< The whole motion is slowed down, the tool stays on its path.
};

/*!
 * \ingroup group_manipulator
 * \brief Parameters of vpRedundancySolver.
 */
struct VISP_EXPORT vpRedundancySpec {
  double period = 0.005; //!< Of the calls, s, > 0.
  vpJointVector weights; //!< W of (3.23), diagonal, n numbers > 0; empty: the identity. Heavy joints move less.
  //! L of the task scaling diag(I, L I), m/rad, > 0: makes rad and m comparable. W cannot do that.
  double taskLength = 0.4;
  double singularRegion = 0.05; //!< s0, m/rad, > 0: damping acts on singular values of the scaled Jacobian below it.
  double damping = 0.03;        //!< Damping at a singular value of 0, m/rad, > 0.
  double escapeSpeed = 0.2;     //!< Length of the joint velocity that leads out of a singularity, rad/s, >= 0; 0: none.
  double escapeDemand = 0.02;   //!< Task velocity in the lost direction that asks for the full escape speed, m/s, > 0.
  double selfMotion = 0.5; //!< |eta| of k0 as corrected, 0..1: length of the self-motion relative to the task's motion.
  double minSelfMotion = 0.2; //!< v_min of k0, rad/s, >= 0: the self-motion at rest is eta times this.
  //! Smallest denominator of k0, > 0: projected gradients below it move in proportion, without chatter.
  double softGradient = 0.05;
  //! Share of the joints' acceleration limits with which the self-motion changes, 0..1, so that the task finds the rest
  //! for itself; 0: the self-motion changes at once, and the whole motion is slowed to its limits then.
  double selfAcceleration = 0.;
  double positionMargin = 0.;                       //!< Kept from the position limits, rad or m, >= 0.
  vpLimitPolicy policy = vpLimitPolicy::StopJoints; //!< At position limits.

  /*!
   * \throw vpException (badValue) naming the field that is out of range for this arm, and its value.
   */
  void validate(const vpArmModel &model) const;
};

/*!
 * \ingroup group_manipulator
 * \brief A task below the main one: J q' = velocity with up to 6 rows, as far as the tasks above it leave room.
 */
struct VISP_EXPORT vpArmTask {
  int rows = 0;                                                               //!< 0..6.
  vpArmJacobian J;                                                            //!< Its first rows count; n columns.
  Eigen::Matrix<double, 6, 1> velocity = Eigen::Matrix<double, 6, 1>::Zero(); //!< m/s or rad/s.

  //! Velocity of the origin of joint \e joint (0..n-1) in the base, m/s. After vpArmKinematics::forward().
  [[nodiscard]] static vpArmTask pointVelocity(const vpArmModel &model, const vpArmData &data, int joint,
                                               const Eigen::Vector3d &velocity) noexcept;
};

//! \ingroup group_manipulator
//! \brief Most tasks below the main one.
constexpr int vpMaxArmTasks = 3;
//! \ingroup group_manipulator
//! \brief Most indices at a time.
constexpr int vpMaxArmIndices = 8;

/*!
 * \ingroup group_manipulator
 * \brief What is wanted now.
 */
struct VISP_EXPORT vpRedundancyInput {
  vpTwist twist;                         //!< Wanted velocity.
  vpArmFrame frame = vpArmFrame::Camera; //!< Its frame and point.
  std::array<bool, 6> free{}; //!< Components of the twist that do not matter; {5} is the turn about the optical axis.
  std::array<vpArmTask, vpMaxArmTasks> tasks; //!< Below the main task, in order of priority.
  int taskCount = 0;                          //!< How many of them count.
  std::array<vpSelfMotionIndex, vpMaxArmIndices>
      indices;                 //!< What is left of the joints climbs the sum of gain times index.
  int indexCount = 0;          //!< How many of them count.
  double selfMotionShare = 1.; //!< Factor on the self-motion, 0..1.
  vpJointVector previous;      //!< Velocities of the last period; n numbers.
};

//! \ingroup group_manipulator
//! \brief How the wish and the answer differ; the gravest holds.
enum class vpRedundancyStatus {
  Exact,           //!< As wanted: off by a millionth of the wish (of 1 mm/s for slower ones) in scaled units at most.
  Accelerating,    //!< On the way to what is wanted (or to as much of it as Scaled gives), at an acceleration limit.
  Scaled,          //!< Slower than wanted, on the same path, because of a velocity (ScaleMotion: or position) limit.
  Damped,          //!< Near a singularity: slower than wanted in the direction that is getting lost.
  Escaping,        //!< Near a singularity: self-motion leads out of it.
  JointsStopped,   //!< Joints are held at their position limits; the others do not make up for all of it.
  BlockedByLimits, //!< The wanted motion is impossible because of position limits.
  BlockedBySingularity, //!< The wanted motion is impossible for the arm in this pose (it is stretched out).
  InvalidInput          //!< Something was not finite, beyond vpArmLargest or of a wrong size; the arm brakes.
};

/*!
 * \ingroup group_manipulator
 * \brief Velocities to command, and what became of the wish.
 */
struct VISP_EXPORT vpRedundancyOutput {
  vpJointVector velocity;   //!< rad/s or m/s; within all limits.
  vpJointVector selfMotion; //!< Part of it that the indices wanted, before the acceleration limit.
  vpRedundancyStatus status = vpRedundancyStatus::Exact; //!< How it differs from the wish.
  double taskShare = 1.;          //!< Part of the wanted twist that is done, 0..1 (1 when none is wanted).
  double smallestSingular = 0.;   //!< Of the scaled task, m/rad; a lower bound outside the singular region.
  unsigned int stoppedJoints = 0; //!< Bit i: joint i is held at a position limit.
  double scale = 1.;              //!< Factor because of velocity (ScaleMotion: and position) limits, 0..1.

  //! The status as a sentence for a person.
  [[nodiscard]] const char *sentence() const noexcept;
};

/*!
 * \class vpRedundancySolver
 * \ingroup group_manipulator
 * \brief Gradient projection within limits, thesis (3.22)-(3.24), corrected; step() neither allocates nor throws, locks
 * or prints.
 *
 * In weighted coordinates y = W^1/2 q' the inverse (3.23) is orthogonal and the self-motion is N W^-1 grad m (with N
 * grad m, as printed, it descends in 17 % of random cases for W != I). k0 of (3.24) is eta max(|J^# x'|, v_min) /
 * max(|N v|, eps), which is 0/0 nowhere and does not stop at rest. Singular values below s0 are damped one by one; when
 * the lost direction is wanted, second derivatives of the kinematics tell which self-motion gains it back, and if none
 * does, the status says so. Position limits become velocity bounds from which the joint can always brake; velocity
 * limits scale the motion, acceleration limits blend it with the last one, so that neither bends the path from rest.
 */
class VISP_EXPORT vpRedundancySolver
{
public:
  /*!
   * \param model : Is referred to; must outlive the solver.
   * \param spec : Parameters; copied.
   * \throw vpException (badValue) naming a joint without velocity or acceleration limit, or a field that is out of
   * range.
   */
  explicit vpRedundancySolver(const vpArmModel &model, const vpRedundancySpec &spec = {});

  /*!
   * One cycle.
   * \param data : Present configuration, after vpArmKinematics::jacobian().
   * \param input : What is wanted.
   * \param output : Receives the joint velocities and how they differ from the wish.
   */
  void step(const vpArmData &data, const vpRedundancyInput &input, vpRedundancyOutput &output) const noexcept;

  //! The parameters.
  [[nodiscard]] const vpRedundancySpec &spec() const noexcept { return m_spec; }

private:
  void brake(const vpRedundancyInput &input, vpRedundancyOutput &output) const noexcept;

  const vpArmModel *m_model;
  vpRedundancySpec m_spec;
  Eigen::Matrix<double, vpArmMaxJoints, 1> m_scale; // W^-1/2, zero where there is no joint
};

END_VISP_NAMESPACE
#endif
