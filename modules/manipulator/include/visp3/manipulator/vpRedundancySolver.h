/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpRedundancySolver.h
 * \brief Joint velocities from a twist: weighted inverse, self-motion, singularities and limits.
 */
#ifndef vpRedundancySolver_h
#define vpRedundancySolver_h

#include <visp3/direct_core/vpTwist.h>
#include <visp3/manipulator/vpSelfMotionIndex.h>

#include <array>
#include <cstdint>

BEGIN_VISP_NAMESPACE

//! \ingroup group_manipulator
//! \brief Behaviour when a joint reaches its position or velocity limit.
enum class vpLimitPolicy {
  StopJoints, //!< Only that joint stops; the others take over its share as far as possible. Also at velocity limits.
  ScaleMotion //!< The whole motion is slowed down, at velocity limits as well; the tool stays on its path.
};

/*!
 * \ingroup group_manipulator
 * \brief Parameters of vpRedundancySolver.
 */
struct VISP_EXPORT vpRedundancySpec {
  double period = 0.005; //!< Control period, s, > 0.
  //! Diagonal of W in (3.23), n numbers > 0; empty: identity. Heavy joints move less; 1/vmax^2 spares slow joints
  //! before they are at their limits, but distorts #singularRegion, which is in weighted coordinates.
  vpJointVector weights;
  //! Length L of the task scaling diag(I, L I), m/rad, > 0: makes rad and m comparable, which W cannot do.
  double taskLength = 0.4;
  double singularRegion = 0.05; //!< s0, m/rad, > 0: singular values of the scaled Jacobian below it are damped.
  double damping = 0.03;        //!< Damping at a singular value of 0, m/rad, > 0.
  double escapeSpeed = 0.2;     //!< Norm of the joint velocity that escapes a singularity, rad/s, >= 0; 0: none.
  double escapeDemand = 0.02;   //!< Task velocity in the lost direction that gives the full escape speed, m/s, > 0.
  double selfMotion = 0.5;    //!< |eta| of k0 as corrected, 0..1: norm of the self-motion relative to the task motion.
  double minSelfMotion = 0.2; //!< v_min of k0, rad/s, >= 0: the self-motion at rest is eta times this.
  //! Smallest denominator of k0, > 0: below it self-motion is proportional to the projected gradient, without chatter.
  double softGradient = 0.05;
  //! Fraction of the joint acceleration limits available to changes of the self-motion, 0..1; the task gets the rest.
  //! 0: the self-motion changes at once, and the whole motion is then slowed to the limits.
  double selfAcceleration = 0.;
  double positionMargin = 0.;                       //!< Distance kept from the position limits, rad or m, >= 0.
  vpLimitPolicy policy = vpLimitPolicy::StopJoints; //!< Behaviour at position limits.

  /*!
   * \throw vpException (badValue) naming the field that is out of range for this arm, and its value.
   */
  void validate(const vpArmModel &model) const;
};

/*!
 * \ingroup group_manipulator
 * \brief A task of lower priority: J q' = velocity with up to 6 rows, fulfilled as far as higher priorities allow.
 */
struct VISP_EXPORT vpArmTask {
  int rows = 0;    //!< Number of rows, 0..6.
  vpArmJacobian J; //!< Jacobian, of which the first #rows rows are used; n columns.
  Eigen::Matrix<double, 6, 1> velocity = Eigen::Matrix<double, 6, 1>::Zero(); //!< Desired task velocity, m/s or rad/s.

  //! Task: velocity of the origin of joint or follower \e joint of the chain (0..l-1) in the base, m/s. After
  //! vpArmKinematics::forward().
  [[nodiscard]] static vpArmTask pointVelocity(const vpArmModel &model, const vpArmData &data, int joint,
                                               const Eigen::Vector3d &velocity) noexcept;
};

//! \ingroup group_manipulator
//! \brief Maximum number of tasks below the main one.
constexpr int vpMaxArmTasks = 3;
//! \ingroup group_manipulator
//! \brief Maximum number of indices.
constexpr int vpMaxArmIndices = 8;

/*!
 * \ingroup group_manipulator
 * \brief Input of a step.
 */
struct VISP_EXPORT vpRedundancyInput {
  vpTwist twist;                         //!< Desired twist, m/s and rad/s.
  vpArmFrame frame = vpArmFrame::Camera; //!< Axes and reference point of the twist.
  std::array<bool, 6> free{}; //!< Free (uncontrolled) components of the twist; {5}: rotation about the optical axis.
  std::array<vpArmTask, vpMaxArmTasks> tasks; //!< Tasks below the main one, in order of priority.
  int taskCount = 0;                          //!< Number of tasks used.
  std::array<vpSelfMotionIndex, vpMaxArmIndices>
      indices;                 //!< The remaining redundancy maximizes the sum of gain times index.
  int indexCount = 0;          //!< Number of indices used.
  double selfMotionShare = 1.; //!< Factor on the self-motion, 0..1.
  vpJointVector previous;      //!< Velocities of the last period, rad/s or m/s; n numbers.
};

