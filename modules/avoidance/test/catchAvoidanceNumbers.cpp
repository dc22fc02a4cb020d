/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// NaN, infinities and overflowing magnitudes as input of every check of the module: none may be reported free.
#include "vpCatch.h"
#include "vpNumbersTestKit.h"

#include <visp3/avoidance/vpCertifiedTrajectory.h>
#include <visp3/avoidance/vpDiscreteMotion.h>
#include <visp3/avoidance/vpFclChecker.h>
#include <visp3/avoidance/vpGoalConfiguration.h>
#include <visp3/avoidance/vpPathPlanner.h>
#include <visp3/avoidance/vpSegmentDistance.h>
#include <visp3/avoidance/vpTimedPath.h>
#include <visp3/core/vpException.h>

#include <functional>

using namespace vpAvoidanceTestKit;
using namespace vpWildNumbers;

namespace
{
constexpr double infinity = std::numeric_limits<double>::infinity();
} // namespace

TEST_CASE("A distance of numbers out of range is -infinity, never NaN and never far", "[numbers]")
{
  using Numbers = std::array<double, 15>;
  const Numbers ordinary{{0.1, 0.2, 0.3, 0.4, -0.1, 0.2, 0.5, 0.5, 0.5, 0.7, 0.4, 0.5, 0.9, 0.2, 0.1}};
  const auto p = [](const Numbers &x, std::size_t k) { return Vector3d(x[3 * k], x[3 * k + 1], x[3 * k + 2]); };
  const std::vector<std::pair<std::size_t, std::function<double(const Numbers &)>>> kernels = {
      {9, [&](const Numbers &x) { return vpSegmentDistance::point(p(x, 0), p(x, 1), p(x, 2)).distance; }},
      {12, [&](const Numbers &x) { return vpSegmentDistance::segment(p(x, 0), p(x, 1), p(x, 2), p(x, 3)).distance; }},
      {9, [&](const Numbers &x) { return vpSegmentDistance::box(p(x, 0), p(x, 1), p(x, 2)).distance; }},
      {8, [&](const Numbers &x) { return vpSegmentDistance::cylinder(p(x, 0), p(x, 1), x[6], x[7]).distance; }},
      {15, [&](const Numbers &x) {
         return vpSegmentDistance::triangle(p(x, 0), p(x, 1), p(x, 2), p(x, 3), p(x, 4)).distance;
       }}};
  for (std::size_t kernel = 0; kernel < kernels.size(); ++kernel) {
    everyPlace(ordinary, [&](const Numbers &x, std::size_t place, std::size_t value) {
      const double distance = kernels[kernel].second(x);
      CAPTURE(kernel, place, values[value], distance);
      if (place < kernels[kernel].first && !(std::fabs(values[value]) <= 100. * vpLargestLength)) {
        REQUIRE(distance == -infinity);
      }
      else {
        REQUIRE((distance >= 0. && distance < 10.));
      }
    });
  }
}

TEST_CASE("A configuration or time out of range is in collision for every query", "[numbers][needs-FCL]")
{
  const vpCollisionScene scene(amor(), everything());
  vpCollisionData data;
  vpNearPairs near;
  const auto isUnknown = [&](double time) {
    scene.near(data, 0.3, near, time);
    const vpClearance least = scene.clearance(data, infinity, time);
    return scene.inCollision(data, 0., time) && least.distance == -infinity && least.kind == vpCollisionKind::Unknown &&
           near.dropped && near.count == 0 && scene.pair(data, 0, 0, time).distance == -infinity &&
           !scene.describe(least).empty();
  };
  CHECK(isUnknown(0.)); // before the first place()
  scene.place(home(), data);
  REQUIRE_FALSE(scene.inCollision(data));
  for (const double time : values) {
    CAPTURE(time);
    CHECK((isUnknown(time) || (std::fabs(time) <= 1e6 && !scene.inCollision(data, 0., time))));
  }
  CHECK(scene.inCollision(data, NAN));
  CHECK(scene.clearance(data, NAN).distance == -infinity);
  vpSceneChecker own(scene);
  vpFclChecker fcl(scene);
  vpReachBounds reach(amor());
  everyPlace(home(), [&](const vpJointVector &q, std::size_t place, std::size_t value) {
    CAPTURE(place, values[value]);
    scene.place(q, data);
    REQUIRE(isUnknown(0.) == !isInRange(q));
    REQUIRE(reach.holds(q) == isInRange(q));
    if (!isInRange(q)) {
      REQUIRE(scene.selfPair(data, 0, 2).distance == -infinity);
      REQUIRE(scene.groundPair(data, 3).distance == -infinity);
      REQUIRE(own.inCollision(q, 0.));
      REQUIRE(fcl.inCollision(q, 0.));
      REQUIRE(own.clearance(q, infinity).distance == -infinity);
      REQUIRE(fcl.clearance(q, infinity).distance == -infinity);
    }
  });
  scene.place(vpJointVector::Zero(6), data);
  CHECK(isUnknown(0.));
}

