/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Damaged files of every format that the modules read are refused in a sentence, or read, in a bounded time. Best under the
// address sanitizer: scripts/sanitize.sh files
#include "vpCatch.h"

#include "fileMutator.h"
#include "vpTestFile.h"

#include <visp3/avoidance/vpCollisionSceneJson.h>
#include <visp3/avoidance/vpSelfCollisionStatistics.h>
#include <visp3/manipulator/vpArmJson.h>
#include <visp3/manipulator/vpArmUrdf.h>
#include <visp3/manipulator/vpSrdf.h>
#include <visp3/pattern/vpMicroscopeCalibration.h>
#include <visp3/planar_target/vpPlanarTargetDatabase.h>
#include <visp3/servoing/vpServoCalibration.h>

#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>

VISP_DIRECT_USING_NAMESPACE

namespace
{
const std::string data = VISP_DIRECT_DATA_DIR;

//! A file of this program.
struct File : vpTestSupport::File {
  File(const std::string &name, const std::string &content) : vpTestSupport::File("catchMutatedFiles-" + name, content)
  {}
};

void tell(const char *format, const MutationCount &count)
{
  std::cout << format << ": " << count.accepted << " damaged files accepted, " << count.refused << " refused\n";
  CHECK(count.accepted > 0);
  CHECK(count.refused > count.accepted / 10);
}

std::string bytesOf(float value)
{
  char bytes[4];
  std::memcpy(bytes, &value, 4);
  return {bytes, 4};
}

//! The corners of the 12 triangles of a cube.
std::vector<std::array<float, 3>> cube()
{
  std::vector<std::array<float, 3>> corners;
  for (const int corner :
       {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5}) {
    corners.push_back(
        {static_cast<float>(corner & 1), static_cast<float>((corner >> 1) & 1), static_cast<float>(corner >> 2)});
  }
  return corners;
}

std::string binaryStl()
{
  const std::vector<std::array<float, 3>> corners = cube();
  std::string bytes = std::string(80, ' ') + std::string("\x0c\0\0\0", 4);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    bytes += i % 3 == 0 ? std::string(12, '\0') : ""; // normal
    for (const float x : corners[i]) {
      bytes += bytesOf(x);
    }
    bytes += i % 3 == 2 ? std::string(2, '\0') : "";
  }
  return bytes;
}

std::string textStl()
{
  const std::vector<std::array<float, 3>> corners = cube();
  std::string text = "solid cube\n";
  for (std::size_t i = 0; i < corners.size(); ++i) {
    text += i % 3 == 0 ? "facet normal 0 0 0\nouter loop\n" : "";
    text += "vertex";
    for (const float x : corners[i]) {
      text += " " + std::to_string(x);
    }
    text += i % 3 == 2 ? "\nendloop\nendfacet\n" : "\n";
  }
  return text + "endsolid cube\n";
}

std::string plyFile()
{
  return "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
         "element face 5\nproperty list uchar int vertex_indices\nend_header\n"
         "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0.5 0.5 1\n4 0 3 2 1\n3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n";
}

std::string binaryPly()
{
  std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                      "property float z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n";
  for (const float x : {0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F}) {
    bytes += bytesOf(x);
  }
  for (const char *face : {"\x00\x02\x01", "\x00\x01\x03", "\x00\x03\x02", "\x01\x02\x03"}) {
    bytes += '\x03';
    for (int k = 0; k < 3; ++k) {
      bytes += std::string(1, face[k]) + std::string(3, '\0');
    }
  }
  return bytes;
}

std::string colladaFile()
{
  return R"(<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="centimeter" meter="0.01"/><up_axis>Z_UP</up_axis></asset>
<library_effects><effect id="e"><profile_COMMON><technique sid="t"><phong/></technique></profile_COMMON></effect></library_effects>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="pa" count="12">0 0 0 1 0 0 0 1 0 0 0 1</float_array><technique_common>
<accessor source="#pa" count="4" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="3"><input semantic="VERTEX" source="#v" offset="0"/><p>0 2 1 0 1 3 0 3 2</p></triangles>
<polylist count="1"><input semantic="VERTEX" source="#v" offset="0"/><vcount>3</vcount><p>1 2 3</p></polylist>
</mesh></geometry></library_geometries>
<library_nodes><node id="n"><rotate>0 0 1 90</rotate><instance_geometry url="#g"/></node></library_nodes>
<library_visual_scenes><visual_scene id="s"><node id="a"><matrix>1 0 0 5 0 1 0 0 0 0 1 0 0 0 0 1</matrix>
<instance_geometry url="#g"/><node id="b"><translate>0 0 9</translate><instance_node url="#n"/></node></node></visual_scene>
</library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
}

//! A tree of octomap with its values: some leaves below some inner nodes.
std::string fullOctree()
{
  const std::string value = bytesOf(0.85F);
  return "# Octomap OcTree file\nid OcTree\nsize 7\nres 0.05\ndata\n" + value + "\x05" + value + "\x81" + value +
         std::string(1, '\0') + value + "\x02" + value + std::string(1, '\0') + value + "\x40" + value +
         std::string(1, '\0');
}
} // namespace

