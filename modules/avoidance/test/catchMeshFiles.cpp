/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// One solid through every mesh format, with scales, mirrors, units and places; what would crash the parser is refused.
#include "vpTestFile.h"
#include "vpAvoidanceTestKit.h"
#include "vpCaseFile.h"
#include "vpCatch.h"

#include <visp3/avoidance/vpTriangleMesh.h>
#include <visp3/core/vpException.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iostream>
#include <sstream>

using namespace vpAvoidanceTestKit;

namespace
{
// A file of this test.
struct File : vpTestSupport::File {
  File(const std::string &name, const std::string &content) : vpTestSupport::File("catchMeshFiles-" + name, content) {}
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

std::string errorIn(const std::string &ending, const std::string &text)
{
  const File file("broken" + ending, text);
  return errorOf([&] { return vpTriangleMesh::load(file.name()); });
}

template <class Number> void append(std::string &bytes, Number number)
{
  bytes.append(reinterpret_cast<const char *>(&number), sizeof number);
}

std::string row(const Vector3d &v)
{
  std::ostringstream text;
  text.precision(17);
  text << v.x() << ' ' << v.y() << ' ' << v.z();
  return text.str();
}

std::string textStl(const vpTriangleMesh &mesh)
{
  std::string text = "solid s\n";
  for (const auto &t : mesh.triangles()) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const int i : t) {
      text += "vertex " + row(mesh.vertices()[static_cast<std::size_t>(i)]) + "\n";
    }
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid s\n";
}

std::string binaryStl(const vpTriangleMesh &mesh)
{
  std::string bytes(80, ' ');
  append(bytes, static_cast<std::uint32_t>(mesh.triangles().size()));
  for (const auto &t : mesh.triangles()) {
    bytes.append(12, '\0'); // normal
    for (const int i : t) {
      for (int k = 0; k < 3; ++k) {
        append(bytes, static_cast<float>(mesh.vertices()[static_cast<std::size_t>(i)](k)));
      }
    }
    bytes.append(2, '\0');
  }
  return bytes;
}

std::string obj(const vpTriangleMesh &mesh)
{
  std::string text = "mtllib nowhere.mtl\n";
  for (const Vector3d &v : mesh.vertices()) {
    text += "v " + row(v) + "\n";
  }
  for (const auto &t : mesh.triangles()) {
    text += "f " + std::to_string(t[0] + 1) + "//1 " + std::to_string(t[1] + 1) + "//1 " + std::to_string(t[2] + 1) +
            "//1\n";
  }
  return text + "vn 0 0 1\n";
}

std::string ply(const vpTriangleMesh &mesh, bool binary)
{
  std::string text = std::string("ply\nformat ") + (binary ? "binary_little_endian" : "ascii") +
                     " 1.0\nelement vertex " + std::to_string(mesh.vertices().size()) +
                     "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
                     std::to_string(mesh.triangles().size()) + "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Vector3d &v : mesh.vertices()) {
    text += binary ? "" : row(v) + "\n";
    for (int k = 0; binary && k < 3; ++k) {
      append(text, v(k));
    }
  }
  for (const auto &t : mesh.triangles()) {
    text += binary ? "\x03" : "3";
    for (const int i : t) {
      binary ? append(text, static_cast<std::int32_t>(i)) : void(text += " " + std::to_string(i));
    }
    text += binary ? "" : "\n";
  }
  return text;
}

// A binary .ply file in the other byte order.
std::string bigEndian(std::string text, std::size_t vertices)
{
  text.replace(text.find("little"), 6, "big");
  auto at = text.begin() + static_cast<std::ptrdiff_t>(text.find("end_header\n") + 11);
  for (std::size_t i = 0; i < 3 * vertices; ++i, at += 8) {
    std::reverse(at, at + 8);
  }
  for (; at != text.end(); at += 13) { // a number of vertices in one byte, and three of them
    for (int k = 1; k < 13; k += 4) {
      std::reverse(at + k, at + k + 4);
    }
  }
  return text;
}

std::string collada(const vpTriangleMesh &mesh, const std::string &unit, const std::string &up,
                    const std::string &nodes)
{
  std::string points, triangles;
  for (const Vector3d &v : mesh.vertices()) {
    points += row(v) + " ";
  }
  for (const auto &t : mesh.triangles()) {
    triangles += std::to_string(t[0]) + " " + std::to_string(t[1]) + " " + std::to_string(t[2]) + " ";
  }
  const std::string n = std::to_string(mesh.vertices().size());
  return R"(<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset>)" +
         (unit.empty() ? "" : "<unit name=\"u\" meter=\"" + unit + "\"/>") + "<up_axis>" + up +
         "</up_axis></asset><library_geometries><geometry id=\"g\"><mesh><source id=\"p\"><float_array id=\"a\" "
         "count=\"" +
         std::to_string(3 * mesh.vertices().size()) + "\">" + points +
         "</float_array><technique_common><accessor source=\"#a\" count=\"" + n +
         R"(" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>)"
         R"(</accessor></technique_common></source><vertices id="v"><input semantic="POSITION" source="#p"/></vertices>)"
         R"(<triangles count=")" +
         std::to_string(mesh.triangles().size()) + R"("><input semantic="VERTEX" source="#v" offset="0"/><p>)" +
         triangles + "</p></triangles></mesh></geometry></library_geometries>" + nodes +
         R"(<scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
}

