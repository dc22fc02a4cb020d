/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpCatch.h"
#include "vpWildNumbers.h"

#include <visp3/core/vpExponentialMap.h>
#include <visp3/feedforward/vpOdometryBridge.h>
#include <visp3/simulation/vpVisionChannel.h>

#include <cmath>

VISP_DIRECT_USING_NAMESPACE

namespace
{
vpServoMeasurement look(const vpHomogeneousMatrix &cMo, double time)
{
  vpServoMeasurement m;
  m.valid = true;
  m.time = time;
  m.cMo = cMo;
  for (const auto &p : {std::pair<double, double>(-0.1, 0.05), {0.07, 0.02}, {0., -0.09}}) {
    const double Z = cMo[2][0] * p.first + cMo[2][1] * p.second + cMo[2][3];
    m.points.push_back({(cMo[0][0] * p.first + cMo[0][1] * p.second + cMo[0][3]) / Z,
                        (cMo[1][0] * p.first + cMo[1][1] * p.second + cMo[1][3]) / Z, Z, true});
  }
  m.outline = m.points;
  return m;
}
} // namespace

TEST_CASE("every exposure arrives once, in order, and not before its latency is over", "[channel]")
{
  auto rng = vpTestSupport::generator(1);
  CAPTURE(vpTestSupport::seed());
  std::uniform_real_distribution<double> loop(20., 1000.), share(0.01, 1.), latency(0., 0.5);
  for (int problem = 0; problem < 200; ++problem) {
    const double loopRate = loop(rng), frameRate = loopRate * share(rng), late = problem % 4 == 0 ? 0. : latency(rng);
    CAPTURE(problem, loopRate, frameRate, late);
    vpVisionChannel channel(frameRate, late);
    std::vector<double> exposed, arrived;
    const int cycles = 2000;
    for (int k = 0; k < cycles; ++k) {
      const double now = k / loopRate;
      if (channel.due(now)) {
        vpServoMeasurement m;
        m.time = now;
        exposed.push_back(now);
        channel.push(m);
        REQUIRE_FALSE(channel.due(now));
      }
      vpServoMeasurement result;
      while (channel.pop(now, result)) {
        arrived.push_back(result.time);
        REQUIRE(now - result.time >= late - 1e-6);
        REQUIRE(now - result.time <= late + 1. / loopRate + 1e-6);
      }
    }
    // All but those still on their way.
    REQUIRE(arrived.size() <= exposed.size());
    REQUIRE(std::equal(arrived.begin(), arrived.end(), exposed.begin()));
    REQUIRE((cycles - 1) / loopRate - exposed[arrived.size() - (arrived.size() == exposed.size())] <=
            late + 1. / frameRate + 1. / loopRate + 1e-6);
    const double expected = (cycles - 1) / loopRate * frameRate;
    REQUIRE(std::fabs(exposed.size() - expected) <= 1.01);
    for (std::size_t n = 0; n < exposed.size(); ++n) {
      REQUIRE(std::fabs(exposed[n] - n / frameRate) <= 1. / loopRate + 1e-6); // no drift
    }
  }
  CHECK_THROWS_WITH(vpVisionChannel(0., 0.1), Catch::Contains("frame rate is 0 Hz, must be > 0 and finite"));
  CHECK_THROWS_WITH(vpVisionChannel(10., -1.), Catch::Contains("latency is -1 s, must be >= 0 and finite"));
}

TEST_CASE("a frame at 10 Hz comes every tenth cycle of 100 Hz, whatever 0.1 is in binary", "[channel]")
{
  vpVisionChannel channel(10., 0.1);
  for (int k = 0; k < 5000; ++k) {
    REQUIRE(channel.due(k * 0.01) == (k % 10 == 0));
    if (k % 10 == 0) {
      vpServoMeasurement m, result;
      m.time = k * 0.01;
      channel.push(m);
      REQUIRE(channel.pop(k * 0.01, result) == (k >= 10));
      REQUIRE(result.time == Approx(k >= 10 ? (k - 10) * 0.01 : 0.));
    }
  }
}

