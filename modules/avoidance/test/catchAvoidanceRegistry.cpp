/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Planners and methods of a user's own beside ours. A program of its own: what is added stays.
#include "vpAvoidanceTestKit.h"
#include "vpCatch.h"
#include "vpIndependentClearance.h"

#include <visp3/avoidance/vpAvoidanceMethods.h>
#include <visp3/avoidance/vpCollisionSceneJson.h>
#include <visp3/avoidance/vpPathPlanner.h>
#include <visp3/avoidance/vpPlannedMotion.h>
#include <visp3/core/vpException.h>

#include <ompl/base/PlannerStatus.h>
#include <ompl/base/ProblemDefinition.h>
#include <ompl/base/goals/GoalState.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/planners/rrt/LazyRRT.h>

#include <algorithm>
#include <stdexcept>

using namespace vpAvoidanceTestKit;

namespace
{
namespace ob = ompl::base;
using Space = std::shared_ptr<ob::SpaceInformation>;

// Checks nothing: goes straight from the start to the goal.
class Straight : public ob::Planner
{
public:
  explicit Straight(const Space &space) : ob::Planner(space, "Straight") {}
  ob::PlannerStatus solve(const ob::PlannerTerminationCondition &) override
  {
    auto path = std::make_shared<ompl::geometric::PathGeometric>(si_);
    path->append(pdef_->getStartState(0));
    path->append(pdef_->getGoal()->as<ob::GoalState>()->getState());
    pdef_->addSolutionPath(path);
    return ob::PlannerStatus::EXACT_SOLUTION;
  }
};

bool has(const std::vector<std::string> &names, const std::string &name)
{
  return std::find(names.begin(), names.end(), name) != names.end();
}

void addPlanners()
{
  static bool isDone = false;
  if (isDone) {
    return;
  }
  isDone = true;
  vpPathPlanner::add("LazyRRT", "Checks its motions last.",
                     [](const Space &space, const vpPathPlannerSpec &) -> std::shared_ptr<ob::Planner> {
                       return std::make_shared<ompl::geometric::LazyRRT>(space);
                     });
  vpPathPlanner::add("Straight", "Checks nothing.",
                     [](const Space &space, const vpPathPlannerSpec &) -> std::shared_ptr<ob::Planner> {
                       return std::make_shared<Straight>(space);
                     });
}
} // namespace

TEST_CASE("a planner of one's own finds free paths, or its path is refused", "[registry][planner]")
{
  addPlanners();
  CHECK(has(vpPathPlanner::names(), "LazyRRT"));
  CHECK(vpPathPlanner::sentence("Straight") == "Checks nothing.");

  const vpCollisionSceneFile file = vpLoadCollisionScene(dataFile("scene/s4a-pillar.json"));
  const vpCollisionScene scene(amor(), file.spec);
  const IndependentClearance oracle(scene.arm(), file.spec);
  for (const auto validation : {vpMotionValidation::Certified, vpMotionValidation::Discrete}) {
    for (const double shorten : {0., 0.2}) {
      vpPathPlannerSpec spec;
      spec.validation = validation;
      spec.shortenTime = shorten;
      spec.planner = "Straight";
      const vpPathResult straight = vpPathPlanner(scene, spec).plan(file.tasks[0].start, file.tasks[0].goal);
      CHECK(straight.status == vpPathStatus::NotFree);
      CHECK(straight.path.points.empty());
      CHECK(straight.message == "Straight returned a path that is not free; it is not used.");
    }
  }
  int solved = 0;
  for (unsigned int seed = 1; seed <= 3; ++seed) {
    vpPathPlannerSpec spec;
    spec.planner = "LazyRRT";
    spec.seed = seed;
    spec.timeLimit = 10.;
    const vpPathResult result = vpPathPlanner(scene, spec).plan(file.tasks[0].start, file.tasks[0].goal);
    CAPTURE(seed, result.message);
    if (result.status == vpPathStatus::Solved) {
      ++solved;
      for (int i = 0; i <= 2000; ++i) {
        REQUIRE(oracle.clearance(result.path.at(i / 2000.), scene.selfPairs(), 0.1) >= spec.margin - 1e-9);
      }
    }
  }
  CHECK(solved >= 1);
}

