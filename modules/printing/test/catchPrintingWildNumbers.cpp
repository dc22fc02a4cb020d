/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Every step of this module under NaN, infinities, numbers whose squares overflow, denormals and wrong clocks: the
// output is finite, the status reports it, rejected input changes nothing, and valid input is accepted again
// afterwards.
#include "vpCatch.h"
#include "vpWildNumbers.h"

#include <visp3/printing/vpAlphaBetaFilter.h>
#include <visp3/printing/vpMotionKalmanFilter.h>
#include <visp3/printing/vpMotionObserver.h>
#include <visp3/printing/vpPreviewControl.h>
#include <visp3/printing/vpPrintReference.h>
#include <visp3/printing/vpPrintTrigger.h>
#include <visp3/printing/vpPrintVelocityControl.h>
#include <visp3/printing/vpProductOdometer.h>

#include <cstring>
#include <vector>

VISP_DIRECT_USING_NAMESPACE

namespace
{
constexpr int sequences = 400, steps = 60;
constexpr double share = 0.2; // of wild numbers

using vpTestSupport::uniform;
double wild(std::mt19937_64 &rng, double ordinary) { return vpWildNumbers::mixed(rng, ordinary, share); }

bool finite(std::initializer_list<double> numbers)
{
  return std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); });
}
bool finite(const vpAxisState &x) { return finite({x[0], x[1], x[2], x[3]}); }

bool finite(const vpMotionEstimate &e)
{
  return finite({e.time, e.position, e.velocity, e.acceleration, e.sigmaPosition, e.sigmaVelocity, e.sigmaAcceleration,
                 e.encoderScale, e.encoderOffset, e.sigmaScale, e.sigmaOffset}) &&
         e.covariance.allFinite();
}
bool finite(const vpObservedMotion &m)
{
  return finite(
      {m.time, m.position, m.velocity, m.acceleration, m.force, m.disturbance, m.sigmaPosition, m.sigmaVelocity});
}

void motionKalmanFilter(std::mt19937_64 &rng)
{
  vpMotionKalmanSpec spec;
  spec.model = uniform(rng, 0., 1.) < 0.5 ? vpMotionModel::ConstantVelocity : vpMotionModel::ConstantAcceleration;
  spec.gate = uniform(rng, 0., 1.) < 0.5 ? 6. : std::numeric_limits<double>::infinity();
  spec.encoderScaleSigma = uniform(rng, 0., 1.) < 0.5 ? 0. : 0.02;
  vpMotionKalmanFilter filter(spec);
  vpWildNumbers::Clock clock(1.);
  for (int k = 0; k < steps; ++k) {
    const double t = clock.next(rng, share);
    const auto kind = static_cast<vpMotionReadingKind>(std::uniform_int_distribution<int>(0, 3)(rng));
    const vpMotionReading reading{kind, t, wild(rng, 3. * k), wild(rng, 0.1)};
    CAPTURE(k, t, reading.value, reading.sigma, static_cast<int>(kind));
    const vpMotionEstimate before = filter.at(NAN);
    const vpMotionReadingResult result = filter.add(reading);
    const vpMotionEstimate now = filter.at(NAN), later = filter.at(vpWildNumbers::any(rng));
    REQUIRE(finite(now));
    REQUIRE(finite(later));
    if (!(std::fabs(t) <= 1e12) || !(reading.sigma > 0.) || !std::isfinite(reading.sigma)) {
      REQUIRE(result == vpMotionReadingResult::Invalid);
    }
    else if (t > before.time + spec.maxGap) {
      REQUIRE(result != vpMotionReadingResult::Used);
    }
    if (result == vpMotionReadingResult::Invalid || result == vpMotionReadingResult::ImplausibleTime ||
        result == vpMotionReadingResult::TooLate) {
      REQUIRE(now.time == before.time);
      REQUIRE(now.position == before.position);
      REQUIRE(now.covariance == before.covariance);
    }
  }
  // Not lost: subsequent position readings are used, and the estimate converges.
  const double start = filter.at(NAN).time;
  for (int k = 1; k <= 200; ++k) {
    const auto result = filter.add({vpMotionReadingKind::Position, start + k, 3. * k, 0.1});
    CAPTURE(k, static_cast<int>(result));
    REQUIRE((result == vpMotionReadingResult::Used || result == vpMotionReadingResult::Outlier));
    REQUIRE(finite(filter.at(start + k)));
  }
  const vpMotionEstimate end = filter.at(start + 200.);
  CHECK(end.position == Approx(600.).margin(6. * end.sigmaPosition));
}