TEST_CASE("Damaged arms", "[files][mutated]")
{
  tell("arm.json", readMutated({data + "/robot/amor.json"}, ".json", mutationCount(400),
                               [](const std::string &file) { static_cast<void>(vpLoadArmJson(file)); }));
  vpArmUrdfSpec options;
  options.tip = "tool";
  tell("arm.urdf", readMutated({data + "/robot/generic-6r.urdf"}, ".urdf", mutationCount(400),
                               [&](const std::string &file) { static_cast<void>(vpLoadArmUrdf(file, options)); }));
  const File srdf("arm.srdf", R"(<?xml version="1.0"?><!-- pairs --><robot name="generic-6r">
  <group name="arm"><chain base_link="base" tip_link="tool"/></group>
  <group name="some"><joint name="elbow"/><link name="forearm"/><group name="arm"/></group>
  <group_state name="home" group="arm"><joint name="base_yaw" value="0"/><joint name="shoulder" value="0.5"/>
    <joint name="elbow" value="-1"/><joint name="forearm_roll" value="0"/><joint name="wrist_bend" value="1e-1"/>
    <joint name="flange_roll" value="0"/></group_state>
  <disable_collisions link1="turret" link2="upper_arm" reason="Adjacent"/></robot>)");
  tell("arm.srdf", readMutated({srdf.name()}, ".srdf", mutationCount(400), [&](const std::string &file) {
         static_cast<void>(vpLoadSrdf(file));
         vpArmUrdfSpec withSrdf;
         withSrdf.srdf = file;
         const std::string urdf = data + "/robot/generic-6r.urdf";
         try {
           static_cast<void>(vpLoadArmUrdf(urdf, withSrdf));
         }
         catch (const vpException &e) { // the groups of a valid file may be none of this arm
           CHECK(std::string(e.getStringMessage()).find(urdf + ": ") == 0);
         }
       }));
  const File limits("limits.yaml",
                    "joint_limits:\n  elbow:\n    has_velocity_limits: true # rad/s\n    max_velocity: 1.5\n"
                    "    has_position_limits: true\n    min_position: -1\n    max_position: 1\n"
                    "  shoulder:\n    has_acceleration_limits: false\n    max_acceleration: 0\n");
  tell("limits.yaml", readMutated({limits.name()}, ".yaml", mutationCount(400), [&](const std::string &file) {
         vpArmUrdfSpec withLimits = options;
         withLimits.limits = file;
         static_cast<void>(vpLoadArmUrdf(data + "/robot/generic-6r.urdf", withLimits));
       }));
}

TEST_CASE("Damaged scenes", "[files][mutated]")
{
  const File everything("scene.json", R"({"name": "all", "comment": "x",
    "ground": {"normal": [0, 0, 2], "offset_m": -0.1, "first_link": 4}, "allowed_link_pairs": [[1, 5]],
    "objects": [
      {"name": "a", "shape": "sphere", "radius_m": 0.1, "inflation_m": 0.02,
       "velocity": {"linear_m_s": [0.1, 0, 0], "angular_rad_s": [0, 0, 1]}},
      {"name": "b", "shape": "capsule", "radius_m": 0.1, "length_m": 0.2, "allowed_links": [0, 1]},
      {"name": "c", "shape": "mesh", "vertices_m": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
       "triangles": [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]},
      {"name": "d", "shape": "octree", "cells_m": [[0, 0, 0, 0.1]]},
      {"name": "e", "shape": "box", "size_m": [1, 2, 3], "photo": "p",
       "pose": {"translation_m": [0, 0, 1], "rotation_deg": [0, 90, 0]}}],
    "tasks": [{"name": "t", "start_rad": [0, 0.1], "goal_rad": [1, 1]}]})");
  tell("scene.json",
       readMutated({everything.name(), data + "/scene/photo-box.json", data + "/scene/s4b-shelf.json"}, ".json",
                   mutationCount(400), [](const std::string &file) { static_cast<void>(vpLoadCollisionScene(file)); }));
}

TEST_CASE("Damaged statistics of self collisions", "[files][mutated]")
{
  const vpSelfCollisionStatistics pairs{"arm", 10000, 1, {{"a", "b", 9900, false, true}, {"a", "c", 0, true, false}}};
  pairs.save("catchMutatedFiles-pairs.json");
  tell("pairs.json",
       readMutated({"catchMutatedFiles-pairs.json"}, ".json", mutationCount(400),
                   [](const std::string &file) { static_cast<void>(vpSelfCollisionStatistics::load(file)); }));
  std::remove("catchMutatedFiles-pairs.json");
}

