/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#ifndef vpPlannedMotion_h
#define vpPlannedMotion_h

#include <visp3/avoidance/vpAvoidanceMethod.h>
#include <visp3/avoidance/vpPathPlanner.h>
#include <visp3/avoidance/vpTimedPath.h>

#include <optional>
#include <vector>

BEGIN_VISP_NAMESPACE

//! \ingroup group_avoidance
//! \brief Reaction of a planned motion to an obstacle on its path.
enum class vpReplanning {
  FromRest, //!< Brakes, replans at rest, and continues: the usual way of using planners.
  OnTheFly  //!< Re-times the remaining path or replans from the moving state; brakes only if neither is free.
};

/*!
 * \ingroup group_avoidance
 * \brief Parameters of vpPlannedMotion.
 */
struct VISP_EXPORT vpPlannedMotionSpec {
  vpAvoidanceMethodSpec common;                                  //!< Common parameters; the seed is for the planner.
  vpReplanning replanning = vpReplanning::OnTheFly;              //!< Reaction to obstacles on the path.
  std::string planner = "BiRRT";                                 //!< See vpPathPlannerSpec.
  vpMotionValidation validation = vpMotionValidation::Certified; //!< See vpPathPlannerSpec.
  double clearance = 0.005;  //!< Clearance of paths beyond the margin, m, >= 0: room for trajectories to deviate.
  double startTime = 2.;     //!< Maximum planning time in start(), s, > 0.
  double replanTime = 0.05;  //!< Maximum time of each planning in look(), s, > 0.
  double shortenTime = 0.05; //!< Maximum time for shortening a path, s, >= 0.

  //! \throw vpException (badValue) naming the field that is out of range, and its value.
  void validate() const;
};

/*!
 * \class vpPlannedMotion
 * \ingroup group_avoidance
 * \brief Follows a path of vpPathPlanner as trajectories (vpTimedPath), re-timed or replanned when the scene changes:
 * the methods `planner` and `planner-dtg`, proposed in section 9.2 of the thesis.
 *
 * Every commanded motion is proven free up to its end at rest (vpCertifiedTrajectory), with the objects moving at their
 * velocities; look() proves the remaining part again. If that fails, vpReplanning::OnTheFly tries the same path slower,
 * then another path from the moving state (moving obstacles fixed at their predicted near-future poses), and finally a
 * stop followed by a new path. Stops go straight on or along the path, whichever is proven free. If no stop is proven
 * free, the status is Unsafe.
 *
 * Joints keep their limits, and the end effector the bounds of vpAvoidanceMethodSpec: motions that would exceed them
 * are slowed, and stops take longer. Where no stop within these bounds is proven free, the arm stops within the joint
 * limits alone (vpAvoidanceOutput::stopping). Where no such stop is proven free either, because the arm is within its
 * margin of something that was found to be larger or elsewhere, it stops within the bounds if that is proven to touch
 * nothing; the status is Unsafe.
 *
 * \code
 * vpPlannedMotion motion(scene);
 * motion.start(q, vpAvoidanceGoal::at(arm, goal));
 * vpAvoidanceOutput output;
 * for (int cycle = 0; cycle < 4000 && (cycle == 0 || vpIsWorking(output)); ++cycle) { // every 5 ms, up to 20 s
 *   if (cycle % 8 == 0) {
 *     motion.look(); // after each image, when the scene has been updated
 *   }
 *   motion.step(q, output);
 *   q += 0.005 * output.velocity; // to the drives
 * }
 * std::cout << vpMessage(output, scene, 0.01) << std::endl; // arrived, or what is in the way
 * \endcode
 */
class VISP_EXPORT vpPlannedMotion : public vpAvoidanceMethod
{
public:
  /*!
   * \param scene : Must outlive this.
   * \param spec : Parameters; copied.
   * \throw vpException (badValue), see vpPlannedMotionSpec::validate(); naming a joint without motion limits.
   */
  explicit vpPlannedMotion(const vpCollisionScene &scene, const vpPlannedMotionSpec &spec = {});

  vpAvoidanceStatus start(const vpJointVector &q, const vpAvoidanceGoal &goal) override;
  void setGoal(const vpAvoidanceGoal &goal) noexcept override;
  void look() override;
  /*!
   * \copydoc vpAvoidanceMethod::step()
   * If \e q differs from the commanded configuration, the arm returns to it as fast as the velocity limits allow.
   */
  void step(const vpJointVector &q, vpAvoidanceOutput &output) noexcept override;

  //! Elapsed time and total duration of the current motion, s.
  [[nodiscard]] double clock() const noexcept { return m_clock; }
  //! \overload
  [[nodiscard]] double duration() const noexcept { return m_duration; }
  //! State of joint \e joint at time \e t of the current motion.
  [[nodiscard]] vpAxisState at(int joint, double t) const noexcept;

private:
  struct State {
    vpJointVector q, v, a;
  };
  using Parts = std::vector<vpTimedPath::Part>;
  struct Stop {
    vpTrajectoryPlan plan;
    bool isHard; // within the joint limits alone
  };

  [[nodiscard]] State state(double t) const;
  [[nodiscard]] bool isAtRest() const noexcept { return m_clock >= m_duration; }
  [[nodiscard]] bool restIsFree(double margin);
  [[nodiscard]] vpJointPath restOfPath() const;
  void predict(double time);
  [[nodiscard]] vpPathResult findPath(const vpJointVector &from, double time);
  [[nodiscard]] std::optional<Parts> timed(const vpJointPath &path, const State &from, double begin, double speed,
                                           double margin);
  void planFromRest();
  [[nodiscard]] bool planOnTheFly();
  void hasten();
  [[nodiscard]] bool stopAndPlan();
  void brake();
  [[nodiscard]] std::vector<Stop> freeStops(double margin, bool withHard);
  [[nodiscard]] std::vector<vpTrajectoryPlan> hardStops() const;
  void follow(Parts parts, bool toGoal, vpAvoidanceStatus status);

  const vpCollisionScene *m_scene;
  vpPlannedMotionSpec m_spec;
  vpCollisionScene m_view;              // the scene predicted to another time
  vpPathPlanner m_wide, m_near;         // in m_view; with clearance, with the margin alone
  vpCertifiedTrajectory m_now, m_later; // in the scene; in m_view
  double m_planningTime = 0.;
  unsigned int m_tries = 0;
  vpAvoidanceGoal m_goal, m_wish;
  bool m_goalChanged = false;
  bool m_toGoal = false; // the motion in force ends there
  Parts m_parts;
  double m_duration = 0., m_clock = 0.;
  double m_stopping = 0.;  // until then the motion is a stop
  vpJointVector m_command; // of the last period
  vpJointVector m_hold;    // configuration to hold while there are no parts
  vpAvoidanceStatus m_status = vpAvoidanceStatus::InvalidInput;
  vpClearance m_pair;
  vpArmData m_data;
};

END_VISP_NAMESPACE
#endif
