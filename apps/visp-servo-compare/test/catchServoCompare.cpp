/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The parts of visp-servo-compare: catalogue, task files, plan.
#include "vpCatch.h"
#include "vpFieldRows.h"

#include "appMain.h"
#include "catalogue.h"
#include "format.h"
#include "outputFolder.h"
#include "plan.h"
#include "results.h"
#include "runLog.h"
#include "scenario.h"

#include <visp3/feedforward/vpServoLaw.h>

using namespace servoCompare;

TEST_CASE("Every law has a sentence, with its filter", "[visp-servo-compare]")
{
  for (const std::string &id : vpServoLaw::ids()) {
    CAPTURE(id);
    CHECK(sentenceOf(id).size() > 20);
    CHECK(sentenceOf(id + "+cbf") == sentenceOf(id) +
                                         " Behind it the filter that keeps the object's corners in the view "
                                         "of a robot that executes its twist.");
  }
  CHECK(withoutFilter("ibvs+cbf") == "ibvs");
  CHECK(withoutFilter("+cbf") == "+cbf");
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

  std::vector<vpServoRun> runs(plan.runs.size());
  for (std::size_t i = 0; i < runs.size(); ++i) {
    runs[i].spec = plan.runs[i];
  }
  const Results results(std::move(runs));
  CHECK_FALSE(results.find("ibvs", "A", "points")->spec.shape);
  CHECK(results.find("ibvs", "A", "points")->spec.seed == 1);
  CHECK(results.find("ibvs", "A", "points", Command::Shaped)->spec.shape);
  CHECK(results.find("ibvs", "A", "image") == nullptr);
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
