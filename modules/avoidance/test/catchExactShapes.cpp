/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Exact shapes where capsules do not decide, on random arms of boxes, cylinders, spheres and meshes.
#include "vpCatch.h"
#include "vpExactOracle.h"

#include <visp3/avoidance/vpCertifiedMotion.h>
#include <visp3/avoidance/vpExactChecker.h>
#include <visp3/avoidance/vpPathPlanner.h>
#include <visp3/avoidance/vpSelfCollisionStatistics.h>
#include <visp3/core/vpException.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iostream>

using namespace vpAvoidanceTestKit;

namespace
{
// A frame of three bars, open in the middle: no single capsule is near it. Removed at the end.
struct FrameFile {
  std::string name = (std::filesystem::temp_directory_path() / (std::to_string(getpid()) + "-frame.obj")).string();
  FrameFile()
  {
    std::ofstream out(name);
    int first = 1;
    for (const auto &bar : {std::make_pair(Vector3d(0., 0., 0.), Vector3d(10., 100., 10.)),
                            std::make_pair(Vector3d(60., 110., 0.), Vector3d(70., 10., 10.)),
                            std::make_pair(Vector3d(60., -110., 0.), Vector3d(70., 10., 10.))}) {
      for (int k = 0; k < 8; ++k) {
        out << "v " << bar.first.x() + (k & 1 ? 1 : -1) * bar.second.x() << " "
            << bar.first.y() + (k & 2 ? 1 : -1) * bar.second.y() << " "
            << bar.first.z() + (k & 4 ? 1 : -1) * bar.second.z() << "\n";
      }
      for (const auto &f : {"1 3 4 2", "5 6 8 7", "1 2 6 5", "3 7 8 4", "1 5 7 3", "2 4 8 6"}) {
        std::istringstream in(f);
        out << "f";
        for (int i = 0; in >> i;) {
          out << " " << first + i - 1;
        }
        out << "\n";
      }
      first += 8;
    }
  }
  ~FrameFile() { std::remove(name.c_str()); }
  FrameFile(const FrameFile &) = delete;
  FrameFile &operator=(const FrameFile &) = delete;
};

const std::string &frameFile()
{
  static const FrameFile file;
  return file.name;
}

Vector3d extentOf(const vpArmShape &shape)
{
  switch (shape.kind) {
  case vpArmShapeKind::Sphere:
    return Vector3d::Constant(shape.size(0));
  case vpArmShapeKind::Cylinder:
    return {shape.size(0), shape.size(0), 0.5 * shape.size(1)};
  case vpArmShapeKind::Box:
    return 0.5 * shape.size;
  default:
    return {0.13, 0.12, 0.01};
  }
}

// The mixed arm with a body of a random shape on every link, each in a capsule that encloses it.
vpArmModel shapedArm(std::mt19937_64 &rng)
{
  vpArmSpec spec = mixed().spec();
  spec.capsules.clear();
  for (int link = 1; link <= 5; ++link) {
    spec.bodies.push_back({"b" + std::to_string(link), link});
    vpArmShape shape;
    shape.body = link - 1;
    shape.kind = static_cast<vpArmShapeKind>((link + static_cast<int>(uniform(rng, 0., 4.))) % 4);
    shape.size = Vector3d(uniform(rng, 0.03, 0.06), uniform(rng, 0.05, 0.3), uniform(rng, 0.02, 0.06));
    shape.pose = pose(rng, 0.1);
    if (shape.kind == vpArmShapeKind::Mesh) {
      shape.file = frameFile();
      shape.size.setConstant(1e-3);
    }
    spec.shapes.push_back(shape);
    const Vector3d half = extentOf(shape);
    int longest = 0;
    half.maxCoeff(&longest);
    Vector3d across = half, end = Vector3d::Zero();
    across(longest) = 0.;
    end(longest) = half(longest);
    spec.capsules.push_back(
        {link, shape.pose.R * -end + shape.pose.p, shape.pose.R * end + shape.pose.p, across.norm() + 1e-9, link - 1});
  }
  return vpArmModel(spec);
}

vpCollisionSceneSpec objects(std::mt19937_64 &rng, int count, const std::shared_ptr<const vpExactShapes> &exact)
{
  vpCollisionSceneSpec spec = randomScene(rng, count, 0.8);
  for (vpCollisionObject &object : spec.objects) {
    object.inflation = 0.;
  }
  spec.exact = exact;
  return spec;
}
} // namespace

