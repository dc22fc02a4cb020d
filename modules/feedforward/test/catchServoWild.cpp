/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Invalid numbers in every field of a measurement, of a goal and of the time, for every law; and divergence of ibvs.
#include "vpCatch.h"
#include "vpServoScene.h"
#include "vpWildNumbers.h"

#include <visp3/core/vpException.h>
#include <visp3/feedforward/vpFeatureFeedforwardSum.h>
#include <visp3/feedforward/vpFeatureLookAt.h>
#include <visp3/feedforward/vpFeedforwardTask.h>
#include <visp3/feedforward/vpServoController.h>
#include <visp3/feedforward/vpTwistProjection.h>

#include <array>

namespace
{
using namespace vpServoScene;

constexpr std::size_t fields = 16 + 4 * 3 + 36 + 2; // cMo, points, covariance, time, dt
using Numbers = std::array<double, fields>;

Numbers numbersOf(const vpServoMeasurement &m, double dt)
{
  Numbers x{};
  std::size_t k = 0;
  for (unsigned int i = 0; i < 16; ++i) {
    x[k++] = m.cMo.data[i];
  }
  for (std::size_t i = 0; i < 4; ++i) {
    x[k++] = m.points[i].x;
    x[k++] = m.points[i].y;
    x[k++] = m.points[i].Z;
  }
  for (double c : m.covariance.C) {
    x[k++] = c;
  }
  x[k++] = m.time;
  x[k++] = dt;
  return x;
}

void put(const Numbers &x, vpServoMeasurement &m, double &dt)
{
  std::size_t k = 0;
  for (unsigned int i = 0; i < 16; ++i) {
    m.cMo.data[i] = x[k++];
  }
  for (std::size_t i = 0; i < 4; ++i) {
    m.points[i] = {x[k], x[k + 1], x[k + 2], true};
    k += 3;
  }
  m.outline = m.points;
  for (double &c : m.covariance.C) {
    c = x[k++];
  }
  m.time = x[k++];
  dt = x[k];
}

// Valid output of a step: finite, zero with an error, and no faster than the largest gain times the largest distance.
void check(const vpServoCommand &command)
{
  REQUIRE(command.v.isFinite());
  if (!vpIsWorking(command.status) && command.status != vpServoStatus::Deadlock) {
    REQUIRE(command.v.linearNorm() + command.v.angularNorm() == 0.);
  }
}
} // namespace

TEST_CASE("no wild number gets through a law or a controller, and it goes on after them", "[wild]")
{
  auto rng = vpTestSupport::generator(81);
  CAPTURE(vpTestSupport::seed());
  const auto points = object(rng, 0.16, 4);
  const vpHomogeneousMatrix cdMo = pose(Eigen::Matrix3d::Identity(), {0., 0., 0.5});
  const vpHomogeneousMatrix cMo = pose(turn(0.3, Eigen::Vector3d(1., 2., 0.5).normalized()), {0.05, -0.03, 0.6});
  vpServoMeasurement good, seen;
  measure(cMo, points, good);
  good.covariance.known = true;
  for (std::size_t i = 0; i < 6; ++i) {
    good.covariance(i, i) = 1e-6;
  }
  const Numbers ordinary = numbersOf(good, 0.01);
  for (const std::string &id : lawsWithoutPlan()) { // the others: catchServoPlanLimits
    for (const bool filtered : {false, true}) {
      CAPTURE(id, filtered);
      vpServoController servo = vpServoController::create(filtered ? id + "+cbf" : id);
      servo.setGoal(goal(cdMo, points));
      const auto run = [&](const Numbers &x) {
        double dt = 0.;
        seen = good;
        put(x, seen, dt);
        const vpServoCommand command = servo.step(seen, dt);
        check(command);
        if (filtered) {
          REQUIRE(vpWildNumbers::atMost(command.v.linearNorm(), servo.spec().view.maxLinear));
          REQUIRE(vpWildNumbers::atMost(command.v.angularNorm(), servo.spec().view.maxAngular));
        }
        REQUIRE(servo.referenceRotation(seen, command).allFinite());
      };
      vpWildNumbers::everyPlace(ordinary, [&](const Numbers &x, std::size_t place, std::size_t value) {
        CAPTURE(place, value);
        run(x);
      });
      for (int k = 0; k < 1000; ++k) {
        Numbers x = ordinary;
        vpWildNumbers::mix(rng, x, k % 2 == 0 ? 0.02 : 0.3);
        CAPTURE(k);
        run(x);
      }
      servo.reset();
      servo.setGoal(goal(cdMo, points));
      const vpServoCommand after = servo.step(good, 0.01);
      REQUIRE(vpIsWorking(after.status));
      REQUIRE(after.v.linearNorm() < 10.);
    }
  }
}