TEST_CASE("odometry carries a late measurement to now exactly", "[bridge]")
{
  auto rng = vpTestSupport::generator(2);
  CAPTURE(vpTestSupport::seed());
  std::uniform_real_distribution<double> unit(-1., 1.);
  for (int problem = 0; problem < 100; ++problem) {
    const int delay = problem % 15;
    CAPTURE(problem, delay);
    vpOdometryBridge bridge;
    vpVisionChannel channel(10., delay * 0.01);
    vpHomogeneousMatrix wMc;
    const vpHomogeneousMatrix wMo(0.05 * unit(rng), 0.05 * unit(rng), 0.8, 0.3 * unit(rng), 0.3 * unit(rng), unit(rng));
    for (int k = 0; k < 100; ++k) {
      const double now = k * 0.01;
      if (channel.due(now)) {
        channel.push(look(wMc.inverse() * wMo, now));
      }
      vpServoMeasurement result, predicted;
      while (channel.pop(now, result)) {
        REQUIRE(bridge.correct(result));
      }
      bridge.predict(predicted);
      REQUIRE(predicted.valid == (k >= delay));
      if (predicted.valid) {
        const vpServoMeasurement truth = look(wMc.inverse() * wMo, now);
        for (unsigned int i = 0; i < 16; ++i) {
          REQUIRE(predicted.cMo.data[i] == Approx(truth.cMo.data[i]).margin(1e-12));
        }
        for (std::size_t i = 0; i < truth.points.size(); ++i) {
          REQUIRE(predicted.points[i].x == Approx(truth.points[i].x).margin(1e-12));
          REQUIRE(predicted.points[i].y == Approx(truth.points[i].y).margin(1e-12));
          REQUIRE(predicted.points[i].Z == Approx(truth.points[i].Z).margin(1e-12));
          REQUIRE(predicted.outline[i].x == Approx(truth.outline[i].x).margin(1e-12));
        }
        REQUIRE(predicted.time <= now - delay * 0.01 + 1e-9);
      }
      const vpTwist v(0.2 * unit(rng), 0.2 * unit(rng), 0.2 * unit(rng), 0.4 * unit(rng), 0.4 * unit(rng), unit(rng));
      wMc = wMc * vpExponentialMap::direct(v.toColVector(), 0.01);
      REQUIRE(bridge.move(v, (k + 1) * 0.01));
    }
  }
}

TEST_CASE("the bridge passes on what was not seen and refuses the future", "[bridge]")
{
  vpOdometryBridge bridge;
  vpServoMeasurement now;
  now.valid = true;
  bridge.predict(now);
  CHECK_FALSE(now.valid); // nothing came yet

  vpServoMeasurement seen = look(vpHomogeneousMatrix(0., 0., 0.5, 0., 0., 0.), 0.);
  seen.points[1].visible = false;
  CHECK(bridge.correct(seen));
  CHECK(bridge.move(vpTwist(0., 0., 1., 0., 0., 0.), 0.4));
  bridge.predict(now);
  CHECK(now.valid);
  CHECK(now.cMo[2][3] == Approx(0.1));
  CHECK(now.points[0].visible);
  CHECK_FALSE(now.points[1].visible);

  CHECK(bridge.move(vpTwist(0., 0., 1., 0., 0., 0.), 0.6)); // now behind the camera
  bridge.predict(now);
  CHECK_FALSE(now.valid);
  CHECK_FALSE(now.points[0].visible);

  seen.time = 0.7;
  CHECK_FALSE(bridge.correct(seen)); // of the future
  seen.time = 0.6;
  seen.valid = false;
  CHECK(bridge.correct(seen));
  bridge.predict(now);
  CHECK_FALSE(now.valid); // a frame without the object replaces the one that had it
  CHECK(now.time == 0.6);
}

