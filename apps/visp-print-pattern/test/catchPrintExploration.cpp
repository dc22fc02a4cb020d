/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The parts of --explore: front, designs, timing of a camera, the machine in its units, files.
#include "vpCatch.h"

#include "findings.h"

#include <visp3/rendering/vpProductPattern.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

using namespace printExplore;

namespace
{
//! By definition, each point against all others.
std::vector<std::size_t> bruteForceFront(const std::vector<Costs> &points)
{
  std::vector<std::size_t> front;
  for (std::size_t i = 0; i < points.size(); ++i) {
    bool beaten = false;
    for (const Costs &other : points) {
      bool worse = false, better = false;
      for (std::size_t k = 0; k < other.size(); ++k) {
        worse = worse || other[k] > points[i][k];
        better = better || other[k] < points[i][k];
      }
      beaten = beaten || (better && !worse);
    }
    if (!beaten) {
      front.push_back(i);
    }
  }
  return front;
}

Setup setupOf(const std::string &text) { return readSetup(text, "spec.json"); }
} // namespace

TEST_CASE("The front is what the definition says, with ties and twins", "[explore]")
{
  const unsigned int seed = GENERATE(range(0u, 300u));
  CAPTURE(seed);
  std::mt19937 random(seed);
  const std::size_t objectives = 1 + random() % 4;
  const int values = 1 + static_cast<int>(random() % 12); // few: many ties and equal points
  std::vector<Costs> points(random() % 120);
  for (Costs &point : points) {
    for (std::size_t k = 0; k < objectives; ++k) {
      point.push_back(static_cast<double>(static_cast<int>(random() % static_cast<unsigned int>(values))) - 3.);
    }
  }
  CHECK(paretoFront(points) == bruteForceFront(points));
}

TEST_CASE("The compromise is a point of the front, and scale plays no part", "[explore]")
{
  CHECK(compromise({{0., 10.}, {4., 4.}, {10., 0.}}) == 1);
  CHECK(compromise({{0., 10e6}, {4., 4e6}, {10., 0.}}) == 1);
  CHECK(compromise({{1., 1.}}) == 0);
  CHECK(compromise({{2., 5.}, {1., 5.}}) == 1); // all equal in the second
  const unsigned int seed = GENERATE(range(0u, 50u));
  CAPTURE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> between(0., 1.);
  std::vector<Costs> points(2 + random() % 50);
  for (Costs &point : points) {
    point = {between(random), between(random), between(random)};
  }
  const std::vector<std::size_t> front = paretoFront(points);
  CHECK(std::count(front.begin(), front.end(), compromise(points)) == 1);
}

TEST_CASE("A grid has every combination once", "[explore]")
{
  const Setup setup = setupOf(R"({"thesis": false, "design": {"frame_rate_hz": [800, 1600],
    "image_px": [[64, 48], [160, 100], [200, 50]], "um_per_px": {"from": 2, "to": 8, "steps": 3, "scale": "log"},
    "exposure_us": {"from": 10, "to": 50, "steps": 5}, "controller": ["observer", "pid"], "speed_up": [1, 1.25]}})");
  CHECK(setup.designs.size() == 2 * 3 * 3 * 5 * 2 * 2);
  std::set<std::string> different;
  std::set<double> sizes, exposures;
  for (const Design &design : setup.designs) {
    different.insert(textOf(design));
    sizes.insert(design.pixelSize);
    exposures.insert(design.exposure);
    CHECK(design.dropVelocity == 28.8);
  }
  CHECK(different.size() == setup.designs.size());
  CHECK(exposures == std::set<double>{10., 20., 30., 40., 50.});
  REQUIRE(sizes.size() == 3);
  CHECK(*sizes.begin() == 2.);
  CHECK(*std::next(sizes.begin()) == Approx(4.));
  CHECK(*sizes.rbegin() == 8.);
}

