/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Printed formulas of thesis section 3.3 on random configurations, beside what is used here. See doc/errata.md.
#include "vpArmTestKit.h"
#include "vpCatch.h"

#include <visp3/manipulator/vpRedundancySolver.h>

#include <Eigen/SVD>

using namespace vpArmTestKit;

namespace
{
vpArmData at(const vpArmModel &model, const vpJointVector &q)
{
  vpArmData data;
  vpArmKinematics::update(model, q, data);
  return data;
}

Eigen::Vector3d randomPoint(std::mt19937_64 &rng)
{
  return {uniform(rng, -0.8, 0.8), uniform(rng, -0.8, 0.8), uniform(rng, -0.8, 0.8)};
}

double distanceOf(const vpArmData &data, const vpSelfMotionIndex &index)
{
  vpIndexValue value;
  static_cast<void>(vpEvaluateIndex(amor(), data, index, value));
  return value.distance;
}
} // namespace

TEST_CASE("(3.12): the axis is a column of the rotation to the base, not to the joint before", "[errata]")
{
  auto rng = vpTestSupport::generator(51);
  CAPTURE(vpTestSupport::seed());
  int wrong = 0, columns = 0;
  const double h = 1e-6;
  for (int k = 0; k < 200; ++k) {
    const vpJointVector q = configuration(amor(), rng);
    const vpArmData data = at(amor(), q);
    for (int i = 1; i < amor().size(); ++i) {
      vpJointVector before = q, after = q;
      before(i) -= h;
      after(i) += h;
      // The turn of the tool by this joint, without any Jacobian.
      const Eigen::AngleAxisd turn(at(amor(), after).tool.R * at(amor(), before).tool.R.transpose());
      const Eigen::Vector3d truth = turn.angle() / (2. * h) * turn.axis();
      const auto n = static_cast<std::size_t>(i);
      const Eigen::Vector3d printed = (data.joint[n - 1].R.transpose() * data.joint[n].R).col(2);
      REQUIRE((data.J.col(i).tail<3>() - truth).norm() < 1e-6);
      wrong += (printed - truth).norm() > 0.1;
      ++columns;
    }
  }
  CHECK(wrong > 0.9 * columns);
}

TEST_CASE("(3.30): the partial Jacobians of all usable joints are singular", "[errata]")
{
  auto rng = vpTestSupport::generator(52);
  CAPTURE(vpTestSupport::seed());
  for (int k = 0; k < 500; ++k) {
    const vpArmData data = at(amor(), configuration(amor(), rng));
    for (const int joint : {1, 3, 5}) { // 2, 4 and 6 of the text: the others lie at the base or in the same places
      Eigen::MatrixXd partial = Eigen::MatrixXd::Zero(6, 7); // of the link that carries the joint
      partial.topRows(3) = vpArmKinematics::pointJacobian(amor(), data, joint);
      partial.block(3, 0, 3, joint) = data.J.block(3, 0, 3, joint);
      const Eigen::MatrixXd square = partial * partial.transpose(); // (3.23) inverts it
      const Eigen::VectorXd s = square.jacobiSvd().singularValues();
      REQUIRE(s(5) < 1e-12 * s(0));
      // The gradient of a distance needs no inverse.
      const Eigen::Vector3d thing = randomPoint(rng);
      const auto index = vpSelfMotionIndex::pointDistance(joint, thing, vpIndexSense::Repel);
      vpIndexValue value;
      REQUIRE(vpEvaluateIndex(amor(), data, index, value));
      const Eigen::VectorXd slope =
          partial.topRows(3).transpose() * (data.joint[static_cast<std::size_t>(joint)].p - thing).normalized();
      REQUIRE(value.gradient.dot(slope) > 0.999999 * value.gradient.norm() * slope.norm());
    }
  }
}

TEST_CASE("(3.33): the foot is clamped to the segment between base and tool", "[errata]")
{
  auto rng = vpTestSupport::generator(53);
  CAPTURE(vpTestSupport::seed());
  int beyond = 0;
  for (int k = 0; k < 1000; ++k) {
    const vpArmData data = at(amor(), configuration(amor(), rng));
    for (const int which : {3, 5}) {
      const Eigen::Vector3d joint = data.joint[static_cast<std::size_t>(which)].p, tool = data.tool.p;
      double nearest = 1e9;
      constexpr int n = 2000;
      for (int i = 0; i <= n; ++i) {
        nearest = std::min(nearest, (static_cast<double>(i) / n * tool - joint).norm());
      }
      const double ours = distanceOf(data, vpSelfMotionIndex::lineDistance(which, vpIndexSense::Repel));
      REQUIRE(ours <= nearest + 1e-12);
      REQUIRE(ours > nearest - 1e-3 * tool.norm());
      const double printed = (joint.dot(tool) / tool.squaredNorm() * tool - joint).norm();
      beyond += printed < nearest - 0.01; // the foot lies on the line beyond base or tool
    }
  }
  CHECK(beyond > 20);
}