TEST_CASE("An object goes nowhere else and gets no motion that is no number", "[numbers]")
{
  vpCollisionScene scene(amor(), everything());
  const auto isGood = [&scene] {
    for (int i = 0; i < scene.objectCount(); ++i) {
      const vpCollisionObject &o = scene.object(i);
      if (!o.pose.p.allFinite() || !o.pose.R.allFinite() || !std::isfinite(o.inflation) ||
          !allFinite(std::array<double, 6>{o.velocity[0], o.velocity[1], o.velocity[2], o.velocity[3], o.velocity[4],
                                           o.velocity[5]})) {
        return false;
      }
    }
    return true;
  };
  for (int i = 0; i < scene.objectCount(); ++i) {
    const vpCollisionObject before = scene.object(i);
    for (const double value : values) {
      CAPTURE(i, value);
      vpRigidTransform pose = before.pose;
      pose.p.y() = value;
      REQUIRE(scene.moveObject(i, pose) == (std::fabs(value) <= vpLargestLength));
      pose.R(1, 2) = value;
      REQUIRE((std::fabs(value) < 1e-9 || !scene.moveObject(i, pose)));
      vpTwist velocity = before.velocity;
      velocity[4] = value;
      REQUIRE(scene.setVelocity(i, velocity) == (std::fabs(value) <= 1e3));
      REQUIRE(scene.setInflation(i, value) == (value >= 0. && value <= vpLargestLength));
      static_cast<void>(scene.advance(value));
      REQUIRE(isGood());
      REQUIRE(scene.moveObject(i, before.pose));
      REQUIRE(scene.setVelocity(i, before.velocity));
      REQUIRE(scene.setInflation(i, 0.));
    }
  }
  REQUIRE(scene.setVelocity(0, vpTwist(1., 0., 0., 0., 0., 0.)));
  CHECK_FALSE(scene.advance(NAN));
  CHECK_FALSE(scene.advance(1e12));
}

TEST_CASE("No motion to or from nowhere is free", "[numbers]")
{
  const vpCollisionScene scene(amor(), everything());
  const vpCertifiedMotion certified(scene);
  vpSceneChecker checker(scene);
  vpDiscreteMotion discrete(checker, 0.1);
  vpMotionScratch scratch;
  REQUIRE(certified.check(home(), home(), scratch).isFree());
  everyPlace(home(), [&](const vpJointVector &q, std::size_t place, std::size_t value) {
    if (isInRange(q)) {
      return; // 0 and what is next to it
    }
    CAPTURE(place, values[value]);
    REQUIRE(certified.check(home(), q, scratch).status == vpMotionStatus::BadInput);
    REQUIRE(certified.check(q, home(), scratch).status == vpMotionStatus::BadInput);
    REQUIRE(certified.check(q, q, scratch).status == vpMotionStatus::BadInput);
    REQUIRE_FALSE(discrete.check(home(), q).isFree());
    REQUIRE_FALSE(discrete.check(q, q).isFree());
  });
  // Reach bounds of an arm with prismatic joints hold only within their limits.
  const vpCollisionScene slides(mixed());
  const vpCertifiedMotion within(slides);
  const vpJointVector zero = vpJointVector::Zero(5);
  vpJointVector far = zero;
  far(1) = 3.; // upper is 1
  CHECK(within.check(zero, far, scratch).status == vpMotionStatus::BadInput);
  far(1) = 1.04;
  CHECK(within.check(zero, far, scratch).status != vpMotionStatus::BadInput);
}