TEST_CASE("Samples fill the space evenly, repeat, and more of them only add designs", "[explore]")
{
  const unsigned int seed = GENERATE(1u, 2u, 77u);
  CAPTURE(seed);
  const std::string space = R"("thesis": false, "design": {"frame_rate_hz": {"from": 500, "to": 8000, "scale": "log"},
    "um_per_px": {"from": 3, "to": 7}, "exposure_us": {"from": 10, "to": 100}, "image_px": [[64, 48], [160, 100]],
    "controller": ["pid", "pid-ff", "observer"], "drop_velocity_mm_s": {"from": 20, "to": 60}},)";
  const auto drawn = [&](int count, unsigned int of) {
    return setupOf("{" + space + R"("seed": )" + std::to_string(of) + R"(, "samples": )" + std::to_string(count) + "}")
        .designs;
  };
  const std::vector<Design> some = drawn(210, seed), more = drawn(420, seed), others = drawn(210, seed + 1);
  REQUIRE(some.size() == 210);
  CHECK(std::equal(some.begin(), some.end(), more.begin()));
  CHECK_FALSE(some == others);
  // In each tenth of each variable about a tenth of the samples; random ones would vary by 4.3.
  const auto even = [&](auto share) {
    std::vector<int> count(10, 0);
    for (const Design &design : some) {
      const double s = share(design);
      REQUIRE(s >= 0.);
      REQUIRE(s < 1.);
      ++count[static_cast<std::size_t>(10. * s)];
    }
    for (const int n : count) {
      CHECK(std::abs(n - 21) <= 6);
    }
  };
  even([](const Design &d) { return std::log(d.frameRate / 500.) / std::log(16.); });
  even([](const Design &d) { return (d.pixelSize - 3.) / 4.; });
  even([](const Design &d) { return (d.exposure - 10.) / 90.; });
  even([](const Design &d) { return (d.dropVelocity - 20.) / 40.; });
  int pid = 0, small = 0;
  for (const Design &design : some) {
    pid += design.controller == vpPrintController::Pid ? 1 : 0;
    small += design.width == 64 ? 1 : 0;
  }
  CHECK(std::abs(pid - 70) <= 6);
  CHECK(std::abs(small - 105) <= 6);
}

TEST_CASE("The thesis's camera is as late as in its experiments, and has its figures", "[explore]")
{
  const Setup setup;
  const Design design = Design::thesis(vpPrintController::Pid);
  const Timing t = timingOf(design, setup);
  CHECK(t.readout == Approx(500.)); // table 7.3
  CHECK(t.delayFrames == Approx(1.28).margin(0.02));
  CHECK(t.dataRate == Approx(25.6));            // "roughly 26 MB/s"
  CHECK(t.tracking == Approx(12.).margin(0.3)); // n_f M of section 7.3.1
  CHECK(t.light == 1.);
  CHECK(t.leastCells == 8);
  CHECK(checkTiming(design, setup, t).feasible());
}

TEST_CASE("Cells in view are those that the product says", "[explore]")
{
  const unsigned int seed = GENERATE(range(0u, 12u));
  CAPTURE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> between(0., 1.);
  const Setup setup;
  Design design;
  design.width = 60 + random() % 200;
  design.height = 40 + random() % 150;
  design.pixelSize = 3. + 5. * between(random);
  const Timing t = timingOf(design, setup);
  const vpProductPattern product(productOf(design, setup, t));
  double sum = 0.;
  int least = 1 << 30;
  constexpr int places = 3000;
  for (int i = 0; i < places; ++i) {
    int whole = 0;
    for (const vpPatternTruthCell &cell : product.cells(1000. * between(random), 1000. * between(random))) {
      whole += cell.complete ? 1 : 0;
    }
    sum += whole;
    least = std::min(least, whole);
  }
  CHECK(sum / places == Approx(t.cells).epsilon(0.03).margin(0.05));
  CHECK(least == t.leastCells);
}

TEST_CASE("Limits of camera, link and processor are reported with their numbers", "[explore]")
{
  Setup setup;
  const auto kind = [&](const Design &design) {
    const Verdict verdict = checkTiming(design, setup, timingOf(design, setup));
    CAPTURE(verdict.sentence);
    CHECK(verdict.sentence.empty() == verdict.kind.empty());
    return verdict.kind;
  };
  Design design;
  CHECK(kind(design).empty());
  design.exposure = 126.; // 500 us of readout in 625 us
  CHECK(kind(design) == "camera");
  CHECK(checkTiming(design, setup, timingOf(design, setup)).sentence ==
        "exposure of 126 us and readout of 500 us do not fit into the 625 us of a frame");
  setup.camera.overlap = true;
  CHECK(kind(design).empty());
  design.frameRate = 2001.;
  CHECK(kind(design) == "camera");
  design.frameRate = 1999.;
  CHECK(kind(design).empty());
  setup.camera.link = 30.;
  CHECK(kind(design) == "link");
  setup = Setup();
  design = Design();
  setup.processor.maxLoad = 0.01;
  CHECK(kind(design) == "processor");
  setup = Setup();
  setup.minCells = 9;
  CHECK(kind(design) == "view");
  setup = Setup();
  setup.camera.interfaceTime = 6000.;
  CHECK(kind(design) == "delay");
}