TEST_CASE("a task of vpServo refuses the measurements that its law refuses", "[wild]")
{
  auto rng = vpTestSupport::generator(83);
  CAPTURE(vpTestSupport::seed());
  const auto points = object(rng, 0.16, 4);
  const vpServoGoal wanted = goal(pose(Eigen::Matrix3d::Identity(), {0., 0., 0.5}), points);
  vpServoMeasurement seen;
  measure(pose(turn(0.3, Eigen::Vector3d::UnitY()), {0.05, -0.03, 0.6}), points, seen);
  const Numbers ordinary = numbersOf(seen, 0.01);
  for (const std::string &id : vpFeedforwardTask::laws()) {
    CAPTURE(id);
    vpFeedforwardTask task(id);
    task.setGoal(wanted);
    const auto law = vpServoLaw::create(id);
    law->setGoal(wanted);
    int refused = 0;
    const auto run = [&](const Numbers &x) {
      double dt = 0.;
      put(x, seen, dt);
      const bool isTaken = law->step(seen, 0.01).status == vpServoStatus::Servoing;
      refused += isTaken ? 0 : 1;
      try {
        const vpColVector v = task.computeControlLaw(seen);
        REQUIRE(isTaken);
        REQUIRE(std::isfinite(v.sumSquare()));
      }
      catch (const vpException &) {
        REQUIRE_FALSE(isTaken);
      }
    };
    vpWildNumbers::everyPlace(ordinary, [&](const Numbers &x, std::size_t place, std::size_t value) {
      CAPTURE(place, value);
      run(x);
    });
    for (int k = 0; k < 1000; ++k) {
      Numbers x = ordinary;
      vpWildNumbers::mix(rng, x, k % 2 == 0 ? 0.02 : 0.3);
      CAPTURE(k);
      run(x);
    }
    CHECK(refused > 500);
  }
}

TEST_CASE("a wild goal is refused, or harmless", "[wild]")
{
  auto rng = vpTestSupport::generator(82);
  const auto points = object(rng, 0.16, 4);
  const vpHomogeneousMatrix cdMo = pose(Eigen::Matrix3d::Identity(), {0., 0., 0.5});
  vpServoMeasurement seen;
  measure(pose(turn(0.3, Eigen::Vector3d::UnitY()), {0.05, -0.03, 0.6}), points, seen);
  vpServoMeasurement model;
  measure(cdMo, points, model);
  int refused = 0, taken = 0;
  for (const std::string &id : vpServoLaw::ids()) {
    const auto law = vpServoLaw::create(id);
    vpWildNumbers::everyPlace(numbersOf(model, 0.01), [&](const Numbers &x, std::size_t place, std::size_t value) {
      if (place >= 28) {
        return; // not in a goal
      }
      CAPTURE(id, place, value);
      vpServoMeasurement wild = model;
      double dt = 0.;
      put(x, wild, dt);
      try {
        law->setGoal({wild.cMo, wild.points});
        check(law->step(seen, 0.01));
        ++taken;
      }
      catch (const vpException &) {
        ++refused;
      }
      vpFeatureLookAt gaze;
      vpFeatureFeedforwardSum sum;
      try {
        gaze.buildFrom(wild.cMo, cdMo);
        gaze.buildFrom(cdMo, wild.cMo);
        sum.buildFrom(wild.cMo, {wild.points[0]}, {wild.points[1]});
        for (unsigned int i = 0; i < 3; ++i) {
          REQUIRE(std::isfinite(gaze[i]));
          REQUIRE(std::isfinite(sum[i]));
        }
        for (const vpMatrix &L : {gaze.interaction(), sum.interaction()}) {
          for (unsigned int i = 0; i < 18; ++i) {
            REQUIRE(std::isfinite(L.data[i]));
          }
        }
      }
      catch (const vpException &) {
      }
    });
  }
  CHECK(refused > 1000);
  CHECK(taken > 1000);
}

