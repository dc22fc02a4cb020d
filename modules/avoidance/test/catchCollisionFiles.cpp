/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// File contents are read correctly, and errors are reported in one sentence with the file and the element.
#include "vpTestFile.h"
#include "vpAvoidanceTestKit.h"
#include "vpCaseFile.h"
#include "vpCatch.h"

#include <visp3/avoidance/vpCertifiedMotion.h>
#include <visp3/avoidance/vpCollisionSceneJson.h>
#include <visp3/core/vpException.h>

#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <sstream>

using namespace vpAvoidanceTestKit;

namespace
{
// A file of this test.
struct File : vpTestSupport::File {
  File(const std::string &name, const std::string &content)
    : vpTestSupport::File("catchCollisionFiles-" + name, content)
  {}
};

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

std::string sceneError(const std::string &text)
{
  const File file("scene.json", text);
  return errorOf([&] { return vpLoadCollisionScene(file.name()); });
}

std::string objectError(const std::string &fields)
{
  return sceneError("{\"name\": \"s\", \"objects\": [{\"name\": \"o\", " + fields + "}]}");
}

std::string meshError(const std::string &ending, const std::string &text)
{
  const File file("mesh" + ending, text);
  return errorOf([&] { return vpTriangleMesh::load(file.name()); });
}

const char *const cube = "# a cube of quads\n"
                         "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\nvn 0 0 1\n"
                         "f 4 3 2 1\nf 5 6 7 8\nf 1//1 2//1 6//1 5//1\nf 2 3 7 6\nf 3 4 8 7\nf -8 -4 -1 -5\n";

std::string binaryStl(const vpTriangleMesh &mesh)
{
  std::string bytes(80, ' ');
  bytes.replace(0, 5, "solid"); // Binary files that begin as text ones exist.
  const auto add = [&bytes](const void *data, std::size_t size) {
    bytes.append(static_cast<const char *>(data), size);
  };
  const std::uint32_t count = static_cast<std::uint32_t>(mesh.triangles().size());
  add(&count, 4);
  for (const auto &t : mesh.triangles()) {
    float numbers[12] = {};
    for (int k = 0; k < 3; ++k) {
      for (int i = 0; i < 3; ++i) {
        numbers[3 + 3 * k + i] =
            static_cast<float>(mesh.vertices()[static_cast<std::size_t>(t[static_cast<std::size_t>(k)])](i));
      }
    }
    add(numbers, sizeof(numbers));
    bytes.append(2, '\0');
  }
  return bytes;
}
} // namespace

TEST_CASE("Meshes from files", "[files][needs-ASSIMP]")
{
  const File obj("cube.obj", cube);
  const vpTriangleMesh mesh = vpTriangleMesh::load(obj.name(), 0.5);
  CHECK(mesh.vertices().size() == 8);
  CHECK(mesh.triangles().size() == 12);
  CHECK(mesh.isWatertight());
  CHECK(mesh.vertices()[6] == Vector3d(0.5, 0.5, 0.5));
  const File stl("cube.stl", binaryStl(mesh));
  const vpTriangleMesh binary = vpTriangleMesh::load(stl.name());
  CHECK(binary.vertices().size() == 8);
  CHECK(binary.triangles().size() == 12);
  CHECK(binary.isWatertight());
  const File text("text.stl", "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
                              "endloop\nendfacet\nendsolid\n");
  const vpTriangleMesh one = vpTriangleMesh::load(text.name());
  CHECK(one.triangles().size() == 1);
  CHECK(one.message() == text.name() + ": the surface has holes (3 edges with one triangle), it is a surface without "
                                       "an inside");
}

