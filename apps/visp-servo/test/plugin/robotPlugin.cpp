/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Robots as a user's library gives them: a simulated arm by the clock, none, an exception, or frames that move exactly.
#include <visp3/core/vpException.h>
#include <visp3/core/vpExponentialMap.h>
#include <visp3/core/vpPoseVector.h>
#include <visp3/manipulator/vpArmJson.h>
#include <visp3/robot/vpRobot.h>
#include <visp3/servoing/vpRobotPlugin.h>
#include <visp3/simulation/vpSimulatedArm.h>

#include <string>

VISP_DIRECT_USING_NAMESPACE

namespace
{
//! Each velocity acts for a second. Its own camera is not where the user's is.
class Frames : public vpRobot
{
public:
  void get_eJe(vpMatrix &) override {}
  void get_fJe(vpMatrix &) override {}
  void getDisplacement(const vpRobot::vpControlFrameType, vpColVector &) override {}
  void setPosition(const vpRobot::vpControlFrameType, const vpColVector &) override {}
  void getPosition(const vpRobot::vpControlFrameType frame, vpColVector &q) override
  {
    const vpPoseVector pose(m_fMe * in(frame));
    q.resize(6);
    for (unsigned int i = 0; i < 6; ++i) {
      q[i] = pose[i];
    }
  }
  void setVelocity(const vpRobot::vpControlFrameType frame, const vpColVector &v) override
  {
    m_fMe = m_fMe * in(frame)*vpExponentialMap::direct(v, 1.) * in(frame).inverse();
  }

private:
  void init() override {}
  static vpHomogeneousMatrix in(vpRobot::vpControlFrameType frame)
  {
    if (frame != vpRobot::CAMERA_FRAME && frame != vpRobot::END_EFFECTOR_FRAME) {
      throw vpException(vpException::badValue, "another frame");
    }
    return frame == vpRobot::CAMERA_FRAME ? vpHomogeneousMatrix(0.3, 0.2, 0.1, 0.5, 0.4, -0.6) : vpHomogeneousMatrix();
  }
  vpHomogeneousMatrix m_fMe;
};
} // namespace

extern "C" VISP_EXPORT vpRobot *vispDirectRobot(const char *arguments)
{
  if (KIND == 1) {
    return nullptr;
  }
  if (KIND == 3) {
    return new Frames();
  }
  if (KIND == 2) {
    throw vpException(vpException::fatalError, "no robot answers at %s", arguments);
  }
  vpSimulatedArmSpec spec;
  spec.clock = vpArmClock::RealTime;
  return new vpSimulatedArm(vpLoadArmJson(arguments), spec);
}
