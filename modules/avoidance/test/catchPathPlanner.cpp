/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Paths of all planners: free where guaranteed, with correct ends, within the limits, and correctly reported failures.
#include "../src/vpConfigurationTree.h"
#include "vpAvoidanceTestKit.h"
#include "vpCatch.h"
#include "vpIndependentClearance.h"

#include <visp3/avoidance/vpCollisionChecker.h>
#include <visp3/avoidance/vpCollisionSceneJson.h>
#include <visp3/avoidance/vpFclChecker.h>
#include <visp3/avoidance/vpPathPlanner.h>
#include <visp3/core/vpException.h>

#include <chrono>
#include <cstdlib>
#include <iostream>
#include <thread>

using namespace vpAvoidanceTestKit;

namespace
{
//! Least clearance at a number of path positions, by code independent of the planner.
double recheck(const vpCollisionScene &scene, const vpCollisionSceneSpec &spec, const vpJointPath &path, int places)
{
  const IndependentClearance oracle(scene.arm(), spec);
  double least = 0.1;
  for (int i = 0; i <= places; ++i) {
    least = std::min(least, oracle.clearance(path.at(static_cast<double>(i) / places), scene.selfPairs(), least));
  }
  return least;
}

//! Obstacles about the arm, with room for the shoulder.
vpCollisionSceneSpec manyPrimitives(std::mt19937_64 &rng, int count)
{
  vpCollisionSceneSpec spec;
  for (int j = 0; j < count; ++j) {
    vpCollisionObject object;
    object.name = "o" + std::to_string(j);
    object.shape = primitive(rng, j);
    object.pose = pose(rng, 1.);
    object.pose.p = uniform(rng, 0.5, 0.9) * object.pose.p.normalized();
    spec.objects.push_back(object);
  }
  return spec;
}

void requireEnds(const vpArmModel &arm, const vpPathResult &result, const vpJointVector &start,
                 const vpJointVector &goal)
{
  REQUIRE(result.path.points.size() >= 2);
  REQUIRE((result.path.points.front() - start).norm() < 1e-12);
  for (int i = 0; i < arm.size(); ++i) {
    const double off = result.path.points.back()(i) - goal(i);
    REQUIRE(std::fabs(arm.isContinuous(i) ? std::remainder(off, 2. * pi) : off) < 1e-9);
    for (const vpJointVector &q : result.path.points) {
      REQUIRE(q(i) >= arm.lower()(i));
      REQUIRE(q(i) <= arm.upper()(i));
    }
  }
}
} // namespace

TEST_CASE("Two trees on certified motions solve pillar and shelf, free at every place", "[planner][needs-OMPL]")
{
  for (const std::string planner : {"BiRRT", "RRTConnect"}) {
    int plans = 0, motions = 0;
    for (const char *name : {"scene/s4a-pillar.json", "scene/s4b-shelf.json"}) {
      const vpCollisionSceneFile file = vpLoadCollisionScene(dataFile(name));
      const vpCollisionScene scene(amor(), file.spec);
      for (int k = 0; k < vpTestSupport::longer(10); ++k) {
        for (const vpMotionTask &task : file.tasks) {
          vpPathPlannerSpec spec;
          spec.planner = planner;
          spec.seed = static_cast<unsigned int>(k + 1);
          const vpPathResult result = vpPathPlanner(scene, spec).plan(task.start, task.goal);
          CAPTURE(planner, name, task.name, k, result.message);
          REQUIRE(result.status == vpPathStatus::Solved);
          requireEnds(amor(), result, task.start, task.goal);
          REQUIRE(recheck(scene, file.spec, result.path, 10000) >= spec.margin - 1e-9);
          motions += static_cast<int>(result.motions);
          ++plans;
        }
      }
    }
    std::cout << planner << ": " << plans << " certified plans, none nearer than the margin at 10,000 places; "
              << motions / plans << " motions checked on average\n";
  }
}

