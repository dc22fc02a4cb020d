/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpTrueScene.h
 * \brief True scene of an avoidance experiment, its true and reported goal, and a way to reach it.
 */
#ifndef vpTrueScene_h
#define vpTrueScene_h

#include "lab/avoidance/vpAvoidanceRunSpec.h"

#include <visp3/manipulator/vpArmKinematics.h>

#include <random>

BEGIN_VISP_NAMESPACE

//! \brief Static objects, and obstacles that appear, move and vanish.
class vpTrueScene
{
public:
  explicit vpTrueScene(const vpAvoidanceRunSpec &spec);

  //! Adds and removes obstacles according to their presence at time \e t, and moves all to their poses at \e t.
  void enter(double t);
  //! Moves the obstacles in the scene; no allocation. Does not check which should be present.
  void place(double t) noexcept;
  //! The current true scene.
  [[nodiscard]] const vpCollisionScene &scene() const noexcept { return m_scene; }
  //! True if no obstacle moves, appears or vanishes from time \e t on.
  [[nodiscard]] bool isStill(double t) const noexcept;
  //! Maximum speed of all obstacles, m/s.
  [[nodiscard]] double fastest() const noexcept { return m_fastest; }

private:
  struct Obstacle {
    vpMovingObstacle motion;
    int index = -1; // in the scene; -1: absent
  };
  vpCollisionScene m_scene;
  std::vector<Obstacle> m_obstacles;
  double m_fastest = 0.;
};

//! \brief Goal moving along vpAvoidanceRunSpec::goalMoves.
class vpMovingGoal
{
public:
  explicit vpMovingGoal(const vpAvoidanceRunSpec &spec);

  //! True goal at time \e t, s; its velocity counts as 0.
  [[nodiscard]] vpAvoidanceGoal at(double t) const;
  //! True if a goal update is due at time \e t; the first is at 0. Call once per period.
  [[nodiscard]] bool isDue(double t);
  //! Reported goal: with noise, and with matching joints.
  [[nodiscard]] vpAvoidanceGoal told(double t);
  //! Time at which the goal comes to rest finally, s.
  [[nodiscard]] double end() const noexcept { return m_end; }

private:
  const vpAvoidanceRunSpec *m_spec;
  std::mt19937_64 m_random;
  double m_end;
  double m_next = 0.; // number of the next update
};

/*!
 * Finds a configuration near another one with the tool at a given position: damped Newton iteration on the end-effector position alone, within the position limits.
 * \param q : Start; receives the result. \return False if the error exceeds 1e-9 m after 200 steps.
 */
[[nodiscard]] bool vpReachPoint(const vpArmModel &model, const Eigen::Vector3d &place, vpJointVector &q);

END_VISP_NAMESPACE
#endif
