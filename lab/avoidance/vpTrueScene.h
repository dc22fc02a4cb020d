/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpTrueScene.h
 * \brief The scene of an avoidance experiment as it truly is.
 */
#ifndef vpTrueScene_h
#define vpTrueScene_h

#include "lab/avoidance/vpAvoidanceRunSpec.h"

BEGIN_VISP_NAMESPACE

//! \brief Objects at rest, and obstacles that come, move and go.
class vpTrueScene
{
public:
  explicit vpTrueScene(const vpAvoidanceRunSpec &spec);

  //! Obstacles that are there at time \e t come in, those that are not go; and all are where they are then.
  void enter(double t);
  //! Moves those that are there; no allocation. Does not look who should be there.
  void place(double t) noexcept;
  //! As it was last made.
  [[nodiscard]] const vpCollisionScene &scene() const noexcept { return m_scene; }
  //! True when no obstacle moves, comes or goes from time \e t on.
  [[nodiscard]] bool isStill(double t) const noexcept;
  //! Speed that no obstacle ever exceeds, m/s.
  [[nodiscard]] double fastest() const noexcept { return m_fastest; }

private:
  struct Obstacle {
    vpMovingObstacle motion;
    int index = -1; // in the scene; -1: not there
  };
  vpCollisionScene m_scene;
  std::vector<Obstacle> m_obstacles;
  double m_fastest = 0.;
};

END_VISP_NAMESPACE
#endif
