/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Arms with fewer joints than commanded axes: what they do, which axis they name, and free axes.
#include "vpCatch.h"
#include "vpSolverTestKit.h"

#include <visp3/core/vpException.h>
#include <visp3/manipulator/vpClosedLoopKinematics.h>
#include <visp3/manipulator/vpTwistAxes.h>

#include <Eigen/SVD>

#include <bitset>

using namespace vpSolverTestKit;

namespace
{
// An arm with random links and joints that are never at a limit.
vpArmModel randomArm(int n, std::mt19937_64 &rng)
{
  vpArmSpec spec;
  spec.name = "random";
  for (int i = 0; i < n; ++i) {
    vpArmJointSpec joint = vpArmJointSpec::standardDH(uniform(rng, 0., 0.4), uniform(rng, -pi, pi),
                                                      uniform(rng, -0.3, 0.3), uniform(rng, -pi, pi));
    joint.name = "j" + std::to_string(i);
    joint.lower = -50.;
    joint.upper = 50.;
    joint.velocity = joint.acceleration = 1e5;
    if (i > 0 && uniform(rng, 0., 1.) < 0.2) {
      joint.type = vpJointType::Prismatic;
    }
    spec.joints.push_back(joint);
  }
  spec.camera.R = Eigen::AngleAxisd(uniform(rng, -3., 3.), Eigen::Vector3d(1., 2., -1.).normalized()).matrix();
  spec.camera.p << 0.05, -0.02, 0.1;
  return vpArmModel(spec);
}

// Base, three parallel revolute axes and a prismatic one: translations and the rotation about z.
vpArmModel scara()
{
  vpArmSpec spec;
  spec.name = "scara";
  for (int i = 0; i < 4; ++i) {
    vpArmJointSpec joint = vpArmJointSpec::standardDH(i < 2 ? 0.3 : 0., 0., 0., 0.);
    joint.name = "s" + std::to_string(i);
    joint.type = i == 3 ? vpJointType::Prismatic : vpJointType::Revolute;
    joint.lower = i == 3 ? 0. : -2.5;
    joint.upper = i == 3 ? 0.2 : 2.5;
    joint.velocity = joint.acceleration = 100.;
    spec.joints.push_back(joint);
  }
  return vpArmModel(spec);
}

vpRedundancyInput ofCamera(int n, const Vector6 &twist) { return input(n, twist, vpArmFrame::Camera); }

// Jacobian of the camera in the scaled units of the solver.
Eigen::MatrixXd scaled(const vpArmModel &model, const vpArmData &data, double length)
{
  Eigen::MatrixXd J = vpArmKinematics::geometric(model, data, vpArmFrame::Camera);
  J.bottomRows<3>() *= length;
  return J;
}

} // namespace

TEST_CASE("Axes have names", "[axes]")
{
  CHECK(vpFreeAxes({}) == std::array<bool, 6>{});
  CHECK(vpFreeAxes({"rz"}) == std::array<bool, 6>{false, false, false, false, false, true});
  CHECK(vpFreeAxes({"ry", "x"}) == std::array<bool, 6>{true, false, false, false, true, false});
  CHECK_THROWS_WITH(vpFreeAxes({"rz", "yaw"}), "free axis \"yaw\" is unknown, must be x, y, z, rx, ry or rz");
  CHECK_THROWS_WITH(vpFreeAxes({"rz", "rz"}), "free axis \"rz\" is named twice");
  CHECK_THROWS_WITH(vpFreeAxes({"x", "y", "z", "rx", "ry", "rz"}),
                    "all six axes are free, at least one must be commanded");
  CHECK(vpAxesInWords(0).empty());
  CHECK(vpAxesInWords(1U << 4) == "rotation about y");
  CHECK(vpAxesInWords(0xffffff81U) == "translation along x");
  CHECK(vpAxesInWords(vpFreeAxes({"rz"})) == "rotation about z");
  CHECK(vpAxesInWords(1U << 2 | 1U << 3) == "translation along z, rotation about x");
}

