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

Eigen::Vector3d axis(const vpArmData &data, int k) { return data.joint[at(k)].R.col(2); }

// Axes in which a velocity is expressed, its reference point in the base, and the number of links that move it.
struct View {
  Eigen::Matrix3d R;
  Eigen::Vector3d point;
  int links;
};

View view(const vpArmModel &model, const vpArmData &data, vpArmFrame frame)
{
  if (frame == vpArmFrame::Camera) {
    const vpRigidTransform fMc = vpArmKinematics::camera(model, data);
    return {fMc.R, fMc.p, model.cameraLink()};
  }
  return {frame == vpArmFrame::Base ? Eigen::Matrix3d(Eigen::Matrix3d::Identity()) : data.tool.R, data.tool.p,
          model.toolLink()};
}

// Velocity of a point behind joint or follower k, per unit of its coordinate.
Vector6 column(const vpArmModel &model, const vpArmData &data, int k, const Eigen::Vector3d &point)
{
  Vector6 column;
  const Eigen::Vector3d z = axis(data, k);
  if (model.chain(k).isPrismatic) {
    column << z, Eigen::Vector3d::Zero();
  }
  else {
    column << z.cross(point - data.joint[at(k)].p), z;
  }
  return column;
}

// Derivative of column(i) by coordinate k of the chain: a revolute k <= i rotates it; for a revolute i < k the lever
// arm changes by column(k).
Vector6 derivativeOf(const vpArmModel &model, const vpArmData &data, int i, int k, const Eigen::Vector3d &point)
{
  Vector6 d = Vector6::Zero();
  if (k <= i) {
    if (!model.chain(k).isPrismatic) {
      const Eigen::Vector3d z = axis(data, k);
      const Vector6 c = column(model, data, i, point);
      d.head<3>() = z.cross(c.head<3>());
      d.tail<3>() = z.cross(c.tail<3>());
    }
  }
  else if (!model.chain(i).isPrismatic) {
    d.head<3>() = axis(data, i).cross(column(model, data, k, point).head<3>());
  }
  return d;
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
  for (int k = 0; k < model.links(); ++k) {
    const vpArmChainJoint &own = model.chain(k);
    now = k == 0 ? own.step : now * own.step;
    const double coordinate = own.ratio * q(own.joint) + own.offset;
    if (own.isPrismatic) {
      now.p += coordinate * now.R.col(2);
    }
    else {
      const double c = std::cos(coordinate), s = std::sin(coordinate);
      const Eigen::Vector3d x = now.R.col(0);
      now.R.col(0) = c * x + s * now.R.col(1);
      now.R.col(1) = c * now.R.col(1) - s * x;
    }
    data.joint[at(k)] = now;
  }
  data.tool = data.joint[at(model.toolLink() - 1)] * model.toolStep();
  return true;
}

void jacobian(const vpArmModel &model, vpArmData &data) noexcept
{
  data.J.setZero(6, data.size);
  for (int k = 0; k < model.toolLink(); ++k) {
    data.J.col(model.chain(k).joint) += model.chain(k).ratio * column(model, data, k, data.tool.p);
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
  return i == 0 ? vpRigidTransform() : data.joint[at(i - 1)] * model.chain(i - 1).after;
}

vpRigidTransform camera(const vpArmModel &model, const vpArmData &data) noexcept
{
  const int carrier = model.spec().cameraLink;
  return (carrier < 0 ? data.tool : link(model, data, carrier)) * model.spec().camera;
}

vpArmJacobian geometric(const vpArmModel &model, const vpArmData &data, vpArmFrame frame) noexcept
{
  if (frame == vpArmFrame::Base) {
    return data.J;
  }
  const View to = view(model, data, frame);
  vpArmJacobian J = vpArmJacobian::Zero(6, data.size);
  for (int k = 0; k < to.links; ++k) {
    const vpArmChainJoint &own = model.chain(k);
    const Vector6 c = column(model, data, k, to.point);
    J.col(own.joint).head<3>() += own.ratio * (to.R.transpose() * c.head<3>());
    J.col(own.joint).tail<3>() += own.ratio * (to.R.transpose() * c.tail<3>());
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
  J.setZero();
  const bool isTool = k == model.links();
  const Eigen::Vector3d point = isTool ? data.tool.p : data.joint[at(k)].p;
  const int last = isTool ? model.toolLink() - 1 : k; // a joint moves the origin of its own frame if it is prismatic
  for (int i = 0; i <= last; ++i) {
    J.col(model.chain(i).joint) += model.chain(i).ratio * column(model, data, i, point).head<3>();
  }
  return J;
}

vpArmJacobian derivative(const vpArmModel &model, const vpArmData &data, int k, vpArmFrame frame) noexcept
{
  vpArmJacobian D = vpArmJacobian::Zero(6, data.size);
  const View to = view(model, data, frame);
  for (int b = 0; b < to.links; ++b) {
    if (model.chain(b).joint != k) {
      continue;
    }
    const Eigen::Vector3d turn = model.chain(b).isPrismatic ? Eigen::Vector3d(Eigen::Vector3d::Zero()) : axis(data, b);
    for (int a = 0; a < to.links; ++a) {
      const double ratio = model.chain(a).ratio * model.chain(b).ratio;
      Vector6 d = ratio * derivativeOf(model, data, a, b, to.point);
      if (frame != vpArmFrame::Base) { // which rotates as well: d(R^T a) = R^T (da - turn x a)
        const Vector6 c = ratio * column(model, data, a, to.point);
        d.head<3>() = (to.R.transpose() * (d.head<3>() - turn.cross(c.head<3>()))).eval();
        d.tail<3>() = (to.R.transpose() * (d.tail<3>() - turn.cross(c.tail<3>()))).eval();
      }
      D.col(model.chain(a).joint) += d;
    }
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
