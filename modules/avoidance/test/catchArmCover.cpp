/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Covers of whole arms: every body is covered or named, and a file of covers is used, verified and never trusted.
#include "vpCatch.h"
#include "vpCoverTestKit.h"

#include <visp3/avoidance/vpArmCover.h>
#include <visp3/avoidance/vpCapsuleCover.h>
#include <visp3/core/vpException.h>

#include <nlohmann/json.hpp>

#include <cstdio>
#include <fstream>
#include <sstream>

using namespace vpCoverTestKit;

namespace
{
namespace fs = std::filesystem;
using nlohmann::json;

// A folder of this test's files; removed again.
class Folder
{
public:
  Folder() { fs::create_directories(m_name); }
  ~Folder() { fs::remove_all(m_name); }
  Folder(const Folder &) = delete;
  Folder &operator=(const Folder &) = delete;
  [[nodiscard]] std::string file(const std::string &name) const { return m_name + "/" + name; }
  std::string write(const std::string &name, const std::string &text) const
  {
    std::ofstream(file(name), std::ios::binary) << text;
    return file(name);
  }

private:
  std::string m_name = "catchArmCover-files";
};

std::string contentOf(const std::string &file)
{
  std::stringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

template <class Call> std::string errorOf(Call call)
{
  try {
    static_cast<void>(call());
  }
  catch (const vpException &e) {
    return e.getStringMessage();
  }
  return "no error";
}

bool contains(const std::string &text, const std::string &part) { return text.find(part) != std::string::npos; }

std::string obj(const vpTriangleMesh &mesh)
{
  std::ostringstream text;
  for (const Vector3d &v : mesh.vertices()) {
    text << "v " << v.transpose() << "\n";
  }
  for (const auto &t : mesh.triangles()) {
    text << "f " << t[0] + 1 << " " << t[1] + 1 << " " << t[2] + 1 << "\n";
  }
  return text.str();
}

//! Two joints; base of a box and a sphere, an arm of a mesh in millimetres, a hand of a cylinder and a mirrored mesh.
vpArmSpec armSpec(const Folder &folder, std::mt19937_64 &rng)
{
  vpArmSpec spec;
  spec.name = "test arm";
  for (const char *name : {"j1", "j2"}) {
    vpArmJointSpec joint = vpArmJointSpec::standardDH(0.3, 0.5, 0.1, 0.);
    joint.name = name;
    joint.lower = -2.;
    joint.upper = 2.;
    spec.joints.push_back(joint);
  }
  spec.bodies = {{"base", 0}, {"upper", 1}, {"hand", 2}, {"frame", 2}};
  const vpTriangleMesh upper = lump(rng), hand = elbow(0.1, 0.02, 10);
  std::vector<Vector3d> inMillimetres = upper.vertices();
  for (Vector3d &v : inMillimetres) {
    v *= 1000.;
  }
  const std::string upperFile = folder.write("upper.obj", obj(vpTriangleMesh(inMillimetres, upper.triangles())));
  const std::string handFile = folder.write("hand.obj", obj(hand));
  spec.shapes = {{0, vpArmShapeKind::Box, {0.2, 0.1, 0.4}, "", pose(rng, 0.1)},
                 {0, vpArmShapeKind::Sphere, {0.07, 0., 0.}, "", pose(rng, 0.3)},
                 {1, vpArmShapeKind::Mesh, Vector3d::Constant(0.001), upperFile, pose(rng, 0.1)},
                 {2, vpArmShapeKind::Cylinder, {0.03, 0.2, 0.}, "", pose(rng, 0.1)},
                 {2, vpArmShapeKind::Mesh, {1., -1.5, 1.}, handFile, pose(rng, 0.1)}};
  spec.uncovered = {"upper", "hand"};
  spec.capsules = {{0, {0., 0., 0.}, {0., 0., 0.1}, 0.3, 0},
                   {2, {0., 0., 0.}, {0., 0., 0.}, 0.01, 2},
                   {2, {0.5, 0., 0.}, {0.5, 0., 0.}, 0.01, -1}}; // the last one is of nobody
  return spec;
}

std::vector<vpArmCapsule> of(const vpArmModel &arm, int body)
{
  std::vector<vpArmCapsule> capsules;
  for (const vpArmCapsule &c : arm.spec().capsules) {
    if (c.body == body) {
      capsules.push_back(c);
    }
  }
  return capsules;
}

//! A random point of a shape, in the frame of the link.
Vector3d pointOf(const vpArmShape &shape, std::mt19937_64 &rng)
{
  Vector3d p = point(rng, 1.);
  if (shape.kind == vpArmShapeKind::Box) {
    p = 0.5 * shape.size.cwiseProduct(p);
  }
  else if (shape.kind == vpArmShapeKind::Sphere) {
    p = uniform(rng, 0., 1.) * shape.size(0) * p.normalized();
  }
  else if (shape.kind == vpArmShapeKind::Cylinder) {
    const double angle = uniform(rng, -pi, pi), r = shape.size(0) * (rng() % 2 == 0 ? 1. : uniform(rng, 0., 1.));
    p = Vector3d(r * std::cos(angle), r * std::sin(angle), 0.5 * shape.size(1) * p.z());
  }
  else {
    p = surfacePoint(vpTriangleMesh::load(shape.file, shape.size), rng);
  }
  return shape.pose.R * p + shape.pose.p;
}

bool same(const std::vector<vpArmCapsule> &a, const std::vector<vpArmCapsule> &b)
{
  bool equal = a.size() == b.size();
  for (std::size_t i = 0; equal && i < a.size(); ++i) {
    equal = a[i].from == b[i].from && a[i].to == b[i].to && a[i].radius == b[i].radius && a[i].link == b[i].link &&
            a[i].body == b[i].body;
  }
  return equal;
}

//! The entry of a body in a file of covers.
json &entryOf(json &content, const std::string &body)
{
  for (json &entry : content["bodies"]) {
    if (entry["body"] == body) {
      return entry;
    }
  }
  throw std::runtime_error("no entry");
}
} // namespace

TEST_CASE("Every body with shapes gets capsules that hold all of them", "[cover][needs-ASSIMP]")
{
  CAPTURE(vpTestSupport::seed());
  std::mt19937_64 rng = vpTestSupport::generator();
  const Folder folder;
  const vpArmSpec spec = armSpec(folder, rng);
  const vpArmCover cover = vpCoverArm(vpArmModel(spec));
  CHECK(cover.warnings.empty());
  CHECK(cover.arm.spec().uncovered.empty());
  REQUIRE(cover.bodies.size() == 3);
  CHECK(of(cover.arm, -1).size() == 1);
  for (int i = 0; i < 3; ++i) {
    const std::vector<vpArmCapsule> capsules = of(cover.arm, i);
    const vpBodyCover &body = cover.bodies[static_cast<std::size_t>(i)];
    CAPTURE(body.body);
    CHECK(body.body == spec.bodies[static_cast<std::size_t>(i)].name);
    CHECK(body.link == i);
    CHECK(body.count == static_cast<int>(capsules.size()));
    CHECK(body.count <= (i == 0 ? 4 : 3));
    CHECK(body.overhang > 0.);
    CHECK(body.radius > 0.);
    CHECK_FALSE(body.fromCache);
    for (const vpArmCapsule &c : capsules) {
      CHECK(c.link == i);
      CHECK(c.radius < 0.3); // not those from before
    }
    for (const vpArmShape &shape : spec.shapes) {
      for (int k = 0; shape.body == i && k < 1000; ++k) {
        CHECK(outside(pointOf(shape, rng), capsules) < 1e-6); // the file of the mesh has six digits
      }
    }
  }
}

TEST_CASE("Ignored and unreadable bodies stay uncovered, by name", "[cover][needs-ASSIMP]")
{
  std::mt19937_64 rng = vpTestSupport::generator(1);
  const Folder folder;
  vpArmSpec spec = armSpec(folder, rng);
  folder.write("hand.obj", "v 0 0 0\n");
  vpArmCoverSpec options;
  options.capsules = 1;
  options.ignored = {"base", "frame"};
  const vpArmCover cover = vpCoverArm(vpArmModel(spec), options);
  CHECK(cover.arm.spec().uncovered == std::vector<std::string>{"hand", "base", "frame"});
  CHECK(of(cover.arm, 0).empty());
  CHECK(same(of(cover.arm, 2), of(vpArmModel(spec), 2))); // what there was
  REQUIRE(cover.bodies.size() == 1);
  CHECK(cover.bodies[0].count == 1);
  REQUIRE(cover.warnings.size() == 1);
  CHECK(cover.warnings[0].find("body hand stays uncovered: " + folder.file("hand.obj") + ": ") == 0);
  options.ignored = {"thumb"};
  CHECK(errorOf([&] { return vpCoverArm(vpArmModel(spec), options); }) == "ignored body thumb is no body of test arm");
  options.ignored.clear();
  options.capsules = 0;
  CHECK(errorOf([&] { return vpCoverArm(vpArmModel(spec), options); }) ==
        "capsules of the covers of an arm is 0, must be 1 to 8");
}

TEST_CASE("Covers from a file are the same to the last bit, and fitted again when shapes or options change",
          "[cover][needs-ASSIMP]")
{
  CAPTURE(vpTestSupport::seed());
  std::mt19937_64 rng = vpTestSupport::generator(2);
  const Folder folder;
  vpArmSpec spec = armSpec(folder, rng);
  vpArmCoverSpec options;
  options.capsules = 2;
  options.cacheFile = folder.file("covers.json");
  const vpArmCover first = vpCoverArm(vpArmModel(spec), options);
  CHECK(first.warnings.empty());
  const std::string written = contentOf(options.cacheFile);
  const vpArmCover again = vpCoverArm(vpArmModel(spec), options);
  CHECK(same(first.arm.spec().capsules, again.arm.spec().capsules));
  CHECK(contentOf(options.cacheFile) == written);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(again.bodies[i].fromCache);
    CHECK_FALSE(again.bodies[i].edited);
    CHECK(again.bodies[i].overhang == first.bodies[i].overhang);
    CHECK(again.bodies[i].volumeRatio == first.bodies[i].volumeRatio);
    CHECK(again.bodies[i].radius == first.bodies[i].radius);
  }
  // One shape is another one: only its body is fitted.
  spec.shapes[2].pose.p.x() += 0.001;
  const vpArmCover moved = vpCoverArm(vpArmModel(spec), options);
  CHECK(moved.bodies[0].fromCache);
  CHECK_FALSE(moved.bodies[1].fromCache);
  CHECK(moved.bodies[2].fromCache);
  spec.shapes[4].size.y() *= 0.999;
  CHECK_FALSE(vpCoverArm(vpArmModel(spec), options).bodies[2].fromCache);
  options.capsules = 1;
  CHECK_FALSE(vpCoverArm(vpArmModel(spec), options).bodies[0].fromCache);
  options.seed = 2;
  CHECK_FALSE(vpCoverArm(vpArmModel(spec), options).bodies[0].fromCache);
  // Entries of other arms stay.
  spec.bodies[0].name = "other base";
  CHECK_FALSE(vpCoverArm(vpArmModel(spec), options).bodies[0].fromCache);
  json content = json::parse(contentOf(options.cacheFile));
  CHECK(content["bodies"].size() == 4);
  CHECK(fs::directory_iterator(folder.file("")) != fs::directory_iterator());
  for (const auto &entry : fs::directory_iterator(folder.file(""))) {
    CHECK_FALSE(contains(entry.path().string(), ".partial"));
  }
}

