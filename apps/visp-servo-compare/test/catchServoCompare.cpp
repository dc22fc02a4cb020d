/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The parts of visp-servo-compare: catalogue, task files, plan, findings.
#include "vpCatch.h"
#include "vpFieldRows.h"

#include "appMain.h"
#include "catalogue.h"
#include "findings.h"
#include "format.h"
#include "outputFolder.h"
#include "plan.h"
#include "results.h"
#include "runLog.h"
#include "scenario.h"
#include "tables.h"

#include <visp3/feedforward/vpServoLaw.h>

#include <set>

using namespace servoCompare;

namespace
{
//! Results with given metrics instead of simulated ones.
Results resultsOf(const Plan &plan, const std::function<vpServoMetrics(const vpServoRunSpec &)> &metrics)
{
  std::vector<vpServoRun> runs(plan.runs.size());
  for (std::size_t i = 0; i < runs.size(); ++i) {
    runs[i].spec = plan.runs[i];
    runs[i].metrics = metrics(runs[i].spec);
  }
  return Results(std::move(runs));
}

Plan planOf(const std::vector<std::string> &laws, unsigned int repetitions = 1)
{
  Options options;
  options.laws = laws;
  options.measures = {"points"};
  options.repetitions = repetitions;
  return makePlan(options);
}
} // namespace

TEST_CASE("Every law has a name, a sentence and a colour of its own", "[visp-servo-compare]")
{
  std::set<std::string> names, colours;
  for (const std::string &id : vpServoLaw::ids()) {
    CAPTURE(id);
    const LawInfo info = lawInfo(id);
    CHECK(info.id == id);
    CHECK(info.sentence.size() > 20);
    CHECK(names.insert(info.name).second);
    CHECK(colours.insert(info.colour).second);
    CHECK(lawInfo(id + "+cbf").id == id + "+cbf");
    CHECK(lawInfo(id + "+cbf").colour == info.colour);
  }
  CHECK(isFiltered("ibvs+cbf"));
  CHECK_FALSE(isFiltered("+cbf"));
  CHECK(withoutFilter("ibvs+cbf") == "ibvs");
}

TEST_CASE("Numbers and lists read well", "[visp-servo-compare]")
{
  CHECK(fixed(-0.0001, 2) == "0.00");
  CHECK(fixed(-1.5, 2) == "-1.50");
  CHECK(number(0.2, 3) == "0.2");
  CHECK(enumerate({"a", "b", "c"}) == "a, b and c");
  CHECK(enumerate({}).empty());
  CHECK(fileName("slow one/../x+cbf") == "slow_one_.._x+cbf");
}

TEST_CASE("The task file of the data folder is the built-in task", "[visp-servo-compare]")
{
  const Scenario file = readScenario(VISP_DIRECT_DATA_DIR "/scenario/thesis-5.4.json");
  const Scenario built;
  REQUIRE(file.task.segments.size() == built.task.segments.size());
  CHECK(file.task.name == built.task.name);
  CHECK(file.task.objectWidth == built.task.objectWidth);
  CHECK(file.task.objectHeight == built.task.objectHeight);
  CHECK(file.task.pointCount == built.task.pointCount);
  CHECK(file.task.width == built.task.width);
  CHECK(file.task.height == built.task.height);
  CHECK(file.task.camera.get_px() == built.task.camera.get_px());
  CHECK(file.task.camera.get_u0() == built.task.camera.get_u0());
  for (std::size_t i = 0; i < built.task.segments.size(); ++i) {
    CAPTURE(i);
    CHECK(file.task.segments[i].name == built.task.segments[i].name);
    CHECK(file.task.segments[i].duration == built.task.segments[i].duration);
    for (unsigned int k = 0; k < 16; ++k) {
      CHECK(file.task.segments[i].cdMo.data[k] == Approx(built.task.segments[i].cdMo.data[k]).margin(1e-9));
    }
  }
  CHECK(file.gains.lambda == built.gains.lambda);
  CHECK(file.gains.rotation == built.gains.rotation);
  CHECK(file.gains.kappa == built.gains.kappa);
  CHECK(file.gains.saturation == built.gains.saturation);
  CHECK(file.gains.integral == built.gains.integral);
  CHECK(file.gains.integralLimit == built.gains.integralLimit);
  REQUIRE(file.plants.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(file.plants[i].name == built.plants[i].name);
    CHECK(file.plants[i].deadband == built.plants[i].deadband);
  }
  CHECK(file.faults.noise == built.faults.noise);
  CHECK(file.faults.blur == built.faults.blur);

  const Scenario inspection = readScenario(VISP_DIRECT_DATA_DIR "/scenario/inspection.json");
  CHECK(inspection.plants[1].latency == 0.2);
  CHECK(inspection.plants[1].deadband == vpServoPlant::byName("B").deadband);
  CHECK(inspection.gains.lambda == 0.8);
  CHECK(inspection.shape.linearAcceleration == built.shape.linearAcceleration);
}