void motionObserver(std::mt19937_64 &rng)
{
  vpMotionObserverSpec spec;
  spec.model.viscous = 0.02;
  spec.model.coulomb = 0.08;
  spec.model.stiction = 0.12;
  spec.changeRate = uniform(rng, 0., 1.) < 0.5 ? 0. : 0.01;
  spec.gate = uniform(rng, 0., 1.) < 0.5 ? 6. : std::numeric_limits<double>::infinity();
  vpMotionObserver observer(spec);
  vpWildNumbers::Clock clock(1.);
  for (int k = 0; k < steps; ++k) {
    const double t = clock.next(rng, share), position = wild(rng, 3. * k), sigma = wild(rng, 0.1);
    static_cast<void>(observer.command(vpWildNumbers::mixed(rng, t, share), wild(rng, 0.2)));
    const vpObservedMotion before = observer.at(NAN);
    CAPTURE(k, t, position, sigma);
    const vpMotionReadingResult result = observer.measure(t, position, sigma);
    const vpObservedMotion now = observer.at(NAN);
    REQUIRE(finite(now));
    REQUIRE(finite(observer.at(vpWildNumbers::any(rng))));
    if (!(std::fabs(t) <= 1e12) || !(sigma > 0.) || !std::isfinite(sigma)) {
      REQUIRE(result == vpMotionReadingResult::Invalid);
    }
    else if (t > before.time + spec.maxGap) {
      REQUIRE(result != vpMotionReadingResult::Used);
    }
    if (result == vpMotionReadingResult::Invalid || result == vpMotionReadingResult::ImplausibleTime ||
        result == vpMotionReadingResult::TooLate) {
      REQUIRE(now.time == before.time);
      REQUIRE(now.position == before.position);
      REQUIRE(now.sigmaPosition == before.sigmaPosition);
    }
  }
  // Not lost: with a command of 0 and measurements of rest it comes to rest; every third consecutive one is accepted.
  const double start = observer.at(NAN).time;
  int used = 0;
  for (int k = 1; k <= 200; ++k) {
    used += observer.measure(start + k, 0., 0.1) == vpMotionReadingResult::Used ? 1 : 0;
    REQUIRE(finite(observer.at(start + k + 1.)));
    static_cast<void>(observer.command(start + k, 0.));
  }
  CHECK(used >= 66);
  if (std::isfinite(
          spec.gate)) { // without a gate 1e12 px with a deviation of 0.1 is accepted, forgotten at the filter's rate
    const vpObservedMotion end = observer.at(start + 200.);
    CHECK(end.position == Approx(0.).margin(6. * end.sigmaPosition));
  }
}

void alphaBetaFilter(std::mt19937_64 &rng)
{
  vpAlphaBetaFilter filter(vpAlphaBetaGains::criticallyDamped(uniform(rng, 0.05, 0.95)));
  for (int k = 0; k < steps; ++k) {
    const double z = wild(rng, 5.), u = wild(rng, 0.1);
    const auto &state = filter.step(z, u);
    REQUIRE(state.measured == (std::fabs(z) <= 1e12));
    REQUIRE(finite({state.value, state.rate, state.residual, filter.predict(vpWildNumbers::any(rng))}));
  }
  filter.reset(vpWildNumbers::any(rng), vpWildNumbers::any(rng));
  REQUIRE(finite({filter.state().value, filter.state().rate, filter.predict(1.)}));
}

std::vector<vpPatternCell> cells(std::mt19937_64 &rng, double moved)
{
  std::vector<vpPatternCell> list(4);
  for (std::size_t i = 0; i < list.size(); ++i) {
    list[i].column = static_cast<int>(i);
    list[i].x = wild(rng, 49. * static_cast<double>(i) + moved);
    list[i].y = wild(rng, 50.);
    list[i].sigmaX = wild(rng, 0.05);
    list[i].sigmaY = wild(rng, 0.05);
    list[i].valid = true;
  }
  return list;
}

