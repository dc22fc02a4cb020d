/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The motion from cell to cell: given states at the centres, C2 throughout, measured targets, freeze, forecast.
#include "vpCatch.h"

#include <visp3/printing/vpPrintReference.h>

#include <algorithm>
#include <cmath>
#include <vector>

VISP_DIRECT_USING_NAMESPACE

namespace
{
constexpr double pitch = 220. / 4.5;

std::vector<vpPrintTarget> lattice(int n, std::mt19937_64 &rng, double scatter)
{
  std::vector<vpPrintTarget> targets;
  for (int k = 0; k < n; ++k) {
    vpPrintTarget target;
    target.key = k;
    target.position = pitch * (k + 1) + scatter * std::uniform_real_distribution<double>(-1., 1.)(rng);
    targets.push_back(target);
  }
  return targets;
}
} // namespace

TEST_CASE("4 px/frame at the centres, 5 on average: the ripple of the closed form", "[reference]")
{
  auto rng = vpTestSupport::generator(60);
  const auto targets = lattice(40, rng, 0.);
  vpPrintReference reference;
  reference.step(0., targets.data(), targets.size());
  double now = 0.;
  while (reference.step(now, targets.data(), targets.size()).target < 5) {
    now += 0.25;
  }
  const vpTrajectorySegment &piece = reference.pieces()[0];
  CHECK(piece.duration == Approx(9.777778).epsilon(1e-6));
  double fastest = 0., hardest = 0., sum2 = 0.;
  constexpr int n = 20000;
  for (int i = 0; i < n; ++i) {
    const vpAxisState x = reference.at(piece.begin + piece.duration * i / n);
    fastest = std::max(fastest, x[1]);
    hardest = std::max(hardest, std::fabs(x[2]));
    sum2 += (x[1] - 5.) * (x[1] - 5.);
  }
  CHECK(fastest == Approx(5.875).epsilon(1e-5));
  CHECK(hardest == Approx(0.59).epsilon(0.01));
  CHECK(std::sqrt(sum2 / n) == Approx(0.655).epsilon(0.002));
}

TEST_CASE("In every mode the centres are passed as wished and the motion is C2", "[reference]")
{
  auto rng = vpTestSupport::generator(61);
  CAPTURE(vpTestSupport::seed());
  for (int problem = 0; problem < 400; ++problem) {
    vpPrintReferenceSpec spec;
    spec.mode = static_cast<vpPrintReferenceMode>(problem % 4);
    vpPrintReference reference(spec);
    const auto targets = lattice(12, rng, 3.);
    reference.step(0., targets.data(), targets.size());
    vpAxisState before = reference.at(0.);
    for (double now = 0.; now < 110.; now += 0.1) {
      const std::size_t known = 1 + static_cast<std::size_t>(std::max(0., before[0]) / pitch) + 2; // in view
      const auto &out = reference.step(now, targets.data(), std::min(known, targets.size()));
      const vpAxisState &x = out.state;
      if (out.hasTarget) {
        const vpAxisState end = reference.at(out.arrival);
        const vpPrintTarget &target = targets[static_cast<std::size_t>(out.target)];
        REQUIRE(end[0] == Approx(target.position).margin(1e-8));
        REQUIRE(end[1] == Approx(4.).margin(1e-8));
        REQUIRE(end[2] == Approx(0.).margin(1e-8));
        if (spec.mode == vpPrintReferenceMode::LimitedVelocity) {
          REQUIRE_FALSE(out.exceeded);
          REQUIRE(x[1] < 6. * (1. + 1e-9));
        }
        if (spec.mode == vpPrintReferenceMode::FixedArrival) {
          REQUIRE(out.arrival == Approx(spec.dropTime * static_cast<double>(out.target + 1)).margin(1e-9));
        }
        if (spec.mode == vpPrintReferenceMode::ConstantVelocity && out.target > 0) {
          REQUIRE(x[1] == Approx(4.).margin(1e-9));
        }
      }
      if (now > 0.) { // no jump in position, velocity, acceleration
        REQUIRE(std::fabs(x[0] - before[0] - 0.05 * (x[1] + before[1])) < 0.02);
        REQUIRE(std::fabs(x[1] - before[1] - 0.05 * (x[2] + before[2])) < 0.02);
      }
      before = x;
    }
  }
}

