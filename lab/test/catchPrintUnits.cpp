/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Another camera changes the numbers of a machine, not its motion in metres and seconds.
#include "vpCatch.h"

#include "lab/printing/vpPrintUnits.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <random>

VISP_DIRECT_USING_NAMESPACE

namespace
{
vpPrintExperimentSpec withPerfectSensor(vpPrintController controller)
{
  vpPrintExperimentSpec spec = vpPrintExperimentSpec::withObserver(vpPrintSensorModel::tracker());
  if (controller != vpPrintController::Observer) {
    const bool ahead = controller == vpPrintController::PidFeedforward;
    const vpPrintExperimentSpec pid =
        ahead ? vpPrintExperimentSpec::thesisFeedforward() : vpPrintExperimentSpec::thesisPid();
    spec.controller = controller;
    spec.pid = pid.pid;
    spec.filter = pid.filter;
  }
  spec.sensorModel.sigmaX = spec.sensorModel.sigmaY = 1e-9; // > 0 for the filters
  spec.cellsPerRow = 12;
  return spec;
}

//! Force on both axes, in m/s^2 at mass 1, at a time in s: enough to overcome stiction, reverse and stop.
double forceAt(double t, double size) { return size * (std::sin(40. * t) + 0.5 * std::sin(97. * t)); }

//! Positions in um every 10 ms, of a stage in other units under the same force.
std::vector<double> placesOf(const vpXYStageSpec &stage, const vpPrintUnits &units, double size)
{
  constexpr double h = 1e-4, seconds = 0.2; // a command lasts 0.1 ms
  vpXYStage moving(vpInUnits(stage, vpPrintUnits(), units));
  const double toUnits = 1e6 / units.pixelSize / (units.frameRate * units.frameRate); // of 1 m/s^2
  std::vector<double> places;
  for (int k = 0; k * h < seconds; ++k) {
    const double force = forceAt(k * h, size) * toUnits;
    moving.step(h * units.frameRate, {{force, 0.5 * force}});
    if (k % 100 == 99) {
      places.push_back(moving.state().position[0] * units.pixelSize);
      places.push_back(moving.state().position[1] * units.pixelSize);
    }
  }
  return places;
}
} // namespace

TEST_CASE("The same force moves the same stage by as many um whatever the px and frames", "[print-units]")
{
  const unsigned int seed = GENERATE(range(0u, 20u));
  CAPTURE(seed);
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> between(0., 1.);
  vpXYStageSpec stage = vpXYStageSpec::thesis();
  stage.x.delay = between(random) < 0.5 ? 0. : between(random);
  stage.x.viscousRiseFrom = 50. * between(random);
  stage.y.lag = between(random);
  stage.y.maxVelocity = between(random) < 0.5 ? 3. : HUGE_VAL;
  const double size = 2. + 8. * between(random); // m/s^2; stiction is 1.4
  const vpPrintUnits other{0.5 + 10. * between(random), 200. + 9000. * between(random)};
  const std::vector<double> one = placesOf(stage, vpPrintUnits(), size), two = placesOf(stage, other, size);
  REQUIRE(one.size() == two.size());
  double far = 0., worst = 0.;
  for (std::size_t i = 0; i < one.size(); ++i) {
    worst = std::max(worst, std::fabs(two[i] - one[i]));
    far = std::max(far, std::fabs(one[i]));
  }
  CHECK(worst < 0.2); // um: where the axis sticks and where its friction rises falls into other parts of a step
  CHECK(far > 100.);  // it moved
}

TEST_CASE("In the closed loop another magnification changes no um of the motion", "[print-units]")
{
  const auto controller =
      GENERATE(vpPrintController::Pid, vpPrintController::PidFeedforward, vpPrintController::Observer);
  const double pixelSize = GENERATE(1.1, 2.25, 9.);
  vpPrintExperimentSpec spec = withPerfectSensor(controller);
  spec.sensorModel = vpPrintSensorModel::tracker(); // the same errors in um, too
  spec.rows = 2;
  spec.product.flexAmplitudeX = spec.product.flexAmplitudeY = 1.;
  vpPrintExperimentSpec other = vpInUnits(spec, {pixelSize, spec.frameRate});
  // The same field of view, so that the same cells are in it.
  other.product.width = static_cast<unsigned int>(std::lround(160. * 4.5 / pixelSize));
  other.product.height = static_cast<unsigned int>(std::lround(100. * 4.5 / pixelSize));
  CAPTURE(static_cast<int>(controller), pixelSize);
  if (pixelSize == 1.1) { // does not divide the field of view: cells would enter at other instants
    other.product.width = 655;
    other.product.height = 409;
  }
  const vpPrintRun one = runPrintExperiment(spec), two = runPrintExperiment(other);
  REQUIRE(one.samples.size() == two.samples.size());
  const double margin = pixelSize == 1.1 ? 1. : 1e-5; // um
  for (std::size_t i = 0; i < one.samples.size(); ++i) {
    REQUIRE(two.samples[i].x * pixelSize == Approx(one.samples[i].x * 4.5).margin(margin));
    REQUIRE(two.samples[i].y * pixelSize == Approx(one.samples[i].y * 4.5).margin(margin));
  }
  REQUIRE(one.drops.size() == two.drops.size());
  for (std::size_t i = 0; i < one.drops.size(); ++i) {
    REQUIRE(two.drops[i].landTime == Approx(one.drops[i].landTime).margin(0.1 * margin));
    REQUIRE(two.drops[i].errorX == Approx(one.drops[i].errorX).margin(margin));
  }
  CHECK(one.metrics.printed > 15);
}

