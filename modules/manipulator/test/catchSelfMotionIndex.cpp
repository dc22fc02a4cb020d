/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpArmTestKit.h"
#include "vpCatch.h"

#include <visp3/core/vpException.h>
#include <visp3/manipulator/vpRedundancySolver.h>
#include <visp3/manipulator/vpSelfMotionIndex.h>

#include <Eigen/SVD>

#include <iostream>

using namespace vpArmTestKit;

// Gradients of the indices against finite differences, and the sense in which they pull.

namespace
{
Eigen::Vector3d randomPoint(std::mt19937_64 &rng)
{
  return {uniform(rng, -0.8, 0.8), uniform(rng, -0.8, 0.8), uniform(rng, 0., 1.)};
}

std::vector<vpSelfMotionIndex> all(const vpArmModel &model, std::mt19937_64 &rng)
{
  const int n = model.size(), joint = static_cast<int>(rng() % static_cast<unsigned long>(model.links()));
  vpJointVector weights(n);
  for (int i = 0; i < n; ++i) {
    weights(i) = uniform(rng, 0.2, 5.);
  }
  std::vector<vpSelfMotionIndex> indices;
  indices.push_back(vpSelfMotionIndex::manipulability());
  indices.push_back(vpSelfMotionIndex::weightedManipulability(weights, 0.4));
  for (const vpIndexSense sense : {vpIndexSense::Attract, vpIndexSense::Repel}) {
    const double range = uniform(rng, 0.05, 0.5);
    indices.push_back(vpSelfMotionIndex::pointDistance(joint, randomPoint(rng), sense, 1., range));
    indices.push_back(vpSelfMotionIndex::lineDistance(joint, sense, 1., range));
    indices.push_back(vpSelfMotionIndex::planeDistance(
        joint, randomPoint(rng), randomPoint(rng) + Eigen::Vector3d(0., 0., 0.1), sense, 1., range));
  }
  indices.push_back(vpSelfMotionIndex::jointLimits());
  indices.push_back(vpSelfMotionIndex::posture(configuration(model, rng)));
  return indices;
}

vpIndexValue evaluate(const vpArmModel &model, const vpJointVector &q, const vpSelfMotionIndex &index)
{
  vpArmData data;
  vpArmKinematics::update(model, q, data);
  vpIndexValue value;
  static_cast<void>(vpEvaluateIndex(model, data, index, value));
  return value;
}
} // namespace

TEST_CASE("Gradients of the indices are those of finite differences", "[index]")
{
  auto rng = vpTestSupport::generator(21);
  CAPTURE(vpTestSupport::seed());
  double worst = 0.;
  for (const vpArmModel &arm : fixedAndLinkedArms(rng)) {
    const vpArmModel *model = &arm;
    for (int problem = 0; problem < (arm.spec().followers.empty() ? 1000 : 20); ++problem) {
      const vpJointVector q = configuration(*model, rng);
      for (const vpSelfMotionIndex &index : all(*model, rng)) {
        CAPTURE(model->label(), problem, static_cast<int>(index.kind), static_cast<int>(index.sense), index.joint);
        const vpIndexValue here = evaluate(*model, q, index);
        // Where two pieces of the distance to the line meet, or near its kink at zero, differences are not a reference.
        if (index.kind == vpIndexKind::LineDistance || index.kind == vpIndexKind::PointDistance) {
          vpArmData data;
          vpArmKinematics::update(*model, q, data);
          const Eigen::Vector3d at = data.joint[static_cast<std::size_t>(index.joint)].p;
          const double k = at.dot(data.tool.p) / data.tool.p.squaredNorm();
          if (here.distance < 0.02 ||
              (index.kind == vpIndexKind::LineDistance && (std::fabs(k) < 1e-3 || std::fabs(k - 1.) < 1e-3))) {
            continue;
          }
        }
        if (index.kind == vpIndexKind::Manipulability && here.value < 1e-3) {
          continue; // the root of a difference: its curvature grows without bound
        }
        double error = 0.;
        for (int i = 0; i < model->size(); ++i) {
          const double h = 2e-5;
          const auto at = [&](double step) {
            vpJointVector moved = q;
            moved(i) += step;
            return evaluate(*model, moved, index).value;
          };
          // Fourth order, so that the truncation is below the bound.
          const double slope = (8. * (at(h) - at(-h)) - (at(2. * h) - at(-2. * h))) / (12. * h);
          error = std::max(error, std::fabs(slope - here.gradient(i)));
        }
        REQUIRE(error < 1e-7);
        worst = std::max(worst, error);
      }
    }
  }
  std::cout << "largest difference of an index's gradient from finite differences: " << worst << '\n';
}