TEST_CASE("Certified motions by exact shapes are free on the true shapes", "[exact]")
{
  auto rng = vpTestSupport::generator(21);
  CAPTURE(vpTestSupport::seed());
  int covers = 0, exactly = 0, contacts = 0, disputed = 0;
  vpMotionScratch scratch, plain;
  for (int trial = 0; trial < vpTestSupport::longer(12); ++trial) {
    CAPTURE(trial);
    const vpArmModel arm = shapedArm(rng);
    const auto exact = std::make_shared<vpExactShapes>(arm);
    REQUIRE(exact->warnings().empty());
    vpCollisionSceneSpec spec = objects(rng, 6, exact);
    const vpCollisionScene scene(arm, spec);
    spec.exact.reset();
    const vpCollisionScene bare(arm, spec);
    const vpCertifiedMotion certified(scene), byCovers(bare);
    const ExactOracle oracle(arm, scene);
    vpExactChecker checker(scene);
    for (int k = 0; k < 20; ++k) {
      CAPTURE(k);
      const vpJointVector from = configuration(arm, rng), to = from + 0.3 * (configuration(arm, rng) - from);
      const vpMotionResult result = certified.check(from, to, scratch);
      const bool coversFree = byCovers.check(from, to, plain).isFree();
      covers += coversFree ? 1 : 0;
      exactly += result.isFree() ? 1 : 0;
      REQUIRE((result.isFree() || !coversFree));
      if (result.isFree()) {
        for (int i = 0; i <= 200; ++i) {
          const vpJointVector q = from + i / 200. * (to - from);
          contacts += oracle.touches(q) ? 1 : 0;
          REQUIRE((i % 50 != 0 || !checker.inCollision(q, 0.)));
        }
      }
      else if (result.status == vpMotionStatus::Collision) {
        const vpJointVector q = from + result.s * (to - from);
        CHECK(checker.inCollision(q, 1e-9));
        CHECK(result.pair.distance <= 1e-9);
        // A contact of a part inside, or with a prism instead of a cylinder, may be none of surfaces.
        disputed += oracle.touches(q) ? 0 : 1;
      }
    }
  }
  std::cout << "motions free by capsules " << covers << ", with exact shapes " << exactly << ", contacts " << contacts
            << ", collisions that FCL does not see " << disputed << "\n";
  CHECK(contacts == 0);
  CHECK(exactly > covers);
}

TEST_CASE("A ball on the shape, or inside it, is always seen", "[exact]")
{
  auto rng = vpTestSupport::generator(22);
  CAPTURE(vpTestSupport::seed());
  int missed = 0;
  for (int trial = 0; trial < vpTestSupport::longer(40); ++trial) {
    const vpArmModel arm = shapedArm(rng);
    const auto exact = std::make_shared<vpExactShapes>(arm);
    vpCollisionSceneSpec spec;
    vpCollisionObject ball;
    ball.name = "ball";
    ball.shape = vpCollisionShape::sphere(0.01);
    spec.objects = {ball};
    spec.exact = exact;
    vpCollisionScene scene(arm, spec);
    vpExactChecker checker(scene);
    vpArmData data;
    for (int k = 0; k < 10; ++k) {
      const vpJointVector q = configuration(arm, rng);
      vpArmKinematics::forward(arm, q, data);
      for (const vpArmShape &shape : arm.spec().shapes) {
        const Vector3d half = extentOf(shape);
        Vector3d p(uniform(rng, -1., 1.), uniform(rng, -1., 1.), uniform(rng, -1., 1.));
        if (shape.kind == vpArmShapeKind::Mesh) {
          p = Vector3d(0.01 * p.x(), 0.1 * p.y(), 0.01 * p.z());
        }
        else {
          p = half.cwiseProduct(shape.kind == vpArmShapeKind::Box ? p : Vector3d(p.normalized() * 0.99));
          p.z() = shape.kind == vpArmShapeKind::Cylinder ? half.z() * uniform(rng, -1., 1.) : p.z();
        }
        const vpRigidTransform at = vpArmKinematics::link(arm, data, shape.body + 1) * shape.pose;
        REQUIRE(scene.moveObject(0, {Eigen::Matrix3d::Identity(), at.R * p + at.p}));
        missed += checker.inCollision(q, 0.) ? 0 : 1;
      }
    }
  }
  CHECK(missed == 0);
}

