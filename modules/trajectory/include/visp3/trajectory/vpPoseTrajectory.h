/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPoseTrajectory.h
 * \brief Direct trajectory generation for a camera pose: goal pose in, camera twist out.
 */
#ifndef vpPoseTrajectory_h
#define vpPoseTrajectory_h

#include <visp3/core/vpHomogeneousMatrix.h>
#include <visp3/direct_core/vpTwist.h>
#include <visp3/trajectory/vpGoalJitter.h>
#include <visp3/trajectory/vpTrajectoryPlanner.h>

#include <Eigen/Core>

BEGIN_VISP_NAMESPACE

//! \ingroup group_trajectory
//! \brief How the rotation is planned. Both follow the geodesic if the current angular velocity lies on it (as at
//! rest).
enum class vpRotationPath {
  Geodesic,      //!< Limits bound the norm of the rotation vector's rates. The position path is straight, too.
  RotationVector //!< Limits bound each component of the rotation vector's rates.
};

//! \ingroup group_trajectory
//! \brief Limits and choices of vpPoseTrajectory.
struct VISP_EXPORT vpPoseTrajectorySpec {
  double linearVelocity = 0.25;    //!< Bound on |v_c|, m/s, > 0.
  double linearAcceleration = 0.5; //!< Bound on the norm of the acceleration of the camera's origin, m/s^2, > 0.
  double linearJerk = std::numeric_limits<double>::infinity(); //!< Jerk limit per axis, m/s^3, > 0.
  double angularVelocity = 0.5;                                //!< Bound on |w_c|, rad/s, > 0.
  /*!
   * Bound on the second derivative of the rotation vector, rad/s^2, > 0. On a geodesic this is the angular
   * acceleration; while the rotation axis changes, the angular acceleration may be larger by up to 0.32 |w_c|^2.
   */
  double angularAcceleration = 1.;
  double angularJerk = std::numeric_limits<double>::infinity(); //!< Jerk limit per component, rad/s^3, > 0.
  vpRotationPath rotation = vpRotationPath::Geodesic;           //!< How the rotation is planned.
  vpReplanPolicy policy = vpReplanPolicy::EventMinTime; //!< Replanning policy; KeepArrival as in vpTrajectoryFollower.
  double arrivalTime = 0.;     //!< FixedArrival: arrival time, s from reset() or from the previous arrival, > 0.
  double minimumDuration = 0.; //!< Minimum duration of a plan, s, >= 0; the minimum of KeepArrival.
  bool cruise = false;         //!< Allow ramp, constant velocity, ramp on long moves.

  /*!
   * \throw vpException (badValue) naming the number and its value when one is out of its range.
   */
  void validate() const;
};

/*!
 * \ingroup group_trajectory
 * \brief Pose and motion of the camera; f is the fixed reference frame of the caller.
 */
struct VISP_EXPORT vpCameraState {
  Eigen::Matrix3d fRc = Eigen::Matrix3d::Identity(); //!< Rotation of the camera in f.
  Eigen::Vector3d ftc = Eigen::Vector3d::Zero();     //!< Position of the camera in f, m.
  vpTwist v; //!< Velocity v_c of the camera in the current camera frame, m/s and rad/s.
  vpTwist a; //!< Acceleration of the camera's origin and angular acceleration, in the current camera frame.

  //! Write fMc into \e pose. Never allocates.
  void copyTo(vpHomogeneousMatrix &pose) const;
};

/*!
 * \class vpPoseTrajectory
 * \ingroup group_trajectory
 * \brief Moves a camera from any moving state to a goal pose within limits, on SE(3).
 *
 * Implements DTG, direct trajectory generation.
 *
 * Position: three synchronised axes. Rotation: R(t) = R_0 exp(e(t)) with R_0 the rotation when the plan began, so e
 * starts at zero, where e' = w_c and e'' = w_c' exactly, and the transition to a new goal is smooth for every angular
 * velocity. The twist is v_c = R^T p', w_c = J_r(e) e', valid up to an angle of pi. As |J_r| <= 1, a bound on |e'|
 * bounds |w_c|. Position and rotation arrive together.
 *
 * \code
 * vpPoseTrajectory trajectory;
 * trajectory.reset(vpHomogeneousMatrix(0.3, 0., 0.5, 3.1, 0., 0.));   // fMc, m and rad
 * trajectory.setGoal(vpHomogeneousMatrix(0.5, 0.2, 0.4, 2.8, 0., 0.)); // fMcd; at every image, if it moves
 * vpTrajectoryStatus status = trajectory.step(dt);
 * for (; vpIsWorking(status.result); status = trajectory.step(dt)) {
 *   robot.setVelocity(vpRobot::CAMERA_FRAME, trajectory.state().v.toColVector());
 * }
 * robot.setVelocity(vpRobot::CAMERA_FRAME, vpColVector(6)); // at the goal, or at an error
 * std::cout << status.message() << std::endl;
 * \endcode
 */