TEST_CASE("Manipulability is the product of the singular values", "[index]")
{
  auto rng = vpTestSupport::generator(22);
  CAPTURE(vpTestSupport::seed());
  for (const vpArmModel *model : {&amor(), &sixAxes(), &mixed()}) {
    for (int problem = 0; problem < 500; ++problem) {
      const vpJointVector q = configuration(*model, rng);
      vpArmData data;
      vpArmKinematics::update(*model, q, data);
      Eigen::MatrixXd J = data.J;
      CHECK(evaluate(*model, q, vpSelfMotionIndex::manipulability()).value ==
            Approx(J.jacobiSvd().singularValues().prod()).margin(1e-9));
      vpJointVector weights = vpJointVector::Constant(model->size(), 4.);
      J.bottomRows(3) *= 0.3;
      J *= 0.5;
      CHECK(evaluate(*model, q, vpSelfMotionIndex::weightedManipulability(weights, 0.3)).value ==
            Approx(J.jacobiSvd().singularValues().prod()).margin(1e-9));
    }
  }
}

TEST_CASE("Slopes are bounded, repulsion decays, and the wrong side is left", "[index]")
{
  vpArmData data;
  vpArmKinematics::update(amor(), home(), data);
  const Eigen::Vector3d elbow = data.joint[3].p;
  const auto J = vpArmKinematics::pointJacobian(amor(), data, 3);
  double before = 2.;
  for (const double d : {0.01, 0.1, 0.3, 1.}) {
    vpIndexValue value;
    const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
    REQUIRE(
        vpEvaluateIndex(amor(), data, vpSelfMotionIndex::pointDistance(3, elbow - d * up, vpIndexSense::Repel), value));
    CHECK(value.distance == Approx(d));
    // The gradient is the slope times the elbow's motion upwards.
    const double slope = value.gradient.dot(J.transpose() * up) / (J.transpose() * up).squaredNorm();
    CHECK(slope > 0.);
    CHECK(slope < before);
    CHECK(slope <= 1.);
    before = slope;
    REQUIRE(vpEvaluateIndex(amor(), data, vpSelfMotionIndex::pointDistance(3, elbow - d * up, vpIndexSense::Attract),
                            value));
    CHECK(value.gradient.dot(J.transpose() * up) < 0.);
    // A plane above the elbow with its allowed side above: the elbow is on the wrong side and is led up.
    REQUIRE(vpEvaluateIndex(amor(), data, vpSelfMotionIndex::planeDistance(3, elbow + d * up, up, vpIndexSense::Repel),
                            value));
    CHECK(value.distance == Approx(-d));
    CHECK(value.gradient.dot(J.transpose() * up) > 0.);
    REQUIRE(vpEvaluateIndex(amor(), data,
                            vpSelfMotionIndex::planeDistance(3, elbow + 100. * up, up, vpIndexSense::Repel), value));
    CHECK(value.gradient.allFinite());
    CHECK(value.gradient.norm() <= (J.transpose() * up).norm() * (1. + 1e-12));
  }
}

TEST_CASE("An index without a gradient says so", "[index]")
{
  vpArmData data;
  vpArmKinematics::update(amor(), vpJointVector::Zero(7), data); // stretched upwards: singular
  vpIndexValue value;
  CHECK_FALSE(
      vpEvaluateIndex(amor(), data, vpSelfMotionIndex::pointDistance(3, data.joint[3].p, vpIndexSense::Repel), value));
  CHECK(value.gradient.norm() == 0.);
  CHECK_FALSE(vpEvaluateIndex(amor(), data, vpSelfMotionIndex::posture(vector({1., 2.})), value));
  const auto says = [](const vpSelfMotionIndex &index, const char *sentence) {
    CHECK_THROWS_WITH(index.validate(amor()), Catch::Contains(sentence));
  };
  says(vpSelfMotionIndex::manipulability(-1.), "gain must be >= 0 and finite, at most 1e9 (gain -1");
  says(vpSelfMotionIndex::pointDistance(7, {}, vpIndexSense::Repel), "joint must be one of the chain, from 0 on");
  says(vpSelfMotionIndex::pointDistance(3, Eigen::Vector3d::Zero(), vpIndexSense::Repel, 1., 0.), "range must be > 0");
  says(vpSelfMotionIndex::planeDistance(3, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), vpIndexSense::Repel),
       "normal must have length 1");
  says(vpSelfMotionIndex::posture(vector({1., 2.})), "reference must have a finite number for each joint");
  says(vpSelfMotionIndex::weightedManipulability(vpJointVector::Zero(7), 0.4), "weights must have a number > 0");
  CHECK_NOTHROW(vpSelfMotionIndex::jointLimits().validate(amor()));
}

