/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#ifndef vpToolForecast_h
#define vpToolForecast_h

#include "vpToolMotion.h"
#include "vpToolPath.h"

BEGIN_VISP_NAMESPACE

//! \brief What will happen on a tool's motion.
enum class vpForecastStatus {
  Free,     // it is followed to its end
  Conflict, // something comes nearer than the margin
  TooFast,  // joints cannot follow the tool; a slower motion may do
  Stuck     // the arm cannot get there: limits or singularities
};

//! \brief A motion of the tool as the arm would make it.
struct vpForecast {
  vpForecastStatus status = vpForecastStatus::Stuck;
  double time = 0.;                               // s from now: of the conflict, or of the end
  vpClearance pair;                               // Conflict: what
  Eigen::Vector3d tool = Eigen::Vector3d::Zero(); // where the tool is then
  vpJointVector end;                              // configuration then
  vpJointVector velocity;                         // of the joints then
};

/*!
 * \class vpToolForecast
 * \brief The whole arm along a coming motion of the tool: makes it in coarse steps with the same law that makes it in
 * fine ones, objects moving on by their velocities, and measures clearances on the way.
 *
 * Between two looks no point of a capsule is farther from where it was looked at than half of what its ends move, so the
 * margin counts that much more. Joints may come out a little differently in fine steps: this chooses motions, the stop
 * supervisor proves them.
 */
class vpToolForecast
{
public:
  vpToolForecast(const vpCollisionScene &scene, const vpToolMotionSpec &motion, double step = 0.04);

  /*!
   * \param q, velocity : Of the joints now. \param plan : Of the tool; \param clock : where it is on it now, s.
   * \param posture, orientation : See vpToolMotion. \param margin : m. \param later : The motion begins in so many
   * seconds, objects are where they are then.
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
