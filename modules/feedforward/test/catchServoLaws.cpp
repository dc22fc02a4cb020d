/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpCatch.h"
#include "vpServoScene.h"

#include <visp3/feedforward/vpServoController.h>

#include <limits>

namespace
{
using namespace vpServoScene;

// Where each law is expected to converge, and the tested range.
struct Domain {
  const char *id;
  double rotation; // between start and goal, deg
  double bearing;  // of the object at start and goal, deg
  double lateral;  // largest distance between start and goal camera, m
};

const Domain domains[] = {{"pbvs1", 179., 60., 2.},      {"pbvs1-rot2", 179., 60., 2.},       {"pbvs2", 179., 60., 2.},
                          {"ibvs", 25., 15., 0.2},       {"hybrid25d", 70., 20., 0.5},        {"kyrki", 60., 20., 0.3},
                          {"kyrki-rot2", 60., 20., 0.3}, {"kyrki-decoupled", 45., 15., 0.15}, {"ff-sum", 70., 25., 0.3},
                          {"ff-lookat", 179., 60., 2.},  {"ff-lookat-pi", 179., 60., 2.}};

double degrees(double rad) { return rad * 180. / M_PI; }
double radians(double deg) { return deg * M_PI / 180.; }

// A start within the domain around the goal.
vpHomogeneousMatrix randomStart(std::mt19937_64 &rng, const Domain &domain, const vpHomogeneousMatrix &cdMo)
{
  for (;;) {
    const Eigen::Matrix3d R = turn(radians(uniform(rng, 0., domain.rotation)), direction(rng));
    const Eigen::Vector3d t = uniform(rng, 0., domain.lateral) * direction(rng);
    const vpHomogeneousMatrix cMo = pose(R, t).inverse() * cdMo;
    const bool poseOnly = domain.rotation > 170.;
    const Eigen::Vector3d o = translation(cMo), d = translation(cdMo) - t;
    const bool seen = o.z() > 0.15 && std::atan2(o.head<2>().norm(), o.z()) < radians(domain.bearing);
    const double opposite = std::acos(d.normalized().dot(translation(cdMo).normalized()));
    if (poseOnly ? (d.norm() > 0.1 && degrees(opposite) < 170.) : seen) {
      return cMo;
    }
  }
}
} // namespace

TEST_CASE("every law converges from all over its domain on a perfect camera", "[laws]")
{
  const unsigned int seed = vpTestSupport::seed();
  const double dt = 0.05;
  for (const Domain &domain : domains) {
    auto rng = vpTestSupport::generator(11);
    auto law = vpServoLaw::create(domain.id);
    const int runs = 1000;
    vpServoMeasurement measurement;
    for (int run = 0; run < runs; ++run) {
      const auto points = object(rng, 0.16, 8);
      const vpHomogeneousMatrix cdMo = randomPose(rng, 0.4, 1.2, radians(std::min(domain.bearing, 20.)), radians(30.));
      vpHomogeneousMatrix cMo = randomStart(rng, domain, cdMo);
      CAPTURE(seed, domain.id, run);
      law->reset();
      law->setGoal(goal(cdMo, points));
      for (int i = 0; i < 220; ++i) {
        measure(cMo, points, measurement);
        const vpServoCommand command = law->step(measurement, dt);
        if (command.status != vpServoStatus::Servoing) {
          FAIL(vpMessage(command.status));
        }
        cMo = move(cMo, command.v, dt);
      }
      REQUIRE(translationError(cdMo, cMo) < 1e-3);
      REQUIRE(degrees(rotationError(cdMo, cMo)) < 0.1);
    }
  }
}