TEST_CASE("FCL finds no contact on a thousand paths of BiRRT", "[planner][fcl][needs-FCL]")
{
  auto rng = vpTestSupport::generator(902);
  CAPTURE(vpTestSupport::seed());
  constexpr int places = 100, pathsOfScene = 20;
  int paths = 0, bent = 0, failures = 0;
  while (paths < vpTestSupport::longer(1000)) {
    const vpCollisionScene scene(amor(), manyPrimitives(rng, 12));
    vpFclChecker fcl(scene);
    vpPathPlannerSpec spec;
    spec.planner = "BiRRT";
    spec.timeLimit = 1.;
    spec.shortenTime = paths % 3 == 0 ? 0. : 0.02;
    vpPathPlanner planner(scene, spec);
    for (int k = 0; k < pathsOfScene; ++k) {
      planner.setSeed(static_cast<unsigned int>(paths + failures + 1));
      const vpJointVector start = configuration(amor(), rng), goal = configuration(amor(), rng);
      const vpPathResult result = planner.plan(start, goal);
      CAPTURE(paths, k, result.message);
      if (result.status != vpPathStatus::Solved) {
        ++failures;
        REQUIRE(result.status != vpPathStatus::NotFree);
        REQUIRE(result.path.points.empty());
        continue;
      }
      ++paths;
      bent += result.path.points.size() > 2 ? 1 : 0;
      requireEnds(amor(), result, start, goal);
      for (int i = 0; i <= places; ++i) {
        REQUIRE(!fcl.inCollision(result.path.at(static_cast<double>(i) / places), 0.));
      }
    }
  }
  std::cout << paths << " paths of BiRRT, " << bent << " of them bent, no contact by FCL at " << places + 1
            << " places of each\n";
  CHECK(3 * bent > paths);
}

TEST_CASE("Every planner finds a free path round the pillar", "[planner][needs-OMPL]")
{
  const vpCollisionSceneFile file = vpLoadCollisionScene(dataFile("scene/s4a-pillar.json"));
  const vpCollisionScene scene(amor(), file.spec);
  for (const std::string &name : vpPathPlanner::names()) {
    int solved = 0;
    for (unsigned int seed = 1; seed <= 3; ++seed) {
      vpPathPlannerSpec spec;
      spec.planner = name;
      spec.seed = seed;
      spec.timeLimit = 10.; // slow machines; most need milliseconds
      vpPathPlanner planner(scene, spec);
      const vpPathResult result = planner.plan(file.tasks[0].start, file.tasks[0].goal);
      CAPTURE(name, seed, result.message);
      if (result.status == vpPathStatus::Solved) {
        ++solved;
        requireEnds(amor(), result, file.tasks[0].start, file.tasks[0].goal);
        REQUIRE(recheck(scene, file.spec, result.path, 2000) >= spec.margin - 1e-9);
      }
      else {
        REQUIRE(result.status == vpPathStatus::TimedOut);
      }
    }
    CHECK(solved >= 1);
  }
}

TEST_CASE("Discrete validation calls paths free that are not", "[planner]")
{
  // Boards thinner than a step: samples detect them only by chance.
  auto rng = vpTestSupport::generator(901);
  CAPTURE(vpTestSupport::seed());
  int certified = 0, discrete = 0, lies = 0;
  // In 18 % of the problems the samples miss: among 60 none of them once in 1e5 runs.
  for (int problem = 0; problem < vpTestSupport::longer(15) || (lies == 0 && problem < 60); ++problem) {
    vpCollisionSceneSpec spec;
    for (int k = 0; k < 8; ++k) {
      vpCollisionObject board;
      board.name = "board " + std::to_string(k);
      board.shape = vpCollisionShape::box({0.4, 0.4, 0.004});
      board.pose = pose(rng, 1.);
      board.pose.p = uniform(rng, 0.5, 0.9) * board.pose.p.normalized(); // the shoulder must have room
      spec.objects.push_back(board);
    }
    const vpCollisionScene scene(amor(), spec);
    vpSceneChecker checker(scene);
    vpJointVector ends[2];
    for (vpJointVector &q : ends) {
      int attempts = 0;
      do {
        q = configuration(amor(), rng);
      } while (checker.inCollision(q, 0.) && ++attempts < 10000);
    }
    vpPathPlannerSpec how;
    how.margin = 0.;
    how.timeLimit = 1.;
    how.step = 0.2;
    how.shortenTime = 0.05;
    vpPathPlanner sure(scene, how);
    const vpPathResult a = sure.plan(ends[0], ends[1]);
    if (a.status == vpPathStatus::Solved) {
      ++certified;
      REQUIRE(recheck(scene, spec, a.path, 10000) >= -1e-9);
    }
    how.validation = vpMotionValidation::Discrete;
    vpPathPlanner hopeful(scene, how);
    const vpPathResult b = hopeful.plan(ends[0], ends[1]);
    if (b.status == vpPathStatus::Solved) {
      ++discrete;
      lies += recheck(scene, spec, b.path, 10000) < -1e-6 ? 1 : 0;
    }
  }
  std::cout << "among thin boards: " << certified << " certified paths, all free; " << discrete
            << " discrete ones (0.2 rad), " << lies << " of them collide\n";
  CHECK(2 * certified > vpTestSupport::longer(15));
  CHECK(lies > 0);
}

