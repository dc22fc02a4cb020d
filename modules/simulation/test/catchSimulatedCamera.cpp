/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpCatch.h"

#include <visp3/core/vpExponentialMap.h>
#include <visp3/robot/vpRobotException.h>
#include <visp3/robot/vpSimulatorCamera.h>
#include <visp3/simulation/vpFrictionCamera.h>

#include <cmath>

VISP_DIRECT_USING_NAMESPACE

namespace
{
vpColVector randomTwist(std::mt19937_64 &rng, double linear, double angular)
{
  std::uniform_real_distribution<double> unit(-1., 1.);
  vpColVector v(6);
  for (unsigned int i = 0; i < 6; ++i) {
    v[i] = (i < 3 ? linear : angular) * unit(rng);
  }
  return v;
}

double difference(const vpHomogeneousMatrix &a, const vpHomogeneousMatrix &b)
{
  double sum = 0.;
  for (unsigned int i = 0; i < 16; ++i) {
    sum += std::fabs(a.data[i] - b.data[i]);
  }
  return sum;
}

// One rotation about y, asked for during one cycle.
double turn(vpRobot &robot, double wy)
{
  vpColVector v(6);
  v[4] = wy;
  robot.setVelocity(vpRobot::CAMERA_FRAME, v);
  return static_cast<vpFrictionCamera &>(robot).actualTwist()[4];
}
} // namespace

TEST_CASE("without imperfections the camera is a vpSimulatorCamera", "[camera]")
{
  auto rng = vpTestSupport::generator(1);
  CAPTURE(vpTestSupport::seed());
  vpServoPlant plant;
  plant.loopRate = plant.visionRate = 40.;
  vpFrictionCamera camera(plant);
  vpSimulatorCamera peer;
  peer.setSamplingTime(1. / 40.);
  vpRobot &robot = camera; // through ViSP's interface, as a program would
  for (int i = 0; i < 1000; ++i) {
    const vpColVector v = randomTwist(rng, 0.5, 0.8);
    robot.setVelocity(vpRobot::CAMERA_FRAME, v);
    peer.setVelocity(vpRobot::CAMERA_FRAME, v);
  }
  CHECK(difference(camera.getPosition(), peer.getPosition()) < 1e-9);
  CHECK(camera.getRobotState() == vpRobot::STATE_VELOCITY_CONTROL);
}

TEST_CASE("limits scale the whole twist by one factor", "[camera]")
{
  auto rng = vpTestSupport::generator(2);
  CAPTURE(vpTestSupport::seed());
  vpServoPlant plant;
  plant.maxLinear = 0.3;
  plant.maxAngular = 0.7;
  vpFrictionCamera camera(plant);
  int limited = 0;
  for (int i = 0; i < 1000; ++i) {
    const vpTwist asked = vpTwist::fromColVector(randomTwist(rng, 0.5, 1.));
    camera.setVelocity(vpRobot::CAMERA_FRAME, asked.toColVector());
    const vpTwist &done = camera.actualTwist();
    const double factor = done[0] / asked[0];
    for (unsigned int k = 0; k < 6; ++k) {
      REQUIRE(done[k] == Approx(factor * asked[k]).margin(1e-12));
    }
    const double use = std::max(done.linearNorm() / 0.3, done.angularNorm() / 0.7);
    REQUIRE(use < 1. + 1e-12);
    REQUIRE((factor > 1. - 1e-12 || use > 1. - 1e-12)); // never slower than it must be
    limited += factor < 1. - 1e-12;
  }
  CHECK(limited > 500);
}

TEST_CASE("lag is the exact first-order response at every cycle time", "[camera]")
{
  const double rate = GENERATE(1000., 100., 20.);
  CAPTURE(rate);
  vpServoPlant plant;
  plant.loopRate = rate;
  plant.visionRate = 10.;
  plant.lag = 0.03;
  vpFrictionCamera camera(plant);
  for (int k = 1; k <= 20; ++k) {
    REQUIRE(turn(camera, 0.5) == Approx(0.5 * (1. - std::exp(-k / rate / 0.03))).epsilon(1e-12));
  }
}

TEST_CASE("friction takes the deadband from each rotation axis and leaves translation alone", "[camera]")
{
  auto rng = vpTestSupport::generator(3);
  CAPTURE(vpTestSupport::seed());
  vpServoPlant plant;
  plant.deadband = 0.2;
  plant.maxAngular = 10.;
  vpFrictionCamera camera(plant);
  for (int i = 0; i < 1000; ++i) {
    const vpColVector v = randomTwist(rng, 0.5, 0.5);
    camera.setVelocity(vpRobot::CAMERA_FRAME, v);
    for (unsigned int k = 0; k < 6; ++k) {
      const double lost = k < 3 ? 0. : 0.2;
      const double expected = v[k] > lost ? v[k] - lost : (v[k] < -lost ? v[k] + lost : 0.);
      REQUIRE(camera.actualTwist()[k] == Approx(expected).margin(1e-15));
    }
  }
  CHECK(turn(camera, 0.19) == 0.);
  CHECK(turn(camera, -0.25) == Approx(-0.05));
}