TEST_CASE("The plan holds what was asked for", "[visp-servo-compare]")
{
  const std::size_t laws = vpServoLaw::ids().size();
  CHECK(makePlan(Options()).runs.size() == 3 * laws + 6); // 3 laws by image on 2 plants with friction
  Options full;
  full.full = true;
  CHECK(makePlan(full).runs.size() == 6 * laws);
  Options few;
  few.laws = {"ibvs", "ibvs+cbf", "ibvs"};
  few.plants = {"D"};
  few.measures = {"points"};
  few.repetitions = 4;
  few.seed = 5;
  const Plan plan = makePlan(few);
  REQUIRE(plan.runs.size() == 8);
  CHECK(plan.runs[3].law == "ibvs");
  CHECK(plan.runs[3].seed == 8);
  CHECK(plan.runs[4].law == "ibvs+cbf");
  CHECK(plan.hardPlant().name == "D");
  CHECK(plan.mainMeasure() == "points");
  CHECK(logName(plan.runs[4]) == "log/ibvs+cbf-D-points-seed5.csv");
}

TEST_CASE("With --shape every run occurs raw and shaped, and each is found", "[visp-servo-compare]")
{
  Options options;
  options.laws = {"ibvs"};
  options.plants = {"A", "D"};
  options.measures = {"points"};
  options.repetitions = 2;
  CHECK_FALSE(makePlan(options).shaped);
  options.shape = true;
  const Plan plan = makePlan(options);
  CHECK(plan.shaped);
  REQUIRE(plan.runs.size() == 8); // plant A: seeds 1 and 2 raw, then shaped; then plant D
  for (std::size_t i = 0; i < 8; ++i) {
    CAPTURE(i);
    CHECK(plan.runs[i].plant.name == (i < 4 ? "A" : "D"));
    CHECK(plan.runs[i].seed == 1 + i % 2);
    CHECK(plan.runs[i].shape.has_value() == (i % 4 >= 2));
  }
  CHECK(plan.runs[2].shape->linearAcceleration == 1.);
  CHECK(plan.runs[2].shape->angularAcceleration == 2.5);
  CHECK(plan.runs[2].shape->linearJerk == 10.);
  CHECK(plan.runs[2].shape->angularJerk == 25.);
  CHECK(logName(plan.runs[0]) == "log/ibvs-A-points-seed1.csv");
  CHECK(logName(plan.runs[2]) == "log/ibvs-A-points-seed1-shaped.csv");

  const Results results = resultsOf(plan, [](const vpServoRunSpec &spec) {
    vpServoMetrics m;
    m.settle_s = spec.seed + (spec.shape ? 100. : 0.);
    return m;
  });
  CHECK_FALSE(results.find("ibvs", "A", "points")->spec.shape);
  CHECK(results.find("ibvs", "A", "points", Command::Shaped)->spec.shape);
  CHECK(results.spread("ibvs", "D", "points", &vpServoMetrics::settle_s)->largest == 2.);
  CHECK(results.spread("ibvs", "D", "points", &vpServoMetrics::settle_s, Command::Shaped)->least == 101.);
  const vpApp::HtmlTable table = stepTable(plan, results, plan.hardPlant(), "points");
  REQUIRE(table.rows.size() == 1);
  REQUIRE(table.rows[0].size() == 15); // law, then seven metrics raw and shaped
  CHECK(table.rows[0][11].text == "1.50");
  CHECK(table.rows[0][12].text == "101.50");
  CHECK(stepTable(plan, results, plan.hardPlant(), "image").rows.empty());
}