void productOdometer(std::mt19937_64 &rng)
{
  vpProductOdometer odometer;
  for (int k = 0; k < steps; ++k) {
    const auto seen = cells(rng, 3. * k);
    const double x = wild(rng, 3.), y = wild(rng, 0.);
    const bool lostBefore = odometer.output().lost;
    const auto &out = odometer.step(seen.data(), seen.size(), static_cast<unsigned int>(k / 7), x, y);
    REQUIRE(finite({out.x, out.y, out.dx, out.dy, out.sigmaX, out.sigmaY}));
    if (k > 0 && !out.measured && !lostBefore) {
      REQUIRE(out.lost == !(std::fabs(x) <= 1e12 && std::fabs(y) <= 1e12));
    }
    const vpCellVelocity v = vpFindCellVelocity(seen.data(), seen.size(), seen.data(), seen.size(), wild(rng, 1.));
    REQUIRE(finite({v.vx, v.vy, v.sigmaX, v.sigmaY}));
  }
}

void previewControl(std::mt19937_64 &rng)
{
  vpPreviewControlSpec spec;
  spec.model.coulomb = 0.08;
  spec.positionGain = 0.03;
  spec.maxForce = uniform(rng, 0., 1.) < 0.5 ? 0.5 : std::numeric_limits<double>::infinity();
  const vpPreviewControl control(spec);
  for (int k = 0; k < steps; ++k) {
    std::array<double, 11> x{{1., 4., 0.1, 0., 1., 4., 0.1, 0., 1., 4., 0.}};
    vpWildNumbers::mix(rng, x, share / 4.);
    const auto out = control.command({{{x[0], x[1], x[2], x[3]}}, {{x[4], x[5], x[6], x[7]}}, x[8], x[9], x[10]});
    const bool good = std::all_of(x.begin(), x.end(), [](double v) { return std::fabs(v) <= 1e12; });
    REQUIRE(out.valid == good);
    REQUIRE(std::isfinite(out.force));
    REQUIRE(std::fabs(out.force) <= spec.maxForce);
    REQUIRE((good || out.force == 0.));
  }
}

void printVelocityControl(std::mt19937_64 &rng)
{
  vpPrintVelocityControlSpec spec = vpPrintVelocityControlSpec::thesisFeedforward();
  spec.maxForce = uniform(rng, 0., 1.) < 0.5 ? 0.5 : std::numeric_limits<double>::infinity();
  vpPrintVelocityControl control(spec);
  for (int k = 0; k < steps; ++k) {
    const vpPrintVelocityControl::Input input{wild(rng, 4.), wild(rng, 0.1), wild(rng, 4.)};
    const double integral = control.integral();
    const auto out = control.step(input);
    const bool good =
        std::fabs(input.velocity) <= 1e12 && std::fabs(input.acceleration) <= 1e12 && std::fabs(input.measured) <= 1e12;
    REQUIRE(out.valid == good);
    REQUIRE(finite({out.force, out.feedback, out.feedforward, control.integral()}));
    REQUIRE(std::fabs(out.force) <= spec.maxForce);
    if (!(std::fabs(input.velocity) <= 1e12 && std::fabs(input.measured) <= 1e12)) {
      REQUIRE(control.integral() == integral);
    }
  }
}