TEST_CASE("Edited covers are used if they enclose, else refused by name or taken with a warning",
          "[cover][needs-ASSIMP]")
{
  CAPTURE(vpTestSupport::seed());
  std::mt19937_64 rng = vpTestSupport::generator(3);
  const Folder folder;
  const vpArmModel arm(armSpec(folder, rng));
  vpArmCoverSpec options;
  options.capsules = 2;
  options.cacheFile = folder.file("covers.json");
  static_cast<void>(vpCoverArm(arm, options));
  const json fitted = json::parse(contentOf(options.cacheFile));
  json content = fitted;
  for (json &c : entryOf(content, "upper")["capsules"]) {
    c["radius_m"] = c["radius_m"].get<double>() + 0.01;
  }
  folder.write("covers.json", content.dump());
  const vpArmCover wider = vpCoverArm(arm, options);
  CHECK(wider.bodies[1].edited);
  CHECK(wider.bodies[1].fromCache);
  CHECK_FALSE(wider.bodies[1].unchecked);
  CHECK(wider.bodies[1].overhang == Approx(entryOf(content, "upper")["overhang_m"].get<double>() + 0.01).margin(0.005));
  CHECK_FALSE(wider.bodies[0].edited);
  CHECK(wider.warnings.empty());
  options.seed = 5; // an edited one is not fitted again
  CHECK(vpCoverArm(arm, options).bodies[1].edited);
  options.seed = 1;
  content = fitted;
  for (json &c : entryOf(content, "upper")["capsules"]) {
    c["radius_m"] = c["radius_m"].get<double>() - 0.005;
  }
  folder.write("covers.json", content.dump());
  const std::string error = errorOf([&] { return vpCoverArm(arm, options); });
  CHECK(error.find(options.cacheFile +
                   ": the capsules of body upper do not certainly enclose it: upper: the point (") == 0);
  CHECK(contains(error, "mm outside the capsules"));
  entryOf(content, "upper")["unchecked"] = true;
  folder.write("covers.json", content.dump());
  const vpArmCover unchecked = vpCoverArm(arm, options);
  CHECK(unchecked.bodies[1].unchecked);
  REQUIRE(unchecked.warnings.size() == 1);
  CHECK(unchecked.warnings[0] == error);
}

