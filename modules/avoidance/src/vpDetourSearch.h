/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#ifndef vpDetourSearch_h
#define vpDetourSearch_h

#include "vpToolMotion.h"

#include <visp3/avoidance/vpDirectTrajectoryAvoidance.h>

#include <optional>
#include <vector>

BEGIN_VISP_NAMESPACE

//! \brief Start of a search.
struct vpDetourStart {
  vpToolState tool;
  vpJointVector q, velocity;
  vpJointVector posture;       // preferred posture; may be empty
  Eigen::Matrix3d orientation; // orientation to keep, if the method does
};

//! \brief Result of a search.
struct vpDetourResult {
  std::optional<vpToolTask> task; // none: no motion is predicted to be free
  vpForecast direct;              // of the direct path, for its status
};

/*!
 * \class vpDetourSearch
 * \brief Best-first search over tasks with increasing numbers of vias: obstacles on a path are bypassed on all sides,
 * the shortest path first.
 */
class vpDetourSearch
{
public:
  vpDetourSearch(const vpCollisionScene &scene, const vpDirectTrajectoryAvoidanceSpec &spec,
                 const vpToolMotionSpec &motion);

  //! Predicts the arm on a task, slower if the joints require it; \e task receives the speed used.
  [[nodiscard]] vpForecast foresee(const vpDetourStart &start, vpToolTask &task, double margin);
  //! Predicts the rest of a motion.
  [[nodiscard]] vpForecast foresee(const vpDetourStart &start, const vpTrajectoryPlan &plan, double clock,
                                   double margin);
  //! Searches the direct path to the goal or a detour.
  [[nodiscard]] vpDetourResult search(const vpDetourStart &start, const Eigen::Vector3d &goal,
                                      const Eigen::Vector3d &goalVelocity);
  //! End of the direct path without obstacles; none: the arm cannot reach it.
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
  int m_left = 0;           // remaining forecasts
};

END_VISP_NAMESPACE
#endif
