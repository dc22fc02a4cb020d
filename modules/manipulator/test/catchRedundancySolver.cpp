/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// One step of the solver: inverse, projection, priorities, limits, errors.
#include "vpCatch.h"
#include "vpSolverTestKit.h"

#include <visp3/core/vpException.h>
#include <visp3/manipulator/vpJointBounds.h>

#include <Eigen/LU>

#include <iostream>

using namespace vpSolverTestKit;

TEST_CASE("Away from singularities the inverse is (3.23) and the self-motion is N W^-1 grad m", "[solver]")
{
  auto rng = vpTestSupport::generator(31);
  CAPTURE(vpTestSupport::seed());
  const vpArmModel model = unlimited(amor());
  int regular = 0, descents = 0;
  for (int problem = 0; problem < 3000; ++problem) {
    vpRedundancySpec spec;
    spec.weights = randomWeights(7, rng);
    spec.singularRegion = 1e-3;
    spec.softGradient = 1e-9;
    const vpRedundancySolver solver(model, spec);
    const vpArmData data = at(model, configuration(amor(), rng));
    const vpArmFrame frame = problem % 3 == 0   ? vpArmFrame::Base
                             : problem % 3 == 1 ? vpArmFrame::EndEffector
                                                : vpArmFrame::Camera;
    const Vector6 twist = randomTwist(rng);
    vpRedundancyInput in = input(7, twist, frame);
    vpRedundancyOutput out;
    solver.step(data, in, out);
    if (out.smallestSingular < 0.02) {
      continue;
    }
    ++regular;
    const Eigen::MatrixXd J = vpArmKinematics::geometric(model, data, frame);
    const Eigen::MatrixXd Winv = spec.weights.cwiseInverse().asDiagonal();
    const Eigen::MatrixXd inverse = Winv * J.transpose() * (J * Winv * J.transpose()).inverse();
    const Eigen::VectorXd expected = inverse * twist;
    REQUIRE((out.velocity - expected).norm() < 1e-7 * (1. + expected.norm()));
    REQUIRE(out.status == vpRedundancyStatus::Exact);
    REQUIRE(out.taskShare == Approx(1.));

    in.indices[0] = vpSelfMotionIndex::posture(configuration(amor(), rng));
    in.indexCount = 1;
    solver.step(data, in, out);
    vpIndexValue index;
    REQUIRE(vpEvaluateIndex(model, data, in.indices[0], index));
    const Eigen::MatrixXd N = Eigen::MatrixXd::Identity(7, 7) - inverse * J;
    const Eigen::VectorXd projected = N * Winv * index.gradient;
    // k0 as corrected: half the length of the task's motion.
    const Eigen::VectorXd self = 0.5 * std::max(expected.norm(), spec.minSelfMotion) * projected.normalized();
    REQUIRE((out.selfMotion - self).norm() < 1e-6 * (1. + self.norm()));
    REQUIRE((J * out.selfMotion).norm() < 1e-9 * (1. + self.norm()));
    REQUIRE(index.gradient.dot(out.selfMotion) > 0.);
    descents += index.gradient.dot(N * index.gradient) < 0. ? 1 : 0; // as printed
  }
  std::cout << "N grad m, as printed, descends in " << 100. * descents / regular << " % of " << regular << " cases\n";
  CHECK(regular > 1500);
  CHECK(descents > regular / 20);
}

