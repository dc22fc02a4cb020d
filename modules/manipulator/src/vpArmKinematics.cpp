/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/direct_core/vpSO3.h>
#include <visp3/manipulator/vpArmKinematics.h>

#include <Eigen/Geometry>

#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
using Vector6 = Eigen::Matrix<double, 6, 1>;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

Eigen::Vector3d axis(const vpArmData &data, int i) { return data.joint[at(i)].R.col(2); }

// Rotation into the axes of a frame, and the lever from the end effector to its origin in the base.
void view(const vpArmModel &model, const vpArmData &data, vpArmFrame frame, Eigen::Matrix3d &R, Eigen::Vector3d &lever)
{
  R.setIdentity();
  lever.setZero();
  if (frame == vpArmFrame::EndEffector) {
    R = data.tool.R;
  }
  else if (frame == vpArmFrame::Camera) {
    R = data.tool.R * model.spec().camera.R;
    lever = data.tool.R * model.spec().camera.p;
  }
}

// For an unknown configuration everything is NaN, so that every comparison fails.
void forget(vpArmData &data)
{
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  data.q.setConstant(data.size, unknown);
  data.tool.R.setConstant(unknown);
  data.tool.p.setConstant(unknown);
  data.joint.fill(data.tool);
}
} // namespace

namespace vpArmKinematics
{
bool forward(const vpArmModel &model, const vpJointVector &q, vpArmData &data) noexcept
{
  const int n = model.size();
  data.size = n;
  if (q.size() != n || !vpIsPlausibleForArm(q)) {
    forget(data);
    return false;
  }
  data.q = q;
  vpRigidTransform now;
  for (int i = 0; i < n; ++i) {
    now = i == 0 ? model.step(0) : now * model.step(i);
    const double coordinate = q(i) + model.offset(i);
    if (model.isPrismatic(i)) {
      now.p += coordinate * now.R.col(2);
    }
    else {
      const double c = std::cos(coordinate), s = std::sin(coordinate);
      const Eigen::Vector3d x = now.R.col(0);
      now.R.col(0) = c * x + s * now.R.col(1);
      now.R.col(1) = c * now.R.col(1) - s * x;
    }
    data.joint[at(i)] = now;
  }
  data.tool = now * model.toolStep();
  return true;
}

void jacobian(const vpArmModel &model, vpArmData &data) noexcept
{
  data.J.resize(6, data.size);
  for (int i = 0; i < data.size; ++i) {
    const Eigen::Vector3d z = axis(data, i);
    if (model.isPrismatic(i)) {
      data.J.col(i) << z, Eigen::Vector3d::Zero();
    }
    else {
      data.J.col(i) << z.cross(data.tool.p - data.joint[at(i)].p), z;
    }
  }
}

bool update(const vpArmModel &model, const vpJointVector &q, vpArmData &data) noexcept
{
  const bool good = forward(model, q, data);
  jacobian(model, data);
  return good;
}

vpRigidTransform link(const vpArmModel &model, const vpArmData &data, int i) noexcept
{
  return i == 0 ? vpRigidTransform() : data.joint[at(i - 1)] * model.spec().joints[at(i - 1)].after;
}

vpRigidTransform camera(const vpArmModel &model, const vpArmData &data) noexcept
{
  return data.tool * model.spec().camera;
}

vpArmJacobian geometric(const vpArmModel &model, const vpArmData &data, vpArmFrame frame) noexcept
{
  if (frame == vpArmFrame::Base) {
    return data.J;
  }
  Eigen::Matrix3d R;
  Eigen::Vector3d lever;
  view(model, data, frame, R, lever);
  vpArmJacobian J(6, data.size);
  for (int i = 0; i < data.size; ++i) {
    const Eigen::Vector3d w = data.J.col(i).tail<3>();
    J.col(i).head<3>() = R.transpose() * (data.J.col(i).head<3>() + w.cross(lever));
    J.col(i).tail<3>() = R.transpose() * w;
  }
  return J;
}

vpArmJacobian analytic(const vpArmModel &, const vpArmData &data) noexcept
{
  // d(theta u)/dt = J_l^-1(theta u) w with w in the base, and J_l(e) = J_r(-e).
  const Eigen::Matrix3d rate = vpSO3::rightJacobianInverse(-vpSO3::log(data.tool.R));
  vpArmJacobian J(6, data.size);
  for (int i = 0; i < data.size; ++i) {
    J.col(i).head<3>() = data.J.col(i).head<3>();
    J.col(i).tail<3>() = rate * data.J.col(i).tail<3>();
  }
  return J;
}

Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, vpArmMaxJoints>
pointJacobian(const vpArmModel &model, const vpArmData &data, int k) noexcept
{
  Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, vpArmMaxJoints> J(3, data.size);
  const Eigen::Vector3d point = k == data.size ? data.tool.p : data.joint[at(k)].p;
  for (int i = 0; i < data.size; ++i) {
    const Eigen::Vector3d z = axis(data, i);
    if (model.isPrismatic(i)) {
      // A prismatic joint moves the origin of its own frame.
      J.col(i) = i <= k ? z : Eigen::Vector3d::Zero();
    }
    else {
      J.col(i) = i < k ? Eigen::Vector3d(z.cross(point - data.joint[at(i)].p)) : Eigen::Vector3d::Zero();
    }
  }
  return J;
}

Vector6 columnDerivative(const vpArmModel &model, const vpArmData &data, int i, int k) noexcept
{
  Vector6 d = Vector6::Zero();
  if (k <= i) {
    if (!model.isPrismatic(k)) {
      const Eigen::Vector3d z = axis(data, k);
      d.head<3>() = z.cross(data.J.col(i).head<3>());
      d.tail<3>() = z.cross(data.J.col(i).tail<3>());
    }
  }
  else if (!model.isPrismatic(i)) {
    d.head<3>() = axis(data, i).cross(data.J.col(k).head<3>());
  }
  return d;
}

vpArmJacobian derivative(const vpArmModel &model, const vpArmData &data, int k, vpArmFrame frame) noexcept
{
  vpArmJacobian D(6, data.size);
  Eigen::Matrix3d R;
  Eigen::Vector3d lever;
  view(model, data, frame, R, lever);
  const Eigen::Vector3d turn = data.J.col(k).tail<3>(); // angular velocity of the frame for q'_k = 1
  for (int i = 0; i < data.size; ++i) {
    const Vector6 d = columnDerivative(model, data, i, k);
    const Eigen::Vector3d w = data.J.col(i).tail<3>(), dw = d.tail<3>();
    if (frame == vpArmFrame::Base) {
      D.col(i) = d;
      continue;
    }
    const Eigen::Vector3d v = data.J.col(i).head<3>() + w.cross(lever);
    const Eigen::Vector3d dv = d.head<3>() + dw.cross(lever) + w.cross(turn.cross(lever));
    // The frame rotates as well: d(R^T a) = R^T (da - turn x a).
    D.col(i).head<3>() = R.transpose() * (dv - turn.cross(v));
    D.col(i).tail<3>() = R.transpose() * (dw - turn.cross(w));
  }
  return D;
}

vpArmJacobian timeDerivative(const vpArmModel &model, const vpArmData &data, const vpJointVector &velocity,
                             vpArmFrame frame) noexcept
{
  vpArmJacobian D = vpArmJacobian::Zero(6, data.size);
  if (velocity.size() != data.size || !vpIsPlausibleForArm(velocity)) {
    return D.setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  for (int k = 0; k < data.size; ++k) {
    D += velocity(k) * derivative(model, data, k, frame);
  }
  return D;
}
} // namespace vpArmKinematics

END_VISP_NAMESPACE