TEST_CASE("Plans repeat for a seed, and paths are shorter after shortening", "[planner][needs-OMPL]")
{
  const vpCollisionSceneFile file = vpLoadCollisionScene(dataFile("scene/s4b-shelf.json"));
  const vpCollisionScene scene(amor(), file.spec);
  vpPathPlannerSpec spec;
  spec.planner = GENERATE("BiRRT", "RRTConnect");
  spec.shortenTime = 0.;
  spec.timeLimit = 60.;
  vpPathPlanner first(scene, spec), second(scene, spec);
  const vpPathResult a = first.plan(file.tasks[0].start, file.tasks[0].goal);
  const vpPathResult b = second.plan(file.tasks[0].start, file.tasks[0].goal);
  REQUIRE(a.status == vpPathStatus::Solved);
  REQUIRE(a.path.points.size() == b.path.points.size());
  for (std::size_t i = 0; i < a.path.points.size(); ++i) {
    REQUIRE(a.path.points[i] == b.path.points[i]);
  }
  spec.shortenTime = 0.5;
  vpPathPlanner third(scene, spec);
  const vpPathResult c = third.plan(file.tasks[0].start, file.tasks[0].goal);
  REQUIRE(c.status == vpPathStatus::Solved);
  CHECK(c.path.length() < a.path.length());
}

TEST_CASE("What cannot be planned is said", "[planner][needs-OMPL]")
{
  const vpCollisionSceneFile file = vpLoadCollisionScene(dataFile("scene/s4a-pillar.json"));
  vpCollisionScene scene(amor(), file.spec);
  vpPathPlannerSpec spec;
  spec.planner = GENERATE("BiRRT", "RRTConnect");
  spec.timeLimit = 0.2;
  vpPathPlanner planner(scene, spec);
  const vpJointVector start = file.tasks[0].start, goal = file.tasks[0].goal;

  vpJointVector beyond = goal;
  beyond(1) = 3.;
  vpPathResult result = planner.plan(start, beyond);
  CHECK(result.status == vpPathStatus::OutsideLimits);
  CHECK(result.message == "Joint q2 of the goal is at 3, beyond its limit 2.3561944901923448.");
  // A limit rounded in a file counts as the limit; a slightly larger value does not, and is printed differently.
  const vpCollisionScene nothing(amor());
  vpPathPlanner free(nothing, spec);
  const double limit = amor().upper()(5);
  beyond = amor().home();
  beyond(5) = std::nextafter(limit, 10.);
  result = free.plan(amor().home(), beyond);
  CAPTURE(result.message);
  REQUIRE(result.status == vpPathStatus::Solved);
  CHECK(result.path.points.back()(5) == limit);
  CHECK(free.plan(beyond, amor().home()).status == vpPathStatus::Solved);
  beyond(5) = limit + 5e-6;
  result = free.plan(amor().home(), beyond);
  CHECK(result.status == vpPathStatus::OutsideLimits);
  const std::size_t at = result.message.find("is at 1.527168"), than = result.message.find("limit 1.5271630");
  CHECK((at != std::string::npos && than != std::string::npos));
  CHECK(planner.plan(vpJointVector::Zero(3), goal).status == vpPathStatus::BadInput);
  CHECK(planner.plan(start, vpJointVector::Constant(7, NAN)).status == vpPathStatus::BadInput);

  result = planner.plan(start, start);
  CHECK(result.status == vpPathStatus::Solved);
  CHECK(result.path.length() == 0.);

  // An obstacle in the hand of the goal; then one that shuts it in.
  vpArmData data;
  vpArmKinematics::forward(amor(), goal, data);
  vpCollisionObject ball;
  ball.name = "ball";
  ball.pose = data.tool;
  const int index = scene.add(ball);
  result = planner.plan(start, goal);
  CHECK(result.status == vpPathStatus::GoalInCollision);
  CHECK(result.message == "In the goal the arm is nearer than the margin: link 7 and object ball touch.");
  CHECK(planner.plan(goal, start).status == vpPathStatus::StartInCollision);
  // Beside it, within the margin.
  vpCollisionData placed;
  scene.place(goal, placed);
  const vpPlacedCapsule &hand = placed.capsules[3];
  vpRigidTransform beside;
  beside.p = hand.to + (hand.radius + 0.05 + 0.00985) * (hand.to - hand.from).normalized();
  REQUIRE(scene.moveObject(index, beside));
  spec.margin = 0.01;
  CHECK(
      vpPathPlanner(scene, spec).plan(goal, start).message ==
      "In the start the arm is nearer than the margin: link 7 and object ball are 9.85 mm apart, the margin is 10 mm.");
  beside.p = hand.to + (hand.radius + 0.05 + 0.0099999999) * (hand.to - hand.from).normalized();
  REQUIRE(scene.moveObject(index, beside));
  CHECK(vpPathPlanner(scene, spec).plan(goal, start).message.find("are 9.9999999") != std::string::npos);
  // What is known of it to 10 mm only touches where it may be; bodies have their names.
  vpArmSpec named = amor().spec();
  named.bodies = {{"hand", 7}};
  named.capsules[3].body = 0;
  vpCollisionScene blurred{vpArmModel(named)};
  ball.pose = beside;
  ball.inflation = 0.0101;
  blurred.add(ball);
  CHECK(vpPathPlanner(blurred, spec).plan(goal, start).message ==
        "In the start the arm is nearer than the margin: hand and object ball, inflated by 10.1 mm, touch.");
  scene.remove(index);
  for (int side = 0; side < 6; ++side) {
    vpCollisionObject wall;
    wall.name = "wall " + std::to_string(side);
    Vector3d size = Vector3d::Constant(0.8), place = Vector3d::Zero();
    size(side / 2) = 0.01;
    place(side / 2) = side % 2 == 0 ? -0.4 : 0.4;
    wall.shape = vpCollisionShape::box(size);
    wall.pose.p = data.tool.p + place;
    scene.add(wall);
  }
  result = planner.plan(start, goal);
  CAPTURE(result.message);
  CHECK(result.status != vpPathStatus::Solved);
  CHECK(!result.message.empty());

  spec.planner = "RRTX";
  CHECK_THROWS_WITH(
      vpPathPlanner(scene, spec),
      Catch::Contains(
          "path planner \"RRTX\" is unknown, known are: BiRRT, RRT, RRTConnect, RRTstar, PRM, BITstar, KPIECE"));
  spec = vpPathPlannerSpec();
  spec.margin = -0.1;
  CHECK_THROWS_WITH(vpPathPlanner(scene, spec), Catch::Contains("margin of the path planner is -0.1, must be >= 0"));
  spec = vpPathPlannerSpec();
  spec.timeLimit = NAN;
  CHECK_THROWS_WITH(vpPathPlanner(scene, spec), Catch::Contains("timeLimit of the path planner is nan"));
}

