/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Public robots with meshes: covers first, exact shapes where they do not decide, and pairs from statistics.
#include "vpExactOracle.h"
#include "vpMeshArms.h"

#include <visp3/avoidance/vpCertifiedMotion.h>
#include <visp3/avoidance/vpCollisionSceneJson.h>
#include <visp3/avoidance/vpExactChecker.h>
#include <visp3/avoidance/vpPathPlanner.h>
#include <visp3/avoidance/vpSelfCollisionStatistics.h>
#include <visp3/manipulator/vpSrdf.h>

#include <iostream>

using namespace vpMeshArms;

TEST_CASE("A ball of 1 cm on the mesh of any link is seen", "[arms]")
{
  auto rng = vpTestSupport::generator(31);
  CAPTURE(vpTestSupport::seed());
  for (const Robot &robot : {panda, ur5, tiago}) {
    const Loaded &loaded = load(robot);
    if (!loaded.arm) {
      return;
    }
    const vpArmModel &arm = *loaded.arm;
    vpCollisionSceneSpec spec;
    vpCollisionObject ball;
    ball.name = "ball";
    ball.shape = vpCollisionShape::sphere(0.01);
    spec.objects = {ball};
    spec.ignoredBodies = arm.spec().uncovered;
    spec.exact = loaded.exact;
    vpCollisionScene scene(arm, spec);
    vpExactChecker checker(scene);
    vpCollisionData data;
    int placed = 0, missed = 0;
    for (const vpArmShape &shape : arm.spec().shapes) {
      const int link = arm.spec().bodies[static_cast<std::size_t>(shape.body)].link;
      if (link == 0 || shape.kind != vpArmShapeKind::Mesh) {
        continue;
      }
      const vpTriangleMesh mesh = vpTriangleMesh::load(shape.file, shape.size);
      for (int k = 0; k < vpTestSupport::longer(100); ++k) {
        const auto &t = mesh.triangles()[static_cast<std::size_t>(uniform(rng, 0., mesh.triangles().size() - 1e-9))];
        const double a = uniform(rng, 0., 1.), b = uniform(rng, 0., 1. - a);
        const auto corner = [&](std::size_t i) { return mesh.vertices()[static_cast<std::size_t>(t[i])]; };
        const Vector3d p = (1. - a - b) * corner(0) + a * corner(1) + b * corner(2);
        const vpJointVector q = configuration(arm, rng);
        scene.place(q, data);
        const vpRigidTransform at = vpArmKinematics::link(arm, data.arm, link) * shape.pose;
        REQUIRE(scene.moveObject(0, {Eigen::Matrix3d::Identity(), at.R * p + at.p}));
        ++placed;
        missed += scene.inCollision(data) && checker.inCollision(q, 0.) ? 0 : 1;
      }
    }
    std::cout << robot.name << ": " << placed << " balls on meshes, " << missed << " missed\n";
    CHECK(missed == 0);
    CHECK(placed > 5 * vpTestSupport::longer(100));
  }
}

TEST_CASE("Certified motions of public robots are free on their meshes", "[arms]")
{
  auto rng = vpTestSupport::generator(32);
  CAPTURE(vpTestSupport::seed());
  for (const Robot &robot : {panda, ur5, tiago}) {
    const Loaded &loaded = load(robot);
    if (!loaded.arm) {
      return;
    }
    int free = 0, byCovers = 0, contacts = 0, tried = 0;
    vpMotionScratch scratch, plain;
    while (free < vpTestSupport::longer(20) && tried < vpTestSupport::longer(400)) {
      vpCollisionSceneSpec spec = sceneOf(loaded, rng, 8);
      const vpCollisionScene scene(*loaded.arm, spec);
      spec.exact.reset();
      const vpCollisionScene bare(*loaded.arm, spec);
      const vpCertifiedMotion certified(scene), covers(bare);
      const ExactOracle oracle(*loaded.arm, scene);
      for (int k = 0; k < 8; ++k, ++tried) {
        const vpJointVector from = configuration(*loaded.arm, rng),
                            to = from + 0.3 * (configuration(*loaded.arm, rng) - from);
        byCovers += covers.check(from, to, plain).isFree() ? 1 : 0;
        if (!certified.check(from, to, scratch).isFree()) {
          continue;
        }
        ++free;
        for (int i = 0; i <= 2000; ++i) {
          contacts += oracle.touches(from + i / 2000. * (to - from)) ? 1 : 0;
        }
      }
    }
    std::cout << robot.name << ": of " << tried << " motions free " << free << ", by covers alone " << byCovers
              << "; contacts at 2000 points each " << contacts << "\n";
    CHECK(contacts == 0);
    CHECK(free >= vpTestSupport::longer(20));
    CHECK(free >= byCovers);
  }
}

