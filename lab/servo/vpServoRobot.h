/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Robot that carries the camera of a servo experiment: free-flying with friction, or an arm.
#ifndef vpServoRobot_h
#define vpServoRobot_h

#include <visp3/direct_core/vpTwist.h>
#include "lab/servo/vpServoExperiment.h"

#include <memory>

BEGIN_VISP_NAMESPACE

class vpServoRobot
{
public:
  //! Creates a free-flying camera, or the arm of the spec. \throw vpException naming the invalid parameter.
  [[nodiscard]] static std::unique_ptr<vpServoRobot> create(const vpServoRunSpec &spec);
  virtual ~vpServoRobot() = default;

  //! Moves for one cycle of the plant with a twist in the camera frame.
  virtual void move(const vpTwist &twist) = 0;
  //! True pose of the camera in its frame at the start.
  [[nodiscard]] virtual vpHomogeneousMatrix wMc() = 0;
  //! Twist executed in the last cycle, as measured by encoders, camera frame.
  [[nodiscard]] virtual vpTwist actual() const = 0;
  //! Current state of the arm, with the command of the last cycle; false for a free-flying camera.
  virtual bool sample(vpArmSample &) const { return false; }
};

END_VISP_NAMESPACE
#endif