TEST_CASE("A broken file of covers is an error, one that cannot be written a warning", "[cover][needs-ASSIMP]")
{
  std::mt19937_64 rng = vpTestSupport::generator(4);
  const Folder folder;
  const vpArmModel arm(armSpec(folder, rng));
  vpArmCoverSpec options;
  options.capsules = 1;
  options.cacheFile = folder.file("covers.json");
  const auto errorWith = [&](const std::string &text) {
    folder.write("covers.json", text);
    return errorOf([&] { return vpCoverArm(arm, options); });
  };
  const std::string file = options.cacheFile + ": ";
  CHECK(errorWith("").find(file) == 0);
  CHECK(errorWith("{\"bodies\": [").find(file) == 0);
  CHECK(errorWith("{}") == file + "bodies is missing");
  const std::string head = R"({"bodies": [{"body": "base", "key": "", "fitted": "", "capsules": [)";
  CHECK(errorWith(head + "]}]}") == file + "bodies[0].capsules is [], must be at least one capsule");
  CHECK(errorWith(head + R"({"from_m": [0, 0, 0], "to_m": [0, 0, 0], "radius_m": 0}]}]})") ==
        file + "bodies[0].capsules[0].radius_m is 0, must be > 0 and at most 10000 m");
  CHECK(errorWith(head + R"({"from_m": [0, 0, 0], "to_m": [0, 1e9, 0], "radius_m": 1}]}]})") ==
        file + "bodies[0].capsules[0].to_m is [0,1000000000.0,0], must be within 10000 m");
  CHECK(contains(errorWith(head + R"({"from_m": [0, 0, 0], "to_m": [0, 0, 0], "radius_m": 9, "x": 1}]}]})"),
                 "unknown field bodies[0].capsules[0].x"));
  const std::string entry = R"({"body": "a", "key": "", "fitted": "", "capsules": [{"from_m": [0, 0, 0],
    "to_m": [0, 0, 0], "radius_m": 1}]})";
  CHECK(errorWith("{\"bodies\": [" + entry + ", " + entry + "]}") ==
        file + "bodies[1].body is \"a\", must be another one than before");
  options.cacheFile = folder.file("no/such/folder.json");
  const vpArmCover cover = vpCoverArm(arm, options);
  CHECK(cover.bodies.size() == 3);
  REQUIRE(cover.warnings.size() == 1);
  CHECK(cover.warnings[0] == options.cacheFile + ": the covers cannot be written (No such file or directory)");
}

