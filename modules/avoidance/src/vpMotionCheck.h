/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpMotionCheck.h
 * \brief The three checks of motions behind one interface, for the planners.
 */
#ifndef vpMotionCheck_h
#define vpMotionCheck_h

#include <visp3/avoidance/vpMotionResult.h>
#include <visp3/avoidance/vpPathPlanner.h>

#include <memory>

BEGIN_VISP_NAMESPACE

//! Check of configurations and motions with the margin of a planner. One object per thread.
class vpMotionCheck
{
public:
  virtual ~vpMotionCheck() = default;
  [[nodiscard]] virtual bool isFree(const vpJointVector &from, const vpJointVector &to) = 0;
  //! All motions of a path, each in one direction or the other; false for less than two points.
  [[nodiscard]] bool isFree(const vpJointPath &path);
  [[nodiscard]] virtual bool inCollision(const vpJointVector &q) = 0;
  //! The least clearance below the cutoff, m.
  [[nodiscard]] virtual vpClearance clearance(const vpJointVector &q, double cutoff) = 0;
};

//! The check that the parameters name. \throw vpException (notImplementedError) naming FCL if built without it.
std::unique_ptr<vpMotionCheck> vpMakeMotionCheck(const vpCollisionScene &scene, const vpPathPlannerSpec &spec);

END_VISP_NAMESPACE
#endif