TEST_CASE("An arm of fewer than six joints does its best and names axes without which it does all", "[axes]")
{
  auto rng = vpTestSupport::generator(101);
  CAPTURE(vpTestSupport::seed());
  int least = 0, freed = 0;
  for (int problem = 0; problem < 600; ++problem) {
    const int n = 1 + problem % 5;
    const vpArmModel model = randomArm(n, rng);
    vpRedundancySpec spec;
    spec.singularRegion = 1e-3;
    const vpRedundancySolver solver(model, spec);
    const vpArmData data = at(model, 0.99 * configuration(model, rng)); // away from the limits, which stop joints
    const Eigen::MatrixXd J = scaled(model, data, spec.taskLength);
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(J, Eigen::ComputeFullU | Eigen::ComputeFullV);
    if (svd.singularValues()(n - 1) < 2e-3) {
      continue;
    }
    const Vector6 twist = randomTwist(rng);
    vpRedundancyInput in = ofCamera(n, twist);
    vpRedundancyOutput out;
    solver.step(data, in, out);
    Vector6 wish = twist;
    wish.tail<3>() *= spec.taskLength;
    CAPTURE(n, out.message(), svd.singularValues().transpose());
    const Eigen::VectorXd best = svd.solve(wish);
    REQUIRE((out.velocity - best).norm() < 1e-6 * (1. + best.norm())); // least squares
    REQUIRE(out.status == vpRedundancyStatus::AxisUnreachable);
    REQUIRE(out.smallestSingular <= svd.singularValues()(n - 1) + 1e-9);
    REQUIRE(std::bitset<32>(out.unreachableAxes).count() == static_cast<std::size_t>(6 - n));
    REQUIRE(std::string(out.message()).find("cannot be commanded in this configuration") != std::string::npos);
    if (n == 5) { // that of the direction that no joint moves
      Eigen::Index axis = 0;
      Vector6 u = svd.matrixU().col(5).cwiseAbs();
      u.tail<3>() *= 2.; // rotations are preferred
      u.maxCoeff(&axis);
      REQUIRE(out.unreachableAxes == 1U << axis);
    }
    ++least;

    // A twist that the joints can do is done, and no fault is found with it.
    const Vector6 possible = J * randomVector(n, rng);
    vpRedundancyInput easy = ofCamera(n, possible);
    for (std::size_t k = 3; k < 6; ++k) {
      easy.twist[k] /= spec.taskLength;
    }
    solver.step(data, easy, out);
    REQUIRE(out.status == vpRedundancyStatus::Exact);

    const unsigned int axes = out.unreachableAxes;
    for (std::size_t k = 0; k < 6; ++k) {
      in.free[k] = (axes >> k & 1U) != 0U;
    }
    solver.step(data, in, out);
    REQUIRE(out.unreachableAxes == 0U);
    REQUIRE(out.status != vpRedundancyStatus::AxisUnreachable);
    if (out.smallestSingular > 1e-3) {
      ++freed;
      Vector6 missed = scaled(model, data, spec.taskLength) * out.velocity - wish;
      for (int k = 0; k < 6; ++k) {
        missed(k) = (axes >> k & 1U) != 0U ? 0. : missed(k);
      }
      REQUIRE(out.status == vpRedundancyStatus::Exact);
      REQUIRE(missed.norm() < 1e-7);
    }
  }
  CHECK(least > 300);
  CHECK(freed > 250);
}

// The arm cut off behind the camera says what must come out.
TEST_CASE("Joints behind the camera do not move it and are left to their own wishes", "[axes]")
{
  auto rng = vpTestSupport::generator(105);
  CAPTURE(vpTestSupport::seed());
  for (int problem = 0; problem < 300; ++problem) {
    const int n = 7, carrier = 1 + problem % 6;
    vpArmSpec spec = randomArm(n, rng).spec();
    spec.cameraLink = carrier;
    const vpArmModel model(spec);
    spec.joints.resize(static_cast<std::size_t>(carrier));
    spec.cameraLink = -1;
    const vpArmModel cut(spec);
    vpRedundancySpec redundancy;
    redundancy.singularRegion = 1e-3;
    const vpRedundancySolver solver(model, redundancy), alone(cut, redundancy);
    const vpJointVector q = configuration(model, rng);
    const vpArmData data = at(model, q), dataCut = at(cut, q.head(carrier));
    if (scaled(cut, dataCut, redundancy.taskLength).jacobiSvd().singularValues()(carrier - 1) < 2e-3) {
      continue;
    }
    vpRedundancyInput in = ofCamera(n, randomTwist(rng)), inCut = in;
    inCut.previous = vpJointVector::Zero(carrier);
    vpRedundancyOutput out, expected;
    solver.step(data, in, out);
    alone.step(dataCut, inCut, expected);
    CAPTURE(problem, carrier, out.message(), expected.message());
    REQUIRE(out.status == expected.status);
    REQUIRE(out.unreachableAxes == expected.unreachableAxes);
    REQUIRE((carrier >= 6 || out.status == vpRedundancyStatus::AxisUnreachable));
    REQUIRE((out.velocity.head(carrier) - expected.velocity).norm() < 1e-9 * (1. + expected.velocity.norm()));
    REQUIRE(out.velocity.tail(n - carrier).norm() < 1e-9);

    in.indices[0] = vpSelfMotionIndex::posture(vpJointVector::Zero(n));
    in.indexCount = 1;
    solver.step(data, in, out);
    REQUIRE((out.velocity.head(carrier) - expected.velocity).norm() < 1e-9 * (1. + expected.velocity.norm()));
    REQUIRE(out.velocity.tail(n - carrier).dot(q.tail(n - carrier)) < 0.);
  }
}

