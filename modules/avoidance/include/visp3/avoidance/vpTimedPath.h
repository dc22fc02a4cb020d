/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpTimedPath.h
 * \brief Converts a path to a motion within the joint limits that is as free as the path.
 */
#ifndef vpTimedPath_h
#define vpTimedPath_h

#include <visp3/avoidance/vpCertifiedTrajectory.h>
#include <visp3/avoidance/vpJointPath.h>

#include <limits>
#include <string>
#include <vector>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_avoidance
 * \brief Parameters of vpTimedPath.
 */
struct VISP_EXPORT vpTimedPathSpec {
  double speed = 1.;        //!< Fraction of the joint velocity limits used, (0, 1].
  double acceleration = 1.; //!< Fraction of the joint acceleration limits used, (0, 1].
  double margin = 0.;       //!< Proven clearance, m, >= 0; not above that of the path's planner.
  double resolution = 1e-4; //!< See vpCertifiedMotionSpec, m, > 0.
  //! Velocity bound of the end effector's origin, m/s, > 0; infinity: none. Each trajectory is extended until it keeps
  //! the tool bounds at samples 5 ms apart, with 1 % reserve for the time between.
  double toolVelocity = std::numeric_limits<double>::infinity();
  double toolAcceleration = std::numeric_limits<double>::infinity(); //!< Its acceleration bound, m/s^2, likewise.
  vpJointVector startVelocity;     //!< Joint velocities at the path's first point, n numbers; empty: at rest.
  vpJointVector startAcceleration; //!< Joint accelerations at the path's first point, likewise.
};

/*!
 * \class vpTimedPath
 * \ingroup group_avoidance
 * \brief Sequence of rest-to-rest trajectories along a path.
 *
 * One trajectory with the path's points as vias (minimum jerk, vpDirectTrajectory) leaves the straight motions between
 * the points and may collide where the path does not; vpCertifiedTrajectory checks it. If it is not free it is replaced
 * by two with a rest between them, down to single straight motions, which all joints traverse with the same polynomial
 * and which thus follow the path exactly.
 *
 * With a start velocity, the first trajectory begins with it; the motion to the second point is then not straight, and
 * inserting a rest may not resolve a collision.
 *
 * \code
 * vpPathPlanner planner(scene); // margin 5 mm
 * const vpPathResult found = planner.plan(q, goal);
 * if (found.status == vpPathStatus::Solved) {
 *   vpTimedPathSpec spec;
 *   spec.speed = 0.5;    // of the joints' velocity limits
 *   spec.margin = 0.004; // m, proven
 *   const vpTimedPath motion(scene, found.path, spec);
 *   std::cout << motion.message(scene) << std::endl; // also what is in the way
 *   for (double t = 0.; motion.isFree() && t < motion.duration(); t += 0.005) {
 *     send(motion.at(0, t)[0]); // joint 1, rad
 *   }
 * }
 * \endcode
 */
class VISP_EXPORT vpTimedPath
{
public:
  //! \brief One of the trajectories.
  struct Part {
    double begin = 0.;     //!< Start time, s from the start of the whole motion.
    vpTrajectoryPlan plan; //!< Trajectory of the arm's joints.
  };

  /*!
   * \param scene : Objects at the start of the motion; they move at their velocities.
   * \param path : At least one point, within the position limits.
   * \param spec : Margin, limits and start state.
   * \throw vpException (badValue) naming a parameter, a joint without velocity or acceleration limit, or an empty path.
   */
  vpTimedPath(const vpCollisionScene &scene, const vpJointPath &path, const vpTimedPathSpec &spec = {});
  /*!
   * \overload
   * \param scene, path, spec : As above.
   * \param certificate : Checker for the same scene; saves 10 ms for creating one. Its margin is set to that of the
   * spec, its resolution is kept.
   */
  vpTimedPath(const vpCollisionScene &scene, const vpJointPath &path, const vpTimedPathSpec &spec,
              vpCertifiedTrajectory &certificate);

  //! True if the whole motion is proven free with the margin. False for a path that is not free itself, or that cannot
  //! be entered at the start velocity within the limits and bounds.
  [[nodiscard]] bool isFree() const noexcept { return m_worst.isFree(); }
  //! Result for the first part that is not free, or the last one.
  [[nodiscard]] const vpTrajectoryClearance &clearance() const noexcept { return m_worst; }
  //! The trajectories in their order.
  [[nodiscard]] const std::vector<Part> &parts() const noexcept { return m_parts; }
  //! Total duration, s.
  [[nodiscard]] double duration() const noexcept { return m_duration; }
  /*!
   * State of joint \e joint (from 0) at time \e t, s from the start: (rad, rad/s, rad/s^2, rad/s^3). No allocation.
   */
  [[nodiscard]] vpAxisState at(int joint, double t) const noexcept;
  //! Result as a sentence: duration, rests, or what is in the way and when.
  [[nodiscard]] std::string message(const vpCollisionScene &scene) const;

private:
  void build(const vpCollisionScene &scene, const vpJointPath &path, const vpTimedPathSpec &spec,
             vpCertifiedTrajectory &certificate);
  void append(const vpTrajectoryPlan &plan, const vpTrajectoryClearance &clearance);

  std::vector<Part> m_parts;
  double m_duration = 0.;
  vpTrajectoryClearance m_worst;
  vpJointVector m_start;
};

END_VISP_NAMESPACE
#endif