TEST_CASE("A closed mesh is a solid, however its file repeats corners and turns triangles", "[files][needs-ASSIMP]")
{
  // A box of six faces with corners of their own, as textured models have them.
  std::string vertices, faces, turned;
  for (int face = 0; face < 6; ++face) {
    for (int corner = 0; corner < 4; ++corner) {
      const int axis = face / 2, u = corner == 1 || corner == 2 ? 1 : 0, v = corner / 2;
      int p[3];
      p[axis] = face % 2;
      p[(axis + 1) % 3] = face % 2 == 1 ? u : v;
      p[(axis + 2) % 3] = face % 2 == 1 ? v : u;
      vertices += "v " + std::to_string(p[0]) + " " + std::to_string(p[1]) + " " + (p[2] == 0 && face > 3 ? "-" : "") +
                  std::to_string(p[2]) + "\n"; // -0 is 0
    }
    const auto index = [face](int k) { return " " + std::to_string(4 * face + k); };
    faces += "f" + index(1) + index(2) + index(3) + index(4) + "\n";
    turned += face == 2 ? "f" + index(4) + index(3) + index(2) + index(1) + "\n"
                        : "f" + index(1) + index(2) + index(3) + index(4) + "\n";
  }
  std::string inwards = faces;
  for (std::size_t i = 0; (i = inwards.find("f ", i)) != std::string::npos; ++i) {
    std::istringstream line(inwards.substr(i + 1, inwards.find('\n', i) - i));
    std::string a, b, c, d;
    line >> a >> b >> c >> d;
    inwards.replace(i, inwards.find('\n', i) - i, "f " + d + " " + c + " " + b + " " + a);
  }
  for (const std::string &surface : {faces, turned, inwards}) {
    CAPTURE(surface);
    const File file("split.obj", vertices + surface);
    const vpTriangleMesh mesh = vpTriangleMesh::load(file.name());
    CHECK(mesh.vertices().size() == 8);
    REQUIRE(mesh.isWatertight());
    // The arm within it collides, beside it not.
    vpCollisionSceneSpec spec;
    vpCollisionObject box;
    box.name = "box";
    box.shape = vpCollisionShape::mesh(vpTriangleMesh::load(file.name(), 4.));
    box.pose.p << -2., -2., -2.;
    spec.objects.push_back(box);
    vpCollisionScene scene(amor(), spec);
    vpCollisionData data;
    scene.place(amor().home(), data);
    CHECK(scene.inCollision(data));
    CHECK(scene.clearance(data).distance < -0.8);
    box.pose.p.x() = 1.5;
    REQUIRE(scene.moveObject(0, box.pose));
    CHECK_FALSE(scene.inCollision(data));
  }
  // An inner shell that is oriented inwards is a cavity: its inside is free.
  std::string cavity = vertices + faces;
  std::istringstream lines(vertices);
  std::string v;
  double x, y, z;
  while (lines >> v >> x >> y >> z) {
    cavity += "v " + std::to_string(0.25 + 0.5 * x) + " " + std::to_string(0.25 + 0.5 * y) + " " +
              std::to_string(0.25 + 0.5 * z) + "\n";
  }
  std::istringstream quads(inwards);
  int i, j, k, l;
  while (quads >> v >> i >> j >> k >> l) {
    cavity += "f " + std::to_string(i + 24) + " " + std::to_string(j + 24) + " " + std::to_string(k + 24) + " " +
              std::to_string(l + 24) + "\n";
  }
  const File file("cavity.obj", cavity);
  const vpTriangleMesh hollow = vpTriangleMesh::load(file.name());
  REQUIRE(hollow.isWatertight());
  const auto depth = [&hollow](double at) {
    const Vector3d p(at, 0.5, 0.5);
    vpArmSpec arm;
    vpArmJointSpec joint;
    joint.name = "j";
    joint.type = vpJointType::Continuous;
    arm.name = "point";
    arm.joints = {joint};
    arm.capsules = {{1, p, p, 1e-3}};
    vpCollisionSceneSpec spec;
    spec.objects.push_back({"hollow", vpCollisionShape::mesh(hollow), {}, {}, 0.});
    const vpCollisionScene scene((vpArmModel(arm)), spec);
    vpCollisionData data;
    scene.place(vpJointVector::Zero(1), data);
    return scene.clearance(data).distance;
  };
  CHECK(depth(0.5) == Approx(0.249));
  CHECK(depth(0.1) == Approx(-0.101));
  CHECK(depth(-0.1) == Approx(0.099));
}

