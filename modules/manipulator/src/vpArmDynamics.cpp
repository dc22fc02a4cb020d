/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/core/vpException.h>
#include <visp3/manipulator/vpArmDynamics.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include <array>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
using Eigen::Matrix3d;
using Eigen::Vector3d;

// A body in the moving frame of its joint: its mass, mass times centre of mass, and inertia about the frame's origin.
struct Body {
  double mass = 0.;
  Vector3d moment = Vector3d::Zero();
  Matrix3d inertia = Matrix3d::Zero();

  Body &operator+=(const Body &other)
  {
    mass += other.mass;
    moment += other.moment;
    inertia += other.inertia;
    return *this;
  }
  // The same in the frame before, where this frame is at T.
  [[nodiscard]] Body seenFrom(const vpRigidTransform &T) const
  {
    const Vector3d turned = T.R * moment, p = T.p;
    const Matrix3d outer = turned * p.transpose();
    Body body;
    body.mass = mass;
    body.moment = turned + mass * p;
    body.inertia = T.R * inertia * T.R.transpose() - outer - outer.transpose() - mass * p * p.transpose();
    body.inertia.diagonal().array() += 2. * turned.dot(p) + mass * p.squaredNorm();
    return body;
  }
};

// Force and moment about the origin of a frame.
struct Wrench {
  Vector3d force, moment;
  [[nodiscard]] Wrench seenFrom(const vpRigidTransform &T) const
  {
    const Vector3d f = T.R * force;
    return {f, T.R * moment + T.p.cross(f)};
  }
  // Its component along the joint's axis, z.
  [[nodiscard]] double along(bool isPrismatic) const { return isPrismatic ? force.z() : moment.z(); }
};
} // namespace

class vpArmDynamics::Impl
{
public:
  Impl(const vpArmModel &model, const Vector3d &fall)
    : arm(model), n(model.size()), links(model.links()), rotor(n), gravity(fall)
  {
    for (int i = 0; i < n; ++i) {
      rotor(i) = model.spec().joints[static_cast<std::size_t>(i)].rotorInertia;
    }
    for (int k = 0; k < links; ++k) {
      const vpArmLinkSpec &link = model.spec().links[at(k)];
      const vpRigidTransform &after = model.chain(k).after;
      const Vector3d com = after.R * link.com + after.p;
      bodies[at(k)] = {link.mass, link.mass * com,
                       after.R * link.inertia * after.R.transpose() +
                           link.mass * (com.squaredNorm() * Matrix3d::Identity() - com * com.transpose())};
    }
  }
  [[nodiscard]] bool fits(const vpJointVector &numbers) const
  {
    return numbers.size() == n && vpIsPlausibleForArm(numbers);
  }
  // Places each joint's frame in the one before.
  [[nodiscard]] bool take(const vpJointVector &position)
  {
    if (!fits(position)) {
      return false;
    }
    const vpJointVector q = arm.coordinates(position);
    for (int k = 0; k < links; ++k) {
      const vpArmChainJoint &joint = arm.chain(k);
      vpRigidTransform &T = frames[at(k)];
      T = joint.step;
      if (joint.isPrismatic) {
        T.p += q(k) * T.R.col(2);
      }
      else {
        const double c = std::cos(q(k)), s = std::sin(q(k));
        T.R.col(0) = c * joint.step.R.col(0) + s * joint.step.R.col(1);
        T.R.col(1) = c * joint.step.R.col(1) - s * joint.step.R.col(0);
      }
    }
    return true;
  }
  // Torques of the chain's coordinates at velocity v and without acceleration of the joints, the base accelerating by a
  // (gravity: upwards): recursive Newton-Euler.
  void newtonEuler(const vpJointVector &v, Vector3d a, vpJointVector &torque) const
  {
    std::array<Wrench, vpArmMaxJoints> wrenches;
    Vector3d w = Vector3d::Zero(), dw = w;
    for (int k = 0; k < links; ++k) {
      const auto &[R, p] = frames[at(k)];
      const Body &body = bodies[at(k)];
      a = R.transpose() * (a + dw.cross(p) + w.cross(w.cross(p)));
      w = R.transpose() * w;
      dw = R.transpose() * dw;
      const Vector3d across(w.y() * v(k), -w.x() * v(k), 0.); // of w and the joint's velocity
      if (arm.chain(k).isPrismatic) {
        a += 2. * across;
      }
      else {
        dw += across;
        w.z() += v(k);
      }
      wrenches[at(k)] = {body.mass * a + dw.cross(body.moment) + w.cross(w.cross(body.moment)),
                         body.inertia * dw + w.cross(body.inertia * w) + body.moment.cross(a)};
    }
    for (int k = links - 1; k >= 0; --k) {
      torque(k) = wrenches[at(k)].along(arm.chain(k).isPrismatic);
      if (k > 0) {
        const Wrench passed = wrenches[at(k)].seenFrom(frames[at(k)]);
        wrenches[at(k - 1)].force += passed.force;
        wrenches[at(k - 1)].moment += passed.moment;
      }
    }
  }
  //! The same of the joints, with what their followers pass on; or zero.
  bool giveTorque(bool good, const vpJointVector &velocity, const Vector3d &base, vpJointVector &to) const
  {
    to.setZero(n);
    if (!good || !fits(velocity)) {
      return false;
    }
    vpJointVector torque(links);
    newtonEuler(arm.changes(velocity), base, torque);
    if (!torque.allFinite()) {
      return false;
    }
    for (int k = 0; k < links; ++k) {
      to(arm.chain(k).joint) += arm.chain(k).ratio * torque(k);
    }
    return true;
  }
  //! C^T M C, where C are the ratios of the chain's coordinates to the joints: composite rigid bodies.
  void giveInertia(vpJointMatrix &to) const
  {
    to = rotor.asDiagonal();
    Body all;
    for (int k = links - 1; k >= 0; --k) {
      const vpArmChainJoint &own = arm.chain(k);
      all += bodies[at(k)];
      // What accelerates all links from k on by one unit.
      Wrench wrench = own.isPrismatic ? Wrench{{0., 0., all.mass}, {all.moment.y(), -all.moment.x(), 0.}}
                                      : Wrench{{-all.moment.y(), all.moment.x(), 0.}, all.inertia.col(2)};
      to(own.joint, own.joint) += own.ratio * own.ratio * wrench.along(own.isPrismatic);
      for (int i = k; i > 0; --i) {
        wrench = wrench.seenFrom(frames[at(i)]);
        const vpArmChainJoint &inner = arm.chain(i - 1);
        const double m = own.ratio * inner.ratio * wrench.along(inner.isPrismatic);
        to(own.joint, inner.joint) += m;
        to(inner.joint, own.joint) += m;
      }
      if (k > 0) {
        all = all.seenFrom(frames[at(k)]);
      }
    }
  }
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }

  vpArmModel arm;
  int n, links;
  vpJointVector rotor;
  Vector3d gravity;
  std::array<Body, vpArmMaxJoints> bodies;
  std::array<vpRigidTransform, vpArmMaxJoints> frames;
};