TEST_CASE("Public arms: all links covered, twice the same", "[cover][cases][needs-ASSIMP]")
{
  std::vector<CaseArm> arms = caseArms();
  vpArmSpec spec;
  spec.name = arms[0].name;
  for (std::size_t i = 0; i < arms[0].files.size(); ++i) {
    vpArmJointSpec joint = vpArmJointSpec::standardDH(0.1, 1.5, 0.3, 0.);
    joint.name = "j" + std::to_string(i);
    joint.upper = 1.;
    spec.joints.push_back(joint);
    const int link = static_cast<int>(i) + 1;
    spec.bodies.push_back({"link" + std::to_string(link), link});
    spec.uncovered.push_back(spec.bodies.back().name);
    spec.shapes.push_back({static_cast<int>(i), vpArmShapeKind::Mesh, Vector3d::Ones(), arms[0].files[i], {}});
  }
  if (spec.joints.empty()) {
    return;
  }
  const Folder folder;
  vpArmCoverSpec options;
  options.cacheFile = folder.file("panda.json");
  const vpArmCover cover = vpCoverArm(vpArmModel(spec), options), again = vpCoverArm(vpArmModel(spec), options);
  CHECK(cover.warnings.empty());
  CHECK(cover.arm.spec().uncovered.empty());
  CHECK(cover.bodies.size() == spec.joints.size());
  CHECK(same(cover.arm.spec().capsules, again.arm.spec().capsules));
  for (const vpBodyCover &body : again.bodies) {
    CHECK(body.fromCache);
    CHECK(body.count <= 3);
  }
}
