/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpTrueScene.h
 * \brief True scene of an avoidance experiment.
 */
#ifndef vpTrueScene_h
#define vpTrueScene_h

#include "lab/avoidance/vpAvoidanceRunSpec.h"

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

END_VISP_NAMESPACE
#endif