// vpRedundancySpec::selfAcceleration: self-motion that starts and changes with a fraction of the accelerations.

namespace
{
constexpr double period = 0.005; // s

//! Results of self-motion with the tool at rest over some periods.
struct Course {
  double largestShare = 0.; //!< Largest ratio of a joint's velocity change in a period to its acceleration limit.
  double drift = 0.;        //!< |J v|, m/s and rad/s.
  double speed = 0.;        //!< Final joint speed, rad/s.
};

Course climb(const vpArmModel &model, const vpJointVector &start, double selfAcceleration, int periods)
{
  vpRedundancySpec spec;
  spec.period = period;
  spec.selfAcceleration = selfAcceleration;
  const vpRedundancySolver solver(model, spec);
  vpRedundancyInput in;
  in.frame = vpArmFrame::Base;
  in.indices[0] = vpSelfMotionIndex::posture(start + vpJointVector::Constant(model.size(), 0.4));
  in.indexCount = 1;
  in.previous = vpJointVector::Zero(model.size());
  vpRedundancyOutput out;
  vpJointVector q = start;
  vpArmData data;
  Course course;
  for (int k = 0; k < periods; ++k) {
    vpArmKinematics::update(model, q, data);
    solver.step(data, in, out);
    for (int i = 0; i < model.size(); ++i) {
      course.largestShare = std::max(course.largestShare,
                                     std::fabs(out.velocity(i) - in.previous(i)) / (model.acceleration()(i) * period));
    }
    course.drift = std::max(course.drift, (data.J * out.velocity).norm());
    in.previous = out.velocity;
    q += period * out.velocity;
  }
  course.speed = out.velocity.norm();
  return course;
}
} // namespace

TEST_CASE("Self-motion starts with its share of the accelerations and then goes as fast", "[self-motion]")
{
  auto rng = vpTestSupport::generator(1901);
  CAPTURE(vpTestSupport::seed());
  int moving = 0, faster = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const vpJointVector start = amor().home() + 0.3 * vpJointVector::NullaryExpr(amor().size(), [&](Eigen::Index) {
                                                  return uniform(rng, -1., 1.);
                                                });
    const double share = uniform(rng, 0.02, 0.3);
    const Course slow = climb(amor(), start, share, 4), free = climb(amor(), start, 0., 4);
    CAPTURE(trial, share);
    CHECK(slow.largestShare <= share + 1e-3); // the free direction turns a little from one period to the next
    CHECK(slow.drift < 1e-9);
    moving += slow.speed > 1e-6 ? 1 : 0;
    faster += free.largestShare > share ? 1 : 0;
    // With enough time it reaches the same speed.
    const Course later = climb(amor(), start, 0.3, 100), without = climb(amor(), start, 0., 100);
    CHECK(later.speed == Approx(without.speed).epsilon(0.15).margin(2e-3));
  }
  CHECK(moving > 50);
  CHECK(faster > 30); // without it the self-motion does change faster than that
}

TEST_CASE("selfAcceleration outside its range is named", "[self-motion]")
{
  for (const double bad : {-0.1, 1.1, std::nan("")}) {
    vpRedundancySpec spec;
    spec.selfAcceleration = bad;
    try {
      const vpRedundancySolver solver(amor(), spec);
      FAIL("accepted " << bad);
    }
    catch (const vpException &error) {
      CHECK(std::string(error.getMessage()).find("selfAcceleration") != std::string::npos);
      CHECK(std::string(error.getMessage()).find("in [0, 1]") != std::string::npos);
    }
  }
}