//! \ingroup group_manipulator
//! \brief How the output differs from the request; the most severe applies.
enum class vpRedundancyStatus {
  Exact,           //!< As requested: error at most 1e-6 of the request (of 1 mm/s for slower ones), in scaled units.
  Accelerating,    //!< Approaching the requested velocity (or its share by Scaled) at an acceleration limit.
  Scaled,          //!< Slower than requested, on the same path, due to velocity (ScaleMotion: or position) limits.
  Damped,          //!< Near a singularity: slower than requested in the direction being lost.
  Escaping,        //!< Near a singularity: self-motion leads out of it.
  JointsStopped,   //!< Joints are held at their position limits; the others do not compensate fully.
  BlockedByLimits, //!< The requested motion is impossible due to position limits.
  BlockedBySingularity, //!< The requested motion is impossible in this configuration (stretched out).
  //! The arm has too few joints for the commanded axes, in any configuration: vpRedundancyOutput::unreachableAxes.
  AxisUnreachable,
  InvalidInput //!< An input was not finite, beyond vpArmLargest or of the wrong size; the arm brakes.
};

/*!
 * \ingroup group_manipulator
 * \brief Output of a step: velocities to command, and how they differ from the request.
 */
struct VISP_EXPORT vpRedundancyOutput {
  vpJointVector velocity;   //!< Joint velocities within all limits, rad/s or m/s.
  vpJointVector selfMotion; //!< Part of #velocity due to the indices, before the acceleration limit.
  vpRedundancyStatus status = vpRedundancyStatus::Exact; //!< How the velocity differs from the request.
  double taskShare = 1.;          //!< Fraction of the requested twist achieved, 0..1 (1 if the request is zero).
  double smallestSingular = 0.;   //!< Smallest singular value of the scaled task, m/rad; lower bound if regular.
  unsigned int stoppedJoints = 0; //!< Bit i: joint i is held at a position limit.
  double scale = 1.;              //!< Factor due to velocity (ScaleMotion: and position) limits, 0..1.
  //! Bit i: joint i is held at its velocity limit, and the others take over its share of the task.
  unsigned int saturatedJoints = 0;
  /*!
   * Axes of the twist that the arm has too few joints for, as bits: without them the commanded axes are independent
   * in this configuration, see vpAxesInWords(); they may differ in another one. A rotation is preferred to a
   * translation. 0 if the arm has enough joints.
   */
  unsigned int unreachableAxes = 0;

  //! Status as a readable sentence; for AxisUnreachable it names the first of these axes.
  [[nodiscard]] const char *message() const noexcept;
};

/*!
 * \class vpRedundancySolver
 * \ingroup group_manipulator
 * \brief Redundancy resolution by gradient projection within limits, thesis (3.22)-(3.24), corrected. step() does not
 * allocate, throw, lock or print.
 *
 * In weighted coordinates y = W^1/2 q' the inverse (3.23) is orthogonal and the self-motion is N W^-1 grad m (N grad m,
 * as printed, descends in 17 % of random cases for W != I). k0 of (3.24) is eta max(|J^# x'|, v_min) /
 * max(|N v|, eps), which is never 0/0 and does not stop at rest. Singular values below s0 are damped one by one; if
 * the lost direction is requested, second derivatives of the kinematics give the self-motion that regains it, and if
 * there is none, the status reports it. Position limits become velocity bounds from which the joint can always brake;
 * acceleration limits blend the motion with the last one. With vpLimitPolicy::StopJoints a joint at its velocity limit
 * leaves its share to the others as long as this makes the task faster (saturation in the null space, at most four
 * joints); beyond that velocity limits scale the motion. None of this bends a path from rest. Saturation is for the
 * main task: where tasks of lower priority exceed a velocity limit the whole motion is scaled.
 *
 * \code
 * const vpRedundancySolver solver(arm);
 * vpRedundancyInput input;
 * input.twist = vpTwist(0.1, 0., 0., 0., 0., 0.);    // of the camera, m/s and rad/s
 * input.free = {false, false, false, false, false, true}; // it may turn about its optical axis
 * input.indices[0] = vpSelfMotionIndex::jointLimits();
 * input.indexCount = 1;
 * input.previous = vpJointVector::Zero(arm.size());
 * vpArmData data;
 * vpRedundancyOutput output;
 * for (int i = 0; i < 200; ++i) { // every 5 ms
 *   vpArmKinematics::update(arm, q, data);
 *   solver.step(data, input, output);
 *   input.previous = output.velocity;
 *   q += solver.spec().period * output.velocity; // to the drives
 * }
 * std::cout << 100. * output.taskShare << " % of the twist: " << output.message() << std::endl;
 * \endcode
 */
class VISP_EXPORT vpRedundancySolver
{
public:
  /*!
   * \param model : The arm; referenced, must outlive the solver.
   * \param spec : Parameters; copied.
   * \throw vpException (badValue) naming a joint without velocity or acceleration limit, or a field that is out of
   * range.
   */
  explicit vpRedundancySolver(const vpArmModel &model, const vpRedundancySpec &spec = {});

  /*!
   * One control period.
   * \param data : Current configuration, after vpArmKinematics::jacobian().
   * \param input : The request.
   * \param output : Receives the joint velocities and how they differ from the request.
   */
  void step(const vpArmData &data, const vpRedundancyInput &input, vpRedundancyOutput &output) const noexcept;

  //! The parameters.
  [[nodiscard]] const vpRedundancySpec &spec() const noexcept { return m_spec; }

private:
  void brake(const vpRedundancyInput &input, vpRedundancyOutput &output) const noexcept;

  const vpArmModel *m_model;
  vpRedundancySpec m_spec;
  Eigen::Matrix<double, vpArmMaxJoints, 1> m_scale; // W^-1/2, zero beyond the last joint
  std::array<std::uint8_t, 192> m_lacking;          // see vpLackingAxes()
};

END_VISP_NAMESPACE
#endif