std::string scene(const std::string &nodes)
{
  return "<library_visual_scenes><visual_scene id=\"s\">" + nodes + "</visual_scene></library_visual_scenes>";
}

const std::string node = R"(<node id="a"><instance_geometry url="#g"/></node>)";

// A closed mesh of random corners: a box, distorted.
vpTriangleMesh solid(std::mt19937_64 &rng)
{
  std::vector<Vector3d> corners;
  for (int i = 0; i < 8; ++i) {
    corners.push_back(Vector3d(i & 1, (i >> 1) & 1, i >> 2) + point(rng, 0.2));
  }
  return vpTriangleMesh(corners, {{0, 2, 1},
                                  {1, 2, 3},
                                  {4, 5, 6},
                                  {5, 7, 6},
                                  {0, 1, 4},
                                  {1, 5, 4},
                                  {2, 6, 3},
                                  {3, 6, 7},
                                  {0, 4, 2},
                                  {2, 4, 6},
                                  {1, 3, 5},
                                  {3, 7, 5}});
}

double volume(const vpTriangleMesh &mesh)
{
  double sum = 0.;
  for (const auto &t : mesh.triangles()) {
    const auto at = [&](std::size_t k) { return mesh.vertices()[static_cast<std::size_t>(t[k])]; };
    sum += at(0).dot(at(1).cross(at(2))) / 6.;
  }
  return sum;
}

// Largest distance of a corner of one from the nearest corner of the other, transformed.
template <class Map> double difference(const vpTriangleMesh &a, const vpTriangleMesh &b, Map map)
{
  double most = 0.;
  for (const Vector3d &v : a.vertices()) {
    double least = 1e9;
    for (const Vector3d &w : b.vertices()) {
      least = std::min(least, (v - map(w)).norm());
    }
    most = std::max(most, least);
  }
  return a.vertices().size() == b.vertices().size() ? most : 1e9;
}
} // namespace

TEST_CASE("Every format gives the same solid, with any scale, in any case of letters", "[files][needs-ASSIMP]")
{
  CAPTURE(vpTestSupport::seed());
  std::mt19937_64 rng = vpTestSupport::generator();
  for (int i = 0; i < 20; ++i) {
    const vpTriangleMesh mesh = solid(rng);
    const std::array<std::pair<const char *, std::string>, 7> files = {{
        {"a.stl", textStl(mesh)},
        {"b.STL", binaryStl(mesh)},
        {"c.Obj", obj(mesh)},
        {"d.ply", ply(mesh, false)},
        {"e.PLY", ply(mesh, true)},
        {"f.dae", collada(mesh, "1", "Y_UP", scene(node))},
        {"g.DAE", collada(mesh, "", "Z_UP", scene(node))},
    }};
    Vector3d scale(uniform(rng, 0.01, 3.), uniform(rng, 0.01, 3.), uniform(rng, 0.01, 3.));
    for (int k = 0; k < 3; ++k) {
      scale(k) *= rng() % 2 == 0 ? 1. : -1.;
    }
    for (const auto &content : files) {
      const File file(content.first, content.second);
      CAPTURE(i, content.first, scale.transpose());
      const vpTriangleMesh same = vpTriangleMesh::load(file.name());
      CHECK(same.isWatertight());
      CHECK(same.triangles().size() == 12);
      CHECK(difference(same, mesh, [](const Vector3d &v) { return v; }) < 1e-6);
      const vpTriangleMesh scaled = vpTriangleMesh::load(file.name(), scale);
      CHECK(difference(scaled, mesh, [&](const Vector3d &v) { return scale.cwiseProduct(v).eval(); }) < 1e-6);
      // Outwards, also when mirrored.
      CHECK(volume(scaled) == Approx(std::fabs(scale.prod()) * volume(mesh)).epsilon(1e-4));
    }
  }
}

