/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "scene.h"

#include <visp3/avoidance/vpArmCover.h>
#include <visp3/avoidance/vpCollisionSceneJson.h>
#include <visp3/avoidance/vpExactShapes.h>

#include <array>
#include <limits>
#include <optional>

namespace visp_python
{
const vpCollisionData &placed(const vpCollisionScene &scene, const vpJointVector &q)
{
  thread_local const auto data = std::make_unique<vpCollisionData>();
  checkJoints("q", q.size(), scene.arm().size());
  scene.place(q, *data);
  return *data;
}

namespace
{
using Scene = vpCollisionScene;

std::vector<Eigen::Vector3d> ends(const Scene &scene, const vpJointVector &q)
{
  const vpCollisionData &data = placed(scene, q);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < scene.capsuleCount() && data.placed; ++i) {
    points.push_back(data.capsules[static_cast<std::size_t>(i)].from);
    points.push_back(data.capsules[static_cast<std::size_t>(i)].to);
  }
  return points;
}

// A cube is a row: its centre and the length of an edge.
void bindOctree(py::module_ &m)
{
  bindClass<vpOctree>(m)
      .def(py::init([](const std::vector<Eigen::Vector4d> &cells, const std::string &label) {
             std::vector<vpOctreeCell> cubes;
             for (const Eigen::Vector4d &cell : cells) {
               cubes.push_back({cell.head<3>(), cell(3)});
             }
             return vpOctree(cubes, label);
           }),
           py::arg("cells"), py::arg("label") = "octree",
           "cells: cubes, one row each: centre in the map frame and length of an edge, m. label: for messages.")
      .def_static("load", &vpOctree::load, py::arg("file"), Unlocked(), doc("vpOctree::load"))
      .def(
          "cells",
          [](const vpOctree &self) {
            std::vector<Eigen::Vector4d> rows;
            for (const vpOctreeCell &cell : self.cells()) {
              rows.emplace_back(cell.centre(0), cell.centre(1), cell.centre(2), cell.size);
            }
            return rows;
          },
          "The cubes, one row each: centre and length of an edge, m.")
      .def("label", &vpOctree::label, doc("vpOctree::label"));
}

void bindShapes(py::module_ &m)
{
  using Mesh = vpTriangleMesh;
  using Shape = vpCollisionShape;
  constexpr auto copy = py::return_value_policy::copy;
  bindClass<Mesh>(m)
      .def(py::init([](const std::vector<Eigen::Vector3d> &vertices, const std::vector<std::array<int, 3>> &triangles,
                       const std::string &label) { return Mesh(vertices, triangles, label); }),
           py::arg("vertices"), py::arg("triangles"), py::arg("label") = "mesh", doc("vpTriangleMesh::vpTriangleMesh"))
      .def_static("load", py::overload_cast<const std::string &, double>(&Mesh::load), py::arg("file"),
                  py::arg("scale") = 1., Unlocked(), doc("vpTriangleMesh::load"))
      .def(
          "vertices", [](const Mesh &self) { return self.vertices(); }, doc("vpTriangleMesh::vertices"))
      .def(
          "triangles",
          [](const Mesh &self) {
            const std::vector<std::array<int, 3>> &triangles = self.triangles();
            return py::array_t<int>({static_cast<py::ssize_t>(triangles.size()), py::ssize_t(3)},
                                    triangles.front().data());
          },
          doc("vpTriangleMesh::triangles"))
      .def("isWatertight", &Mesh::isWatertight, doc("vpTriangleMesh::isWatertight"))
      .def("message", &Mesh::message, doc("vpTriangleMesh::message"))
      .def("label", &Mesh::label, doc("vpTriangleMesh::label"));
  bindOctree(m);
  bindEnum<vpShapeType>(m);
  bindEnum<vpMeshUse>(m);
  bindClass<Shape>(m)
      .def_static("sphere", &Shape::sphere, py::arg("radius"), doc("vpCollisionShape::sphere"))
      .def_static("capsule", &Shape::capsule, py::arg("radius"), py::arg("length"), doc("vpCollisionShape::capsule"))
      .def_static("box", &Shape::box, py::arg("size"), doc("vpCollisionShape::box"))
      .def_static("cylinder", &Shape::cylinder, py::arg("radius"), py::arg("length"), doc("vpCollisionShape::cylinder"))
      .def_static(
          "mesh", [](const Mesh &mesh, vpMeshUse use) { return Shape::mesh(mesh, use); }, py::arg("mesh"),
          py::arg("use") = vpMeshUse::Solid, doc("vpCollisionShape::mesh"))
      .def_static(
          "octree", [](const vpOctree &octree) { return Shape::octree(octree); }, py::arg("octree"),
          doc("vpCollisionShape::octree"))
      .def("type", &Shape::type, doc("vpCollisionShape::type"))
      .def("radius", &Shape::radius, doc("vpCollisionShape::radius"))
      .def("length", &Shape::length, doc("vpCollisionShape::length"))
      .def("size", &Shape::size, copy, doc("vpCollisionShape::size"))
      .def(
          "triangles",
          [](const Shape &self) -> std::optional<Mesh> {
            return self.type() == vpShapeType::Mesh ? std::optional<Mesh>(self.mesh()) : std::nullopt;
          },
          "The mesh of a shape of type Mesh; None for the others.")
      .def(
          "cubes",
          [](const Shape &self) -> std::optional<vpOctree> {
            return self.type() == vpShapeType::Octree ? std::optional<vpOctree>(self.octree()) : std::nullopt;
          },
          "The octree of a shape of type Octree; None for the others.");
  Bound<vpExactShapes, std::shared_ptr<vpExactShapes>>(m, "ExactShapes", doc("vpExactShapes"))
      .def(py::init<const vpArmModel &>(), py::arg("arm"), Unlocked(), doc("vpExactShapes::vpExactShapes"))
      .def("has", &vpExactShapes::has, py::arg("i"), doc("vpExactShapes::has"))
      .def("warnings", &vpExactShapes::warnings, copy, doc("vpExactShapes::warnings"));
}

void bindSpecs(py::module_ &m)
{
  bindStruct<vpCollisionObject>(m).def("poseAt", &vpCollisionObject::poseAt, py::arg("t"),
                                       doc("vpCollisionObject::poseAt"));
  bindStruct<vpHalfSpace>(m);
  bindStruct<vpAllowedContact>(m);
  bindStruct<vpCollisionSceneSpec>(m);
  bindStruct<vpSelfPair>(m);
  bindEnum<vpCollisionKind>(m);
  bindStruct<vpClearance>(m);
  bindStruct<vpMotionTask>(m);
  bindStruct<vpObjectPhoto>(m);
  bindStruct<vpCollisionSceneFile>(m);
  m.def("loadCollisionScene", &vpLoadCollisionScene, py::arg("file"), Unlocked(), doc("vpLoadCollisionScene"));
  bindStruct<vpArmCoverSpec>(m);
  bindStruct<vpBodyCover>(m);
  bindStruct<vpArmCover>(m, false);
  m.def("coverArm", &vpCoverArm, py::arg("arm"), py::arg("spec") = vpArmCoverSpec(), Unlocked(), doc("vpCoverArm"));
}

void bindCollisionScene(py::module_ &m)
{
  constexpr auto copy = py::return_value_policy::copy;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const std::string in = "vpCollisionScene::";
  const auto checked = [](const Scene &scene, int i) { return checkedIndex(i, scene.objectCount(), "object"); };
  bindClass<Scene>(m)
      .def(py::init<const vpArmModel &, const vpCollisionSceneSpec &>(), py::arg("arm"),
           py::arg("spec") = vpCollisionSceneSpec(), doc(in + "vpCollisionScene"))
      .def(
          "__copy__", [](const Scene &self) { return Scene(self); }, "A copy: the same arm, objects of its own.")
      .def("arm", &Scene::arm, copy, doc(in + "arm"))
      .def("capsuleCount", &Scene::capsuleCount, doc(in + "capsuleCount"))
      .def("selfPairs", &Scene::selfPairs, copy, doc(in + "selfPairs"))
      .def("ground", &Scene::ground, copy, doc(in + "ground"))
      .def("objectCount", &Scene::objectCount, doc(in + "objectCount"))
      .def(
          "object", [checked](const Scene &self, int i) { return self.object(checked(self, i)); }, py::arg("i"),
          doc(in + "object"))
      .def("find", &Scene::find, py::arg("name"), doc(in + "find"))
      .def("add", &Scene::add, py::arg("object"), doc(in + "add"))
      .def("remove", &Scene::remove, py::arg("i"), doc(in + "remove"))
      .def("moveObject", &Scene::moveObject, py::arg("i"), py::arg("pose"), doc(in + "moveObject"))
      .def("setVelocity", &Scene::setVelocity, py::arg("i"), py::arg("velocity"), doc(in + "setVelocity"))
      .def("setInflation", &Scene::setInflation, py::arg("i"), py::arg("inflation"), doc(in + "setInflation"))
      .def("advance", &Scene::advance, py::arg("dt"), doc(in + "advance"))
      .def("capsuleEnds", &ends, py::arg("q"),
           "Ends of the axes of the arm's capsules in the base, m: two rows for each capsule; none if q is invalid.")
      .def(
          "inCollision",
          [](const Scene &self, const vpJointVector &q, double margin, double time) {
            return self.inCollision(placed(self, q), margin, time);
          },
          py::arg("q"), py::arg("margin") = 0., py::arg("time") = 0., doc(in + "inCollision"))
      .def(
          "clearance",
          [](const Scene &self, const vpJointVector &q, double cutoff, double time) {
            return self.clearance(placed(self, q), cutoff, time);
          },
          py::arg("q"), py::arg("cutoff") = infinity, py::arg("time") = 0., doc(in + "clearance"))
      .def(
          "near",
          [](const Scene &self, const vpJointVector &q, double cutoff, double time) {
            const auto pairs = std::make_unique<vpNearPairs>();
            self.near(placed(self, q), cutoff, *pairs, time);
            return std::vector<vpClearance>(pairs->pairs.begin(), pairs->pairs.begin() + pairs->count);
          },
          py::arg("q"), py::arg("cutoff"), py::arg("time") = 0., doc(in + "near"))
      .def(
          "describe",
          [](const Scene &self, const vpClearance &pair) {
            using Kind = vpCollisionKind;
            if (pair.kind != Kind::None && pair.kind != Kind::Unknown) {
              checkedIndex(pair.capsule, self.capsuleCount(), "capsule");
            }
            if (pair.kind == Kind::Object || pair.kind == Kind::Self) {
              checkedIndex(pair.other, pair.kind == Kind::Object ? self.objectCount() : self.capsuleCount(),
                           "other part");
            }
            return self.describe(pair);
          },
          py::arg("pair"), doc(in + "describe"));
}
} // namespace

void bindScene(py::module_ &m)
{
  bindShapes(m);
  bindSpecs(m);
  bindCollisionScene(m);
}
} // namespace visp_python
