/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpTimedPath.h
 * \brief From a path to a motion within the joints' limits that is as free as the path.
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
  double speed = 1.;        //!< Part of the joints' velocity limits that is used, (0, 1].
  double acceleration = 1.; //!< Part of their acceleration limits, (0, 1].
  double margin = 0.;       //!< Clearance that is proven, m, >= 0; not above that of the path's planner.
  double resolution = 1e-4; //!< See vpCertifiedMotionSpec, m, > 0.
  //! Bounds of the end effector's origin, m/s and m/s^2, > 0; infinity: none. Each trajectory is made so much longer that
  //! it keeps them at samples 5 ms apart, with 1 % to spare for what is between.
  double toolVelocity = std::numeric_limits<double>::infinity();
  double toolAcceleration = std::numeric_limits<double>::infinity(); //!< See there.
  vpJointVector startVelocity;     //!< Of the joints at the path's first point, n numbers; empty: at rest.
  vpJointVector startAcceleration; //!< The same for their accelerations.
};

/*!
 * \class vpTimedPath
 * \ingroup group_avoidance
 * \brief Trajectories one after another, from rest to rest each, along a path.
 *
 * One trajectory with the path's points as vias (least jerk, vpDirectTrajectory) leaves the straight motions between the
 * points and may touch what the path does not; vpCertifiedTrajectory looks at it. Where it is not free it is replaced by
 * two with a rest between them, down to single straight motions, which all joints traverse with the same polynomial and
 * which so are the path itself.
 *
 * With a velocity at the start, the first trajectory takes it up; the way to the second point is then not straight, and
 * what is not free cannot always be mended by a rest.
 */
class VISP_EXPORT vpTimedPath
{
public:
  //! \brief One of the trajectories.
  struct Part {
    double begin = 0.;     //!< s from the start of the whole motion.
    vpTrajectoryPlan plan; //!< In the joints of the arm.
  };

  /*!
   * \param scene : Objects where they are when the motion starts; they move on by their velocities.
   * \param path : At least one point, within the position limits.
   * \param spec : Margin, limits and the state at the start.
   * \throw vpException (badValue) naming a parameter, a joint without velocity or acceleration limit, or an empty path.
   */
  vpTimedPath(const vpCollisionScene &scene, const vpJointPath &path, const vpTimedPathSpec &spec = {});
  /*!
   * \overload
   * \param scene, path, spec : As above.
   * \param certificate : For the same scene; saves the 10 ms of making one. Its margin becomes that of the spec, its
   * resolution stays.
   */
  vpTimedPath(const vpCollisionScene &scene, const vpJointPath &path, const vpTimedPathSpec &spec,
              vpCertifiedTrajectory &certificate);

  //! True when all of it is proven to be free with the margin. False for a path that is not free itself, or that cannot
  //! be taken up from the velocity at its start within the limits and bounds.
  [[nodiscard]] bool isFree() const noexcept { return m_worst.isFree(); }
  //! The first part that is not free, or the last one.
  [[nodiscard]] const vpTrajectoryClearance &clearance() const noexcept { return m_worst; }
  //! The trajectories in their order.
  [[nodiscard]] const std::vector<Part> &parts() const noexcept { return m_parts; }
  //! Until the arm is at the goal, s.
  [[nodiscard]] double duration() const noexcept { return m_duration; }
  /*!
   * State of joint \e joint (from 0) at time \e t, s from the start: (rad, rad/s, rad/s^2, rad/s^3). No allocation.
   */
  [[nodiscard]] vpAxisState at(int joint, double t) const noexcept;
  //! A sentence on how it went: duration, rests, or what is in the way and when.
  [[nodiscard]] std::string sentence(const vpCollisionScene &scene) const;

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
