/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#ifndef vpDirectTrajectoryAvoidance_h
#define vpDirectTrajectoryAvoidance_h

#include <visp3/avoidance/vpAvoidanceMethod.h>

#include <memory>
#include <vector>

BEGIN_VISP_NAMESPACE

//! \ingroup group_avoidance
//! \brief How the trajectory is modified.
enum class vpDetourKind {
  PointToPoint, //!< (8.3)-(8.5): a temporary final position beside the obstacle until the goal is accessible.
  Via           //!< Multi-point, (8.6)-(8.9): up to four via positions, the goal is unchanged.
};

/*!
 * \ingroup group_avoidance
 * \brief Parameters of vpDirectTrajectoryAvoidance.
 */
struct VISP_EXPORT vpDirectTrajectoryAvoidanceSpec {
  vpAvoidanceMethodSpec common;            //!< Parameters common to all methods.
  vpDetourKind detour = vpDetourKind::Via; //!< How the trajectory is modified.
  double clearance = 0.015;                //!< Clearance of a new motion beyond the margin, m, >= 0.
  double toolClearance = 0.08;  //!< Clearance of the end effector's origin from the obstacle at a detour, m, >= 0.
  int sides = 8;                //!< Number of directions tried around an obstacle, 2..32.
  int forecasts = 40;           //!< Maximum number of forecasts per look(), >= 1: each takes some 0.3 to 1.5 ms.
  bool keepOrientation = false; //!< Keeps the orientation of the end effector: a camera keeps its viewing direction.
  bool usePosture = true;       //!< Attracts the posture to vpAvoidanceGoal::q, if given.

  //! \throw vpException (badValue) naming the field that is out of range, and its value.
  void validate() const;
};

/*!
 * \class vpDirectTrajectoryAvoidance
 * \ingroup group_avoidance
 * \brief Avoidance at trajectory level by direct trajectory generation (DTG), thesis 8.2.2: each period computes the
 * next state of a minimum-jerk tool motion from the current state; its final or via position is chosen from the
 * obstacle's extent and the free side.
 *
 * look() predicts the motion of the whole arm, with obstacles moving at their velocities. If an obstacle gets closer
 * than the margin, it tries positions beside it, shortest paths first, and recursively for obstacles on the new path,
 * until a motion is predicted to be free; it is entered from the current position, velocity and acceleration. If there
 * is none the tool brakes within its bounds, and every look() tries again.
 *
 * step() follows by the redundancy solver, with self-motion away from obstacles ((8.10)-(8.12), corrected), and under
 * vpStopSupervisor: the arm can always stop in time, slows for approaching obstacles, and may always retreat. If the
 * joints or the supervisor do not allow the planned motion, the next one starts from the allowed state.
 *
 * Norms of the tool's planned velocity and acceleration keep the bounds; joint limits always hold. Only while the
 * supervisor acts (vpAvoidanceOutput::stopping) may the tool brake harder than its bound.
 *
 * \code
 * vpDirectTrajectoryAvoidanceSpec spec;
 * spec.common.maxVelocity = 0.3; // of the tool, m/s
 * spec.keepOrientation = true;
 * vpDirectTrajectoryAvoidance method(scene, spec);
 * method.start(q, vpAvoidanceGoal::at(arm, goal));
 * vpAvoidanceOutput output;
 * for (int cycle = 0; cycle < 4000 && (cycle == 0 || vpIsWorking(output)); ++cycle) { // every 5 ms, up to 20 s
 *   if (cycle % 8 == 0) {
 *     method.look(); // after each image, when the scene has been updated
 *   }
 *   method.step(q, output);
 *   q += spec.common.period * output.velocity; // to the drives
 * }
 * std::cout << vpMessage(output, scene, spec.common.margin) << std::endl; // arrived, or what is in the way
 * \endcode
 */
class VISP_EXPORT vpDirectTrajectoryAvoidance : public vpAvoidanceMethod
{
public:
  /*!
   * \param scene : Must outlive this.
   * \param spec : Parameters; copied.
   * \throw vpException (badValue), see vpDirectTrajectoryAvoidanceSpec::validate(); naming a joint without motion
   * limits.
   */
  explicit vpDirectTrajectoryAvoidance(const vpCollisionScene &scene, const vpDirectTrajectoryAvoidanceSpec &spec = {});
  ~vpDirectTrajectoryAvoidance() override;

  vpAvoidanceStatus start(const vpJointVector &q, const vpAvoidanceGoal &goal) override;
  void setGoal(const vpAvoidanceGoal &goal) noexcept override;
  void look() override;
  void step(const vpJointVector &q, vpAvoidanceOutput &output) noexcept override;

  //! Via positions or, for vpDetourKind::PointToPoint, the temporary final position, m; for display. Empty without a
  //! detour.
  [[nodiscard]] std::vector<Eigen::Vector3d> detour() const;

private:
  class Impl;
  std::unique_ptr<Impl> m_impl;
};

END_VISP_NAMESPACE
#endif