vpArmDynamics::vpArmDynamics(const vpArmModel &model, const Vector3d &gravity)
{
  if (!model.hasMasses()) {
    for (const vpArmLinkSpec &link : model.spec().links) {
      if (!link.hasMass) {
        throw vpException(vpException::badValue, "%s: link %s has no mass, the dynamics need one",
                          model.label().c_str(), link.name.c_str());
      }
    }
    throw vpException(vpException::badValue, "%s: the links are missing, the dynamics need their masses",
                      model.label().c_str());
  }
  m_impl = std::make_unique<Impl>(model, gravity);
}

vpArmDynamics::~vpArmDynamics() = default;
vpArmDynamics::vpArmDynamics(vpArmDynamics &&) noexcept = default;
vpArmDynamics &vpArmDynamics::operator=(vpArmDynamics &&) noexcept = default;

bool vpArmDynamics::inertia(const vpJointVector &q, vpJointMatrix &M)
{
  const bool good = m_impl->take(q);
  if (good) {
    m_impl->giveInertia(M);
  }
  if (!good || !M.allFinite()) {
    M.setZero(m_impl->n, m_impl->n);
    return false;
  }
  return true;
}

bool vpArmDynamics::coriolis(const vpJointVector &q, const vpJointVector &velocity, vpJointVector &torque)
{
  return m_impl->giveTorque(m_impl->take(q), velocity, Vector3d::Zero(), torque);
}

bool vpArmDynamics::gravity(const vpJointVector &q, vpJointVector &torque)
{
  return m_impl->giveTorque(m_impl->take(q), vpJointVector::Zero(m_impl->n), -m_impl->gravity, torque);
}

bool vpArmDynamics::acceleration(const vpJointVector &q, const vpJointVector &velocity, const vpJointVector &torque,
                                 vpJointVector &acceleration)
{
  vpJointMatrix M;
  vpJointVector bias;
  if (inertia(q, M) && m_impl->giveTorque(true, velocity, -m_impl->gravity, bias) && m_impl->fits(torque)) {
    const Eigen::LLT<vpJointMatrix> factor(M);
    acceleration = torque - bias;
    factor.solveInPlace(acceleration);
    if (factor.info() == Eigen::Success && acceleration.allFinite()) {
      return true;
    }
  }
  acceleration.setZero(m_impl->n);
  return false;
}

END_VISP_NAMESPACE
