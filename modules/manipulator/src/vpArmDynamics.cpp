/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/core/vpException.h>
#include <visp3/manipulator/vpArmDynamics.h>

#include <kdl/chain.hpp>
#include <kdl/chaindynparam.hpp>

#include <Eigen/Cholesky>

BEGIN_VISP_NAMESPACE

namespace
{
KDL::Frame frame(const vpRigidTransform &T)
{
  return {
      KDL::Rotation(T.R(0, 0), T.R(0, 1), T.R(0, 2), T.R(1, 0), T.R(1, 1), T.R(1, 2), T.R(2, 0), T.R(2, 1), T.R(2, 2)),
      KDL::Vector(T.p(0), T.p(1), T.p(2))};
}

// KDL wants the body in the frame at the end of the segment, and moments about the centre of mass.
KDL::RigidBodyInertia body(const vpArmLinkSpec &link, const vpRigidTransform &endMlink)
{
  const Eigen::Vector3d com = endMlink.R * link.com + endMlink.p;
  const Eigen::Matrix3d I = endMlink.R * link.inertia * endMlink.R.transpose();
  return KDL::RigidBodyInertia(link.mass, KDL::Vector(com(0), com(1), com(2)),
                               KDL::RotationalInertia(I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2)));
}

KDL::Chain chainOf(const vpArmModel &model)
{
  KDL::Chain chain;
  const vpArmSpec &spec = model.spec();
  chain.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::None), frame(spec.joints.front().before)));
  for (std::size_t i = 0; i < spec.joints.size(); ++i) {
    const vpRigidTransform next = i + 1 < spec.joints.size() ? spec.joints[i + 1].before : vpRigidTransform();
    const KDL::Joint::JointType type =
        spec.joints[i].type == vpJointType::Prismatic ? KDL::Joint::TransZ : KDL::Joint::RotZ;
    chain.addSegment(
        KDL::Segment(KDL::Joint(type), frame(spec.joints[i].after * next), body(spec.links[i], next.inverse())));
  }
  return chain;
}
} // namespace

class vpArmDynamics::Impl
{
public:
  Impl(const vpArmModel &model, const Eigen::Vector3d &gravity)
    : n(model.size()), offset(n), rotor(n), chain(chainOf(model)),
      solver(chain, KDL::Vector(gravity(0), gravity(1), gravity(2))), q(static_cast<unsigned int>(n)),
      v(static_cast<unsigned int>(n)), torque(static_cast<unsigned int>(n)), M(n)
  {
    for (int i = 0; i < n; ++i) {
      offset(i) = model.offset(i);
      rotor(i) = model.spec().joints[static_cast<std::size_t>(i)].rotorInertia;
    }
  }
  [[nodiscard]] bool fits(const vpJointVector &numbers) const
  {
    return numbers.size() == n && vpIsPlausibleForArm(numbers);
  }
  [[nodiscard]] bool take(const vpJointVector &position)
  {
    if (!fits(position)) {
      return false;
    }
    q.data = position + offset;
    return true;
  }
  //! The solver's torque, or zero.
  bool give(bool good, vpJointVector &to) const
  {
    if (!good || !torque.data.allFinite()) {
      to.setZero(n);
      return false;
    }
    to = torque.data;
    return true;
  }

  int n;
  vpJointVector offset, rotor;
  KDL::Chain chain;
  KDL::ChainDynParam solver;
  KDL::JntArray q, v, torque;
  KDL::JntSpaceInertiaMatrix M;
};

vpArmDynamics::vpArmDynamics(const vpArmModel &model, const Eigen::Vector3d &gravity)
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
    m_impl->solver.JntToMass(m_impl->q, m_impl->M);
    M = m_impl->M.data;
    M.diagonal() += m_impl->rotor;
  }
  if (!good || !M.allFinite()) {
    M.setZero(m_impl->n, m_impl->n);
    return false;
  }
  return true;
}

bool vpArmDynamics::coriolis(const vpJointVector &q, const vpJointVector &velocity, vpJointVector &torque)
{
  const bool good = m_impl->take(q) && m_impl->fits(velocity);
  if (good) {
    m_impl->v.data = velocity;
    m_impl->solver.JntToCoriolis(m_impl->q, m_impl->v, m_impl->torque);
  }
  return m_impl->give(good, torque);
}

bool vpArmDynamics::gravity(const vpJointVector &q, vpJointVector &torque)
{
  const bool good = m_impl->take(q);
  if (good) {
    m_impl->solver.JntToGravity(m_impl->q, m_impl->torque);
  }
  return m_impl->give(good, torque);
}

bool vpArmDynamics::acceleration(const vpJointVector &q, const vpJointVector &velocity, const vpJointVector &torque,
                                 vpJointVector &acceleration)
{
  vpJointMatrix M;
  vpJointVector bend, weight;
  if (inertia(q, M) && coriolis(q, velocity, bend) && gravity(q, weight) && m_impl->fits(torque)) {
    const Eigen::LLT<vpJointMatrix> factor(M);
    acceleration = torque - bend - weight;
    factor.solveInPlace(acceleration);
    if (factor.info() == Eigen::Success && acceleration.allFinite()) {
      return true;
    }
  }
  acceleration.setZero(m_impl->n);
  return false;
}

END_VISP_NAMESPACE