TEST_CASE("a projection of wild numbers is finite or says that there is none", "[wild][projection]")
{
  auto rng = vpTestSupport::generator(83);
  CAPTURE(vpTestSupport::seed());
  int solved = 0;
  for (int k = 0; k < 20000; ++k) {
    vpTwistProjection projection;
    const double share = k % 2 == 0 ? 0.05 : 0.3;
    for (int row = 0; row < 4; ++row) {
      vpTwistProjection::Vector a;
      for (int i = 0; i < 6; ++i) {
        a[i] = vpWildNumbers::mixed(rng, uniform(rng, -1., 1.), share);
      }
      static_cast<void>(projection.addRow(a, vpWildNumbers::mixed(rng, uniform(rng, -1., 0.5), share)));
    }
    vpTwistProjection::Vector x;
    for (int i = 0; i < 6; ++i) {
      x[i] = vpWildNumbers::mixed(rng, uniform(rng, -1., 1.), share);
    }
    if (projection.solve(x) == vpTwistProjection::Result::Solved) {
      ++solved;
      REQUIRE(projection.solution().allFinite());
    }
  }
  CHECK(solved > 5000);
}

TEST_CASE("recovery of a lost target remembers nothing wild", "[wild][recovery]")
{
  auto rng = vpTestSupport::generator(84);
  CAPTURE(vpTestSupport::seed());
  vpTargetLossRecovery recovery;
  for (int run = 0; run < 50; ++run) {
    for (int k = 0; k < 100; ++k) {
      std::array<double, 6> v{0.1, 0., 0.05, 0., 0.1, 0.};
      vpWildNumbers::mix(rng, v, 0.1);
      const vpServoCommand command{{v[0], v[1], v[2], v[3], v[4], v[5]}, vpServoStatus::Servoing};
      REQUIRE(recovery.step(command, vpWildNumbers::mixed(rng, 0.01, 0.1)).v.isFinite());
    }
    int cycles = 0;
    vpServoCommand back;
    do { // ends
      back = recovery.step({vpTwist(), vpServoStatus::Holding}, 0.01);
      REQUIRE(back.v.isFinite());
      REQUIRE(vpWildNumbers::atMost(back.v.linearNorm(), recovery.spec().maxLinear));
      REQUIRE(vpWildNumbers::atMost(back.v.angularNorm(), recovery.spec().maxAngular));
    } while (vpIsWorking(back.status) && ++cycles < 10000);
    REQUIRE(back.status == vpServoStatus::Lost);
  }
}

TEST_CASE("ibvs that runs away from the target says so and stops; a roll it can do it does", "[ibvs]")
{
  auto rng = vpTestSupport::generator(85);
  const auto points = object(rng, 0.16, 4);
  const vpHomogeneousMatrix cdMo = pose(Eigen::Matrix3d::Identity(), {0., 0., 0.5});
  for (const double degrees : {60., 120., 150., 175., 180.}) {
    CAPTURE(degrees);
    const auto law = vpServoLaw::create("ibvs");
    law->setGoal(goal(cdMo, points));
    vpHomogeneousMatrix cMo = pose(turn(degrees * M_PI / 180., Eigen::Vector3d::UnitZ()), {0., 0., 0.5});
    vpServoMeasurement seen;
    vpServoCommand command;
    int cycles = 0;
    double farthest = 0.;
    do { // the loop of the documentation
      measure(cMo, points, seen);
      command = law->step(seen, 0.01);
      cMo = move(cMo, command.v, 0.01);
      farthest = std::max(farthest, translation(cMo).z());
    } while (vpIsWorking(command.status) && rotationError(cdMo, cMo) + translationError(cdMo, cMo) > 1e-3 &&
             ++cycles < 5000);
    CHECK(cycles < 5000);
    CHECK(farthest < 2.6);
    CHECK(command.status == (degrees < 157. ? vpServoStatus::Servoing : vpServoStatus::Diverging));
    if (degrees > 157.) {
      CHECK(command.v.linearNorm() == 0.);
      CHECK(std::string(vpToString(command.status)) == "Diverging");
      law->setGoal(goal(cMo, points)); // a nearby goal: it continues
      CHECK(law->step(seen, 0.01).status == vpServoStatus::Servoing);
    }
  }
}