TEST_CASE("every law answers bad input with a status and zero twist", "[laws]")
{
  auto rng = vpTestSupport::generator(12);
  const auto points = object(rng, 0.16, 6);
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  for (const std::string &id : lawsWithoutPlan()) {
    CAPTURE(id);
    auto law = vpServoLaw::create(id);
    vpServoMeasurement good;
    measure(pose(turn(0.2, Eigen::Vector3d::UnitY()), {0.05, 0., 0.6}), points, good);
    const auto check = [&](const vpServoMeasurement &measurement, double dt, vpServoStatus status) {
      const vpServoCommand command = law->step(measurement, dt);
      REQUIRE(vpToString(command.status) == std::string(vpToString(status)));
      REQUIRE((status == vpServoStatus::Servoing) == (command.v.linearNorm() + command.v.angularNorm() > 0.));
    };
    check(good, 0.01, vpServoStatus::NoGoal);
    law->setGoal(goal(pose(Eigen::Matrix3d::Identity(), {0., 0., 0.5}), points));
    check(good, 0.01, vpServoStatus::Servoing);

    for (double dt : {0., -0.01, nan, inf}) {
      check(good, dt, vpServoStatus::InvalidInput);
    }
    vpServoMeasurement bad = good;
    bad.valid = false;
    check(bad, 0.01, vpServoStatus::Holding);
    for (double value : {nan, inf, -inf}) {
      bad = good;
      bad.cMo[1][3] = value;
      check(bad, 0.01, vpServoStatus::InvalidInput);
      bad = good;
      bad.cMo[0][2] = value;
      check(bad, 0.01, vpServoStatus::InvalidInput);
      bad = good;
      bad.points[2].x = value;
      check(bad, 0.01, vpServoStatus::InvalidInput);
      bad.points[2].visible = false; // is then ignored
      check(bad, 0.01, vpServoStatus::Servoing);
    }
    for (double depth : {0., -0.5, nan}) {
      bad = good;
      bad.points[5].Z = depth;
      check(bad, 0.01, vpServoStatus::InvalidInput);
    }
    bad = good;
    bad.points.pop_back();
    check(bad, 0.01, vpServoStatus::InvalidInput);
    bad = good;
    bad.cMo[0][0] = -bad.cMo[0][0]; // not a rotation any more
    check(bad, 0.01, vpServoStatus::InvalidInput);
    law->reset();
    check(good, 0.01, vpServoStatus::NoGoal);
  }
}

TEST_CASE("laws without enough points are degenerate, not wild", "[laws]")
{
  auto rng = vpTestSupport::generator(13);
  const vpHomogeneousMatrix cdMo = pose(Eigen::Matrix3d::Identity(), {0., 0., 0.5});
  const vpHomogeneousMatrix cMo = pose(turn(0.2, Eigen::Vector3d::UnitX()), {0.05, 0.02, 0.6});
  const auto statusWith = [&](const char *id, const std::vector<Eigen::Vector3d> &points, int visible) {
    auto law = vpServoLaw::create(id);
    law->setGoal(goal(cdMo, points));
    vpServoMeasurement measurement;
    measure(cMo, points, measurement);
    for (std::size_t i = visible; i < measurement.points.size(); ++i) {
      measurement.points[i].visible = false;
    }
    const vpServoCommand command = law->step(measurement, 0.01);
    if (command.status != vpServoStatus::Servoing) {
      REQUIRE(command.v.linearNorm() + command.v.angularNorm() == 0.);
    }
    return command.status;
  };
  const auto square = object(rng, 0.16, 6);
  CHECK(statusWith("ibvs", square, 2) == vpServoStatus::Degenerate);
  CHECK(statusWith("ibvs", square, 3) == vpServoStatus::Servoing);
  const std::vector<Eigen::Vector3d> line = {{-0.1, 0., 0.}, {0., 0., 0.}, {0.05, 0., 0.}, {0.1, 0., 0.}};
  CHECK(statusWith("ibvs", line, 4) == vpServoStatus::Degenerate);
  for (unsigned int k = 0; k < 200; ++k) { // a line in any direction, and a small square far away, which is enough
    auto random = vpTestSupport::generator(1300 + k);
    CAPTURE(vpTestSupport::seed(), k);
    const bool worst = k == 0; // straight ahead, 2 m away
    const vpHomogeneousMatrix seenFrom =
        worst ? pose(Eigen::Matrix3d::Identity(), {0., 0., 2.}) : randomPose(random, 0.4, 2., 0.3, 0.8);
    const Eigen::Vector3d along(0.06, 0.02, 0.01);
    const auto status = [&](const std::vector<Eigen::Vector3d> &points) {
      auto law = vpServoLaw::create("ibvs");
      law->setGoal(goal(cdMo, points));
      vpServoMeasurement measurement;
      measure(seenFrom, points, measurement);
      return law->step(measurement, 0.01).status;
    };
    REQUIRE(status({-along, 0.3 * along, along, 1.7 * along}) == vpServoStatus::Degenerate);
    const double half = 0.0025;
    REQUIRE(status({{-half, -half, 0.}, {half, -half, 0.}, {half, half, 0.}, {-half, half, 0.}}) ==
            vpServoStatus::Servoing);
  }
  for (const char *id : {"hybrid25d", "kyrki", "kyrki-rot2", "kyrki-decoupled", "ff-sum"}) {
    CAPTURE(id);
    CHECK(statusWith(id, square, 0) == vpServoStatus::Degenerate);
    CHECK(statusWith(id, square, 1) == vpServoStatus::Servoing);
  }
  for (const char *id : {"pbvs1", "pbvs1-rot2", "pbvs2", "ff-lookat", "ff-lookat-pi"}) {
    CAPTURE(id);
    CHECK(statusWith(id, square, 0) == vpServoStatus::Servoing); // they need the pose only
  }
  // The camera on the other side of the object: no orientation is "the nearest" that looks at it.
  auto law = vpServoLaw::create("ff-lookat");
  law->setGoal(goal(cdMo, square));
  vpServoMeasurement behind;
  measure(pose(turn(M_PI, Eigen::Vector3d::UnitY()), {0., 0., 0.5}), square, behind);
  behind.cMo = pose(Eigen::Matrix3d::Identity(), {0., 0., -0.5});
  CHECK(law->step(behind, 0.01).status == vpServoStatus::Degenerate);
}

