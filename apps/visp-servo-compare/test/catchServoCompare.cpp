/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The parts of visp-servo-compare: catalogue, task files, plan, findings.
#include "vpCatch.h"

#include "appMain.h"
#include "catalogue.h"
#include "findings.h"
#include "format.h"
#include "plan.h"
#include "results.h"
#include "runLog.h"

#include <visp3/feedforward/vpServoLaw.h>

#include <set>

using namespace servoCompare;

namespace
{
//! Results with given figures instead of simulated ones.
Results resultsOf(const Plan &plan, const std::function<vpServoMetrics(const vpServoRunSpec &)> &metrics)
{
  Results results(plan.runs.size());
  for (std::size_t i = 0; i < plan.runs.size(); ++i) {
    vpServoRun run;
    run.spec = plan.runs[i];
    run.metrics = metrics(run.spec);
    results.set(i, run);
  }
  return results;
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