TEST_CASE("Tasks keep their order", "[solver]")
{
  auto rng = vpTestSupport::generator(32);
  CAPTURE(vpTestSupport::seed());
  const vpArmModel model = unlimited(amor());
  vpRedundancySpec spec;
  spec.singularRegion = 1e-3;
  const vpRedundancySolver solver(model, spec);
  double with = 0., without = 0.;
  for (int problem = 0; problem < 1000; ++problem) {
    const vpArmData data = at(model, configuration(amor(), rng));
    const Vector6 twist = randomTwist(rng);
    vpRedundancyInput in = input(7, twist);
    // The rotation about the tool's own axis is free: two redundant joints.
    in.frame = vpArmFrame::EndEffector;
    in.free[5] = true;
    vpRedundancyOutput out;
    solver.step(data, in, out);
    const Eigen::MatrixXd J = vpArmKinematics::geometric(model, data, in.frame);
    if (out.smallestSingular < 0.02) {
      continue;
    }
    REQUIRE((J * out.velocity - twist).head(5).norm() < 1e-8);
    const auto partial = vpArmKinematics::pointJacobian(model, data, 3);
    const Eigen::Vector3d wanted(0.1, -0.05, 0.08);
    without += (partial * out.velocity - wanted).norm();
    in.tasks[0] = vpArmTask::pointVelocity(model, data, 3, wanted);
    in.taskCount = 1;
    in.indices[0] = vpSelfMotionIndex::jointLimits();
    in.indexCount = 1;
    solver.step(data, in, out);
    REQUIRE((J * out.velocity - twist).head(5).norm() < 1e-7);
    with += (partial * (out.velocity - out.selfMotion) - wanted).norm();
  }
  std::cout << "error of the lower task, sum: " << with << ", without it " << without << '\n';
  CHECK(with < 0.8 * without);
}

TEST_CASE("No velocity or acceleration ever exceeds its limit", "[limits]")
{
  auto rng = vpTestSupport::generator(33);
  CAPTURE(vpTestSupport::seed());
  double velocity = -1., acceleration = -1.;
  for (int problem = 0; problem < 20000; ++problem) {
    const vpArmModel &model = problem % 2 == 0 ? amor() : sixAxes();
    const int n = model.size();
    vpRedundancySpec spec;
    spec.policy = problem % 4 < 2 ? vpLimitPolicy::StopJoints : vpLimitPolicy::ScaleMotion;
    const vpRedundancySolver solver(model, spec);
    vpJointVector q = configuration(model, rng);
    if (problem % 5 == 0) { // beyond a limit, or exactly at one
      q(1) = problem % 10 == 0 ? model.upper()(1) : model.upper()(1) + 0.1;
    }
    if (problem % 7 == 0) {
      q(n - 2) = 0.;
    }
    vpRedundancyInput in = input(n, 10. * uniform(rng, 0., 1.) * randomTwist(rng), vpArmFrame::Camera);
    in.previous = model.velocity().cwiseProduct(randomVector(n, rng));
    in.indices[0] = vpSelfMotionIndex::manipulability(100.);
    in.indices[1] = vpSelfMotionIndex::jointLimits();
    in.indexCount = 2;
    vpRedundancyOutput out;
    solver.step(at(model, q), in, out);
    CAPTURE(problem, out.velocity.transpose(), in.previous.transpose(), q.transpose());
    REQUIRE(out.velocity.allFinite());
    velocity = std::max(velocity, (out.velocity.cwiseAbs() - model.velocity()).maxCoeff());
    acceleration = std::max(acceleration,
                            ((out.velocity - in.previous).cwiseAbs() / spec.period - model.acceleration()).maxCoeff());
    REQUIRE(velocity <= 0.);
    REQUIRE(acceleration <= 1e-9);
    REQUIRE(out.taskShare >= 0.);
    REQUIRE(out.taskShare <= 1.);
  }
}

TEST_CASE("From rest neither velocity nor acceleration limits bend the tool's way", "[limits]")
{
  auto rng = vpTestSupport::generator(34);
  CAPTURE(vpTestSupport::seed());
  const vpRedundancySolver solver(amor());
  int checked = 0;
  for (int problem = 0; problem < 1000; ++problem) {
    const vpArmData data = at(amor(), configuration(amor(), rng, 0.2));
    const Vector6 twist = 20. * randomTwist(rng);
    vpRedundancyInput in = input(7, twist);
    vpRedundancyOutput out;
    // The fastest motion along the way, and the first step towards it.
    for (int k = 0; k < 400; ++k) {
      solver.step(data, in, out);
      in.previous = out.velocity;
      if (k == 0 && out.smallestSingular >= 0.05 && out.stoppedJoints == 0) {
        const Vector6 done = data.J * out.velocity;
        REQUIRE(done.normalized().dot(twist.normalized()) > 1. - 1e-9);
        ++checked;
      }
    }
    if (out.smallestSingular >= 0.05 && out.stoppedJoints == 0) {
      const Vector6 done = data.J * out.velocity;
      REQUIRE(done.normalized().dot(twist.normalized()) > 1. - 1e-9);
      // Some joint is at its limit.
      REQUIRE((out.status == vpRedundancyStatus::Scaled || out.status == vpRedundancyStatus::Exact));
      const double most = (out.velocity.cwiseAbs().cwiseQuotient(amor().velocity())).maxCoeff();
      REQUIRE((out.status == vpRedundancyStatus::Exact || most == Approx(1.)));
    }
  }
  CHECK(checked > 300);
}