TEST_CASE("A mesh that stays open is refused as a solid, by name, unless a surface is enough", "[files][needs-ASSIMP]")
{
  std::string open = cube;
  open.resize(open.rfind("f "));
  const File obj("open.obj", open);
  const vpTriangleMesh mesh = vpTriangleMesh::load(obj.name());
  CHECK_FALSE(mesh.isWatertight());
  CHECK_THROWS_WITH(vpCollisionShape::mesh(mesh),
                    obj.name() + ": the surface has holes (4 edges with one triangle), it is a surface without an "
                                 "inside; close it, or say that a surface is enough (\"surface\": true in a scene, "
                                 "vpMeshUse::Surface)");
  CHECK(vpCollisionShape::mesh(mesh, vpMeshUse::Surface).type() == vpShapeType::Mesh);
  const auto scene = [](const std::string &more) {
    return R"({"name": "s", "objects": [{"name": "a", "shape": "mesh", "file": "catchCollisionFiles-open.obj")" + more +
           "}]}";
  };
  const File solid("open.json", scene("")), surface("surface.json", scene(", \"surface\": true")),
      wrong("wrong.json", scene(", \"surface\": 1"));
  CHECK(errorOf([&] {
          return vpLoadCollisionScene(solid.name());
        }).find(solid.name() + ": objects[0]: " + obj.name() + ": the surface has holes (4 edges with one triangle)") ==
        0);
  CHECK(vpLoadCollisionScene(surface.name()).warnings.size() == 1);
  CHECK(errorOf([&] { return vpLoadCollisionScene(wrong.name()); }).find("surface") != std::string::npos);
}

TEST_CASE("The public case of a block round the arm collides", "[files][needs-ASSIMP]")
{
  for (const char *name : {"jenga.obj", "cube.obj"}) {
    const std::string file = vpTestSupport::caseFile(std::string("meshes/") + name);
    if (file.empty()) {
      return;
    }
    CAPTURE(file);
    vpCollisionObject block;
    block.name = "block";
    block.shape = vpCollisionShape::mesh(vpTriangleMesh::load(file, 3.));
    block.pose.p << 0., 0., 0.4;
    vpCollisionSceneSpec spec;
    spec.objects.push_back(block);
    const vpCollisionScene scene(amor(), spec);
    vpJointVector goal = amor().home();
    goal(0) = 0.9;
    vpMotionScratch scratch;
    CHECK(vpCertifiedMotion(scene).check(amor().home(), goal, scratch).status == vpMotionStatus::Collision);
  }
}

TEST_CASE("Magnitudes that no workplace has are refused in a sentence", "[files][needs-ASSIMP]")
{
  const auto sceneError = [](const std::string &object) {
    const File file("large.json", R"({"name": "s", "objects": [{"name": "a", )" + object + "}]}");
    return errorOf([&] { return vpCollisionScene(amor(), vpLoadCollisionScene(file.name()).spec); });
  };
  CHECK(sceneError(R"("shape": "capsule", "radius_m": 1e19, "length_m": 1)").find("radius of the capsule is 1e+19 m") !=
        std::string::npos);
  CHECK(
      sceneError(R"("shape": "box", "size_m": [1, 2147483648, 1])").find("size of the box along y is 2.14748e+09 m") !=
      std::string::npos);
  CHECK(sceneError(R"("shape": "sphere", "radius_m": 0.1, "pose": {"translation_m": [0, 0, 1e155]})")
            .find("object a is 1e+155 m away, must be within 10000 m") != std::string::npos);
  CHECK(sceneError(R"("shape": "sphere", "radius_m": 0.1, "inflation_m": 1e9)")
            .find("inflation of object a is 1e+09 m, must be 0 to 10000") != std::string::npos);
  CHECK(sceneError(R"("shape": "sphere", "radius_m": 0.1, "velocity": {"linear_m_s": [0, 1e9, 0]})")
            .find("velocity of object a is not finite or above 1000 m/s or rad/s") != std::string::npos);
  CHECK(sceneError(R"("shape": "octree", "cells_m": [[0, 0, 0, 1e200]])").find("cell 0 has the size 1e+200 m") !=
        std::string::npos);
  CHECK(meshError(".obj", "v 0 0 0\nv 1e9 0 0\nv 0 1 0\nf 1 2 3\n").find("vertex 1 is not within 10000 m") !=
        std::string::npos);
}