TEST_CASE("A path is walked by its length", "[planner]")
{
  vpJointPath path;
  for (const double x : {0., 1., 1., 4.}) {
    path.points.push_back(vpJointVector::Constant(1, x));
  }
  CHECK(path.length() == 4.);
  CHECK(path.at(-1.)(0) == 0.);
  CHECK(path.at(0.25)(0) == 1.);
  CHECK(path.at(0.5)(0) == Approx(2.));
  CHECK(path.at(2.)(0) == 4.);
}

TEST_CASE("Plans repeat for a seed, alone and while other threads plan", "[planner][needs-OMPL]")
{
  const vpCollisionSceneFile file = vpLoadCollisionScene(dataFile("scene/s4b-shelf.json"));
  const vpCollisionScene scene(amor(), file.spec);
  constexpr unsigned int seeds = 8;
  const std::string name = GENERATE("BiRRT", "RRTConnect");
  const auto plan = [&](unsigned int seed) {
    vpPathPlannerSpec spec;
    spec.planner = name;
    spec.seed = seed;
    spec.shortenTime = 0.; // a limit of time
    spec.timeLimit = 60.;
    spec.iterations = 5000;
    vpPathPlanner planner(scene, spec);
    std::vector<double> numbers;
    for (const vpJointVector &q : planner.plan(file.tasks[1].start, file.tasks[1].goal).path.points) {
      numbers.insert(numbers.end(), q.data(), q.data() + q.size());
    }
    return numbers;
  };
  std::vector<std::vector<double>> alone, together(seeds);
  for (unsigned int k = 0; k < seeds; ++k) {
    alone.push_back(plan(k + 1));
    REQUIRE(alone.back().size() >= 14);
  }
  for (int round = 0; round < 5; ++round) {
    std::vector<std::thread> threads;
    for (unsigned int half = 0; half < 4; ++half) {
      threads.emplace_back([&, half] {
        for (unsigned int k = half; k < seeds; k += 4) {
          together[k] = plan(k + 1);
        }
      });
    }
    for (std::thread &thread : threads) {
      thread.join();
    }
    for (unsigned int k = 0; k < seeds; ++k) {
      CHECK((alone[k] == together[k]));
    }
  }
  CHECK((alone[0] != alone[1]));
}