void printReference(std::mt19937_64 &rng)
{
  vpPrintReferenceSpec spec;
  spec.mode = static_cast<vpPrintReferenceMode>(std::uniform_int_distribution<int>(0, 3)(rng));
  spec.freeze = uniform(rng, 0., 1.) < 0.5 ? 0. : 4.;
  vpPrintReference reference(spec);
  vpWildNumbers::Clock clock(1.);
  double last = 0.;
  for (int k = 0; k < steps; ++k) {
    std::vector<vpPrintTarget> targets(4);
    for (std::size_t i = 0; i < targets.size(); ++i) {
      targets[i] = {k / 10 + static_cast<long>(i), wild(rng, 49. * (k / 10 + static_cast<double>(i) + 1.)),
                    wild(rng, 4.), wild(rng, 0.)};
    }
    const double now = clock.next(rng, share);
    const vpAxisState before = reference.output().state;
    CAPTURE(k, now, last);
    const auto &out = reference.step(now, targets.data(), targets.size());
    REQUIRE(finite(out.state));
    REQUIRE(std::isfinite(out.arrival));
    REQUIRE(finite(reference.at(vpWildNumbers::any(rng))));
    if (!(now >= last && now <= last + vpPrintReference::longestGap)) {
      REQUIRE_FALSE(out.valid);
      REQUIRE(out.state == before);
    }
    last = out.valid ? now : last;
  }
  reference.reset(last, 0., 1000);
  const std::vector<vpPrintTarget> good{{1001, 49., 4., 0.}};
  const auto &out = reference.step(last + 1., good.data(), good.size());
  CHECK(out.valid);
  CHECK(out.hasTarget);
}

void printTrigger(std::mt19937_64 &rng)
{
  vpPrintTriggerSpec spec;
  spec.method = uniform(rng, 0., 1.) < 0.8 ? vpPrintTriggerMethod::Horizon : vpPrintTriggerMethod::ThesisAlgorithm;
  vpPrintTrigger trigger(spec);
  vpWildNumbers::Clock clock(1.);
  for (int k = 0; k < steps; ++k) {
    const auto seen = cells(rng, 3. * k);
    vpPrintTriggerInput input;
    input.time = clock.next(rng, share / 2.);
    input.captureTime = vpWildNumbers::mixed(rng, input.time - 1.28, share / 2.);
    input.cells = seen.data();
    input.cellCount = seen.size();
    input.captureAlong = vpWildNumbers::mixed(rng, 3. * k, share / 2.);
    input.along.time = vpWildNumbers::mixed(rng, input.time, share / 4.);
    std::array<double, 5> x{{3. * k, 3., 0., 1., 3.}};
    vpWildNumbers::mix(rng, x, share / 4.);
    input.along.position = x[0];
    input.along.velocity = x[1];
    input.along.acceleration = x[2];
    input.along.accelerationTime = x[3];
    input.along.errorTime = x[4];
    input.along.pieces = uniform(rng, 0., 1.) < 0.1 ? std::uniform_int_distribution<int>(-3, 1000)(rng) : 0;
    const int remembered = trigger.remembered();
    const auto &out = trigger.step(input);
    const bool plausible = std::fabs(input.time) <= 1e12 && input.along.isPlausible() &&
                           std::fabs(input.time - input.along.time) <= vpMotionForecast::longest;
    REQUIRE((out.status == vpPrintTriggerStatus::InputRefused) == !plausible);
    REQUIRE((std::string(out.message()).rfind("InputRefused: ", 0) == 0) == !plausible);
    if (out.status != vpPrintTriggerStatus::Good) {
      REQUIRE(trigger.remembered() == remembered);
    }
    REQUIRE((plausible || out.shotCount + out.missedCount + out.plannedCount == 0));
    for (int i = 0; i < out.shotCount; ++i) {
      const vpPrintShot &shot = out.shots[static_cast<std::size_t>(i)];
      REQUIRE(finite({shot.fireTime, shot.landTime, shot.offset, shot.sigma}));
      REQUIRE(shot.fireTime >= input.time);
      REQUIRE(shot.fireTime <= input.time + spec.period + spec.lead);
    }
    for (int i = 0; i < out.missedCount; ++i) {
      const vpPrintShot &shot = out.missed[static_cast<std::size_t>(i)];
      REQUIRE(finite({shot.fireTime, shot.landTime, shot.offset, shot.sigma}));
    }
    for (int i = 0; i < out.plannedCount; ++i) {
      const vpPrintShot &shot = out.planned[static_cast<std::size_t>(i)];
      REQUIRE(finite({shot.fireTime, shot.landTime, shot.offset, shot.sigma}));
    }
  }
}