TEST_CASE("Photons go with exposure and the area of a pixel, until the lamp is dimmed", "[explore]")
{
  const Setup setup;
  Design design;
  design.exposure = 25.;
  CHECK(timingOf(design, setup).light == Approx(0.5));
  design.pixelSize = 3.;
  CHECK(timingOf(design, setup).light == Approx(0.5 * 4. / 9.));
  const vpProductPatternSpec product = productOf(design, setup, timingOf(design, setup));
  CHECK(product.bright == Approx(170. * 0.5 * 4. / 9.));
  CHECK(product.psf == Approx(1.2));
  CHECK(product.exposure == Approx(25. / 625.));
  design.pixelSize = 20.;
  CHECK(productOf(design, setup, timingOf(design, setup)).bright == Approx(240.));
}

TEST_CASE("The thesis's camera gets the thesis's machine", "[explore]")
{
  const Setup setup;
  for (const auto controller :
       {vpPrintController::Pid, vpPrintController::PidFeedforward, vpPrintController::Observer}) {
    const Design design = Design::thesis(controller);
    Timing timing = timingOf(design, setup);
    timing.delayFrames = 1.28;
    const vpPrintExperimentSpec spec = experimentOf(design, setup, timing, vpPrintSensorModel::tracker());
    vpPrintExperimentSpec known = vpPrintExperimentSpec::withObserver(vpPrintSensorModel::tracker());
    if (controller != vpPrintController::Observer) {
      known = vpPrintExperimentSpec::withPid(controller == vpPrintController::PidFeedforward);
    }
    CHECK(spec.pid.kp == Approx(known.pid.kp));
    CHECK(spec.pid.ki == Approx(known.pid.ki));
    CHECK(spec.filter.alpha == Approx(known.filter.alpha));
    CHECK(spec.filter.beta == Approx(known.filter.beta));
    CHECK(spec.stage.x.stiction == Approx(known.stage.x.stiction));
    CHECK(spec.product.pitchX == Approx(known.product.pitchX));
    CHECK(spec.product.exposure == Approx(known.product.exposure));
    CHECK(spec.dropVelocity == Approx(4.));
    CHECK(spec.reference.meanVelocity == Approx(5.));
    CHECK(spec.reference.freeze == Approx(4.));
    CHECK(spec.travelTime == Approx(0.32));
    CHECK_NOTHROW(spec.validate());
  }
}

TEST_CASE("A camera that is later gets slower PIDs, and the observer keeps its gains in seconds", "[explore]")
{
  Setup setup;
  Design design = Design::thesis(vpPrintController::Pid);
  const Timing timing = timingOf(design, setup);
  const vpPrintExperimentSpec now = experimentOf(design, setup, timing, vpPrintSensorModel::tracker());
  setup.camera.interfaceTime += 3. * 625.;
  const Timing late = timingOf(design, setup);
  const vpPrintExperimentSpec later = experimentOf(design, setup, late, vpPrintSensorModel::tracker());
  const double slower = (late.delayFrames + 0.8) / (timing.delayFrames + 0.8); // 0.5 of the hold, 0.3 of the lag
  CHECK(later.pid.kp * slower == Approx(now.pid.kp));
  CHECK(later.pid.ki * slower * slower == Approx(now.pid.ki));
  CHECK(later.pid.maxForce == now.pid.maxForce);
  CHECK(later.filter.alpha < now.filter.alpha);
  CHECK(later.preview.velocityGain == now.preview.velocityGain);
  setup = Setup();
  design.frameRate = 800.;
  const vpPrintExperimentSpec half =
      experimentOf(design, setup, timingOf(design, setup), vpPrintSensorModel::tracker());
  CHECK(half.preview.velocityGain == Approx(2. * now.preview.velocityGain));
  CHECK(half.commandsPerFrame == 8);
}