TEST_CASE("Errors in meshes name the file and the place", "[files][needs-ASSIMP][needs-OCTOMAP]")
{
  const std::string obj = "catchCollisionFiles-mesh.obj: ", stl = "catchCollisionFiles-mesh.stl: ";
  const std::string noObj = obj + "is no readable .obj file (", noStl = stl + "is no readable .stl file (";
  CHECK(meshError(".obj", "v 0 0 0\nv 0 1\nf 1 2 2\n").find(obj) == 0);
  CHECK(meshError(".obj", "v 0 0 0\nf 1 2 3\n") == noObj + "OBJ: vertex index out of range)");
  CHECK(meshError(".obj", "v 0 0 0\nf 1 x 3\n") == noObj + "OBJ: Invalid face index.)");
  CHECK(meshError(".obj", "v 0 0 0\nf 1 1 1\n") == obj + "there is no triangle with an area");
  CHECK(meshError(".obj", "") == obj + "is empty");
  CHECK(meshError(".obj", "v nan 0 0\nf 1 1 1\n").find(obj) == 0);
  CHECK(meshError(".stl", "") == stl + "is empty");
  CHECK(meshError(".stl", "neither text nor binary").find(noStl) == 0);
  CHECK(meshError(".stl", "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n").find(noStl) == 0);
  CHECK(meshError(".stl", "solid\nvertex 0 0\n") == stl + "there is no triangle with an area");
  CHECK(meshError(".stl", binaryStl(tetrahedron(1.)).substr(0, 200)).find(stl) == 0);
  std::string cut = binaryStl(tetrahedron(1.)).substr(0, 200);
  cut[0] = ' ';
  CHECK(meshError(".stl", cut).find(noStl) == 0);
  CHECK(meshError(".ply", "ply") == "catchCollisionFiles-mesh.ply: ends within its head");
  CHECK(meshError(".step", "x") == "catchCollisionFiles-mesh.step: is no .stl, .obj, .dae or .ply file");
  CHECK(errorOf([] { return vpTriangleMesh::load("nowhere.obj"); }) ==
        "nowhere.obj: cannot be read (there is no such file)");
  CHECK(errorOf([] { return vpTriangleMesh::load("nowhere.obj", -1.); }) ==
        "nowhere.obj: scale is -1, must be > 0 and finite");
  CHECK(errorOf([] { return vpOctree::load("nowhere.bt"); }) == "nowhere.bt: cannot be read (there is no such file)");
  const File tree("no.bt", "no tree");
  CHECK(errorOf([&] { return vpOctree::load(tree.name()); }) == tree.name() + ": is no octree of octomap");
}