TEST_CASE("Only the joint at its limit stops, and the spare joint takes over", "[limits]")
{
  auto rng = vpTestSupport::generator(35);
  CAPTURE(vpTestSupport::seed());
  int stopped = 0, exact = 0;
  for (int problem = 0; problem < 2000; ++problem) {
    vpRedundancySpec spec;
    spec.policy = vpLimitPolicy::StopJoints;
    const vpRedundancySolver stopping(amor(), spec);
    spec.policy = vpLimitPolicy::ScaleMotion;
    const vpRedundancySolver scaling(amor(), spec);
    vpJointVector q = configuration(amor(), rng, 0.1);
    const int joint = 1 + static_cast<int>(rng() % 3);
    q(joint) = problem % 2 == 0 ? amor().upper()(joint) : amor().lower()(joint);
    const vpArmData data = at(amor(), q);
    vpRedundancyInput in = input(7, 0.02 * randomTwist(rng));
    const Vector6 twist(in.twist.data());
    vpRedundancyOutput out;
    stopping.step(data, in, out);
    if (out.smallestSingular < 0.05 || out.stoppedJoints != 1U << joint) {
      continue;
    }
    ++stopped;
    REQUIRE(out.velocity(joint) == Approx(0.).margin(1e-12));
    for (int k = 0; k < 60 && out.status == vpRedundancyStatus::Accelerating; ++k) {
      in.previous = out.velocity;
      stopping.step(data, in, out);
    }
    if (out.status == vpRedundancyStatus::Exact) {
      REQUIRE((data.J * out.velocity - twist).norm() < 1e-7);
      ++exact;
    }
    in.previous.setZero();
    scaling.step(data, in, out);
    REQUIRE(out.velocity.norm() == 0.);
    REQUIRE(out.status == vpRedundancyStatus::BlockedByLimits);
    REQUIRE(std::string(out.message()).find("position limits") != std::string::npos);
  }
  CHECK(stopped > 200);
  CHECK(exact > 3 * stopped / 4);
}

TEST_CASE("What a joint still moves while it brakes before its limit is taken off the others", "[limits]")
{
  auto rng = vpTestSupport::generator(36);
  CAPTURE(vpTestSupport::seed());
  const vpRedundancySolver solver(amor());
  int moving = 0;
  for (int problem = 0; problem < 2000; ++problem) {
    vpJointVector q = configuration(amor(), rng, 0.2);
    const int joint = 1 + static_cast<int>(rng() % 3);
    q(joint) = problem % 2 == 0 ? amor().upper()(joint) - 2e-4 : amor().lower()(joint) + 2e-4;
    const vpArmData data = at(amor(), q);
    vpRedundancyInput in = input(7, 0.3 * randomTwist(rng));
    const Vector6 twist(in.twist.data());
    vpRedundancyOutput out;
    for (int k = 0; k < 60; ++k) { // the arm stands, its commands settle
      solver.step(data, in, out);
      in.previous = out.velocity;
    }
    if (out.status != vpRedundancyStatus::Exact || out.stoppedJoints != 1U << joint || out.smallestSingular < 0.05) {
      continue;
    }
    ++moving;
    REQUIRE(std::fabs(out.velocity(joint)) > 0.01);
    REQUIRE((data.J * out.velocity - twist).norm() < 1e-7);
  }
  CHECK(moving > 20);
}

