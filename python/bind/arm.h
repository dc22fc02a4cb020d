/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#ifndef arm_h
#define arm_h

#include "binding.h"

#include <visp3/manipulator/vpArmMotion.h>

namespace visp_python
{
//! Kinematics in one configuration with its arm, so that both always fit.
struct ArmKinematics {
  const vpArmModel *model;
  vpArmData data;

  ArmKinematics(const vpArmModel &arm, const vpJointVector &q);
};

//! vpArmMotion with its arm, to check the size of what is given.
class ArmMotion : public vpArmMotion
{
public:
  ArmMotion(const vpArmModel &arm, const vpRedundancySpec &redundancy, const vpClosedLoopSpec &closedLoop)
    : vpArmMotion(arm, redundancy, closedLoop), m_joints(arm.size())
  {}
  const vpJointVector &fitting(const char *name, const vpJointVector &given) const
  {
    checkJoints(name, given.size(), m_joints);
    return given;
  }

private:
  int m_joints;
};
} // namespace visp_python
#endif