void motionForecast(std::mt19937_64 &rng)
{
  for (int k = 0; k < steps; ++k) {
    std::array<double, 9> x{{0., 1., 2., 0.1, 1., 3., 0., 1., 5.}};
    vpWildNumbers::mix(rng, x, share / 3.);
    vpMotionForecast forecast;
    forecast.time = x[0];
    forecast.position = x[1];
    forecast.velocity = x[2];
    forecast.acceleration = x[3];
    forecast.accelerationTime = x[4];
    forecast.errorTime = x[5];
    forecast.pieces = std::uniform_int_distribution<int>(0, 1)(rng);
    forecast.plan[0].begin = x[6];
    forecast.plan[0].duration = x[7];
    forecast.plan[0].p = {0., x[8], 0.5};
    if (forecast.isPlausible()) {
      REQUIRE(finite(forecast.at(vpWildNumbers::any(rng))));
      REQUIRE(finite(forecast.at(uniform(rng, -10., 10.))));
    }
    else { // only for one of the numbers
      REQUIRE_FALSE(std::all_of(x.begin(), x.end(), [](double v) { return v >= 1e-12 && v <= 1e12; }));
    }
  }
}

void frictionModel(std::mt19937_64 &rng)
{
  vpFrictionModel model;
  model.viscous = 0.02;
  model.coulomb = 0.08;
  model.stiction = 0.12;
  model.stribeckVelocity = uniform(rng, 0., 1.) < 0.5 ? 1e-30 : 0.3;
  REQUIRE_NOTHROW(model.validate("test"));
  for (const double v : vpWildNumbers::values) {
    for (const double a : vpWildNumbers::values) {
      if (vpIsPlausible(v) && vpIsPlausible(a)) {
        REQUIRE(std::isfinite(model.force(v, a)));
      }
    }
  }
}

struct Step {
  const char *name;
  void (*run)(std::mt19937_64 &);
};
// Add every new class with a step to this list.
const Step everyStep[] = {
    {"vpMotionKalmanFilter", motionKalmanFilter}, {"vpMotionObserver", motionObserver},
    {"vpAlphaBetaFilter", alphaBetaFilter},       {"vpProductOdometer, vpFindCellVelocity", productOdometer},
    {"vpPreviewControl", previewControl},         {"vpPrintVelocityControl", printVelocityControl},
    {"vpPrintReference", printReference},         {"vpPrintTrigger", printTrigger},
    {"vpMotionForecast", motionForecast},         {"vpFrictionModel", frictionModel}};
} // namespace

TEST_CASE("Under wild numbers and clocks every step answers finitely, says so, and is not lost", "[wild]")
{
  CAPTURE(vpTestSupport::seed());
  for (const Step &step : everyStep) {
    DYNAMIC_SECTION(step.name)
    {
      for (unsigned int sequence = 0; sequence < static_cast<unsigned int>(sequences); ++sequence) {
        CAPTURE(sequence);
        auto rng = vpTestSupport::generator(800 + sequence);
        step.run(rng);
      }
    }
  }
}

TEST_CASE("Specifications with numbers beyond reason are refused", "[wild]")
{
  for (const double x : vpWildNumbers::values) {
    if (x >= 1e-30 && x <= 1e15) {
      continue;
    }
    CAPTURE(x);
    vpMotionKalmanSpec kalman;
    kalman.maxGap = x;
    CHECK_THROWS_WITH(vpMotionKalmanFilter(kalman), Catch::Contains("maxGap of the motion filter is"));
    vpMotionObserverSpec observer;
    observer.model.mass = x;
    CHECK_THROWS_WITH(vpMotionObserver(observer), Catch::Contains("mass of the motion observer is"));
    CHECK_THROWS_WITH(vpAlphaBetaFilter(vpAlphaBetaGains(), x), Catch::Contains("period of the alpha-beta filter is"));
    vpPrintReferenceSpec reference;
    reference.maxVelocity = x;
    CHECK_THROWS_WITH(vpPrintReference(reference), Catch::Contains("maxVelocity of the print reference is"));
    vpPrintTriggerSpec trigger;
    trigger.period = x;
    CHECK_THROWS_WITH(vpPrintTrigger(trigger), Catch::Contains("period of the print trigger is"));
  }
}