TEST_CASE("A measured target is followed until the freeze, and made good afterwards", "[reference]")
{
  auto rng = vpTestSupport::generator(62);
  CAPTURE(vpTestSupport::seed());
  std::normal_distribution<double> normal(0., 0.18);
  double hardest[2] = {0., 0.};
  for (const int frozen : {0, 1}) {
    vpPrintReferenceSpec spec;
    spec.freeze = frozen == 1 ? 4. : 0.;
    vpPrintReference reference(spec);
    auto targets = lattice(60, rng, 0.3);
    const auto truth = targets;
    long last = -1;
    double place = 0., bound = 0.; // last measured target position; bound of the acceleration on the way there
    for (int k = 0; k < 500; ++k) {
      for (std::size_t i = 0; i < targets.size(); ++i) {
        targets[i].position = truth[i].position + normal(rng);
      }
      const auto &out = reference.step(k, targets.data(), targets.size());
      REQUIRE(out.hasTarget);
      // Measured with 0.18 px of noise, the error of the target: 5.5 standard deviations in 1000 frames.
      REQUIRE(std::fabs(reference.at(out.arrival)[0] - truth[static_cast<std::size_t>(out.target)].position) < 1.);
      CHECK(out.frozen == (out.arrival - k < spec.freeze));
      const vpTrajectorySegment &piece = reference.pieces()[0];
      const double seen = targets[static_cast<std::size_t>(out.target)].position;
      if (out.newTarget) {
        bound = piece.p.derivative().derivative().range().peak() / (piece.duration * piece.duration);
      }
      else if (!out.frozen) { // a correction d in the rest r adds a quintic with a peak of 10 / sqrt(3) |d| / r^2
        bound += 10. / std::sqrt(3.) * std::fabs(seen - place) / (piece.duration * piece.duration);
      }
      place = out.frozen && !out.newTarget ? place : seen;
      for (double t = k; t < std::min(k + 1., out.arrival); t += 0.05) {
        const double a = std::fabs(reference.at(t)[2]);
        REQUIRE(a <= bound * (1. + 1e-9));
        hardest[frozen] = std::max(hardest[frozen], a);
      }
      last = out.target;
    }
    CHECK(last > 40);
  }
  // Reason for the freeze: of the last corrections without it, half come with less than half a frame left and need more
  // than 5.8 |d| / 0.25 each.
  CHECK(hardest[0] > 2. * hardest[1]);
}

TEST_CASE("A turn stops at the turning point and comes back", "[reference]")
{
  vpPrintReference reference;
  const std::vector<vpPrintTarget> targets = {
      {0, 50., 4., 0.}, {1, 100., 0., 25.}, {2, 50., -4., 25.}, {3, 0., -4., 0.}};
  double farthest = 0.;
  for (double now = 0.; now < 90.; now += 0.5) {
    reference.step(now, targets.data(), targets.size());
    farthest = std::max(farthest, reference.at(now)[0]);
  }
  CHECK(farthest == Approx(100.).margin(0.1));
  CHECK(reference.at(90.)[1] == Approx(-4.).margin(1e-9));
  CHECK_FALSE(reference.step(90.5, targets.data(), targets.size()).hasTarget);
}

TEST_CASE("A forecast starts at the state and joins the plan", "[forecast]")
{
  vpMotionForecast forecast;
  forecast.time = 10.;
  forecast.position = 3.;
  forecast.velocity = 2.;
  forecast.acceleration = 0.5;
  forecast.accelerationTime = 2.;
  CHECK(forecast.at(11.)[0] == Approx(3. + 2. + 0.25));
  CHECK(forecast.at(13.)[0] == Approx(3. + 2. * 3. + 0.5 * 2. * 3. - 0.5 * 0.5 * 4.));
  CHECK(forecast.at(13.)[1] == Approx(3.));
  CHECK(forecast.at(9.)[0] == Approx(1.));
  auto rng = vpTestSupport::generator(63);
  const auto targets = lattice(10, rng, 1.);
  vpPrintReference reference;
  reference.step(0., targets.data(), targets.size());
  reference.step(10., targets.data(), targets.size());
  forecast.plan = reference.pieces();
  forecast.pieces = reference.pieceCount();
  forecast.errorTime = 2.;
  const vpAxisState r = reference.at(10.);
  forecast.position = r[0] + 1.;
  forecast.velocity = r[1] + 0.3;
  CHECK(forecast.at(10.)[0] == Approx(r[0] + 1.));
  CHECK(forecast.at(10.)[1] == Approx(r[1] + 0.3));
  CHECK(forecast.at(40.)[0] == Approx(reference.at(40.)[0] + 1. + 0.3 * 2.).margin(1e-4));
  for (double t = 8.; t < 40.; t += 0.37) { // velocity is the derivative of the position
    CHECK(forecast.at(t)[1] == Approx((forecast.at(t + 1e-5)[0] - forecast.at(t - 1e-5)[0]) / 2e-5).margin(1e-5));
  }
}

TEST_CASE("A print reference says what is wrong and does not allocate", "[reference]")
{
  vpPrintReferenceSpec spec;
  spec.dropTime = 0.;
  CHECK_THROWS_WITH(vpPrintReference(spec), Catch::Contains("dropTime of the print reference is 0, must be > 0"));
  spec = vpPrintReferenceSpec();
  spec.maxAcceleration = -1.;
  CHECK_THROWS_WITH(vpPrintReference(spec),
                    Catch::Contains("maxAcceleration of the print reference is -1, must be > 0"));
  auto rng = vpTestSupport::generator(64);
  auto targets = lattice(60, rng, 1.);
  for (int mode = 0; mode < 4; ++mode) {
    spec = vpPrintReferenceSpec();
    spec.mode = static_cast<vpPrintReferenceMode>(mode);
    vpPrintReference reference(spec);
    const unsigned long before = vpTestSupport::allocationCount();
    for (int k = 0; k < 400; ++k) {
      targets[static_cast<std::size_t>(k / 10)].position += 0.001;
      reference.step(k, targets.data(), targets.size());
    }
    reference.step(NAN, nullptr, 0);
    CHECK(vpTestSupport::allocationCount() == before);
  }
}
