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
  chain.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::None), frame(model.chain(0).step)));
  for (int k = 0; k < model.links(); ++k) {
    const vpArmChainJoint &own = model.chain(k);
    const vpRigidTransform end = k + 1 < model.links() ? model.chain(k + 1).step : own.after;
    chain.addSegment(KDL::Segment(KDL::Joint(own.isPrismatic ? KDL::Joint::TransZ : KDL::Joint::RotZ), frame(end),
                                  body(model.spec().links[static_cast<std::size_t>(k)], end.inverse() * own.after)));
  }
  return chain;
}
} // namespace

class vpArmDynamics::Impl
{
public:
  Impl(const vpArmModel &model, const Eigen::Vector3d &gravity)
    : arm(model), n(model.size()), rotor(n), chain(chainOf(model)),
      solver(chain, KDL::Vector(gravity(0), gravity(1), gravity(2))), q(chain.getNrOfJoints()),
      v(chain.getNrOfJoints()), torque(chain.getNrOfJoints()), M(static_cast<int>(chain.getNrOfJoints()))
  {
    for (int i = 0; i < n; ++i) {
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
    q.data = arm.coordinates(position);
    return true;
  }
  //! The torques of the joints, with those that their followers pass on, or zero.
  bool give(bool good, vpJointVector &to) const
  {
    if (!good || !torque.data.allFinite()) {
      to.setZero(n);
      return false;
    }
    to.setZero(n);
    for (int k = 0; k < arm.links(); ++k) {
      to(arm.chain(k).joint) += arm.chain(k).ratio * torque.data(k);
    }
    return true;
  }
  //! C^T M C, where C are the ratios of the chain's coordinates to the joints.
  void giveInertia(vpJointMatrix &to) const
  {
    to = rotor.asDiagonal();
    for (int a = 0; a < arm.links(); ++a) {
      for (int b = 0; b < arm.links(); ++b) {
        to(arm.chain(a).joint, arm.chain(b).joint) += arm.chain(a).ratio * arm.chain(b).ratio * M.data(a, b);
      }
    }
  }

  vpArmModel arm;
  int n;
  vpJointVector rotor;
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
  const bool good = m_impl->take(q) && m_impl->fits(velocity);
  if (good) {
    m_impl->v.data = m_impl->arm.changes(velocity);
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