TEST_CASE("Distances of exact shapes from a ball are those of the solids", "[exact]")
{
  auto rng = vpTestSupport::generator(23);
  CAPTURE(vpTestSupport::seed());
  int near = 0;
  for (int trial = 0; trial < 300; ++trial) {
    CAPTURE(trial);
    const vpArmModel arm = shapedArm(rng);
    vpCollisionSceneSpec spec;
    vpCollisionObject ball;
    ball.name = "ball";
    ball.shape = vpCollisionShape::sphere(uniform(rng, 0.01, 0.05));
    ball.inflation = 0.005;
    spec.objects = {ball};
    spec.allowedLinks = {{1, 2}, {1, 3}, {1, 4}, {1, 5}, {2, 3}, {2, 4}, {2, 5}, {3, 4}, {3, 5}, {4, 5}};
    spec.exact = std::make_shared<vpExactShapes>(arm);
    vpCollisionScene scene(arm, spec);
    vpExactChecker checker(scene);
    vpArmData data;
    const vpJointVector q = configuration(arm, rng);
    vpArmKinematics::forward(arm, q, data);
    const vpArmShape &aim = arm.spec().shapes[static_cast<std::size_t>(trial % 5)];
    const vpRigidTransform there = vpArmKinematics::link(arm, data, aim.body + 1) * aim.pose;
    const Vector3d centre = there.R * extentOf(aim).cwiseProduct(point(rng, 2.)) + there.p;
    REQUIRE(scene.moveObject(0, {Eigen::Matrix3d::Identity(), centre}));
    double truth = 1e9;
    for (const vpArmShape &shape : arm.spec().shapes) {
      const vpRigidTransform at = (vpArmKinematics::link(arm, data, shape.body + 1) * shape.pose).inverse();
      const Vector3d p = at.R * centre + at.p;
      double distance = 1e9;
      switch (shape.kind) {
      case vpArmShapeKind::Sphere:
        distance = std::max(0., p.norm() - shape.size(0));
        break;
      case vpArmShapeKind::Cylinder:
        distance = pointDistance(vpCollisionShape::cylinder(shape.size(0), shape.size(1)), p);
        break;
      case vpArmShapeKind::Box:
        distance = pointDistance(vpCollisionShape::box(shape.size), p);
        break;
      default:
        for (const auto &bar : {std::make_pair(Vector3d(0., 0., 0.), Vector3d(0.02, 0.2, 0.02)),
                                std::make_pair(Vector3d(0.06, 0.11, 0.), Vector3d(0.14, 0.02, 0.02)),
                                std::make_pair(Vector3d(0.06, -0.11, 0.), Vector3d(0.14, 0.02, 0.02))}) {
          distance = std::min(distance, pointDistance(vpCollisionShape::box(bar.second), p - bar.first));
        }
      }
      truth = std::min(truth, distance - ball.shape.radius() - ball.inflation);
    }
    const vpClearance found = checker.clearance(q, 0.3);
    if (truth > 0.3) {
      CHECK(found.distance > 0.29);
      continue;
    }
    // A prism is up to 0.2 % of its radius larger than the cylinder, threads are 0.01 mm wide. Capsules that are
    // farther away than the cutoff may say so.
    ++near;
    CHECK(found.distance <= std::max(0., truth) + 1e-9);
    CHECK(found.distance >= std::max(0., truth) - 2e-4);
    CHECK(checker.inCollision(q, 0.) == (found.distance <= 0.));
    CHECK(checker.inCollision(q, found.distance + 2e-4)); // a thread or prism is nearer than its capsule
    CHECK_FALSE((found.distance > 1e-6 && checker.inCollision(q, found.distance - 1e-6)));
  }
  CHECK(near > 100);
}

