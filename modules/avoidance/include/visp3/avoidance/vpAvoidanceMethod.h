/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#ifndef vpAvoidanceMethod_h
#define vpAvoidanceMethod_h

#include <visp3/avoidance/vpCollisionScene.h>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_avoidance
 * \brief Goal of the arm. Methods that move the tool read #position, methods that move joints read #q.
 */
struct VISP_EXPORT vpAvoidanceGoal {
  vpJointVector q;                                    //!< Configuration, rad or m; empty: only the position is given.
  Eigen::Vector3d position = Eigen::Vector3d::Zero(); //!< Goal of the end effector's origin, base frame, m.
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero(); //!< Velocity of the goal, m/s; 0 for a goal at rest.

  //! Goal from a configuration, with its tool position. \throw vpException (badValue) if it does not fit the arm.
  [[nodiscard]] static vpAvoidanceGoal at(const vpArmModel &model, const vpJointVector &q);
  //! True if #q is empty or of the arm's size and all values are finite and within vpLargestCoordinate, vpLargestLength
  //! and 1000 m/s.
  [[nodiscard]] bool fits(const vpArmModel &model) const noexcept;
};

//! \ingroup group_avoidance
//! \brief Status of the motion.
enum class vpAvoidanceStatus {
  Moving,           //!< Moving directly to the goal.
  Detouring,        //!< Moving around an obstacle, or more slowly behind it.
  Slowed,           //!< Slower than planned: otherwise the arm could not stop in time.
  Waiting,          //!< No free path at present: brakes or stands, and resumes when there is one.
  Arrived,          //!< At the goal, at rest.
  GoalInCollision,  //!< The goal is not free: brakes or stands, and resumes when it is.
  StartInCollision, //!< An obstacle is nearer to the arm than the margin at the start: stands.
  Unreachable,      //!< The arm cannot reach the goal even without obstacles: brakes or stands.
  Unsafe,           //!< Brakes, but may not stop in time because of a new or faster obstacle.
  InvalidInput      //!< A number is not finite or out of range, or a vector has the wrong size; brakes.
};

//! \ingroup group_avoidance
//! \brief Status as a word ("Moving"), for files; static text.
[[nodiscard]] VISP_EXPORT const char *vpToString(vpAvoidanceStatus status);
//! \ingroup group_avoidance
//! \brief Status as a readable sentence; static text.
[[nodiscard]] VISP_EXPORT const char *vpMessage(vpAvoidanceStatus status);

/*!
 * \ingroup group_avoidance
 * \brief Velocities to command for the next period, and their status.
 */
struct VISP_EXPORT vpAvoidanceOutput {
  vpJointVector velocity;                                     //!< Joint velocities, rad/s or m/s.
  vpAvoidanceStatus status = vpAvoidanceStatus::InvalidInput; //!< Status of the motion.
  vpClearance pair;                                           //!< The obstructing pair, if any.
  Eigen::Vector3d wanted = Eigen::Vector3d::Zero();           //!< Planned end-effector position after the period, m.
  bool stopping = false; //!< Protective stop active: the joint limits replace the bounds of the plan.
};

/*!
 * \ingroup group_avoidance
 * \brief Loop condition for step(): true while the arm moves or may still reach its goal (Moving, Detouring, Slowed,
 * Waiting, Unsafe).
 *
 * False after the arm has braked: it has arrived, or an error persists (GoalInCollision, StartInCollision, Unreachable,
 * InvalidInput). To wait until a goal becomes free, continue at GoalInCollision. The two potential fields do not detect
 * unreachable goals: they stay Moving or Waiting forever.
 */
[[nodiscard]] VISP_EXPORT bool vpIsWorking(const vpAvoidanceOutput &output) noexcept;

/*!
 * \ingroup group_avoidance
 * \brief Parameters common to all methods, for comparison on equal terms.
 */
struct VISP_EXPORT vpAvoidanceMethodSpec {
  double period = 0.005;       //!< Period of step(), s, > 0.
  double maxVelocity = 0.5;    //!< Limit for the end effector's origin, m/s, > 0 (thesis 8.3.4).
  double maxAcceleration = 1.; //!< Acceleration limit for the same point, m/s^2, > 0.
  double margin = 0.01;        //!< Clearance to keep, m, >= 0.
  unsigned int seed = 1;       //!< Seed of sampling planners, >= 1.

  //! \throw vpException (badValue) naming the field that is out of range, and its value.
  void validate() const;
};

/*!
 * \class vpAvoidanceMethod
 * \ingroup group_avoidance
 * \brief Common interface of methods that move an arm to a goal among obstacles.
 *
 * A method reads its scene and never changes it. The owner updates the poses and velocities of the objects between
 * the calls:
 * \code
 * vpObjectTracks tracks; // of a vpObstacleDetector, say
 * vpDirectTrajectoryAvoidance method(scene);
 * method.start(q, vpAvoidanceGoal::at(arm, goal));
 * vpAvoidanceOutput output;
 * for (int cycle = 0; cycle == 0 || vpIsWorking(output); ++cycle) { // every 5 ms
 *   if (cycle % 8 == 0) {                                           // after an image
 *     tracks.advance(0.005 * cycle);                                // s
 *     tracks.applyTo(scene);                                        // objects may come and go here
 *     method.look();
 *   }
 *   method.step(q, output);
 *   q += 0.005 * output.velocity; // or the position commanded to the drives
 * }
 * std::cout << vpMessage(output, scene, 0.01) << std::endl; // arrived, or what is in the way
 * \endcode
 */
class VISP_EXPORT vpAvoidanceMethod
{
public:
  virtual ~vpAvoidanceMethod() = default;

  /*!
   * Starts a motion at rest in \e q. May allocate and take milliseconds.
   * \return The status of the next step(): Moving, or the reason for standing.
   */
  virtual vpAvoidanceStatus start(const vpJointVector &q, const vpAvoidanceGoal &goal) = 0;
  //! Changes the goal. No allocation; takes effect in the next look(). Ignored if not finite or if it does not fit.
  virtual void setGoal(const vpAvoidanceGoal &goal) noexcept = 0;
  /*!
   * Updates the motion after a change of the scene: checks it again and searches for a better one. May allocate and
   * take milliseconds; call it for every image.
   */
  virtual void look() = 0;
  /*!
   * One period; no allocation, no exception, no lock.
   * \param q : Current commanded configuration, rad or m.
   * \param output : Receives the velocities to command until the next period, and the status.
   */
  virtual void step(const vpJointVector &q, vpAvoidanceOutput &output) noexcept = 0;
};

/*!
 * \ingroup group_avoidance
 * Status as a sentence with details, such as "The arm stands: link 5 and object pillar are 9.85 mm apart, the margin is
 * 10 mm." Allocates.
 * \param output : Output of a step. \param scene : Scene of the method. \param margin : Margin of the method, m.
 */
[[nodiscard]] VISP_EXPORT std::string vpMessage(const vpAvoidanceOutput &output, const vpCollisionScene &scene,
                                                double margin);

END_VISP_NAMESPACE
#endif