TEST_CASE("the reported twist is the motion", "[camera]")
{
  auto rng = vpTestSupport::generator(4);
  CAPTURE(vpTestSupport::seed());
  vpFrictionCamera camera(vpServoPlant::byName("B"));
  vpHomogeneousMatrix integrated;
  for (int i = 0; i < 500; ++i) {
    camera.setVelocity(vpRobot::CAMERA_FRAME, randomTwist(rng, 0.5, 1.));
    integrated = integrated * vpExponentialMap::direct(camera.actualTwist().toColVector(), 0.01);
  }
  CHECK(difference(camera.getPosition(), integrated) < 1e-10);
}

TEST_CASE("a stop brings the camera to rest at once", "[camera]")
{
  vpFrictionCamera camera(vpServoPlant::byName("B"));
  for (int i = 0; i < 20; ++i) {
    turn(camera, 1.);
  }
  CHECK(camera.actualTwist()[4] > 0.5);
  camera.setRobotState(vpRobot::STATE_STOP);
  CHECK(camera.actualTwist().angularNorm() == 0.);
  CHECK(turn(camera, 0.) == 0.); // nothing of the old motion is left in the lag
}

TEST_CASE("bad commands are named and do not move the camera", "[camera]")
{
  vpFrictionCamera camera;
  vpColVector v(6);
  v[3] = NAN;
  CHECK_THROWS_WITH(camera.setVelocity(vpRobot::CAMERA_FRAME, v),
                    Catch::Contains("component 3 of the velocity is") && Catch::Contains("must be finite"));
  CHECK_THROWS_WITH(camera.setVelocity(vpRobot::CAMERA_FRAME, vpColVector(5)),
                    Catch::Contains("a twist has 6 components, got a vector of 5"));
  CHECK_THROWS_AS(camera.setVelocity(vpRobot::MIXT_FRAME, vpColVector(6)), vpRobotException);
  CHECK(difference(camera.getPosition(), vpHomogeneousMatrix()) == 0.);
}

TEST_CASE("plants have the values of the comparison and refuse others", "[plant]")
{
  const vpServoPlant a = vpServoPlant::byName("A"), b = vpServoPlant::byName("B"), d = vpServoPlant::byName("D");
  CHECK((a.deadband == 0. && a.lag == 0. && a.latency == 0. && a.pixelNoise == 0. && a.visionRate == a.loopRate));
  CHECK((b.visionRate == 10. && b.latency == 0.1 && b.loopRate == 100. && b.pixelNoise == 0.5 && b.lag == 0.03));
  CHECK(b.deadband == 0.10);
  CHECK((d.deadband == 0.20 && d.lag == b.lag && d.visionRate == b.visionRate && d.pixelNoise == b.pixelNoise));
  CHECK((a.maxLinear == d.maxLinear && a.maxAngular == d.maxAngular && b.maxLinear == d.maxLinear));
  CHECK_THROWS_WITH(vpServoPlant::byName("C"), Catch::Contains("unknown plant 'C', known are A, B and D"));

  const struct {
    double vpServoPlant::*field;
    double value;
    const char *sentence;
  } wrong[] = {
      {&vpServoPlant::loopRate, 0., "loopRate of the plant is 0 Hz, must be > 0"},
      {&vpServoPlant::loopRate, INFINITY, "loopRate of the plant is inf Hz"},
      {&vpServoPlant::visionRate, -10., "visionRate of the plant is -10 Hz, must be > 0"},
      {&vpServoPlant::visionRate, 200., "visionRate of the plant is 200 Hz, must be <= loopRate, which is 100 Hz"},
      {&vpServoPlant::latency, -0.1, "latency of the plant is -0.1 s, must be >= 0"},
      {&vpServoPlant::pixelNoise, NAN, "pixelNoise of the plant is"},
      {&vpServoPlant::lag, -1., "lag of the plant is -1 s"},
      {&vpServoPlant::deadband, -0.2, "deadband of the plant is -0.2 rad/s, must be >= 0"},
      {&vpServoPlant::maxLinear, 0., "maxLinear of the plant is 0 m/s, must be > 0"},
      {&vpServoPlant::maxAngular, NAN, "maxAngular of the plant is"},
  };
  for (const auto &w : wrong) {
    vpServoPlant plant;
    plant.*w.field = w.value;
    CHECK_THROWS_WITH(plant.validate(), Catch::Contains(w.sentence));
    CHECK_THROWS_WITH(vpFrictionCamera(plant), Catch::Contains(w.sentence));
  }
}