TEST_CASE("What counts is the rank of the commanded axes, not the number of joints", "[axes]")
{
  auto rng = vpTestSupport::generator(102);
  CAPTURE(vpTestSupport::seed());
  const vpArmModel model = scara();
  vpRedundancySpec spec;
  spec.singularRegion = 0.01;
  const vpRedundancySolver solver(model, spec);
  for (int problem = 0; problem < 200; ++problem) {
    vpJointVector q = configuration(model, rng, 0.2);
    q(1) = std::copysign(std::max(0.3, std::fabs(q(1))), q(1));
    const vpArmData data = at(model, q);
    vpRedundancyInput in = ofCamera(4, 0.1 * randomTwist(rng));
    vpRedundancyOutput out;
    in.free = vpFreeAxes({"rx", "ry"});
    solver.step(data, in, out);
    REQUIRE(out.unreachableAxes == 0U);
    REQUIRE((out.status == vpRedundancyStatus::Exact || out.status == vpRedundancyStatus::Accelerating));
    in.free = vpFreeAxes({"ry", "rz"}); // four joints, four axes, one of which none of them moves
    solver.step(data, in, out);
    REQUIRE(out.unreachableAxes == 1U << 3);
    REQUIRE(out.status == vpRedundancyStatus::AxisUnreachable);
    REQUIRE(std::string(out.message()).find("Rotation about x") == 0);
  }
}

TEST_CASE("An arm with enough joints never lacks an axis, not even at a singularity", "[axes]")
{
  auto rng = vpTestSupport::generator(103);
  CAPTURE(vpTestSupport::seed());
  for (int problem = 0; problem < 1000; ++problem) {
    const vpArmModel &model = problem % 2 == 0 ? amor() : sixAxes();
    vpJointVector q = configuration(model, rng);
    q(model.size() - 2) = 0.;
    vpRedundancyOutput out;
    vpRedundancySolver(model).step(at(model, q), ofCamera(model.size(), randomTwist(rng)), out);
    REQUIRE(out.unreachableAxes == 0U);
    REQUIRE(out.status != vpRedundancyStatus::AxisUnreachable);
  }
}

TEST_CASE("A pose with a free axis is reached by five joints; without, the reason is given", "[axes]")
{
  auto rng = vpTestSupport::generator(104);
  CAPTURE(vpTestSupport::seed());
  vpArmSpec five = sixAxes().spec(); // without the roll of the flange
  five.joints.pop_back();
  five.links.clear();
  five.capsules.clear();
  five.bodies.clear();
  five.shapes.clear();
  five.home.resize(0);
  five.tool = vpRigidTransform();
  const vpArmModel model(five);
  vpClosedLoopKinematics loop(model);
  int reached = 0, stopped = 0, tried = 0;
  for (int problem = 0; problem < 30; ++problem) {
    const vpJointVector start = configuration(model, rng, 0.25);
    vpClosedLoopInput in;
    vpClosedLoopOutput out;
    vpJointVector goal = start;
    for (int i = 0; i < 5; ++i) {
      goal(i) += uniform(rng, -0.2, 0.2);
    }
    const vpArmData data = at(model, goal);
    in.goal = data.tool;
    // Turned about the axis that matters least there.
    vpRedundancyOutput probe;
    vpRedundancyInput all = ofCamera(5, randomTwist(rng));
    all.frame = vpArmFrame::EndEffector;
    vpRedundancySolver(model).step(data, all, probe);
    int axis = 0;
    while (probe.unreachableAxes >> axis != 1U) {
      ++axis;
    }
    if (axis < 3 || probe.smallestSingular < 0.049) {
      continue;
    }
    ++tried;
    in.goal.R = (in.goal.R * Eigen::AngleAxisd(0.2, Eigen::Vector3d::Unit(axis - 3))).eval();
    for (const bool free : {false, true}) {
      in.free[static_cast<std::size_t>(axis)] = free;
      vpClosedLoopState state;
      state.q = start;
      for (int k = 0; k < 4000 && state.status == vpClosedLoopStatus::Moving; ++k) {
        loop.step(in, state, out);
      }
      CAPTURE(problem, axis, free, out.message(), out.error.transpose());
      if (free) {
        reached += out.status == vpClosedLoopStatus::Reached ? 1 : 0;
      }
      else {
        REQUIRE(out.status != vpClosedLoopStatus::Reached);
        stopped += out.status == vpClosedLoopStatus::StoppedByAxis ? 1 : 0;
      }
    }
  }
  CAPTURE(tried, reached, stopped);
  CHECK(tried > 5);
  CHECK(reached > 3 * tried / 4);
  CHECK(stopped > 3 * tried / 4);
}