TEST_CASE("(3.39) to (3.41): a plane that does not go through the origin, with any length of its normal", "[errata]")
{
  auto rng = vpTestSupport::generator(54);
  CAPTURE(vpTestSupport::seed());
  int wrong = 0;
  for (int k = 0; k < 1000; ++k) {
    const vpArmData data = at(amor(), configuration(amor(), rng));
    const Eigen::Vector3d x1 = randomPoint(rng), x2 = randomPoint(rng), x3 = randomPoint(rng);
    const Eigen::Vector3d normal = (x2 - x1).cross(x3 - x1), joint = data.joint[3].p;
    // The distance from the plane as the height of the tetrahedron: six volumes over two areas.
    Eigen::Matrix3d edges;
    edges << x2 - x1, x3 - x1, joint - x1;
    const double height = edges.determinant() / normal.norm();
    REQUIRE(distanceOf(data, vpSelfMotionIndex::planeDistance(3, x1, normal, vpIndexSense::Repel)) ==
            Approx(height).margin(1e-9));
    const double printed = -joint.dot(normal) / normal.squaredNorm(); // d_{p,b} of (3.41), along n
    wrong += std::abs(std::abs(printed) - std::abs(height)) > 0.05;
  }
  CHECK(wrong > 500);
}

TEST_CASE("(3.24): k0 does not grow without bound where nothing is spare, and does not vanish at rest", "[errata]")
{
  auto rng = vpTestSupport::generator(55);
  CAPTURE(vpTestSupport::seed());
  vpRedundancyInput input;
  input.frame = vpArmFrame::Base;
  input.indexCount = 1;
  vpRedundancyOutput output;
  const vpRedundancySolver spare(amor()), full(sixAxes());
  double largest = 0.;
  int moved = 0;
  for (int k = 0; k < 300; ++k) {
    const vpJointVector q6 = configuration(sixAxes(), rng);
    const vpArmData six = at(sixAxes(), q6);
    input.twist = vpTwist(0.1, 0., 0., 0., 0., 0.);
    input.previous = vpJointVector::Zero(6);
    input.indices[0] = vpSelfMotionIndex::posture(configuration(sixAxes(), rng));
    full.step(six, input, output);
    if (output.smallestSingular > 0.05) {
      REQUIRE(output.selfMotion.norm() < 1e-9);
      // As printed: a finite numerator over rounding.
      const Eigen::MatrixXd J = six.J, N = Eigen::MatrixXd::Identity(6, 6) - J.inverse() * J;
      vpIndexValue value;
      static_cast<void>(vpEvaluateIndex(sixAxes(), six, input.indices[0], value));
      const Eigen::VectorXd wanted = J.inverse() * Eigen::VectorXd::Unit(6, 0) * 0.1;
      largest = std::max(largest, wanted.norm() / (N * value.gradient).norm());
    }
    // At rest the numerator is 0, and so would be all self-motion.
    const vpArmData seven = at(amor(), configuration(amor(), rng));
    input.twist = vpTwist();
    input.previous = vpJointVector::Zero(7);
    input.indices[0] = vpSelfMotionIndex::posture(configuration(amor(), rng));
    spare.step(seven, input, output);
    moved += output.selfMotion.norm() > 0.05;
  }
  CHECK(largest > 1e9);
  CHECK(moved > 250);
}

TEST_CASE("Table B.1: upright at 0 by the offset of joint 2, 1.03 m of reach, 1.1 m with the tool", "[errata]")
{
  auto rng = vpTestSupport::generator(56);
  CAPTURE(vpTestSupport::seed());
  CHECK(at(amor(), vpJointVector::Zero(7)).joint[3].p(2) > 0.5);
  vpArmSpec raw = amor().spec();
  raw.joints[1].offset = 0.;
  raw.tool = {};
  const vpArmModel table(raw);
  CHECK(at(table, vpJointVector::Zero(7)).joint[3].p(2) < 0.);
  // Maximum reach of the tool, by joint-by-joint ascent from random configurations.
  const auto farthest = [&](const vpArmModel &model, int axes) {
    const auto length = [&](const vpJointVector &q) { return at(model, q).tool.p.head(axes).norm(); };
    double most = 0.;
    for (int start = 0; start < 20; ++start) {
      vpJointVector q = configuration(model, rng);
      for (double step = 0.5; step > 1e-4; step *= 0.8) {
        for (int i = 0; i < 7; ++i) {
          for (const double by : {step, -step}) {
            vpJointVector moved = q;
            moved(i) += by;
            q = length(moved) > length(q) ? moved : q;
          }
        }
      }
      most = std::max(most, length(q));
    }
    return most;
  };
  CHECK(farthest(table, 3) == Approx(1.03).margin(0.005));
  CHECK(farthest(amor(), 2) == Approx(1.1).margin(0.005));
}
