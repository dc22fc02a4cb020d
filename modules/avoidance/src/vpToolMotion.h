/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Motion of the tool, its execution by the joints, and the prediction of both.
#ifndef vpToolMotion_h
#define vpToolMotion_h

#include <visp3/avoidance/vpCollisionScene.h>
#include <visp3/manipulator/vpRedundancySolver.h>
#include <visp3/trajectory/vpTrajectoryPlanner.h>

#include <array>

BEGIN_VISP_NAMESPACE

//! \brief Position, velocity and acceleration of the tool's origin in the base.
struct vpToolState {
  Eigen::Vector3d x = Eigen::Vector3d::Zero(), v = Eigen::Vector3d::Zero(), a = Eigen::Vector3d::Zero();
};

//! \brief Task of the tool: through vias to a goal, at a speed.
struct vpToolTask {
  static constexpr int maxVias = 4;
  std::array<Eigen::Vector3d, maxVias> vias{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(),
                                            Eigen::Vector3d::Zero()};
  int viaCount = 0;
  Eigen::Vector3d goal = Eigen::Vector3d::Zero(), goalVelocity = Eigen::Vector3d::Zero();
  double speed = 1.; // fraction of the velocity limit

  [[nodiscard]] double length(const Eigen::Vector3d &from) const noexcept;
};

/*!
 * \class vpToolPath
 * \brief Direct trajectory generation (DTG) for the tool's origin: 5th order to the goal or one polynomial per segment
 * through vias, norms of velocity and acceleration bounded (thesis (8.3)-(8.9), corrected). plan() does not allocate.
 */
class vpToolPath
{
public:
  vpToolPath(double maxVelocity, double maxAcceleration);

  //! The fastest motion from \e from. Vias divide the time by the lengths of their segments. False: there is none.
  bool plan(const vpToolState &from, const vpToolTask &task, vpTrajectoryPlan &plan) noexcept;
  //! Brakes on a straight line. False as above.
  bool stop(const vpToolState &from, vpTrajectoryPlan &plan) noexcept;

  //! Stays at a position.
  static void hold(const Eigen::Vector3d &x, vpTrajectoryPlan &plan) noexcept;
  //! State on a plan at a time, s from its start.
  [[nodiscard]] static vpToolState at(const vpTrajectoryPlan &plan, double t) noexcept;
  //! An empty plan with capacity for any of these motions.
  [[nodiscard]] static vpTrajectoryPlan room() { return vpTrajectoryPlan(3, vpToolTask::maxVias); }

private:
  double m_maxVelocity, m_maxAcceleration;
  vpTrajectoryProblem m_problem;
  vpTrajectoryPlanner m_planner;
};

//! \brief Parameters of vpToolMotion.
struct vpToolMotionSpec {
  double period = 0.005;        // control period, s
  double repelRange = 0.12;     // m: nearer obstacles repel the adjacent joints
  double postureGain = 0.3;     // towards the goal's configuration, if given
  double limitGain = 0.1;       // away from position limits
  bool keepOrientation = false; // keeps the end effector's orientation, which takes three degrees of freedom
  double orientationGain = 5.;  // 1/s
};

/*!
 * \class vpToolMotion
 * \brief Joint velocities for a velocity of the tool's origin (thesis (8.1), (8.10)-(8.12), corrected): the remaining
 * redundancy moves the arm's body away from obstacles, to the goal's posture and away from limits.
 *
 * No allocation, no exception in step(). Used with a coarse period for prediction and with a fine one for execution.
 */
class vpToolMotion
{
public:
  static constexpr double jointRest = 1e-2; // rad/s: the norm of joint velocities of an arm that stands

  explicit vpToolMotion(const vpArmModel &model, const vpToolMotionSpec &spec = {});

  /*!
   * \param data : After vpCollisionScene::place(); the Jacobian is added. \param near : Pairs of that configuration.
   * \param velocity : Velocity of the tool's origin, base frame, m/s. \param posture : Preferred posture; may be empty.
   * \param orientation : Orientation to keep, if set in the spec. \param previous : Joint velocities of the last
   * period.
   * \param selfMotion : False: no self-motion.
   */
  void step(vpCollisionData &data, const vpNearPairs &near, const Eigen::Vector3d &velocity,
            const vpJointVector &posture, const Eigen::Matrix3d &orientation, const vpJointVector &previous,
            vpRedundancyOutput &output, bool selfMotion = true) noexcept;

  [[nodiscard]] const vpToolMotionSpec &spec() const noexcept { return m_spec; }

private:
  void repel(const vpCollisionData &data, const vpNearPairs &near) noexcept;

  const vpArmModel *m_model;
  vpToolMotionSpec m_spec;
  vpRedundancySolver m_solver;
  vpRedundancyInput m_input;
};

//! \brief Predicted result of a tool motion.
enum class vpForecastStatus {
  Free,     // followed to its end
  Conflict, // an obstacle comes nearer than the margin
  TooFast,  // joints cannot follow the tool; a slower motion may work
  Stuck     // the arm cannot reach it: limits or singularities
};

//! \brief Prediction of the arm on a tool motion.
struct vpForecast {
  vpForecastStatus status = vpForecastStatus::Stuck;
  double time = 0.;                               // of the conflict, or of the end, s from now
  vpClearance pair;                               // Conflict: the pair
  Eigen::Vector3d tool = Eigen::Vector3d::Zero(); // tool position at that time
  vpJointVector end;                              // configuration at that time
  vpJointVector velocity;                         // joint velocities at that time
};

/*!
 * \class vpToolForecast
 * \brief Predicts the whole arm along a tool motion in coarse steps with the control law that executes it in fine
 * steps, with objects moving at their velocities, and evaluates clearances.
 *
 * Between two evaluations no point of a capsule is farther from an evaluated position than half the motion of its ends,
 * so the margin is enlarged by that. Joints may differ slightly in fine steps: this selects motions, the stop
 * supervisor proves them.
 */
class vpToolForecast
{
public:
  vpToolForecast(const vpCollisionScene &scene, const vpToolMotionSpec &motion, double step = 0.04);

  /*!
   * \param q, velocity : Current state of the joints. \param plan : Plan of the tool. \param clock : Time on it, s.
   * \param posture, orientation : See vpToolMotion. \param margin : m. \param later : Delay of the motion, s, by which
   * objects are extrapolated.
   */
  [[nodiscard]] vpForecast run(const vpJointVector &q, const vpJointVector &velocity, const vpTrajectoryPlan &plan,
                               double clock, const vpJointVector &posture, const Eigen::Matrix3d &orientation,
                               double margin, double later = 0.) noexcept;

private:
  const vpCollisionScene *m_scene;
  double m_step;
  vpToolMotion m_motion;
  vpCollisionData m_data;
  vpNearPairs m_near;
};

END_VISP_NAMESPACE
#endif