TEST_CASE("a method of one's own drives planned motions with one's own planner", "[registry]")
{
  addPlanners();
  const auto add = [](const std::string &name, const std::string &planner) {
    vpAddAvoidanceMethod(name, "plans by " + planner,
                         [planner](const vpCollisionScene &scene, const vpAvoidanceMethodSpec &common) {
                           vpPlannedMotionSpec spec;
                           spec.common = common;
                           spec.planner = planner;
                           return std::make_unique<vpPlannedMotion>(scene, spec);
                         });
  };
  add("lazy-dtg", "LazyRRT");
  add("straight-dtg", "Straight");
  CHECK(has(vpAvoidanceMethodNames(), "lazy-dtg"));
  CHECK(vpAvoidanceMethodMessage("lazy-dtg") == "plans by LazyRRT");

  const vpCollisionSceneFile file = vpLoadCollisionScene(dataFile("scene/s4a-pillar.json"));
  const vpCollisionScene scene(amor(), file.spec);
  const vpAvoidanceGoal goal = vpAvoidanceGoal::at(amor(), file.tasks[0].goal);
  for (const bool isGood : {true, false}) {
    const auto method = vpMakeAvoidanceMethod(isGood ? "lazy-dtg" : "straight-dtg", scene);
    vpJointVector q = file.tasks[0].start;
    vpAvoidanceOutput output;
    output.status = method->start(q, goal);
    for (int cycle = 0; cycle < 4000 && vpIsWorking(output); ++cycle) {
      if (cycle % 8 == 0) {
        method->look();
      }
      method->step(q, output);
      q += 0.005 * output.velocity;
      if (!isGood && cycle > 200) {
        break;
      }
    }
    CHECK((output.status == vpAvoidanceStatus::Arrived) == isGood);
    CHECK(((q - file.tasks[0].start).norm() < 1e-9) != isGood); // without a free path it stands
  }
}

TEST_CASE("what is wrong with an added planner or method is one sentence", "[registry][errors]")
{
  using Catch::Contains;
  const vpCollisionSceneFile file = vpLoadCollisionScene(dataFile("scene/s4a-pillar.json"));
  const vpCollisionScene scene(amor(), file.spec);
  const auto none = [](const Space &, const vpPathPlannerSpec &) { return std::shared_ptr<ob::Planner>(); };
  CHECK_THROWS_WITH(vpPathPlanner::add("RRT", "Mine.", none), "path planner \"RRT\" is registered already");
  CHECK_THROWS_WITH(vpPathPlanner::add("my planner", "Mine.", none), Contains("must have an id of a letter"));
  CHECK_THROWS_WITH(vpPathPlanner::add("mine", "Mine.", nullptr), "path planner \"mine\" has no maker");
  CHECK_THROWS_WITH(vpPathPlanner::sentence("mine"), Contains("path planner \"mine\" is unknown, known are: BiRRT, "));
  vpPathPlanner::add("none", "Makes nothing.", none);
  vpPathPlannerSpec spec;
  spec.planner = "none";
  CHECK_THROWS_WITH(vpPathPlanner(scene, spec).plan(file.tasks[0].start, file.tasks[0].goal),
                    "the maker of path planner \"none\" returned none");

  const auto nothing = [](const vpCollisionScene &, const vpAvoidanceMethodSpec &) {
    return std::unique_ptr<vpAvoidanceMethod>();
  };
  CHECK_THROWS_WITH(vpAddAvoidanceMethod("dtg", "mine", nothing), "avoidance method \"dtg\" is registered already");
  CHECK_THROWS_WITH(vpAddAvoidanceMethod("mine", "", nothing), Contains("must have a sentence, one printable line"));
  vpAddAvoidanceMethod("nothing", "makes nothing", nothing);
  CHECK_THROWS_WITH(vpMakeAvoidanceMethod("nothing", scene), "the maker of avoidance method \"nothing\" returned none");
  CHECK_THROWS_WITH(vpAvoidanceMethodMessage("mine"), Contains("avoidance method \"mine\" is unknown, known are: pot"));
}
