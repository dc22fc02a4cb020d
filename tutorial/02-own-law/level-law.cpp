/*! \example level-law.cpp
 * A servo law of your own as a plug-in: for a camera on four axes (a gantry, a drone) that translates freely and turns
 * about the vertical, but neither tilts nor rolls. Programs load it by `--plugin`.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/direct_core/vpPlugin.h>
#include <visp3/feedforward/vpServoLaw.h>

#include <Eigen/Core>
#include <cmath>

VISP_DIRECT_USING_NAMESPACE

namespace
{
//! [Error]
// Error that the law drives to zero: camera position in the desired camera frame (m), and yaw about the y axis (rad).
Eigen::Vector4d errorOf(const vpHomogeneousMatrix &cMo, const vpHomogeneousMatrix &cdMo)
{
  using Pose = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>; // ViSP's own products would allocate
  const Pose o(cMo.data), d(cdMo.data);
  const Eigen::Matrix3d cdRc = d.topLeftCorner<3, 3>() * o.topLeftCorner<3, 3>().transpose();
  const Eigen::Vector3d cdtc = d.topRightCorner<3, 1>() - cdRc * o.topRightCorner<3, 1>();
  return {cdtc.x(), cdtc.y(), cdtc.z(), std::atan2(cdRc(0, 2), cdRc(2, 2))};
}
//! [Error]
//! [Law]
class LevelLaw : public vpServoLaw
{
public:
  explicit LevelLaw(const vpServoGains &gains) : vpServoLaw("level", gains) {}

protected:
  // The base class has checked the measurement: valid, finite, fits the goal. Do not throw or allocate here.
  vpServoCommand compute(const vpServoMeasurement &seen, double /*dt*/) noexcept override
  {
    const Eigen::Vector4d e = errorOf(seen.cMo, m_goal.cdMo);
    const Eigen::Vector3d v = -m_gains.lambda * e.head<3>(); // along the axes of the desired camera;
    const double c = std::cos(e(3)), s = std::sin(e(3));     // rotated into the current frame below
    const double wy = -m_gains.lambda * m_gains.rotation * e(3);
    return {vpTwist(c * v.x() - s * v.z(), v.y(), s * v.x() + c * v.z(), 0., wy, 0.), vpServoStatus::Servoing};
  }
};
//! [Law]
} // namespace

//! [Plugin]
extern "C" void vispDirectPlugin()
{
  vpServoLaw::add("level", "Translation and yaw, each decaying alone; neither tilt nor roll.",
                  [](const vpServoGains &gains, const vpServoMotionLimits & /*for laws that plan*/) {
                    return std::make_unique<LevelLaw>(gains);
                  });
}
//! [Plugin]
