/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/feedforward/vpServoCommand.h>

BEGIN_VISP_NAMESPACE

const char *vpMessage(vpServoStatus status)
{
  switch (status) {
  case vpServoStatus::Servoing:
    return "The law moves the camera.";
  case vpServoStatus::ViewLimited:
    return "The motion was changed to keep the target in the view or within the velocity limits.";
  case vpServoStatus::Deadlock:
    return "Stuck: every motion towards the goal would take the target out of the view.";
  case vpServoStatus::Holding:
    return "The target is lost; standing still and waiting for it.";
  case vpServoStatus::Retreating:
    return "The target is lost; going back along the last good motion.";
  case vpServoStatus::Lost:
    return "The target is lost and was not found on the way back; standing still.";
  case vpServoStatus::NoGoal:
    return "No goal was set.";
  case vpServoStatus::InvalidInput:
    return "The measurement is not usable: not finite, a depth that is not positive, or not the goal's points.";
  case vpServoStatus::Degenerate:
    return "The law has no answer here: too few points or a singular interaction matrix.";
  case vpServoStatus::Diverging:
    return "The law runs away from the target: this way does not lead to the goal.";
  }
  return "Unknown status.";
}

const char *vpToString(vpServoStatus status)
{
  switch (status) {
  case vpServoStatus::Servoing:
    return "Servoing";
  case vpServoStatus::ViewLimited:
    return "ViewLimited";
  case vpServoStatus::Deadlock:
    return "Deadlock";
  case vpServoStatus::Holding:
    return "Holding";
  case vpServoStatus::Retreating:
    return "Retreating";
  case vpServoStatus::Lost:
    return "Lost";
  case vpServoStatus::NoGoal:
    return "NoGoal";
  case vpServoStatus::InvalidInput:
    return "InvalidInput";
  case vpServoStatus::Degenerate:
    return "Degenerate";
  case vpServoStatus::Diverging:
    return "Diverging";
  }
  return "Unknown";
}

END_VISP_NAMESPACE