TEST_CASE("Binary data may begin with a line end", "[files][needs-ASSIMP]")
{
  CAPTURE(vpTestSupport::seed());
  std::mt19937_64 rng = vpTestSupport::generator();
  const vpTriangleMesh any = solid(rng);
  for (const char first : {'\n', '\r'}) {
    std::vector<Vector3d> corners = any.vertices();
    std::memcpy(&corners[0](0), &first, 1);
    const vpTriangleMesh mesh(corners, any.triangles());
    const std::string bytes = ply(mesh, true);
    const std::size_t data = bytes.find("end_header\n") + 11;
    REQUIRE(bytes[data] == first);
    const File little("line-end.ply", bytes);
    const vpTriangleMesh same = vpTriangleMesh::load(little.name());
    CHECK(same.isWatertight());
    CHECK(difference(same, mesh, [](const Vector3d &v) { return v; }) < 1e-6);

    // The other byte order, in which such a number is almost 0.
    corners[0](0) = 0.;
    const vpTriangleMesh flat(corners, any.triangles());
    std::string turned = bigEndian(ply(flat, true), corners.size());
    turned[turned.find("end_header\n") + 11] = first;
    const File big("line-end-big.ply", turned);
    CHECK(difference(vpTriangleMesh::load(big.name()), flat, [](const Vector3d &v) { return v; }) < 1e-6);

    std::string whole = ply(mesh, true); // an integer cannot be changed
    whole.replace(whole.find("double x"), 8, "int a\nproperty int x");
    const File integer("line-end-int.ply", whole);
    CHECK(errorOf([&] { return vpTriangleMesh::load(integer.name()); }) ==
          integer.name() + ": its binary data begins with a byte " + std::to_string(int{first}) +
              ", which is mistaken for the end of a line; save it as text");
  }
}

TEST_CASE("A cavity stays one when the file is mirrored", "[files][needs-ASSIMP]")
{
  std::vector<Vector3d> corners = tetrahedron(1.).vertices();
  std::vector<std::array<int, 3>> triangles = tetrahedron(1.).triangles();
  for (const auto &t : tetrahedron(1.).triangles()) {
    triangles.push_back({t[0] + 4, t[2] + 4, t[1] + 4});
  }
  for (const Vector3d &v : tetrahedron(0.5).vertices()) {
    corners.push_back(v);
  }
  const vpTriangleMesh hollow(corners, triangles);
  const double full = volume(tetrahedron(1.));
  CHECK(volume(hollow) == Approx(0.875 * full));
  const File file("hollow.obj", obj(hollow));
  CHECK(volume(vpTriangleMesh::load(file.name(), Vector3d(-1., 2., 1.))) == Approx(2. * 0.875 * full));
}