TEST_CASE("A joint always brakes before its limit", "[limits]")
{
  auto rng = vpTestSupport::generator(36);
  CAPTURE(vpTestSupport::seed());
  double nearest = 1.;
  for (int problem = 0; problem < 2000; ++problem) {
    const double period = std::exp(uniform(rng, -7., -3.)), margin = uniform(rng, 0., 0.05);
    vpJointVector q = configuration(sixAxes(), rng, 0.02), v = vpJointVector::Zero(6);
    vpJointBounds bounds;
    for (int k = 0; k < 500; ++k) {
      bounds.update(sixAxes(), q, v, period, margin);
      for (int i = 0; i < 6; ++i) {
        const double before = v(i);
        v(i) = bounds.clamp(i, problem % 2 == 0 ? 100. : uniform(rng, -100., 100.));
        REQUIRE(std::fabs(v(i) - before) <= sixAxes().acceleration()(i) * period * (1. + 1e-12));
      }
      q += period * v;
      for (const int i : {1, 2, 3, 4}) {
        REQUIRE(q(i) <= sixAxes().upper()(i) - margin + 1e-12);
        REQUIRE(q(i) >= sixAxes().lower()(i) + margin - 1e-12);
      }
    }
    nearest = problem % 2 == 0 && period > 0.01 ? std::min(nearest, sixAxes().upper()(4) - margin - q(4)) : nearest;
  }
  CHECK(nearest < 1e-3); // and does not stay away from it
}

TEST_CASE("The step takes nonsense and does not allocate", "[solver]")
{
  const vpRedundancySolver solver(amor());
  const vpArmData data = at(amor(), home());
  vpRedundancyInput in = input(7, Vector6::Constant(0.01));
  in.indices[0] = vpSelfMotionIndex::manipulability();
  in.indices[1] = vpSelfMotionIndex::lineDistance(3, vpIndexSense::Attract);
  in.indices[2] = vpSelfMotionIndex::jointLimits();
  in.indexCount = 3;
  in.tasks[0] = vpArmTask::pointVelocity(amor(), data, 3, Eigen::Vector3d::Zero());
  in.taskCount = 1;
  vpRedundancyOutput out;
  const vpArmData singular = at(amor(), vpJointVector::Zero(7));
  const unsigned long before = vpTestSupport::allocationCount();
  for (int k = 0; k < 100; ++k) {
    solver.step(k % 2 == 0 ? data : singular, in, out);
    in.previous = out.velocity;
  }
  CHECK(vpTestSupport::allocationCount() == before);

  in.previous = vpJointVector::Constant(7, 0.5);
  vpRedundancyInput broken = in;
  broken.twist[2] = NAN;
  solver.step(data, broken, out);
  CHECK(out.status == vpRedundancyStatus::InvalidInput);
  CHECK(out.velocity(0) == Approx(0.5 - 0.005 * 6.)); // brakes at its limit
  broken = in;
  broken.previous = vpJointVector::Zero(3);
  solver.step(data, broken, out);
  CHECK(out.status == vpRedundancyStatus::InvalidInput);
  CHECK(out.velocity.norm() == 0.);
  solver.step(vpArmData(), in, out);
  CHECK(out.status == vpRedundancyStatus::InvalidInput);
  broken = in;
  broken.indexCount = 100;
  solver.step(data, broken, out);
  CHECK(out.status == vpRedundancyStatus::InvalidInput);
  CHECK(std::string(out.message()) == "An input is not finite, beyond 1e9 or of a wrong size; the arm brakes.");

  const auto says = [](const vpRedundancySpec &spec, const char *sentence) {
    CHECK_THROWS_WITH(vpRedundancySolver(amor(), spec), Catch::Contains(sentence));
  };
  vpRedundancySpec spec;
  spec.period = 0.;
  says(spec, "period of the redundancy solver for");
  spec = {};
  spec.selfMotion = -0.5;
  says(spec, "is -0.5, must be in [0, 1]");
  spec = {};
  spec.weights = vpJointVector::Constant(7, -2.);
  says(spec, "weight of the redundancy solver for");
  spec = {};
  spec.positionMargin = 2.;
  says(spec, "less than half the range of every joint");
  vpArmSpec arm = mixed().spec();
  arm.joints[1].velocity = std::numeric_limits<double>::infinity();
  CHECK_THROWS_WITH(vpRedundancySolver(vpArmModel(arm)),
                    Catch::Contains("velocity limit of joint m1 is infinite, the redundancy solver needs one"));
}