TEST_CASE("set-up errors say what is wrong", "[laws][errors]")
{
  using Catch::Contains;
  vpServoGains gains;
  gains.lambda = 0.;
  CHECK_THROWS_WITH(vpServoLaw::create("pbvs1", gains), Contains("lambda of the servo gains is 0 1/s, must be > 0"));
  gains = {};
  gains.kappa = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH(vpServoLaw::create("pbvs1", gains), Contains("kappa of the servo gains is nan"));
  gains = {};
  gains.integralLimit = -1.;
  CHECK_THROWS_WITH(vpServoLaw::create("pbvs1", gains), Contains("integralLimit of the servo gains is -1 rad/s"));
  CHECK_THROWS_WITH(vpServoLaw::create("pvbs"),
                    Contains("servo law \"pvbs\" is unknown, known are: pbvs1, pbvs1-rot2, pbvs2, ibvs, hybrid25d, "
                             "kyrki, kyrki-rot2, kyrki-decoupled, ff-sum, ff-lookat, ff-lookat-pi"));

  auto law = vpServoLaw::create("pbvs1");
  auto rng = vpTestSupport::generator(14);
  const auto points = object(rng, 0.16, 4);
  vpServoGoal bad = goal(pose(Eigen::Matrix3d::Identity(), {0., 0., 0.5}), points);
  bad.points.clear();
  CHECK_THROWS_WITH(law->setGoal(bad), Contains("the servo goal has 0 points"));
  bad = goal(pose(Eigen::Matrix3d::Identity(), {0., 0., 0.5}), points);
  bad.points[3].Z = -2.;
  CHECK_THROWS_WITH(law->setGoal(bad), Contains("point 3 of the servo goal is x = ") && Contains("Z = -2 m"));
  bad = goal(pose(Eigen::Matrix3d::Identity(), {0., 0., 0.5}), points);
  bad.cdMo[2][3] = -0.5;
  CHECK_THROWS_WITH(law->setGoal(bad), Contains("has depth -0.5 m, must be > 0"));
  bad.cdMo[1][1] = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH(law->setGoal(bad), Contains("cdMo is not a finite rigid motion"));
  CHECK(law->goal().points.empty()); // a refused goal changes nothing
}

TEST_CASE("no step of any law or controller allocates", "[laws][realtime]")
{
  if (!vpTestSupport::canCountAllocations()) {
    WARN("allocations cannot be counted in this build");
    return;
  }
  auto rng = vpTestSupport::generator(15);
  const auto points = object(rng, 0.16, 30);
  vpServoMeasurement seen, lost;
  measure(pose(turn(0.3, Eigen::Vector3d::UnitY()), {0.25, 0., 0.6}), points, seen); // partly beyond the border
  for (const std::string &id : vpServoLaw::ids()) {
    for (const char *suffix : {"", "+cbf"}) {
      CAPTURE(id, suffix);
      if (*suffix != '\0' && vpServoLaw::create(id)->plansMotion()) {
        continue; // refused: catchServoController
      }
      auto servo = vpServoController::create(id + suffix);
      servo.setGoal(goal(pose(Eigen::Matrix3d::Identity(), {0., 0., 0.5}), points));
      double sink = 0.;
      const unsigned long before = vpTestSupport::allocationCount();
      for (int i = 0; i < 400; ++i) {
        sink += servo.step(i < 100 ? seen : lost, 0.01).v[4];
        sink += servo.referenceRotation(seen, vpServoCommand())(0, 2);
      }
      REQUIRE(vpTestSupport::allocationCount() == before);
      REQUIRE(std::isfinite(sink));
    }
  }
}