TEST_CASE("A shape moves although its capsule only turns about its own axis", "[exact]")
{
  auto rng = vpTestSupport::generator(26);
  CAPTURE(vpTestSupport::seed());
  vpArmSpec spec;
  spec.name = "turnstile";
  vpArmJointSpec joint;
  joint.name = "j";
  joint.lower = -3.;
  joint.upper = 3.;
  spec.joints = {joint};
  spec.bodies = {{"bar", 1}};
  vpArmShape bar;
  bar.kind = vpArmShapeKind::Box;
  bar.size = {0.4, 0.02, 0.04};
  bar.pose.p.x() = 0.2; // from the joint's axis outwards
  spec.shapes = {bar};
  spec.capsules = {{1, {0., 0., -0.02}, {0., 0., 0.02}, 0.42, 0}};
  const vpArmModel arm(spec);
  vpCollisionSceneSpec with;
  with.exact = std::make_shared<vpExactShapes>(arm);
  vpCollisionObject ball;
  ball.name = "ball";
  ball.shape = vpCollisionShape::sphere(0.02);
  with.objects = {ball};
  vpCollisionScene scene(arm, with);
  const vpCertifiedMotion certified(scene);
  CHECK(certified.reach()(0, 0) == Approx(0.).margin(1e-9));
  vpMotionScratch scratch;
  int free = 0, colliding = 0;
  for (int trial = 0; trial < 200; ++trial) {
    CAPTURE(trial);
    const double angle = uniform(rng, -3., 3.), radius = uniform(rng, 0.1, 0.45);
    const Vector3d p(radius * std::cos(angle), radius * std::sin(angle), uniform(rng, -0.06, 0.06));
    REQUIRE(scene.moveObject(0, {Eigen::Matrix3d::Identity(), p}));
    vpJointVector from(1), to(1);
    from(0) = uniform(rng, -3., 3.);
    to(0) = uniform(rng, -3., 3.);
    double least = 1.;
    for (int i = 0; i <= 1000; ++i) {
      const double q = from(0) + i / 1000. * (to(0) - from(0));
      const Vector3d seen = Eigen::AngleAxisd(-q, Vector3d::UnitZ()) * p - bar.pose.p;
      least = std::min(least, pointDistance(vpCollisionShape::box(bar.size), seen) - ball.shape.radius());
    }
    const vpMotionResult result = certified.check(from, to, scratch);
    if (std::fabs(least) > 1e-3) { // far more than steps and threads
      CHECK(result.isFree() == (least > 0.));
      CHECK((result.status == vpMotionStatus::Collision) == (least < 0.));
      ++(least > 0. ? free : colliding);
    }
  }
  CHECK(free > 40);
  CHECK(colliding > 20);
}

TEST_CASE("A planner with exact shapes goes where capsules cannot", "[exact]")
{
  auto rng = vpTestSupport::generator(24);
  CAPTURE(vpTestSupport::seed());
  int solved = 0, byCovers = 0, contacts = 0;
  for (int trial = 0; trial < 10; ++trial) {
    CAPTURE(trial);
    const vpArmModel arm = shapedArm(rng);
    vpCollisionSceneSpec spec = objects(rng, 4, std::make_shared<vpExactShapes>(arm));
    const vpCollisionScene scene(arm, spec);
    spec.exact.reset();
    const vpCollisionScene bare(arm, spec);
    vpPathPlannerSpec how;
    how.margin = 0.;
    how.iterations = 300;
    how.timeLimit = 60.;
    how.shortenTime = 0.;
    vpPathPlanner planner(scene, how), other(bare, how);
    const ExactOracle oracle(arm, scene);
    const vpJointVector from = configuration(arm, rng), to = configuration(arm, rng);
    byCovers += other.plan(from, to).status == vpPathStatus::Solved ? 1 : 0;
    const vpPathResult result = planner.plan(from, to);
    if (result.status == vpPathStatus::Solved) {
      ++solved;
      for (int i = 0; i <= 2000; ++i) {
        contacts += oracle.touches(result.path.at(i / 2000.)) ? 1 : 0;
      }
    }
  }
  std::cout << "plans: by capsules " << byCovers << ", with exact shapes " << solved << " of 10\n";
  CHECK(contacts == 0);
  CHECK(solved >= byCovers);
}

TEST_CASE("Mistakes in exact shapes are named", "[exact]")
{
  vpArmSpec spec = mixed().spec();
  spec.capsules = {{1, {0., 0., -0.1}, {0., 0., 0.1}, 0.05, 0}};
  spec.bodies = {{"box", 1}, {"bare", 2}};
  vpArmShape box;
  box.body = 0;
  box.kind = vpArmShapeKind::Box;
  box.size = {0.05, 0.05, 0.2};
  spec.shapes = {box};
  const vpExactShapes good{vpArmModel(spec)};
  CHECK(good.has(0));
  CHECK_FALSE(good.has(1));
  CHECK_FALSE(good.has(-1));
  CHECK(good.thickness(0) == Approx(std::hypot(0.025, 0.025)));
  CHECK(good.warnings().empty());
  spec.shapes[0].size.z() = 0.4;
  const vpExactShapes longer{vpArmModel(spec)};
  REQUIRE(longer.warnings().size() == 1);
  CHECK_THAT(longer.warnings()[0],
             Catch::Contains("the shape of body box is") && Catch::Contains("outside its capsules"));
  CHECK_FALSE(longer.has(0));
  spec.shapes[0].kind = vpArmShapeKind::Mesh;
  spec.shapes[0].file = "no-such.obj";
  CHECK_THROWS_WITH(vpExactShapes{vpArmModel(spec)}, Catch::Contains("no-such.obj"));
  vpCollisionSceneSpec scene;
  scene.exact = std::make_shared<vpExactShapes>(vpArmModel(mixed().spec()));
  spec.shapes.clear();
  CHECK_THROWS_WITH(vpCollisionScene(vpArmModel(spec), scene),
                    Catch::Contains("the exact shapes were made for another arm"));
}

