/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// M, C and g against chains of KDL that are made straight from the table and from the URDF, and against energy.
#include "vpKdlTestKit.h"
#include "vpCatch.h"

#include <visp3/direct_core/vpSO3.h>
#include <visp3/manipulator/vpArmDynamics.h>

#include <kdl/chaindynparam.hpp>

#include <Eigen/Eigenvalues>

using namespace vpArmTestKit;

namespace
{
void compareWithKDL(const vpArmModel &model, const KDL::Chain &chain, unsigned int stream)
{
  auto rng = vpTestSupport::generator(stream);
  CAPTURE(vpTestSupport::seed(), model.label());
  KDL::ChainDynParam oracle(chain, KDL::Vector(0., 0., -9.81));
  const unsigned int n = chain.getNrOfJoints();
  KDL::JntArray q(n), v(n), torque(n);
  KDL::JntSpaceInertiaMatrix inertia(static_cast<int>(n));
  vpArmDynamics dynamics(model);
  for (int problem = 0; problem < 2000; ++problem) {
    const vpJointVector at = configuration(model, rng), velocity = randomVector(model.size(), rng);
    q.data = at;
    v.data = velocity;
    vpJointMatrix M;
    dynamics.inertia(at, M);
    oracle.JntToMass(q, inertia);
    for (int i = 0; i < model.size(); ++i) {
      M(i, i) -= model.spec().joints[static_cast<std::size_t>(i)].rotorInertia;
    }
    REQUIRE((M - inertia.data).cwiseAbs().maxCoeff() < 1e-10);
    vpJointVector term;
    dynamics.coriolis(at, velocity, term);
    oracle.JntToCoriolis(q, v, torque);
    REQUIRE((term - torque.data).cwiseAbs().maxCoeff() < 1e-10);
    dynamics.gravity(at, term);
    oracle.JntToGravity(q, torque);
    REQUIRE((term - torque.data).cwiseAbs().maxCoeff() < 1e-10);
  }
}

// Height of all centres of mass times m g.
double potential(const vpArmModel &model, const vpJointVector &q)
{
  vpArmData data;
  vpArmKinematics::forward(model, q, data);
  double energy = 0.;
  for (int i = 1; i <= model.links(); ++i) {
    const vpArmLinkSpec &link = model.spec().links[static_cast<std::size_t>(i - 1)];
    const vpRigidTransform frame = vpArmKinematics::link(model, data, i);
    energy += 9.81 * link.mass * (frame.R * link.com + frame.p)(2);
  }
  return energy;
}
// Energy of all links that move by finite differences of their frames, and of the rotors.
double kinetic(const vpArmModel &model, const vpJointVector &q, const vpJointVector &v)
{
  const double h = 1e-6;
  vpArmData before, after;
  vpArmKinematics::forward(model, q - h * v, before);
  vpArmKinematics::forward(model, q + h * v, after);
  double energy = 0.;
  for (int i = 1; i <= model.links(); ++i) {
    const vpArmLinkSpec &link = model.spec().links[static_cast<std::size_t>(i - 1)];
    const vpRigidTransform a = vpArmKinematics::link(model, before, i), b = vpArmKinematics::link(model, after, i);
    const Eigen::Vector3d speed = (b.R * link.com + b.p - a.R * link.com - a.p) / (2. * h);
    const Eigen::Vector3d turn = vpSO3::log(a.R.transpose() * b.R) / (2. * h);
    energy += 0.5 * link.mass * speed.squaredNorm() + 0.5 * turn.dot(link.inertia * turn);
  }
  for (int i = 0; i < model.size(); ++i) {
    energy += 0.5 * model.spec().joints[static_cast<std::size_t>(i)].rotorInertia * v(i) * v(i);
  }
  return energy;
}
} // namespace

TEST_CASE("AMOR's dynamics are KDL's", "[dynamics]") { compareWithKDL(amor(), kdlAmor(), 11); }
TEST_CASE("The dynamics of the six axes are KDL's", "[dynamics]") { compareWithKDL(sixAxes(), kdlSixAxes(), 12); }

TEST_CASE("Gravity is the gradient of the height, and a free arm keeps its energy", "[dynamics]")
{
  auto rng = vpTestSupport::generator(13);
  CAPTURE(vpTestSupport::seed());
  for (const vpArmModel &arm : fixedAndLinkedArms(rng)) {
    const vpArmModel *model = &arm;
    CAPTURE(model->label());
    vpArmDynamics dynamics(*model);
    const int n = model->size();
    for (int problem = 0; problem < (arm.spec().followers.empty() ? 200 : 10); ++problem) {
      const vpJointVector q = configuration(*model, rng), v = randomVector(n, rng);
      vpJointVector torque(n), expected(n), acceleration;
      dynamics.gravity(q, torque);
      const double h = 1e-5;
      for (int i = 0; i < n; ++i) {
        vpJointVector a = q, b = q;
        a(i) -= h;
        b(i) += h;
        expected(i) = (potential(*model, b) - potential(*model, a)) / (2. * h);
      }
      REQUIRE((torque - expected).cwiseAbs().maxCoeff() < 1e-6);
      vpJointMatrix M, before, after;
      dynamics.inertia(q, M);
      REQUIRE(M.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff() > 0.);
      REQUIRE(0.5 * v.dot(M * v) == Approx(kinetic(*model, q, v)).epsilon(1e-6));
      // d/dt (v' M v / 2 + V) = 0 without a torque.
      REQUIRE(dynamics.acceleration(q, v, vpJointVector::Zero(n), acceleration));
      dynamics.inertia(q - h * v, before);
      dynamics.inertia(q + h * v, after);
      const double power = v.dot(M * acceleration) + 0.25 / h * v.dot((after - before) * v) + v.dot(torque);
      REQUIRE(std::fabs(power) < 1e-6);
    }
  }
}

TEST_CASE("Dynamics want masses, and do not allocate", "[dynamics]")
{
  vpArmSpec spec = amor().spec();
  spec.source.clear();
  spec.links[2].hasMass = false;
  CHECK_THROWS_WITH(vpArmDynamics(vpArmModel(spec)),
                    Catch::Contains("arm AMOR") || Catch::Contains("AMOR: link link3 has no mass"));
  spec.links.clear();
  CHECK_THROWS_WITH(vpArmDynamics(vpArmModel(spec)), Catch::Contains("AMOR: the links are missing"));
  vpArmDynamics dynamics(amor());
  const vpJointVector q = home();
  vpJointVector torque, acceleration;
  static_cast<void>(dynamics.acceleration(q, q, q, acceleration));
  const unsigned long before = vpTestSupport::allocationCount();
  dynamics.gravity(q, torque);
  CHECK(vpTestSupport::allocationCount() == before);
  static_cast<void>(dynamics.acceleration(q, q, q, acceleration));
  CHECK(vpTestSupport::allocationCount() == before);
}
