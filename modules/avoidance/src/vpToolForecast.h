/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#ifndef vpToolForecast_h
#define vpToolForecast_h

#include "vpToolMotion.h"
#include "vpToolPath.h"

BEGIN_VISP_NAMESPACE

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
