/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpCatch.h"
#include "vpServoScene.h"

#include <visp3/feedforward/vpTargetLossRecovery.h>

#include <limits>

namespace
{
using namespace vpServoScene;

const vpServoCommand lost{vpTwist(), vpServoStatus::Holding};

vpServoCommand seen(const vpTwist &v) { return {v, vpServoStatus::Servoing}; }

double distance(const vpHomogeneousMatrix &a, const vpHomogeneousMatrix &b)
{
  return (rotation(a) - rotation(b)).norm() + (translation(a) - translation(b)).norm();
}
} // namespace

TEST_CASE("the retreat undoes the last motion exactly, at the recorded speed or slower", "[recovery]")
{
  const unsigned int seed = vpTestSupport::seed();
  for (int run = 0; run < 300; ++run) {
    auto rng = vpTestSupport::generator(200 + run);
    vpTargetLossSpec spec;
    spec.holdTime = 0.2;
    spec.retreatTime = 1.;
    spec.maxLinear = 0.3;
    spec.maxAngular = 0.4;
    vpTargetLossRecovery recovery(spec);
    const double dt = 0.01;
    vpHomogeneousMatrix cMo = pose(Eigen::Matrix3d::Identity(), {0., 0., 1.}), passed;
    for (int i = 0; i < 150; ++i) { // the last 100 of these are 1 s
      if (i == 50) {
        passed = cMo;
      }
      const vpTwist v = randomTwist(rng, run % 2 == 0 ? 0.2 : 0.6, run % 3 == 0 ? 0.3 : 1.);
      const vpServoCommand command = recovery.step(seen(v), dt);
      REQUIRE(command.status == vpServoStatus::Servoing);
      REQUIRE(command.v[4] == v[4]);
      cMo = move(cMo, command.v, dt);
    }
    int holding = 0, retreating = 0;
    const double slowest = std::max({1., run % 2 == 0 ? 1. : 0.6 / 0.3, run % 3 == 0 ? 1. : 1. / 0.4});
    CAPTURE(seed, run, slowest);
    for (;;) {
      const vpServoCommand command = recovery.step(lost, dt);
      if (command.status == vpServoStatus::Lost) {
        REQUIRE(command.v.linearNorm() + command.v.angularNorm() == 0.);
        break;
      }
      REQUIRE(command.v.linearNorm() <= spec.maxLinear * (1. + 1e-9));
      REQUIRE(command.v.angularNorm() <= spec.maxAngular * (1. + 1e-9));
      holding += command.status == vpServoStatus::Holding;
      retreating += command.status == vpServoStatus::Retreating;
      cMo = move(cMo, command.v, dt);
    }
    REQUIRE(holding == 20);
    REQUIRE(std::abs(retreating - 100. * slowest) <= 1.);
    // A cycle that ends one piece and begins the next averages the two: exact when cycles and pieces coincide.
    REQUIRE(distance(cMo, passed) < (slowest == 1. ? 1e-12 : 5e-3));
    REQUIRE(recovery.step(lost, dt).status == vpServoStatus::Lost); // and so it stays
  }
}

TEST_CASE("a target that is seen again is followed at once, and the way back is then shorter", "[recovery]")
{
  vpTargetLossSpec spec;
  spec.holdTime = 0.05;
  spec.retreatTime = 10.;
  vpTargetLossRecovery recovery(spec);
  const vpTwist forward(0.1, 0., 0., 0., 0., 0.);
  for (int i = 0; i < 100; ++i) {
    (void)recovery.step(seen(forward), 0.01);
  }
  for (int i = 0; i < 5; ++i) {
    CHECK(recovery.step(lost, 0.01).status == vpServoStatus::Holding);
  }
  for (int i = 0; i < 30; ++i) {
    const vpServoCommand command = recovery.step(lost, 0.01);
    REQUIRE(command.status == vpServoStatus::Retreating);
    REQUIRE(command.v[0] == Approx(-0.1));
  }
  CHECK(recovery.step(seen(forward), 0.01).status == vpServoStatus::Servoing);
  for (int i = 0; i < 5; ++i) { // the clock starts again
    CHECK(recovery.step(lost, 0.01).status == vpServoStatus::Holding);
  }
  int retreating = 0;
  while (recovery.step(lost, 0.01).status == vpServoStatus::Retreating) {
    ++retreating;
  }
  CHECK(retreating == 71);
  recovery.reset();
  (void)recovery.step(seen(forward), 0.01);
  recovery.reset(); // forgets the motion
  for (int i = 0; i < 5; ++i) {
    (void)recovery.step(lost, 0.01);
  }
  CHECK(recovery.step(lost, 0.01).status == vpServoStatus::Lost);
}

TEST_CASE("memory is bounded, standing still takes none of it, other answers pass through", "[recovery]")
{
  vpTargetLossSpec spec;
  spec.holdTime = 0.;
  spec.capacity = 20;
  vpTargetLossRecovery recovery(spec);
  for (int i = 0; i < 50; ++i) {
    (void)recovery.step(seen(vpTwist(0., 0.1, 0., 0., 0., 0.)), 0.01);
    (void)recovery.step(seen(vpTwist()), 0.01);
  }
  int retreating = 0;
  while (recovery.step(lost, 0.01).status == vpServoStatus::Retreating) {
    ++retreating;
  }
  CHECK(retreating == 20);

  spec.retreatTime = 0.;
  vpTargetLossRecovery noWayBack(spec);
  (void)noWayBack.step(seen(vpTwist(0., 0.1, 0., 0., 0., 0.)), 0.01);
  CHECK(noWayBack.step(lost, 0.01).status == vpServoStatus::Lost);

  for (vpServoStatus status : {vpServoStatus::NoGoal, vpServoStatus::InvalidInput, vpServoStatus::Degenerate,
                               vpServoStatus::Deadlock, vpServoStatus::ViewLimited}) {
    CHECK(recovery.step({vpTwist(), status}, 0.01).status == status);
  }
  for (double dt : {0., -1., std::numeric_limits<double>::quiet_NaN()}) {
    const vpServoCommand command = recovery.step(seen(vpTwist(1., 0., 0., 0., 0., 0.)), dt);
    CHECK(command.status == vpServoStatus::InvalidInput);
    CHECK(command.v.linearNorm() == 0.);
  }
}

TEST_CASE("recovery set-up errors say what is wrong", "[recovery][errors]")
{
  using Catch::Contains;
  vpTargetLossSpec spec;
  spec.holdTime = -0.1;
  CHECK_THROWS_WITH(vpTargetLossRecovery(spec),
                    Contains("holdTime of the target-loss recovery is -0.1 s, must be >= 0"));
  spec = {};
  spec.retreatTime = std::numeric_limits<double>::infinity();
  CHECK_THROWS_WITH(vpTargetLossRecovery(spec), Contains("retreatTime of the target-loss recovery is inf s"));
  spec = {};
  spec.maxLinear = 0.;
  CHECK_THROWS_WITH(vpTargetLossRecovery(spec), Contains("maxLinear"));
  spec = {};
  spec.maxAngular = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH(vpTargetLossRecovery(spec), Contains("maxAngular"));
  spec = {};
  spec.capacity = 0;
  CHECK_THROWS_WITH(vpTargetLossRecovery(spec),
                    Contains("capacity of the target-loss recovery is 0, must be 1..100000"));
}