TEST_CASE("an hour without a frame: the bridge neither grows nor allocates, and what was seen expires",
          "[bridge][realtime]")
{
  vpOdometryBridge bridge(0.8, 100.);
  vpServoMeasurement seen = look(vpHomogeneousMatrix(0., 0., 0.5, 0., 0., 0.), 0.), now;
  REQUIRE(bridge.correct(seen));
  bridge.predict(now); // the vectors take their sizes
  const unsigned long before = vpTestSupport::allocationCount();
  long lastValid = -1, moved = 0;
  for (long k = 0; k < 360000; ++k) {
    moved += bridge.move(vpTwist(0.01, 0., 0., 0., 0.02, 0.), 0.01 * (k + 1)) ? 1 : 0;
    bridge.predict(now);
    lastValid = now.valid ? k : lastValid;
  }
  const unsigned long after = vpTestSupport::allocationCount();
  CHECK(moved == 360000);
  CHECK(lastValid == 79); // 0.8 s
  CHECK(std::isinf(vpOdometryBridge().age()));
  if (vpTestSupport::canCountAllocations()) {
    CHECK(after == before);
  }
  seen.time = 3600. - 0.5; // a late frame is carried on exactly, also from between two instants
  REQUIRE(bridge.correct(seen));
  bridge.predict(now);
  REQUIRE(now.valid);
  const vpHomogeneousMatrix nMc =
      vpExponentialMap::direct(vpTwist(0.01, 0., 0., 0., 0.02, 0.).toColVector(), 0.5).inverse();
  const vpHomogeneousMatrix expected = nMc * seen.cMo;
  for (unsigned int i = 0; i < 16; ++i) {
    CHECK(now.cMo.data[i] == Approx(expected.data[i]).margin(1e-12));
  }
  seen.time = 3600. - 0.8 - 0.05;
  CHECK_FALSE(bridge.correct(seen)); // too late for the path
  CHECK_THROWS_WITH(vpOdometryBridge(0.), Catch::Contains("greatest age of the odometry bridge is 0 s"));
  CHECK_THROWS_WITH(vpOdometryBridge(1., NAN), Catch::Contains("rate of the odometry bridge is nan Hz"));
}

TEST_CASE("wild clocks and twists never leave a valid measurement that is not finite", "[bridge][wild]")
{
  auto rng = vpTestSupport::generator(4);
  CAPTURE(vpTestSupport::seed());
  int valid = 0;
  for (int run = 0; run < 100; ++run) {
    vpOdometryBridge bridge(0.5, 100.);
    vpWildNumbers::Clock clock(0.01);
    vpServoMeasurement now;
    for (int k = 0; k < 400; ++k) {
      std::array<double, 6> v{0.01, 0.02, -0.01, 0.1, 0., 0.2};
      vpWildNumbers::mix(rng, v, 0.01);
      const double time = clock.next(rng, 0.05);
      static_cast<void>(bridge.move(vpTwist(v[0], v[1], v[2], v[3], v[4], v[5]), time));
      if (k % 10 == 0) {
        static_cast<void>(
            bridge.correct(look(vpHomogeneousMatrix(0., 0., 0.5, 0., 0., 0.), vpWildNumbers::mixed(rng, time, 0.1))));
      }
      bridge.predict(now);
      if (!now.valid) {
        continue;
      }
      ++valid;
      REQUIRE(bridge.age() >= -1e-6);
      REQUIRE(bridge.age() <= 0.5 + 1e-6);
      for (unsigned int i = 0; i < 16; ++i) {
        REQUIRE(std::isfinite(now.cMo.data[i]));
      }
      for (const vpServoPoint &p : now.points) {
        REQUIRE((!p.visible || (std::isfinite(p.x) && std::isfinite(p.y) && p.Z > 0.)));
      }
    }
  }
  CHECK(valid > 10000); // it goes on after every one of them
}