TEST_CASE("With a perfect sensor another frame rate changes the motion by the sampling alone", "[print-units]")
{
  const vpPrintExperimentSpec spec = withPerfectSensor(vpPrintController::Observer);
  const vpPrintRun one = runPrintExperiment(spec);
  for (const double factor : {0.5, 2., 4.}) {
    CAPTURE(factor);
    const vpPrintExperimentSpec other = vpInUnits(spec, {4.5, factor * 1600.});
    CHECK(other.commandsPerFrame == static_cast<int>(4. / factor));
    const vpPrintRun two = runPrintExperiment(other);
    CHECK(two.metrics.printed == 12);
    double worst = 0., far = 0.;
    for (std::size_t i = 0; i < one.samples.size(); ++i) {
      const double at = static_cast<double>(i) * factor;
      const auto k = static_cast<std::size_t>(at);
      if (static_cast<double>(k) == at && k < two.samples.size()) {
        worst = std::max(worst, 4.5 * std::fabs(one.samples[i].x - two.samples[k].x));
        far = std::max(far, 4.5 * std::fabs(one.samples[i].x));
      }
    }
    CHECK(far > 2000.);
    CHECK(worst < 5.); // um, of over 2 mm: forces are held for a sixth of a ms and longer
    CHECK(two.metrics.throughput_cells_per_s == Approx(one.metrics.throughput_cells_per_s).epsilon(1e-3));
    CHECK(two.metrics.landing_worst_um < 1.);
  }
}

TEST_CASE("There and back is where it was", "[print-units]")
{
  const vpPrintExperimentSpec spec = vpPrintExperimentSpec::thesisFeedforward();
  const vpPrintExperimentSpec back = vpInUnits(vpInUnits(spec, {1.3, 3200.}), {4.5, 1600.});
  CHECK(back.pid.kp == Approx(spec.pid.kp));
  CHECK(back.pid.ki == Approx(spec.pid.ki));
  CHECK(back.pid.kd == spec.pid.kd);
  CHECK(back.filter.alpha == Approx(spec.filter.alpha));
  CHECK(back.filter.beta == Approx(spec.filter.beta));
  CHECK(back.observer.disturbanceNoise == Approx(spec.observer.disturbanceNoise));
  CHECK(back.forecast.processNoise == Approx(spec.forecast.processNoise));
  CHECK(back.product.exposure == Approx(spec.product.exposure));
  CHECK(back.product.cornerRadius == Approx(spec.product.cornerRadius));
  CHECK(back.visionDelay == Approx(1.28));
  CHECK(back.frames == 120);
  CHECK(vpInUnits(spec, {4.5, 1e6}).commandsPerFrame == 1);
}

TEST_CASE("A filter keeps its answer in seconds, and stays stable", "[print-units]")
{
  // Step response, compared at the same instants: the poles are the same, so the error decays equally.
  const unsigned int seed = GENERATE(range(0u, 200u));
  CAPTURE(seed);
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> between(0., 1.);
  vpAlphaBetaGains gains;
  gains.alpha = 0.02 + 0.9 * between(random) + (between(random) < 0.5 ? 0. : 1.); // not 1: then there is one pole only
  gains.beta = (4. - 2. * gains.alpha) * (0.01 + 0.98 * between(random));
  const double rate = 200. + 9000. * between(random);
  const vpAlphaBetaGains other = vpInUnits(gains, {4.5, 1600.}, {1., rate});
  CAPTURE(gains.alpha, gains.beta, rate, other.alpha, other.beta);
  CHECK_NOTHROW(other.validate());
  // Product of the poles: their decay a second.
  const double decay = std::log(std::fabs(1. - gains.alpha)) * 1600.;
  CHECK(std::log(std::fabs(1. - other.alpha)) * rate == Approx(decay).epsilon(1e-6));
}

TEST_CASE("Units that are none are told in a sentence", "[print-units]")
{
  const vpPrintExperimentSpec spec;
  CHECK_THROWS_WITH(vpInUnits(spec, {0., 1600.}), Catch::Contains("pixelSize of the units is 0, must be > 0"));
  CHECK_THROWS_WITH(vpInUnits(spec, {4.5, -1.}), Catch::Contains("frameRate of the units is -1, must be > 0"));
  CHECK_THROWS_WITH(vpInUnits(spec.stage, {4.5, 1600.}, {HUGE_VAL, 1.}),
                    Catch::Contains("pixelSize of the units is inf"));
}