TEST_CASE("A sensor is worse with less light and has the deviation of the tracker's benchmark with the thesis's",
          "[explore]")
{
  const Setup setup;
  Design design;
  const auto tested = [&](const Design &of) { return testSensor(productOf(of, setup, timingOf(of, setup)), 4.); };
  const SensorTest normal = tested(design);
  CHECK(normal.good());
  CHECK(normal.model.sigmaX == Approx(0.0149).epsilon(0.15)); // Cramer-Rao bound of this product: modules/pattern
  CHECK(normal.model.sigmaY == Approx(0.0077).epsilon(0.15));
  CHECK(normal.model.effectiveCells > 4.);
  design.exposure = 10.;
  const SensorTest dark = tested(design);
  CHECK(dark.model.sigmaX > 1.8 * normal.model.sigmaX);
  design.exposure = 50.;
  design.width = design.height = 16; // less than a cell
  CHECK_FALSE(tested(design).good());
}

TEST_CASE("Every design goes to one rank, whatever their number, and the work is shared evenly", "[explore]")
{
  const int ranks = GENERATE(1, 2, 3, 7, 64);
  const Setup setup =
      setupOf(R"({"design": {"frame_rate_hz": [400, 800, 1600, 3200], "image_px": [[64, 48], [160, 100]],
    "um_per_px": [3, 5, 7], "drop_velocity_mm_s": [20, 40]}})");
  const auto shares = vpApp::shareOut(sweepOf(setup), ranks);
  REQUIRE(shares.size() == static_cast<std::size_t>(ranks));
  std::vector<int> times(setup.designs.size(), 0);
  for (const auto &share : shares) {
    for (const std::size_t index : share) {
      ++times.at(index);
    }
  }
  CHECK(std::count(times.begin(), times.end(), 1) == static_cast<std::ptrdiff_t>(times.size()));
}

TEST_CASE("Outcomes pass between ranks to the last digit", "[explore]")
{
  const Setup setup = setupOf(R"({"design": {"frame_rate_hz": [400, 800, 1600]}})");
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> between(0., 1.);
  std::vector<Outcome> outcomes(3);
  for (Outcome &o : outcomes) {
    o.landingRms = between(random);
    o.landing95 = 1e-9 * between(random);
    o.landingWorst = 1e9 * between(random);
    o.throughput = 1. / 3.;
    o.sensorX = between(random);
    o.cells = 40;
    o.missed = static_cast<int>(random() % 10);
    o.verdict = {"cells", "of 40 cells, \"some\" got none"};
  }
  vpApp::Writer writer;
  writer(outcomes);
  std::vector<Outcome> back;
  vpApp::Reader(writer.text())(back);
  REQUIRE(back.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(back[i].landingRms == outcomes[i].landingRms);
    CHECK(back[i].landing95 == outcomes[i].landing95);
    CHECK(back[i].landingWorst == outcomes[i].landingWorst);
    CHECK(back[i].throughput == outcomes[i].throughput);
    CHECK(back[i].sensorX == outcomes[i].sensorX);
    CHECK(back[i].missed == outcomes[i].missed);
    CHECK(back[i].verdict.sentence == outcomes[i].verdict.sentence);
  }
  back[0].describe(setup.designs[2], setup);
  back[1].describe(setup.designs[0], setup);
  CHECK(back[0].design.frameRate == 1600.);
  CHECK(back[0].thesis);
  CHECK_FALSE(back[1].thesis);
  for (const std::size_t size : {writer.text().size() - 1, std::size_t{9}, std::size_t{0}}) {
    CHECK_THROWS_WITH(vpApp::Reader(writer.text().substr(0, size))(back),
                      "the results of another process are cut short");
  }
}

TEST_CASE("Only designs that work are on the front, and the best keeps what is required", "[explore]")
{
  Setup setup = setupOf(R"({"require": {"throughput_cells_per_s": 150, "load": 0.5}})");
  std::vector<Outcome> outcomes(4);
  const double landing[] = {1., 2., 0.1, 3.}, throughput[] = {100., 200., 300., 190.};
  for (std::size_t i = 0; i < 4; ++i) {
    outcomes[i].landingWorst = landing[i];
    outcomes[i].throughput = throughput[i];
  }
  outcomes[2].verdict = {"tracker", "lost"};
  const Exploration result = judge(setup, outcomes);
  CHECK(result.feasible == 3);
  CHECK(result.front == std::vector<std::size_t>{1}); // 0 is too slow, 2 is infeasible, 1 is better than 3
  CHECK(result.best == 1);
  CHECK(result.required == 2);
  CHECK(reasonsOf(result).at("tracker") == 1);
  setup.requirements = {{"landing_worst_um", 0.5}};
  CHECK(judge(setup, outcomes).best == -1);
  CHECK(findingsOf(setup, judge(setup, outcomes)).at(1) == "No design that works keeps what is required.");
  CHECK(judge(setup, outcomes).front.empty());
  setup.requirements.clear();
  CHECK(judge(setup, outcomes).front == std::vector<std::size_t>{0, 1});
}