TEST_CASE("Octrees that would harm octomap are refused before they get there", "[files][hostile][needs-OCTOMAP]")
{
  const auto treeError = [](const std::string &name, const std::string &bytes) {
    const File file(name, bytes);
    return errorOf([&] { return vpOctree::load(file.name()); });
  };
  const auto binary = [](const std::string &size, const std::string &nodes) {
    return "# Octomap OcTree binary file\nid OcTree\nsize " + size + "\nres 0.02\ndata\n" + nodes;
  };
  const std::string bt = "catchCollisionFiles-tree.bt: ", ot = "catchCollisionFiles-tree.ot: ";
  // A root with two occupied leaves and one free.
  const std::string root("\x1a\x00", 2);
  CHECK(treeError("tree.bt", binary("4", root)) == "no error");
  CHECK(treeError("tree.bt", binary("5", root)) == bt + "says 5 nodes and has 4");
  CHECK(treeError("tree.bt", binary("4", root.substr(0, 1))) == bt + "says 4 nodes and is cut off");
  // Every node has one child that has children: octomap went as deep as the file is long.
  std::string chain;
  for (int i = 0; i < 1000000; ++i) {
    chain += std::string("\x03\x00", 2);
  }
  CHECK(treeError("tree.bt", binary("1000001", chain)) == bt + "has more than 16 levels");
  std::string deepest = chain.substr(0, 30) + std::string("\x02\x00", 2);
  CHECK(treeError("tree.bt", binary("17", deepest)) == "no error");
  deepest = chain.substr(0, 32) + std::string("\x02\x00", 2);
  CHECK(treeError("tree.bt", binary("18", deepest)) == bt + "has more than 16 levels");

  const auto full = [](const std::string &nodes) {
    return "# Octomap OcTree file\n# a remark\nid OcTree\nsize 2\nres 0.1\ndata\n" + nodes;
  };
  const std::string inner("\x00\x00\x80\x3f\x01", 5), leaf("\x00\x00\x80\x3f\x00", 5), nan("\x00\x00\xc0\x7f\x00", 5);
  CHECK(treeError("tree.ot", full(inner + leaf)) == "no error");
  CHECK(treeError("tree.ot", full(inner + nan)) == ot + "has a node whose occupancy is not finite");
  CHECK(treeError("tree.ot", full(inner)) == ot + "says 2 nodes and is cut off");

  CHECK(treeError("tree.bt", "# Octomap OcTree binary file\nid OcTree\n") == bt + "is cut off in its head");
  CHECK(treeError("tree.bt", "# Octomap OcTree binary file\nid OcTree\nres nan\ndata\n") ==
        bt + "its resolution is no number");
  CHECK(treeError("tree.bt", "# Octomap OcTree binary file\nid OcTree\nres 0\ndata\n") ==
        bt + "its resolution is 0 m, must be > 0");
  CHECK(treeError("tree.bt", "# Octomap OcTree binary file\nid ColorOcTree\nres 1\ndata\n") ==
        bt + "is a tree of the kind ColorOcTree, must be OcTree");
}

TEST_CASE("Scenes are read as strictly as tasks; the public broken ones", "[files][hostile][needs-OCTOMAP]")
{
  const std::string file = "catchCollisionFiles-scene.json: ";
  CHECK(sceneError("{\"name\": \"s\", \"objects\": [], \"objects\": []}") == file + "field \"objects\" is given twice");
  CHECK(sceneError("{\"name\": " + std::string(1000000, '[')) == file + "is nested more than 64 deep");
  CHECK(sceneError("\xef\xbb\xbf{\"name\": \"s\",\r\n\"objects\": []}\r\n") == "no error");
  CHECK(objectError("\"shape\": \"\\u001b[2J\"") ==
        file + "objects[0].shape is \"\\u001b[2J\", must be sphere, capsule, box, cylinder, mesh or octree");

  const auto caseError = [](const std::string &name) {
    const std::string path = vpTestSupport::caseFile("broken/" + name);
    return path.empty() ? "" : errorOf([&] { return vpLoadCollisionScene(path); });
  };
  if (vpTestSupport::caseFile("broken/bom.json").empty()) {
    return;
  }
  CHECK(caseError("bom.json") == "no error");
  CHECK(caseError("crlf.json") == "no error");
  CHECK(caseError("html.json") == "no error");
  CHECK(caseError("dup.json").find("field \"objects\" is given twice") != std::string::npos);
  CHECK(caseError("dup-objects.json").find("field \"objects\" is given twice") != std::string::npos);
  CHECK(caseError("trunc.bt.json").find("trunc.bt: says 4027 nodes and is cut off") != std::string::npos);
}