TEST_CASE("No plan with a number out of range is free", "[numbers]")
{
  const vpCollisionScene scene(amor(), everything());
  vpCertifiedTrajectory certificate(scene);
  vpTrajectoryPlan plan(7);
  const auto make = [&plan](const std::array<double, 8> &x) {
    plan.clear();
    for (int j = 0; j < 7; ++j) {
      const bool odd = j == 2;
      plan.begin(j, odd ? x[0] : home()(j), vpTrajectoryForm::Direct);
      plan.append(j, odd ? vpPolynomial{x[1], x[2], x[3], x[4]} : vpPolynomial{0.}, odd ? x[5] : 0.5);
      plan.finish(j, odd ? vpAxisState{x[6], x[7], 0., 0.} : vpAxisState{home()(j), 0., 0., 0.});
    }
  };
  const double q = home()(2);
  const std::array<double, 8> ordinary{{q, 0., 0.01, 0.01, 0.01, 0.5, q + 0.03, 0.12}};
  make(ordinary);
  REQUIRE(certificate.check(plan).isFree());
  int free = 0;
  everyPlace(ordinary, [&](const std::array<double, 8> &x, std::size_t place, std::size_t value) {
    CAPTURE(place, values[value]);
    make(x);
    const vpTrajectoryClearance verdict = certificate.verdict(plan, 0., 0.5, 0., 2000);
    if (verdict.isFree()) {
      ++free;
      vpCollisionData data;
      for (int k = 0; k <= 200; ++k) {
        vpJointVector at(7);
        for (int j = 0; j < 7; ++j) {
          at(j) = plan.at(j, 0.0025 * k)[0];
        }
        scene.place(at, data);
        REQUIRE_FALSE(scene.inCollision(data, 0., 0.0025 * k));
      }
    }
    REQUIRE((std::fabs(values[value]) <= 1e6 || place == 8 || place == 5 || !verdict.isFree()));
  });
  CHECK(free > 20); // zeros and what is next to them
  make(ordinary);
  for (const double time : values) {
    CAPTURE(time);
    const bool good = std::fabs(time) <= 1e6;
    CHECK((good || certificate.check(plan, 0., time).status == vpMotionStatus::BadInput));
    CHECK((good || certificate.check(plan, -time, time).status == vpMotionStatus::BadInput));
    CHECK((good || certificate.check(plan, 0., 0.5, time).status == vpMotionStatus::BadInput));
  }
  // A plan that jumps proves nothing for the path of the jump: the hand passes a plate between two free positions.
  vpCollisionSceneSpec spec;
  vpCollisionObject plate;
  plate.name = "plate";
  plate.shape = vpCollisionShape::box({0.3, 0.002, 0.3});
  vpArmData data;
  vpJointVector turned = home();
  turned(0) += 0.5;
  vpArmKinematics::update(amor(), turned, data);
  plate.pose.p = data.tool.p;
  plate.pose.R = Eigen::AngleAxisd(std::atan2(data.tool.p.y(), data.tool.p.x()), Vector3d::UnitZ()).toRotationMatrix();
  spec.objects.push_back(plate);
  const vpCollisionScene behind(amor(), spec);
  vpCertifiedTrajectory careful(behind);
  vpTrajectoryPlan jump(7);
  for (int j = 0; j < 7; ++j) {
    jump.begin(j, home()(j), vpTrajectoryForm::Direct);
    jump.append(j, {0.}, 0.5);
    jump.finish(j, {home()(j) + (j == 0 ? 1. : 0.), 0., 0., 0.});
  }
  CHECK_FALSE(careful.verdict(jump, 0., 1., 0., 5000).isFree());
}

TEST_CASE("Planners and paths refuse wild configurations in a sentence", "[numbers]")
{
  const vpCollisionScene scene(amor(), everything());
  vpPathPlanner planner(scene);
  vpJointVector end = home();
  end(0) += 0.1;
  REQUIRE(planner.plan(home(), end).status == vpPathStatus::Solved);
  everyPlace(end, [&](const vpJointVector &q, std::size_t place, std::size_t value) {
    if (std::fabs(values[value]) <= 1e-9) {
      return; // small numbers are configurations
    }
    CAPTURE(place, values[value]);
    for (const vpPathResult &result : {planner.plan(home(), q), planner.plan(q, home())}) {
      REQUIRE((result.status == vpPathStatus::BadInput || result.status == vpPathStatus::OutsideLimits));
      REQUIRE_FALSE(result.message.empty());
    }
    vpJointPath path;
    path.points = {home(), q};
    REQUIRE_THROWS_AS(vpTimedPath(scene, path), vpException);
    REQUIRE_THROWS_AS(vpFindGoalConfiguration(scene, q, Vector3d(0.3, 0.3, 0.3), 0.), vpException);
  });
  vpJointPath path;
  CHECK(path.at(0.5).size() == 0);
  path.points = {home(), end};
  const vpTimedPath timed(scene, path);
  for (const double s : values) {
    CAPTURE(s);
    CHECK(path.at(s).allFinite());
    CHECK(std::isfinite(timed.at(0, s)[0]));
  }
}
