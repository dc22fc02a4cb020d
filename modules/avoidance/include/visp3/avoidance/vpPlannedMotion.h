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
//! \brief What a planned motion does when something comes into its way.
enum class vpReplanning {
  FromRest, //!< Brakes, plans anew when it stands, and goes on: how planners are used as a rule.
  OnTheFly  //!< Times the rest of the path anew or plans another from the moving state; brakes only if neither is free.
};

/*!
 * \ingroup group_avoidance
 * \brief Parameters of vpPlannedMotion.
 */
struct VISP_EXPORT vpPlannedMotionSpec {
  vpAvoidanceMethodSpec common;                                  //!< Its seed goes to the planner.
  vpReplanning replanning = vpReplanning::OnTheFly;              //!< See there.
  std::string planner = "RRTConnect";                            //!< See vpPathPlannerSpec.
  vpMotionValidation validation = vpMotionValidation::Certified; //!< See vpPathPlannerSpec.
  double clearance = 0.005;  //!< Of paths beyond the margin, m, >= 0: room for the timing to leave the path.
  double startTime = 2.;     //!< For planning in start(), s, > 0.
  double replanTime = 0.05;  //!< For each planning in look(), s, > 0.
  double shortenTime = 0.05; //!< For making a found way shorter, s, >= 0.

  //! \throw vpException (badValue) naming the field that is out of range, and its value.
  void validate() const;
};

/*!
 * \class vpPlannedMotion
 * \ingroup group_avoidance
 * \brief A path of vpPathPlanner as trajectories (vpTimedPath), followed and, when the scene changes, timed or planned
 * anew: methods (iv) and (v), thesis section 9.2.
 *
 * Every motion that is commanded is proven to be free up to its end at rest (vpCertifiedTrajectory), with the objects
 * moving on at their velocities; look() proves the rest of it again. If that fails, on the fly are tried: the same path
 * slower, another path from the moving state (obstacles that move stand where they are predicted to be soon), and a stop
 * with a path behind it. Stops go straight on or along the path, whichever is proven free. Only where no stop is, the
 * status is Unsafe.
 *
 * Joints keep their limits, and the end effector the bounds of vpAvoidanceMethodSpec: motions that would not are timed
 * slower. Stops keep the limits of the joints only.
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
   * Where \e q is not what was commanded, the arm goes to where it should be as fast as the joints' velocities allow.
   */
  void step(const vpJointVector &q, vpAvoidanceOutput &output) noexcept override;

  //! How far the present motion is, s, and how long it takes.
  [[nodiscard]] double clock() const noexcept { return m_clock; }
  //! \overload
  [[nodiscard]] double duration() const noexcept { return m_duration; }
  //! State of joint \e joint at time \e t of the present motion.
  [[nodiscard]] vpAxisState at(int joint, double t) const noexcept;

private:
  struct State {
    vpJointVector q, v, a;
  };
  using Parts = std::vector<vpTimedPath::Part>;

  [[nodiscard]] State state(double t) const;
  [[nodiscard]] bool isAtRest() const noexcept { return m_clock >= m_duration; }
  [[nodiscard]] bool restIsFree();
  [[nodiscard]] vpJointPath restOfPath() const;
  void predict(double time);
  [[nodiscard]] vpPathResult findPath(const vpJointVector &from, double time);
  [[nodiscard]] std::optional<Parts> timed(const vpJointPath &path, const State &from, double begin, double speed);
  void planFromRest();
  [[nodiscard]] bool planOnTheFly();
  void hasten();
  [[nodiscard]] bool stopAndPlan();
  void brake();
  [[nodiscard]] std::vector<vpTrajectoryPlan> stops() const;
  void follow(Parts parts, bool toGoal, vpAvoidanceStatus status);

  const vpCollisionScene *m_scene;
  vpPlannedMotionSpec m_spec;
  vpCollisionScene m_view;              // the scene as it will be at another time
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
  vpJointVector m_hold;    // where it stands while there are no parts
  vpAvoidanceStatus m_status = vpAvoidanceStatus::InvalidInput;
  vpClearance m_pair;
  vpArmData m_data;
};

END_VISP_NAMESPACE
#endif