TEST_CASE("An error in a file names field and value", "[explore]")
{
  const std::vector<std::pair<std::string, std::string>> wrong = {
      {"[1]", "spec.json: the content is [1], must be an object { }"},
      {R"({"designs": {}})", "spec.json: unknown field designs; known are "},
      {R"({"design": {"fps": [1]}})", "spec.json: unknown field design.fps; known are "},
      {R"({"design": {"frame_rate_hz": "fast"}})",
       R"(spec.json: design.frame_rate_hz is "fast", must be a number, a list)"},
      {R"({"design": {"frame_rate_hz": []}})", "spec.json: design.frame_rate_hz is [], must be a number, a list"},
      {R"({"design": {"frame_rate_hz": [1600, 0]}})", "within 50..200000"},
      {R"({"design": {"um_per_px": {"from": 5, "to": 3}}})",
       "spec.json: design.um_per_px.to is 3, must be more than from"},
      {R"({"design": {"um_per_px": {"from": 5}}})", "spec.json: design.um_per_px.to is missing"},
      {R"({"design": {"um_per_px": {"from": 5, "to": 6, "scale": "cubic"}}})",
       R"(spec.json: design.um_per_px.scale is "cubic", must be linear or log)"},
      {R"({"design": {"um_per_px": {"from": 5, "to": 6, "steps": 1}}})",
       "design.um_per_px.steps is 1, must be 2..1000"},
      {R"({"design": {"image_px": [[160]]}})",
       "design.image_px is [[160]], must be a list of [width, height], each 8..4096"},
      {R"({"design": {"image_px": [[160, -4]]}})", "design.image_px is [[160,-4]], must be"},
      {R"({"design": {"controller": ["pid", "lqr"]}})",
       R"(design.controller is ["pid","lqr"], must be pid, pid-ff or observer)"},
      {R"({"design": {"controller": 3}})", "design.controller is 3, must be"},
      {R"({"task": {"cells": 1}})", "spec.json: task.cells is 1, must be 2..10000"},
      {R"({"task": {"cells": 2.5}})", "spec.json: task.cells is 2.5, must be"},
      {R"({"task": {"rows": 2}})", "unknown field task.rows"},
      {R"({"camera": {"dark": 200}})", "spec.json: camera: dark is 200, must be less than bright"},
      {R"({"camera": {"overlap": 1}})", "spec.json: camera.overlap is 1, must be"},
      {R"({"processor": {"max_load": 2}})", "spec.json: processor.max_load is 2, must be 1e-06..1"},
      {R"({"objectives": ["beauty"]})",
       R"(spec.json: objectives is ["beauty"], must be a list of some of landing_rms_um,)"},
      {R"({"objectives": ["load", "load"]})", "each once"},
      {R"({"objectives": []})", "spec.json: objectives is [], must be"},
      {R"({"require": {"beauty": 1}})", "spec.json: unknown field require.beauty; known are "},
      {R"({"require": {"load": "low"}})", R"(spec.json: require.load is "low", must be a number)"},
      {R"({"samples": -1})", "spec.json: samples is -1, must be"},
      {R"({"seed": 1, "seed": 2})", R"(spec.json: field "seed" is given twice)"},
      {R"({"design": {"um_per_px": {"from": 1, "to": 9, "steps": 1000}, "exposure_us": {"from": 1, "to": 9, "steps": 1000},
         "frame_rate_hz": [800, 1600]}})",
       "the grid has 2000000 designs, must be at most 1000000; use samples"},
      {"{", "spec.json: line 1, column "}};
  for (const auto &[text, sentence] : wrong) {
    CAPTURE(text);
    CHECK_THROWS_WITH(setupOf(text), Catch::Contains(sentence));
  }
  CHECK(setupOf("{}").designs.size() == 1); // the thesis's camera
}