TEST_CASE("Collada: units and places count, the up axis does not", "[files][needs-ASSIMP]")
{
  CAPTURE(vpTestSupport::seed());
  std::mt19937_64 rng = vpTestSupport::generator(1);
  const vpTriangleMesh mesh = solid(rng);
  for (const char *up : {"X_UP", "Y_UP", "Z_UP"}) {
    const File file("unit.dae", collada(mesh, "0.01", up, scene(node)));
    CHECK(difference(vpTriangleMesh::load(file.name()), mesh, [](const Vector3d &v) { return (0.01 * v).eval(); }) <
          1e-8);
  }
  const File placed("placed.dae",
                    collada(mesh, "0.5", "Z_UP",
                            "<library_nodes><node id=\"n\"><translate>0 0 3</translate><instance_geometry url=\"#g\"/>"
                            "</node></library_nodes>" +
                                scene(R"(<node id="a"><rotate>0 0 1 90</rotate><instance_node url="#n"/></node>)")));
  CHECK(difference(vpTriangleMesh::load(placed.name()), mesh,
                   [](const Vector3d &v) { return (0.5 * Vector3d(-v.y(), v.x(), v.z() + 3.)).eval(); }) < 1e-6);
}

TEST_CASE("What would crash the parser is refused by name", "[files][needs-ASSIMP]")
{
  std::mt19937_64 rng = vpTestSupport::generator(2);
  const vpTriangleMesh mesh = solid(rng);
  const std::string dae = "catchMeshFiles-broken.dae: ", file = "catchMeshFiles-broken.ply: ";
  CHECK(errorIn(".dae", collada(mesh, "1", "Z_UP",
                                "<library_nodes><node id=\"n\"><instance_node url=\"#m\"/></node><node id=\"m\">"
                                "<!-- </node> --><instance_node url=\"#n\"/></node></library_nodes>" +
                                    scene(R"(<node id="a"><instance_node url="#n"/></node>)"))) ==
        dae + "node m contains an instance of itself");
  std::string tower = "<library_nodes><node id=\"n0\"><instance_geometry url=\"#g\"/></node>";
  for (int i = 1; i < 30; ++i) {
    const std::string below = "<instance_node url=\"#n" + std::to_string(i - 1) + "\"/>";
    tower += "<node id=\"n" + std::to_string(i) + "\">" + below + below + "</node>";
  }
  CHECK(errorIn(".dae",
                collada(mesh, "1", "Z_UP",
                        tower + "</library_nodes>" + scene(R"(<node id="a"><instance_node url="#n29"/></node>)"))) ==
        dae + "repeats its nodes more than 100000 times");
  std::string deep;
  for (int i = 0; i < 100000; ++i) {
    deep += "<node>";
  }
  CHECK(errorIn(".dae", "<COLLADA>" + deep).find("is nested more than 64 deep") != std::string::npos);
  // A reference that leads back to itself would be followed without end; materials are not read.
  const File loop("loop.dae",
                  collada(mesh, "1", "Z_UP",
                          "<library_effects><effect id=\"e\"><profile_COMMON><newparam sid=\"p\"><sampler2D>"
                          "<source>p</source></sampler2D></newparam><technique sid=\"t\"><phong><diffuse>"
                          "<texture texture=\"p\" texcoord=\"x\"/></diffuse></phong></technique>"
                          "</profile_COMMON></effect></library_effects>" +
                              scene(node)));
  CHECK(vpTriangleMesh::load(loop.name()).isWatertight());
  const auto changed = [&](std::string text, const std::string &from, const std::string &to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
      text.replace(at, from.size(), to);
    }
    return text;
  };
  const std::string good = collada(mesh, "1", "Z_UP", scene(node));
  CHECK(errorIn(".dae", good) == "no error");
  CHECK(errorIn(".dae", changed(good, "float_array", "Name_array")) == dae + "an accessor goes beyond the end of a");
  CHECK(errorIn(".dae", changed(good, "count=\"8\"", "count=\"9\"")) == dae + "an accessor goes beyond the end of a");
  CHECK(errorIn(".dae", changed(good, "count=\"24\"", "count=\"25\"")) ==
        dae + "float_array a has not the 25 numbers that it says");
  CHECK(errorIn(".dae", changed(good, "count=\"24\"", "count=\"-1e308\"")) ==
        dae + "count of an element float_array is \"-1e308\", must be a whole number");
  CHECK(errorIn(".dae", changed(good, "stride=\"3\"", "stride=\"2\"")) ==
        dae + "the accessor of #a has more parameters than its stride");
  CHECK(errorIn(".dae", changed(good, "<p>0", "<p>1e154")) == dae + "an element p has more than whole numbers");
  CHECK(errorIn(".dae", changed(good, "semantic=\"VERTEX\"", "semantic=\"NORMAL\"")) ==
        dae + "an element triangles has no input VERTEX before its indices");
  CHECK(errorIn(".dae", changed(good, "instance_geometry", "instance_controller")) ==
        dae + "has an instance_controller, must be without skins");
  CHECK(errorIn(".dae", changed(good, "<node id=\"a\">", "<node id=\"&lt;\">")) ==
        dae + "id of an element node is \"&lt;\", must be without & and %");
  std::string wrong = ply(mesh, false);
  CHECK(errorIn(".ply", wrong.replace(wrong.find("\n3 ") + 3, 1, "9")) == file + "a face uses vertex 9 of 8");
  wrong = ply(mesh, false); // for which assimp would make room
  CHECK(errorIn(".ply", wrong.replace(wrong.find("\n3 ") + 1, 1, "2147483647")) ==
        file + "a list of the element face has 2147483647 values, more than its line");
  CHECK(errorIn(".ply", ply(mesh, true).substr(0, ply(mesh, true).size() - 1)) == file + "ends within its data");
  wrong = ply(mesh, true);
  CHECK(errorIn(".ply", wrong.replace(wrong.find("vertex 8"), 8, "vertex 4000000000")) ==
        file + "line 3: says 4000000000 of the element vertex, more than it has bytes");
  CHECK(errorOf([] { return vpTriangleMesh::load("nowhere.obj", Vector3d(1., 0., 1.)); }) ==
        "nowhere.obj: scale along y is 0, must be finite and not 0");
  CHECK(errorOf([] { return vpTriangleMesh::load("nowhere.obj", Vector3d(1., 1., NAN)); }) ==
        "nowhere.obj: scale along z is nan, must be finite and not 0");
}

TEST_CASE("Kinova's arm.dae lies along -y, as in ROS", "[files]")
{
  const std::string file = vpTestSupport::caseFile("example-robot-data/robots/kinova_description/meshes/arm.dae");
  if (!file.empty()) {
    Eigen::AlignedBox3d box;
    for (const Vector3d &v : vpTriangleMesh::load(file).vertices()) {
      box.extend(v);
    }
    CHECK((box.min() - Vector3d(-0.041, -0.451, -0.043)).norm() < 1e-3);
    CHECK((box.max() - Vector3d(0.041, 0.041, 0.)).norm() < 1e-3);
  }
}
