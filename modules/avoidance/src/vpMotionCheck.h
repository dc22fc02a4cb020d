/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Common interface of the three motion checks.
#ifndef vpMotionCheck_h
#define vpMotionCheck_h

#include <visp3/avoidance/vpMotionResult.h>
#include <visp3/avoidance/vpPathPlanner.h>

#include <memory>

BEGIN_VISP_NAMESPACE

class vpMotionCheck
{
public:
  //! \throw vpException as vpPathPlanner's constructor.
  [[nodiscard]] static std::unique_ptr<vpMotionCheck> create(const vpCollisionScene &scene,
                                                             const vpPathPlannerSpec &spec);
  virtual ~vpMotionCheck() = default;
  [[nodiscard]] virtual vpMotionResult motion(const vpJointVector &from, const vpJointVector &to) = 0;
  [[nodiscard]] virtual bool inCollision(const vpJointVector &q) = 0;
};

END_VISP_NAMESPACE
#endif