TEST_CASE("A scene with everything arrives", "[files][needs-ASSIMP]")
{
  const File obj("all.obj", cube);
  const File file("scene.json", R"({"name": "all", "comment": "x",
    "ground": {"normal": [0, 0, 2], "offset_m": -0.1, "first_link": 4},
    "allowed_link_pairs": [[1, 5]],
    "objects": [
      {"name": "a", "shape": "sphere", "radius_m": 0.1, "inflation_m": 0.02,
       "velocity": {"linear_m_s": [0.1, 0, 0], "angular_rad_s": [0, 0, 1]}},
      {"name": "b", "shape": "capsule", "radius_m": 0.1, "length_m": 0.2, "pose": {"translation_m": [0, 1, 0]}},
      {"name": "c", "shape": "box", "size_m": [0.1, 0.2, 0.3], "photo": "klimt",
       "pose": {"translation_m": [0, 0, 1], "rotation_deg": [0, 0, 90]}},
      {"name": "d", "shape": "cylinder", "radius_m": 0.1, "length_m": 0.2, "allowed_links": [5, 7]},
      {"name": "e", "shape": "mesh", "file": "catchCollisionFiles-all.obj", "scale": 0.1},
      {"name": "f", "shape": "mesh", "surface": true,
       "vertices_m": [[0,0,0],[1,0,0],[0,1,0]], "triangles": [[0,1,2]]},
      {"name": "g", "shape": "octree", "cells_m": [[0, 0, 0, 0.1]]}],
    "tasks": [{"name": "t", "start_rad": [0,0,0,0,0,0,0], "goal_rad": [1,0,0,0,0,0,0]}]})");
  const vpCollisionSceneFile all = vpLoadCollisionScene(file.name());
  CHECK(all.name == "all");
  CHECK(all.spec.objects.size() == 7);
  CHECK(all.spec.objects[0].velocity[5] == 1.);
  CHECK(all.spec.objects[2].pose.R(1, 0) == Approx(1.));
  CHECK(all.spec.allowedContacts.size() == 2);
  CHECK(all.spec.objects[4].shape.mesh().vertices()[6].x() == Approx(0.1));
  REQUIRE(all.warnings.size() == 1);
  CHECK(all.warnings[0].find(file.name() + ": objects[5]: mesh: the surface has holes") == 0);
  CHECK(all.tasks[0].goal(0) == 1.);
  REQUIRE(all.photos.size() == 1);
  CHECK(all.photos[0].object == "c");
  CHECK(all.photos[0].target == "klimt");
  const vpCollisionScene scene(amor(), all.spec);
  CHECK(scene.selfPairs().size() == 2);
  CHECK(scene.ground()->normal.z() == 1.);
  CHECK_FALSE(scene.isChecked(3, 3));
  CHECK(scene.isChecked(1, 3));
}