TEST_CASE("What shaping costs follows from the numbers", "[visp-servo-compare]")
{
  Options options;
  options.laws = {"ibvs", "pbvs1+cbf"};
  options.plants = {"A"};
  options.measures = {"points"};
  options.shape = true;
  const Plan plan = makePlan(options);
  double lost = 0.7; // s
  const auto findings = [&]() {
    return stepFindings(plan, resultsOf(plan, [&](const vpServoRunSpec &spec) {
                          const bool ibvs = spec.law == "ibvs";
                          vpServoMetrics m;
                          m.peak_linear_acceleration_mps2 = spec.shape ? 1. : ibvs ? 22.36 : 30.;
                          m.peak_angular_acceleration_radps2 = spec.shape ? (ibvs ? 2.5 : 2.) : 49.6;
                          m.max_image_error_px = spec.shape ? (ibvs ? 15. : 40.) : 10.;
                          m.end_rotation_deg = 0.25;
                          m.settle_s = spec.shape ? (ibvs ? 4. : 3.5) : 3.;
                          m.out_of_view_s = spec.shape && !ibvs ? lost : 0.;
                          return m;
                        }));
  };
  const std::vector<std::string> sentences = findings();
  REQUIRE(sentences.size() == 4); // one plant: its cost is reported once
  CHECK(sentences[0] == "Over all laws and plants the command asks for accelerations of up to 30 m/s^2 and 49.6 "
                        "rad/s^2 raw, and of up to 1 m/s^2 and 2.5 rad/s^2 shaped.");
  CHECK(sentences[1] ==
        "What it costs on plant A: the largest image error rises most with pbvs1+cbf, from 10.0 to 40.0 px; the "
        "rotation error at the end rises with no law; the time to settle rises most with ibvs, from 3.00 to 4.00 s; "
        "the time out of view rises most with pbvs1+cbf, from 0.00 to 0.70 s.");
  CHECK(sentences[2].find("promises nothing. Longer out of view for that: pbvs1+cbf on plant A (0.00 s raw, 0.70 s "
                          "shaped).") != std::string::npos);
  lost = 0.;
  CHECK(findings()[2].find("In these runs no filtered law is longer out of view") != std::string::npos);
}

TEST_CASE("The answer follows from the numbers", "[visp-servo-compare]")
{
  const Plan plan = planOf({"kyrki-rot2", "ff-lookat", "ff-lookat-pi"});
  vpServoMetrics m;
  m.ideal_yaw_range_deg = 56.8;
  const auto answer = [&](double kyrki, double lookat, double pi) {
    const Results results = resultsOf(plan, [&](const vpServoRunSpec &spec) {
      m.end_rotation_deg = spec.law == "kyrki-rot2" ? kyrki : spec.law == "ff-lookat" ? lookat : pi;
      m.status = "ok";
      return m;
    });
    return findingsOf(plan, results).answer;
  };
  CHECK(answer(5., 5.2, 0.1)[0] ==
        "On plant D (friction 0.2 rad/s), only 1 of 3 laws ends within 0.2 deg of every goal: ff-lookat-pi (0.10 deg); "
        "the next is kyrki-rot2 (5.00 deg).");
  CHECK(answer(5., 5.2, 0.1)[1].find("tie on plant D") != std::string::npos);
  CHECK(answer(5., 2., 0.1)[1].find("differ on plant D") != std::string::npos);
  CHECK(answer(5., 2., 0.3)[0].find(
            "none of the 3 laws ends within 0.2 deg of every goal; the closest is ff-lookat-pi") != std::string::npos);
  CHECK(answer(0.1, 0.1, 0.1)[0].find("all 3 laws end within") != std::string::npos);
  CHECK(answer(0.1, 3., 0.1)[0].find("2 of 3 laws end within") != std::string::npos);
}

TEST_CASE("Median and range over the seeds", "[visp-servo-compare]")
{
  const Plan plan = planOf({"ibvs"}, 4);
  const Results results = resultsOf(plan, [](const vpServoRunSpec &spec) {
    vpServoMetrics m;
    m.settle_s = spec.seed == 1 ? 10. : spec.seed;
    return m;
  });
  const auto spread = results.spread("ibvs", "A", "points", &vpServoMetrics::settle_s);
  REQUIRE(spread);
  CHECK(spread->median == 3.5);
  CHECK(spread->least == 2.);
  CHECK(spread->largest == 10.);
  CHECK_FALSE(results.spread("ibvs", "A", "image", &vpServoMetrics::settle_s));
  CHECK(results.find("ibvs", "A", "points")->spec.seed == 1);
}

TEST_CASE("The page of task files has the ranges and defaults of the program", "[visp-servo-compare]")
{
  const std::string page = vpApp::readFile(std::string(VISP_DIRECT_DATA_DIR) + "/scenario/README.md");
  const Scenario defaults;
  CHECK(vpTestSupport::missingRows(page, "gains.", vpServoGains::fields(), defaults.gains, true) == "");
  CHECK(vpTestSupport::missingRows(page, "plants[].", vpServoPlant::fields(), vpServoPlant(), true) == "");
  CHECK(vpTestSupport::missingRows(page, "shape.", vpTwistShaperLimits::fields(), defaults.shape, true) == "");
  CHECK(vpTestSupport::missingRows(page, "image_faults.", vpCameraFaults::fields(), defaults.faults, true) == "");
}