TEST_CASE("The nearest configuration of a tree is the nearest of all", "[planner]")
{
  auto rng = vpTestSupport::generator(903);
  CAPTURE(vpTestSupport::seed());
  vpConfigurationTree tree;
  for (const int joints : {1, 2, 7, 16}) {
    const auto draw = [&] {
      vpJointVector q(joints);
      for (int i = 0; i < joints; ++i) {
        q(i) = uniform(rng, -3., 3.);
      }
      return q;
    };
    std::vector<vpJointVector> all{draw()};
    tree.start(all[0]);
    for (int k = 1; k < 1000; ++k) {
      const vpJointVector wanted = draw();
      double least = 1e9;
      for (const vpJointVector &q : all) {
        least = std::min(least, (q - wanted).norm());
      }
      const int node = tree.nearest(wanted);
      REQUIRE((tree.at(node) - wanted).norm() <= least + 1e-5);
      REQUIRE(tree.at(node) == all[static_cast<std::size_t>(node)]);
      all.push_back(draw());
      REQUIRE(tree.add(all.back(), node) == k);
      const std::vector<vpJointVector> way = tree.wayToRoot(k);
      REQUIRE(way[0] == all.back());
      REQUIRE(way[1] == all[static_cast<std::size_t>(node)]);
      REQUIRE(way.back() == all[0]);
    }
  }
}

TEST_CASE("A limit of iterations ends a search that has no end", "[planner][needs-OMPL]")
{
  vpCollisionSceneSpec closed; // walls on all sides, and the goal turned away: no way round the base
  for (int k = 0; k < 2; ++k) {
    vpCollisionObject wall;
    wall.name = "wall " + std::to_string(k);
    wall.shape = vpCollisionShape::box({0.05, 4., 4.});
    wall.pose.p.x() = k == 0 ? -0.25 : 0.25;
    closed.objects.push_back(wall);
  }
  const vpCollisionScene scene(amor(), closed);
  vpPathPlannerSpec spec;
  vpJointVector start = amor().home(), goal = start;
  start << 1.6, 1.4, 0., -1.6, 0., 0., 0.;
  goal = start;
  goal(0) = -1.6;
  for (const std::string name : {"BiRRT", "RRTConnect"}) {
    spec.planner = name;
    spec.iterations = 20;
    spec.timeLimit = 1000.;
    const vpPathResult few = vpPathPlanner(scene, spec).plan(start, goal);
    CAPTURE(few.message);
    CHECK(few.status == vpPathStatus::TimedOut);
    CHECK(few.path.points.empty());
    CHECK(few.message.find(name + " found no path in ") == 0);
    CHECK(few.message.find(" or 20 iterations;") != std::string::npos);
  }
}

TEST_CASE("A search without a path ends at the time limit", "[planner][needs-OMPL]")
{
  vpArmSpec one; // a single joint cannot go round anything
  vpArmJointSpec joint = vpArmJointSpec::standardDH(0.5, 0., 0., 0.);
  joint.name = "joint";
  joint.lower = -1.5;
  joint.upper = 1.5;
  one.name = "one joint";
  one.joints = {joint};
  one.capsules = {{1, {-0.5, 0., 0.}, {0., 0., 0.}, 0.05}};
  vpCollisionSceneSpec blocked;
  vpCollisionObject ball;
  ball.name = "ball";
  ball.pose.p = Vector3d(0.4, 0., 0.);
  blocked.objects = {ball};
  const vpCollisionScene scene(vpArmModel(one), blocked);
  vpPathPlannerSpec spec;
  spec.planner = GENERATE("BiRRT", "RRTConnect");
  spec.timeLimit = 0.1;
  const auto begin = std::chrono::steady_clock::now();
  const vpPathResult result =
      vpPathPlanner(scene, spec).plan(vpJointVector::Constant(1, -1.), vpJointVector::Constant(1, 1.));
  const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  CAPTURE(result.message);
  CHECK(result.status == vpPathStatus::TimedOut);
  CHECK(result.path.points.empty());
  CHECK(result.planningTime >= 0.1);
  CHECK(elapsed < 2.); // of a machine under load
  CHECK(result.message == spec.planner + " found no path in 0.100000 s; that does not mean that there is none.");
}