TEST_CASE("Errors in scenes name the file and the element", "[files][needs-ASSIMP][needs-OCTOMAP]")
{
  const std::string file = "catchCollisionFiles-scene.json: ";
  CHECK(sceneError("{\"name\": ").find(file + "line 1, column ") == 0);
  CHECK(sceneError("[]") == file + "the content is [], must be an object { }");
  CHECK(sceneError("").find(file + "line 1, column 1") == 0);
  CHECK(sceneError("{\"name\": \"s\"}") == file + "objects is missing");
  CHECK(sceneError("{\"name\": \"s\", \"objects\": [], \"obstacles\": []}") ==
        file + "unknown field obstacles; known are allowed_link_pairs, comment, ground, ignored_bodies, name, objects, "
               "tasks");
  CHECK(sceneError("{\"name\": \"s\", \"objects\": [], \"ignored_bodies\": [1]}") ==
        file + "ignored_bodies is [1], must be a list of texts");
  CHECK(sceneError("{\"name\": \"s\", \"objects\": {}}") == file + "objects is {}, must be a list");
  CHECK(sceneError("{\"name\": \"s\", \"objects\": [], \"allowed_link_pairs\": [[1]]}") ==
        file + "allowed_link_pairs[0] is [1], must be a list of 2 numbers");
  CHECK(sceneError("{\"name\": \"s\", \"objects\": [], \"allowed_link_pairs\": [[1, 2.5]]}") ==
        file + "allowed_link_pairs is 2.5, must be a whole number");
  CHECK(sceneError("{\"name\": \"s\", \"objects\": [], \"tasks\": [{\"name\": \"t\", \"start_rad\": [0], \"goal_rad\": "
                   "[0, 1]}]}") == file + "tasks[0].goal_rad is [0,1], must be a list of as many numbers as start_rad");
  CHECK(objectError("\"shape\": \"cone\"") ==
        file + "objects[0].shape is \"cone\", must be sphere, capsule, box, cylinder, mesh or octree");
  CHECK(objectError("\"shape\": \"sphere\"") == file + "objects[0].radius_m is missing");
  CHECK(objectError("\"shape\": \"sphere\", \"radius_m\": -1") ==
        file + "objects[0]: radius of the sphere is -1 m, must be > 0 and at most 10000 m");
  CHECK(objectError("\"shape\": \"sphere\", \"radius_m\": \"big\"") ==
        file + "objects[0].radius_m is \"big\", must be a number");
  CHECK(objectError("\"shape\": \"sphere\", \"radius_m\": NaN").find(file + "line 1, column ") == 0);
  CHECK(objectError("\"shape\": \"sphere\", \"radius_m\": 1, \"size_m\": 3") ==
        file + "unknown field objects[0].size_m; known are allowed_links, inflation_m, name, photo, pose, radius_m, "
               "shape, velocity");
  CHECK(objectError("\"shape\": \"box\", \"size_m\": [1, 2]") ==
        file + "objects[0].size_m is [1,2], must be a list of 3 numbers");
  CHECK(objectError("\"shape\": \"box\", \"size_m\": [1, 2, 0]") ==
        file + "objects[0]: size of the box along z is 0 m, must be > 0 and at most 10000 m");
  CHECK(objectError("\"shape\": \"sphere\", \"radius_m\": 1, \"pose\": {}") ==
        file + "objects[0].pose.translation_m is missing");
  CHECK(objectError("\"shape\": \"mesh\", \"file\": \"nowhere.stl\"") ==
        file + "objects[0]: nowhere.stl: cannot be read (there is no such file)");
  CHECK(objectError("\"shape\": \"mesh\", \"vertices_m\": [[0, 0]], \"triangles\": []") ==
        file + "objects[0].vertices_m[0] is [0,0], must be a list of 3 numbers");
  CHECK(objectError("\"shape\": \"mesh\", \"vertices_m\": [[0, 0, 0]], \"triangles\": [[0, 0, 4]]") ==
        file + "objects[0]: mesh: triangle 0 uses vertex 4 of 1");
  CHECK(objectError("\"shape\": \"octree\", \"cells_m\": [[0, 0, 0, -1]]") ==
        file + "objects[0]: octree: cell 0 has the size -1 m, must be > 0, and all within 10000 m");
  CHECK(objectError("\"shape\": \"octree\", \"file\": \"nowhere.bt\"") ==
        file + "objects[0]: nowhere.bt: cannot be read (there is no such file)");
  CHECK(objectError("\"shape\": \"sphere\", \"radius_m\": 1, \"photo\": \"klimt\"") ==
        file + "objects[0].photo is \"klimt\", must be on a box");
  const std::string box = "\"shape\": \"box\", \"size_m\": [1, 1, 1], \"photo\": ";
  CHECK(objectError(box + "3").find(file + "objects[0].photo") == 0);
  CHECK(objectError(box + "\"klimt\"}, {\"name\": \"p\", " + box + "\"klimt\"") ==
        file + "objects[1].photo is \"klimt\", must be another one than object o carries");
  CHECK(errorOf([] { return vpLoadCollisionScene("nowhere.json"); }) ==
        "nowhere.json: cannot be read (there is no such file)");
}

TEST_CASE("The scenes of data/scene load, and their tasks start and end free", "[files][needs-ASSIMP][needs-OCTOMAP]")
{
  for (const char *name : {"empty", "s4a-pillar", "s4b-shelf", "s6-trap", "seen"}) {
    CAPTURE(name);
    const vpCollisionSceneFile file = vpLoadCollisionScene(dataFile("scene/" + std::string(name) + ".json"));
    CHECK(file.warnings.empty());
    const vpCollisionScene scene(amor(), file.spec);
    const vpCertifiedMotion certified(scene);
    vpMotionScratch scratch;
    CHECK((std::string(name) == "empty") == file.tasks.empty());
    for (const vpMotionTask &task : file.tasks) {
      CHECK(certified.check(task.start, task.start, scratch).isFree());
      CHECK(certified.check(task.goal, task.goal, scratch).isFree());
      // Otherwise there would be nothing to plan.
      CHECK(certified.check(task.start, task.goal, scratch).status == vpMotionStatus::Collision);
      for (int i = 0; i < 7; ++i) {
        for (const double q : {task.start(i), task.goal(i)}) {
          CHECK((amor().isContinuous(i) || (q >= amor().lower()(i) && q <= amor().upper()(i))));
        }
      }
    }
  }
}