TEST_CASE("Damaged meshes", "[files][mutated]")
{
  const auto load = [](const std::string &file) { static_cast<void>(vpTriangleMesh::load(file)); };
  const File binary("binary.stl", binaryStl()), text("text.stl", textStl());
  CHECK(vpTriangleMesh::load(binary.name()).isWatertight());
  CHECK(vpTriangleMesh::load(text.name()).isWatertight());
  tell("binary .stl", readMutated({binary.name()}, ".stl", mutationCount(400), load));
  tell("text .stl", readMutated({text.name()}, ".stl", mutationCount(400), load));
  tell(".obj", readMutated({data + "/scene/bracket.obj"}, ".obj", mutationCount(400), load));
  const File ply("text.ply", plyFile()), binaryOne("binary.ply", binaryPly()), collada("mesh.dae", colladaFile());
  CHECK(vpTriangleMesh::load(ply.name()).isWatertight());
  CHECK(vpTriangleMesh::load(binaryOne.name()).isWatertight());
  CHECK(vpTriangleMesh::load(collada.name()).isWatertight());
  tell("text .ply", readMutated({ply.name()}, ".ply", mutationCount(400), load));
  tell("binary .ply", readMutated({binaryOne.name()}, ".ply", mutationCount(400), load));
  tell(".dae", readMutated({collada.name()}, ".dae", mutationCount(400), load));
}

TEST_CASE("Damaged octrees", "[files][mutated]")
{
  const auto load = [](const std::string &file) { static_cast<void>(vpOctree::load(file)); };
  const File full("full.ot", fullOctree());
  tell(".bt", readMutated({data + "/scene/seen.bt"}, ".bt", mutationCount(400), load));
  tell(".ot", readMutated({full.name()}, ".ot", mutationCount(400), load));
}

TEST_CASE("Damaged camera files of ViSP", "[files][mutated]")
{
  const std::string name = "catchMutatedFiles-camera.xml";
  std::remove(name.c_str());
  vpMicroscopeCalibration calibration;
  calibration.width = 640;
  calibration.height = 480;
  calibration.scaleX = calibration.scaleY = 2e5;
  calibration.u0 = 320.;
  calibration.v0 = 240.;
  calibration.kappa1 = 1e-9;
  calibration.saveXml(name, "microscope");
  tell("camera.xml", readMutated({name}, ".xml", mutationCount(400), [](const std::string &file) {
         static_cast<void>(vpMicroscopeCalibration::loadXml(file, "microscope", 640, 480));
       }));
  tell("camera.xml of the servo", readMutated({name}, ".xml", mutationCount(400), [](const std::string &file) {
         static_cast<void>(vpLoadCalibratedCamera(file, "microscope", 640, 480));
       }));
  std::remove(name.c_str());
}

TEST_CASE("Damaged poses", "[files][mutated]")
{
  const File vector("eMc.yaml",
                    "rows: 6\ncols: 1\ndata: \n  - [0.1]\n  - [0.2]\n  - [0.3]\n  - [-1.5]\n  - [0]\n  - [1e-3]\n");
  const File matrix("eMc.txt", "0 -1 0 0.1\n1 0 0 -0.2\n0 0 1 0.3\n0 0 0 1");
  tell("eMc", readMutated({vector.name(), matrix.name()}, ".yaml", mutationCount(400),
                          [](const std::string &file) { static_cast<void>(vpLoadPose(file)); }));
}

TEST_CASE("Damaged lists of targets", "[files][mutated]")
{
  // One small photograph, with something for keypoints; a database of it takes milliseconds.
  namespace fs = std::filesystem;
  const fs::path folder = "catchMutatedFiles-targets";
  fs::create_directories(folder);
  auto rng = vpTestSupport::generator(1000000);
  std::string pixels = "P5\n160 160\n255\n";
  std::array<unsigned char, 400> blocks;
  for (unsigned char &block : blocks) {
    block = static_cast<unsigned char>(rng() % 256);
  }
  for (std::size_t i = 0; i < 160 * 160; ++i) {
    pixels += static_cast<char>(blocks[i / 160 / 8 * 20 + i % 160 / 8]);
  }
  std::ofstream(folder / "a.pgm", std::ios::binary) << pixels;
  vpPlanarTargetSpec config;
  config.minInliers = 8;
  const vpCameraParameters camera(600., 600., 320., 240.);
  const File good("targets.json", R"({"comment": "x", "targets": [
    {"name": "a", "image": "a.pgm", "width_m": 0.1, "height_m": 0.1, "depth_m": 0.02}]})");
  tell("targets.json", readMutated({good.name()}, ".json", mutationCount(800), [&](const std::string &file) {
         fs::copy_file(file, folder / "targets.json", fs::copy_options::overwrite_existing);
         try {
           static_cast<void>(vpPlanarTargetDatabase::fromFolder(folder.string(), camera, config));
         }
         catch (const vpException &error) {
           throw std::runtime_error(file + " as " + error.getStringMessage());
         }
       }));
  fs::remove_all(folder);
}