class VISP_EXPORT vpPoseTrajectory
{
public:
  /*!
   * Starts at rest at the identity.
   * \throw vpException (badValue) when an option is out of its range.
   */
  explicit vpPoseTrajectory(const vpPoseTrajectorySpec &spec = {});

  /*!
   * Change limits and choices; triggers a replan.
   * \throw vpException (badValue) when an option is out of its range.
   */
  void setSpec(const vpPoseTrajectorySpec &spec);
  /*!
   * Restart at this pose; it is also the goal until setGoal() is called.
   * \param fMc : Pose of the camera in the reference frame.
   * \param v, a : Velocity and acceleration in the current camera frame, see vpCameraState.
   * \return InvalidInput (and nothing changes) when a number is not finite or the rotation is invalid.
   */
  vpTrajectoryStatus reset(const vpHomogeneousMatrix &fMc, const vpTwist &v = {}, const vpTwist &a = {}) noexcept;
  /*!
   * Set or change the goal, at any cycle; triggers a replan when it differs. Never allocates.
   * \param fMcd : Pose of the camera at the goal in the reference frame.
   * \param twist : Velocity of the goal, in the goal's camera frame, assumed constant.
   * \return InvalidInput (and the old goal stays) when a number is not finite or the rotation is invalid.
   */
  vpTrajectoryStatus setGoal(const vpHomogeneousMatrix &fMcd, const vpTwist &twist = {}) noexcept;
  //! One cycle of \e dt seconds, at most 1e9. Never throws, never allocates.
  vpTrajectoryStatus step(double dt) noexcept;

  [[nodiscard]] const vpCameraState &state() const { return m_state; } //!< Commanded state.
  //! Commanded state at \e t, s from the start of the current plan.
  [[nodiscard]] vpCameraState at(double t) const noexcept;
  [[nodiscard]] double duration() const { return m_plan.duration(); } //!< Duration of the current plan, s.
  [[nodiscard]] double remaining() const
  {
    return m_clock < duration() ? duration() - m_clock : 0.;
  } //!< Time to arrival, s.
  //! Current plan: axes 0-2 position (m), 3-5 rotation vector (rad) from the rotation at its start.
  [[nodiscard]] const vpTrajectoryPlan &plan() const { return m_plan; }

private:
  void fillLimits() noexcept;
  void goalAt(double ahead, Eigen::Matrix3d &R, Eigen::Vector3d &t) const noexcept;
  void noteGoal(const Eigen::Matrix3d &R, const Eigen::Vector3d &t) noexcept;
  [[nodiscard]] double meet(double floor, Eigen::Matrix3d &R, Eigen::Vector3d &t) noexcept;
  void replan() noexcept;

  vpPoseTrajectorySpec m_spec;
  vpTrajectoryProblem m_problem;
  vpTrajectoryPlanner m_planner;
  vpTrajectoryPlan m_plan;
  vpGoalJitter m_jitter;
  vpTrajectoryStatus m_planStatus;
  Eigen::Matrix3d m_fR0 = Eigen::Matrix3d::Identity(); // Origin of the rotation vector
  Eigen::Matrix3d m_fRd = Eigen::Matrix3d::Identity();
  Eigen::Vector3d m_ftd = Eigen::Vector3d::Zero();
  vpTwist m_goalTwist;
  vpCameraState m_state;
  double m_clock = 0.;
  double m_goalAge = 0.;      // Time since the goal was given, s
  double m_goalInterval = 0.; // Time between the last two goals, until the next plan, s
  int m_goals = 0;            // Number of goals since reset(), at most 2
  double m_arrival = -1.;     // FixedArrival: on m_clock; negative: counts from the next plan
  bool m_event = false;
};

END_VISP_NAMESPACE
#endif
