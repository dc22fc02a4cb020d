/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpFieldCheck.h"

#include <visp3/servoing/vpArmServo.h>

#include <visp3/core/vpException.h>
#include <visp3/direct_core/vpSO3.h>
#include <visp3/manipulator/vpTwistAxes.h>

#include <cmath>
#include <utility>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr vpFieldCheck fields("the arm servo");

vpArmServoSpec validated(const vpArmServoSpec &spec, const vpArmModel &model)
{
  spec.validate(model);
  return spec;
}
} // namespace

void vpArmServoSpec::validate(const vpArmModel &model) const
{
  redundancy.validate(model);
  fields.positive("maxAge", maxAge);
  fields.positive("maxLinear", maxLinear);
  fields.positive("maxAngular", maxAngular);
  if (indices.size() > vpMaxArmIndices) {
    throw vpException(vpException::badValue, "the arm servo has %zu indices, must be at most %d", indices.size(),
                      vpMaxArmIndices);
  }
}

vpArmServo::vpArmServo(const vpArmModel &model, vpServoController controller, const vpArmServoSpec &spec)
  : m_model(&model), m_spec(validated(spec, model)), m_controller(std::move(controller)),
    m_motion(model, spec.redundancy, vpClosedLoopSpec()), m_odometry(spec.maxAge, 1. / spec.redundancy.period)
{
  m_motion.setSelfMotion(spec.indices, spec.free);
  m_output.velocity.setZero(model.size());
}

void vpArmServo::supervise(const vpCollisionScene &scene, const vpStopSupervisorSpec &spec)
{
  vpStopSupervisorSpec stop = spec;
  stop.period = m_spec.redundancy.period;
  m_supervisor.emplace(scene, stop);
}

bool vpArmServo::see(const vpServoMeasurement &result) noexcept { return m_odometry.correct(result); }

// Mean camera twist since the last step, in the camera frame.
vpTwist vpArmServo::executed(const vpRigidTransform &fMc, double time) const noexcept
{
  if (!m_started) {
    return {};
  }
  const vpRigidTransform moved = m_camera.inverse() * fMc;
  const double dt = time - m_time;
  const Eigen::Vector3d turn = vpSO3::log(moved.R);
  const Eigen::Vector3d v = vpSO3::rightJacobianInverse(-turn) * moved.p / dt, w = turn / dt;
  return {v.x(), v.y(), v.z(), w.x(), w.y(), w.z()};
}

const vpArmServoOutput &vpArmServo::step(const vpJointVector &q, double time) noexcept
{
  const double dt = m_started ? time - m_time : m_spec.redundancy.period;
  if (vpArmKinematics::update(*m_model, q, m_data) && std::isfinite(time) && dt > 0.) {
    const vpRigidTransform fMc = vpArmKinematics::camera(*m_model, m_data);
    m_odometry.move(executed(fMc, time), time);
    m_odometry.predict(m_measurement);
    m_camera = fMc;
    m_time = time;
    m_started = true;
    const vpServoCommand command = m_controller.step(m_measurement, dt);
    m_output.twist = vpLimitTwist(vpWithoutFreeAxes(command.v, m_spec.free), m_spec.maxLinear, m_spec.maxAngular);
    m_output.servo = command.status;
    m_output.age = m_odometry.age();
    m_motion.twist(m_output.twist, vpArmTwistFrame::Camera);
  }
  else {
    m_output.twist = vpTwist();
    m_output.servo = vpServoStatus::InvalidInput;
    m_motion.hold();
  }
  const vpJointVector &wish = m_motion.step(q, m_output.velocity);
  m_output.arm = m_motion.solver().status;
  m_output.supervision = vpSupervision::Passed;
  if (m_supervisor) {
    m_supervisor->step(q, wish, m_supervised);
    m_output.supervision = m_supervised.status;
    m_output.velocity = m_supervised.velocity;
  }
  else {
    m_output.velocity = wish;
  }
  return m_output;
}

END_VISP_NAMESPACE
