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
 * \brief Where the arm shall go. Methods that move the tool read #position, methods that move joints read #q.
 */
struct VISP_EXPORT vpAvoidanceGoal {
  vpJointVector q;                                    //!< Configuration, rad or m; empty: only the position is given.
  Eigen::Vector3d position = Eigen::Vector3d::Zero(); //!< Of the end effector's origin in the base, m.
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero(); //!< Of that goal, m/s; 0 for a goal at rest.

  //! A configuration and where it brings the end effector. \throw vpException (badValue) when it does not fit the arm.
  [[nodiscard]] static vpAvoidanceGoal at(const vpArmModel &model, const vpJointVector &q);
  //! True when #q is empty or of the arm's size and all is finite and within vpLargestCoordinate, vpLargestLength and
  //! 1000 m/s.
  [[nodiscard]] bool fits(const vpArmModel &model) const noexcept;
};

//! \ingroup group_avoidance
//! \brief How the motion stands.
enum class vpAvoidanceStatus {
  Moving,           //!< On the direct way to the goal.
  Detouring,        //!< On a way round something, or a slower one behind it.
  Slowed,           //!< Slower than planned: otherwise the arm could not stop in time.
  Waiting,          //!< There is no free way now: brakes or stands, and goes on when there is one.
  Arrived,          //!< At the goal, at rest.
  GoalInCollision,  //!< The goal is not free: brakes or stands, and goes on when it is.
  StartInCollision, //!< Something is nearer to the arm than the margin already: stands.
  Unreachable,      //!< The arm cannot get to the goal whether there are obstacles or not: brakes or stands.
  Unsafe,           //!< Brakes, but something has come so that it may not end in time.
  InvalidInput      //!< A number is not finite or out of range, or a vector has a wrong size; brakes.
};

//! \ingroup group_avoidance
//! \brief The status as a word ("Moving"), for files; static text.
[[nodiscard]] VISP_EXPORT const char *toString(vpAvoidanceStatus status);
//! \ingroup group_avoidance
//! \brief The status as a sentence for a person; static text.
[[nodiscard]] VISP_EXPORT const char *sentence(vpAvoidanceStatus status);

/*!
 * \ingroup group_avoidance
 * \brief What to command for the next period, and why.
 */
struct VISP_EXPORT vpAvoidanceOutput {
  vpJointVector velocity;                                     //!< rad/s or m/s.
  vpAvoidanceStatus status = vpAvoidanceStatus::InvalidInput; //!< How the motion stands.
  vpClearance pair;                                           //!< What is in the way, if something is.
  Eigen::Vector3d wanted = Eigen::Vector3d::Zero(); //!< Where the end effector is planned to be after the period, m.
  bool stopping = false; //!< A protective stop acts: the plan's own bounds gave way to those of the joints.
};

/*!
 * \ingroup group_avoidance
 * \brief The condition of a loop of steps: true while the arm moves, or may come to its goal by itself (Moving, Detouring,
 * Slowed, Waiting, Unsafe).
 *
 * False ends the loop, after the arm has braked: it has arrived, or something is wrong that more of the same steps do not
 * mend (GoalInCollision, StartInCollision, Unreachable, InvalidInput). Whoever wants to wait until a goal becomes free goes on
 * at GoalInCollision. The two potential fields do not know what is out of reach: there they are Moving or Waiting for ever.
 */
[[nodiscard]] VISP_EXPORT bool isWorking(const vpAvoidanceOutput &output) noexcept;

/*!
 * \ingroup group_avoidance
 * \brief What all methods have in common, so that they are compared on equal terms.
 */
struct VISP_EXPORT vpAvoidanceMethodSpec {
  double period = 0.005;       //!< Of step(), s, > 0.
  double maxVelocity = 0.5;    //!< Of the end effector's origin, m/s, > 0 (thesis 8.3.4).
  double maxAcceleration = 1.; //!< Of the same, m/s^2, > 0.
  double margin = 0.01;        //!< Clearance that is kept, m, >= 0.
  unsigned int seed = 1;       //!< Of planners that sample, >= 1.

  //! \throw vpException (badValue) naming the field that is out of range, and its value.
  void validate() const;
};

/*!
 * \class vpAvoidanceMethod
 * \ingroup group_avoidance
 * \brief A way to bring an arm to a goal among obstacles: one interface for all that are compared.
 *
 * A method is made with a scene, which it reads and never changes. Its owner moves the objects there to where they are
 * now, with their velocities, between the calls:
 * \code
 * method.start(q, goal);
 * do {
 *   if (newImage) {
 *     tracks.applyTo(scene);        // objects may come and go here
 *     method.look();
 *   }
 *   method.step(q, output);
 *   q += period * output.velocity;  // or what the drives were told
 * } while (isWorking(output));
 * \endcode
 */
class VISP_EXPORT vpAvoidanceMethod
{
public:
  virtual ~vpAvoidanceMethod() = default;

  /*!
   * Begins a motion at rest in \e q. May allocate and take milliseconds.
   * \return What step() will say, if it does nothing else: Moving, or why the arm will stand.
   */
  virtual vpAvoidanceStatus start(const vpJointVector &q, const vpAvoidanceGoal &goal) = 0;
  //! The goal has moved. No allocation; takes effect in the next look(). Ignored when it is not finite or does not fit.
  virtual void setGoal(const vpAvoidanceGoal &goal) noexcept = 0;
  /*!
   * The scene has changed: looks at the coming motion again, and for a better one. May allocate and take milliseconds;
   * call it as often as images come.
   */
  virtual void look() = 0;
  /*!
   * One period; no allocation, no exception, no lock.
   * \param q : Commanded configuration now, rad or m.
   * \param output : Receives what to command until the next period, and how the motion stands.
   */
  virtual void step(const vpJointVector &q, vpAvoidanceOutput &output) noexcept = 0;
};

/*!
 * \ingroup group_avoidance
 * The status as a sentence with what it is about, as "The arm stands: link 5 and object pillar are 9.85 mm apart, the margin
 * is 10 mm." Allocates.
 * \param output : Of a step. \param scene : The one that its method has. \param margin : Of that method, m.
 */
[[nodiscard]] VISP_EXPORT std::string sentence(const vpAvoidanceOutput &output, const vpCollisionScene &scene,
                                               double margin);

END_VISP_NAMESPACE
#endif
