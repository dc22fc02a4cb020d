/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#ifndef vpDetourSearch_h
#define vpDetourSearch_h

#include "vpDetour.h"

#include <visp3/avoidance/vpDirectTrajectoryAvoidance.h>

#include <optional>

BEGIN_VISP_NAMESPACE

//! \brief Where a search starts.
struct vpDetourStart {
  vpToolState tool;
  vpJointVector q, velocity;
  vpJointVector posture;       // to lean to; may be empty
  Eigen::Matrix3d orientation; // kept if the method keeps it
};

//! \brief What a search found.
struct vpDetourResult {
  std::optional<vpToolTask> task; // none: no motion is foreseen to be free
  vpForecast direct;              // of the direct way, for its status
};

/*!
 * \class vpDetourSearch
 * \brief Best first over tasks with more and more vias: what comes into the way of one is gone round on all sides, the
 * shortest way first.
 */
class vpDetourSearch
{
public:
  vpDetourSearch(const vpCollisionScene &scene, const vpDirectTrajectoryAvoidanceSpec &spec,
                 const vpToolMotionSpec &motion);

  //! A motion of the arm on a task, slower if the joints demand it; \e task gets the speed that was needed.
  [[nodiscard]] vpForecast foresee(const vpDetourStart &start, vpToolTask &task, double margin);
  //! The rest of a motion.
  [[nodiscard]] vpForecast foresee(const vpDetourStart &start, const vpTrajectoryPlan &plan, double clock,
                                   double margin);
  //! The direct way to the goal or a way round.
  [[nodiscard]] vpDetourResult search(const vpDetourStart &start, const Eigen::Vector3d &goal,
                                      const Eigen::Vector3d &goalVelocity);
  //! Where the direct way would end if nothing were in the way; none: the arm does not get there.
  [[nodiscard]] std::optional<vpJointVector> endOf(const vpDetourStart &start, const Eigen::Vector3d &goal);

private:
  struct Node {
    vpToolTask task;
    double length = 0.;
  };
  void expand(const vpDetourStart &start, const Node &node, const vpForecast &conflict);
  [[nodiscard]] bool leadsToGoal(const vpDetourStart &start, const vpForecast &there, const Eigen::Vector3d &goal);

  const vpCollisionScene *m_scene;
  vpDirectTrajectoryAvoidanceSpec m_spec;
  vpToolForecast m_forecast;
  vpToolPath m_path;
  vpTrajectoryPlan m_plan;
  std::vector<Node> m_open; // a heap, the shortest on top
  int m_left = 0;           // forecasts
};

END_VISP_NAMESPACE
#endif