TEST_CASE("Statistics of bodies: by capsules and exactly, rules, and the file", "[statistics]")
{
  auto rng = vpTestSupport::generator(25);
  CAPTURE(vpTestSupport::seed());
  int more = 0;
  for (int trial = 0; trial < 20; ++trial) {
    CAPTURE(trial);
    const vpArmModel arm = shapedArm(rng);
    const auto exact = std::make_shared<vpExactShapes>(arm);
    const vpSelfCollisionStatistics covers = vpSampleBodyPairs(arm, nullptr, 200, 7);
    const vpSelfCollisionStatistics exactly = vpSampleBodyPairs(arm, exact, 200, 7);
    REQUIRE(covers.pairs.size() == 6); // of ten pairs four are neighbours
    REQUIRE(exactly.pairs.size() == 6);
    for (std::size_t i = 0; i < 6; ++i) {
      CHECK(covers.pairs[i].first == exactly.pairs[i].first);
      CHECK(covers.pairs[i].second == exactly.pairs[i].second);
      CHECK_FALSE(covers.pairs[i].exact);
      CHECK(exactly.pairs[i].exact);
      CHECK((covers.pairs[i].least <= 0.) == (covers.pairs[i].touching > 0));
      CHECK(covers.pairs[i].least == exactly.pairs[i].least);
      CHECK(covers.pairs[i].touching >= exactly.pairs[i].touching);
      more += covers.pairs[i].touching - exactly.pairs[i].touching;
    }
  }
  CHECK(more > 0);
  vpSelfCollisionStatistics known{"arm",
                                  1000,
                                  3,
                                  {{"a", "b", 950, false, true},
                                   {"a", "c", 949, false, true},
                                   {"a", "d", 3, true, true},
                                   {"b", "d", 0, false, false}}};
  const vpContactRule rules[] = {vpContactRule::Always, vpContactRule::Checked, vpContactRule::Default,
                                 vpContactRule::Never};
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(known.rule(known.pairs[i]) == rules[i]);
  }
  CHECK(known.allowed().size() == 3);
  CHECK(known.allowed(false).size() == 2);
  CHECK(known.allowed(false)[1] == std::pair<std::string, std::string>("a", "d"));
  const std::string file =
      (std::filesystem::temp_directory_path() / (std::to_string(getpid()) + "-pairs.json")).string();
  known.save(file);
  const vpSelfCollisionStatistics read = vpSelfCollisionStatistics::load(file);
  CHECK(read.arm == "arm");
  CHECK(read.samples == 1000);
  CHECK(read.seed == 3);
  REQUIRE(read.pairs.size() == 4);
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(read.pairs[i].first == known.pairs[i].first);
    CHECK(read.pairs[i].second == known.pairs[i].second);
    CHECK(read.pairs[i].touching == known.pairs[i].touching);
    CHECK(read.pairs[i].atZero == known.pairs[i].atZero);
    CHECK(read.pairs[i].exact == known.pairs[i].exact);
  }
  std::stringstream text;
  text << std::ifstream(file).rdbuf();
  CHECK_THAT(text.str(), Catch::Contains("touches in less than 0.3 % of random configurations, with 95 % confidence"));
  CHECK_THROWS_WITH(known.save("/no/such/folder/pairs.json"), Catch::Contains("/no/such/folder/pairs.json"));
  const auto broken = [&](const std::string &from, const std::string &to) {
    std::string changed = text.str();
    changed.replace(changed.find(from), from.size(), to);
    std::ofstream(file) << changed;
    try {
      static_cast<void>(vpSelfCollisionStatistics::load(file));
    }
    catch (const vpException &e) {
      return std::string(e.getStringMessage());
    }
    return std::string();
  };
  CHECK_THAT(broken("\"samples\": 1000", "\"samples\": 0"), Catch::Contains("samples is 0, must be > 0"));
  CHECK_THAT(broken("\"samples\": 1000", "\"samples\": 900"),
             Catch::Contains("pairs[0].touching is 950, must be at most 900"));
  CHECK_THAT(broken("\"touching\"", "\"touched\""), Catch::Contains("pairs[0].touching is missing"));
  CHECK_THAT(broken("\"arm\"", "\"robot\""), Catch::Contains("arm is missing"));
  CHECK_THROWS_WITH(vpSampleBodyPairs(mixed(), nullptr, 0), Catch::Contains("number of samples is 0, must be > 0"));
  std::filesystem::remove(file);
}