TEST_CASE("Nearly all configurations that are free on the meshes are kept, and no others", "[arms]")
{
  auto rng = vpTestSupport::generator(33);
  CAPTURE(vpTestSupport::seed());
  for (const Robot &robot : {panda, ur5, tiago}) {
    const Loaded &loaded = load(robot);
    if (!loaded.arm) {
      return;
    }
    int free = 0, kept = 0, byCovers = 0, wrong = 0;
    for (int trial = 0; trial < vpTestSupport::longer(10); ++trial) {
      const vpCollisionScene scene(*loaded.arm, sceneOf(loaded, rng, 8));
      vpExactChecker checker(scene);
      vpSceneChecker covers(scene);
      const ExactOracle oracle(*loaded.arm, scene);
      for (int k = 0; k < 100; ++k) {
        const vpJointVector q = configuration(*loaded.arm, rng);
        const bool isKept = !checker.inCollision(q, 0.), isFree = !oracle.touches(q) && (isKept || !oracle.isHidden(q));
        free += isFree ? 1 : 0;
        kept += isFree && isKept ? 1 : 0;
        wrong += !isFree && isKept ? 1 : 0;
        byCovers += isFree && !covers.inCollision(q, 0.) ? 1 : 0;
      }
    }
    std::cout << robot.name << ": free on meshes " << free << ", kept " << kept << ", by covers alone " << byCovers
              << ", wrongly free " << wrong << "\n";
    CHECK(wrong == 0);
    CHECK(kept >= 0.99 * free);
  }
}

// Public planning problems for the panda. By FCL on the meshes no more can be solved than have ends without a contact.
TEST_CASE("All public planning problems whose ends are free on the meshes are solved", "[arms]")
{
  const Loaded open = read(panda, 0.04, 3);
  if (!open.arm) {
    return;
  }
  int tasks = 0, free = 0, solved = 0, byCovers = 0, contacts = 0;
  for (const char *name : {"ok0", "ok1", "ok2", "in0", "in1"}) {
    const std::string file = vpTestSupport::caseFile(std::string("scenes/") + name + ".json");
    if (file.empty()) {
      return;
    }
    vpCollisionSceneFile content = vpLoadCollisionScene(file);
    content.spec.ignoredBodies = open.arm->spec().uncovered;
    const vpCollisionScene covers(*open.arm, content.spec);
    content.spec.exact = open.exact;
    const vpCollisionScene scene(*open.arm, content.spec);
    const ExactOracle oracle(*open.arm, scene);
    vpPathPlannerSpec spec;
    spec.timeLimit = 5.;
    vpPathPlanner planner(scene, spec), coarse(covers, spec);
    for (const vpMotionTask &task : content.tasks) {
      const bool isFree = !oracle.touches(task.start) && !oracle.touches(task.goal);
      const vpPathResult result = planner.plan(task.start, task.goal);
      CAPTURE(name, task.name, result.message);
      CHECK((result.status == vpPathStatus::Solved) == isFree);
      ++tasks;
      free += isFree ? 1 : 0;
      solved += result.status == vpPathStatus::Solved ? 1 : 0;
      byCovers += coarse.plan(task.start, task.goal).status == vpPathStatus::Solved ? 1 : 0;
      for (int i = 0; i <= 1000 && !result.path.points.empty(); ++i) {
        contacts += oracle.touches(result.path.at(i / 1000.)) ? 1 : 0;
      }
    }
  }
  std::cout << "panda: of " << tasks << " tasks " << free << " with free ends, solved " << solved
            << ", by covers alone " << byCovers << "; contacts on the paths " << contacts << "\n";
  CHECK(contacts == 0);
}

TEST_CASE("Statistics decide on pairs as the SRDF does", "[arms]")
{
  for (const Robot &robot : {panda, ur5}) {
    const Loaded &loaded = load(robot);
    if (!loaded.arm) {
      return;
    }
    const vpArmSpec &spec = loaded.arm->spec();
    vpSelfCollisionStatistics statistics = vpSampleBodyPairs(*loaded.arm, loaded.exact);
    if (robot.urdf == panda.urdf) { // MoveIt moves the fingers, too: half of the samples with open ones
      const Loaded open = read(robot, 0.04, 1);
      const vpSelfCollisionStatistics more = vpSampleBodyPairs(*open.arm, open.exact);
      REQUIRE(more.pairs.size() == statistics.pairs.size());
      for (std::size_t i = 0; i < more.pairs.size(); ++i) {
        REQUIRE(more.pairs[i].second == statistics.pairs[i].second);
        statistics.pairs[i].touching += more.pairs[i].touching;
      }
      statistics.samples += more.samples;
    }
    const vpSrdf srdf = vpLoadSrdf(fileOf(robot.srdf));
    std::set<std::pair<std::string, std::string>> checked, disabled;
    for (const vpBodyPairStatistics &pair : statistics.pairs) {
      if (statistics.rule(pair) == vpContactRule::Checked) {
        checked.insert(std::minmax(pair.first, pair.second));
      }
    }
    for (const vpSrdfPair &pair : srdf.disabled) {
      disabled.insert(std::minmax(pair.first, pair.second));
    }
    std::set<std::string> shaped;
    for (const vpArmShape &shape : spec.shapes) {
      shaped.insert(spec.bodies[static_cast<std::size_t>(shape.body)].name);
    }
    int pairs = 0, same = 0;
    std::string differ;
    for (const std::string &a : shaped) {
      for (const std::string &b : shaped) {
        if (a < b) {
          const bool agree = checked.count({a, b}) != disabled.count({a, b});
          ++pairs;
          same += agree ? 1 : 0;
          differ += agree ? "" : " " + a + "-" + b;
        }
      }
    }
    std::cout << robot.name << ": " << same << " of " << pairs << " pairs as in the SRDF; others:" << differ << "\n";
    CHECK(same >= (robot.srdf == panda.srdf ? pairs : 0.75 * pairs));
    CHECK(pairs >= 28);
  }
}
