/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Obstacles as sensors see them: found in images, tracks of objects, and maps from depth images.
#include "scene.h"

#include <visp3/avoidance/vpDepthObstacles.h>
#include <visp3/avoidance/vpObjectTracks.h>
#include <visp3/avoidance/vpObstacleDetector.h>
#include <visp3/core/vpCameraParameters.h>

#include <optional>
#include <utility>

namespace visp_python
{
namespace
{
using Depth = vpImage<float>;

const vpCollisionData &placedAt(const vpCollisionScene &scene, const vpJointVector &q)
{
  const vpCollisionData &data = placed(scene, q);
  if (!data.placed) {
    throw py::value_error("q has a number that is not finite or beyond 1e+09");
  }
  return data;
}

void bindTracks(py::module_ &m)
{
  using Tracks = vpObjectTracks;
  bindEnum<vpTrackStatus>(m);
  bindStruct<vpObjectSighting>(m);
  bindSpec<vpObjectTrackSpec>(m);
  bindStruct<vpObjectTrack>(m);
  bindClass<Tracks>(m)
      .def(py::init<const vpObjectTrackSpec &>(), py::arg("spec") = vpObjectTrackSpec(),
           doc("vpObjectTracks::vpObjectTracks"))
      .def("add", &Tracks::add, py::arg("sighting"), doc("vpObjectTracks::add"))
      .def("advance", &Tracks::advance, py::arg("now"), doc("vpObjectTracks::advance"))
      .def("tracks", &Tracks::tracks, py::return_value_policy::copy, doc("vpObjectTracks::tracks"))
      .def(
          "find",
          [](const Tracks &self, const std::string &name) -> std::optional<vpObjectTrack> {
            const vpObjectTrack *track = self.find(name);
            return track ? std::optional<vpObjectTrack>(*track) : std::nullopt;
          },
          py::arg("name"), "Track of that name; None if there is none.")
      .def("applyTo", &Tracks::applyTo, py::arg("scene"), doc("vpObjectTracks::applyTo"));
}

void bindDepth(py::module_ &m)
{
  using Map = vpDepthOctomap;
  using Obstacles = vpDepthObstacles;
  bindEnum<vpDepthStatus>(m);
  bindStruct<vpDepthOctomapSpec>(m);
  bindStruct<vpDepthReport>(m).def("message", &vpDepthReport::message, doc("vpDepthReport::message"));
  bindClass<Map>(m)
      .def(py::init<const vpDepthOctomapSpec &>(), py::arg("spec") = vpDepthOctomapSpec(),
           doc("vpDepthOctomap::vpDepthOctomap"))
      .def(
          "insert",
          [](Map &self, const Depth &depth, const vpCameraParameters &camera, const vpRigidTransform &fMc,
             const vpCollisionScene *scene, const std::optional<vpJointVector> &q) {
            if ((scene != nullptr) != q.has_value()) {
              throw py::value_error("scene and q are given both, or none of them");
            }
            return scene ? self.insert(depth, camera, fMc, *scene, placedAt(*scene, *q))
                         : self.insert(depth, camera, fMc);
          },
          py::arg("depth"), py::arg("camera"), py::arg("fMc"), py::arg("scene") = py::none(),
          py::arg("q") = std::nullopt, Unlocked(),
          "Adds an image; with scene and q without the points on the arm. depth: along the optical axis, m, a 2-D "
          "array "
          "of float32;\n"
          "<= 0, infinite or NaN where there is none. camera: intrinsics of the depth image. fMc: camera in the base "
          "when "
          "it was taken.\n"
          "scene: with the arm's capsules. q: configuration of the arm when it was taken.")
      .def("clear", &Map::clear, doc("vpDepthOctomap::clear"))
      .def("snapshot", &Map::snapshot, doc("vpDepthOctomap::snapshot"))
      .def("save", &Map::save, py::arg("file"), Unlocked(), doc("vpDepthOctomap::save"));
  bindStruct<vpDepthObstaclesSpec>(m)
      .def_static("defaultMap", &vpDepthObstaclesSpec::defaultMap, doc("vpDepthObstaclesSpec::defaultMap"))
      .def("validate", &vpDepthObstaclesSpec::validate, doc("vpDepthObstaclesSpec::validate"));
  bindClass<Obstacles>(m)
      .def(py::init<const vpDepthObstaclesSpec &>(), py::arg("spec") = vpDepthObstaclesSpec(),
           doc("vpDepthObstacles::vpDepthObstacles"))
      .def(
          "insert",
          [](Obstacles &self, const Depth &depth, const vpCameraParameters &camera, const vpRigidTransform &fMc,
             const vpCollisionScene &scene,
             const vpJointVector &q) { return self.insert(depth, camera, fMc, scene, placedAt(scene, q)); },
          py::arg("depth"), py::arg("camera"), py::arg("fMc"), py::arg("scene"), py::arg("q"), Unlocked(),
          "Adds a depth image. depth, camera, fMc, q: as for DepthOctomap.insert(). scene: objects known when the "
          "image "
          "was taken (as\n"
          "perceived), and the arm.")
      .def("applyTo", &Obstacles::applyTo, py::arg("scene"), doc("vpDepthObstacles::applyTo"))
      .def(
          "snapshot", [](const Obstacles &self) { return self.map().snapshot(); }, doc("vpDepthOctomap::snapshot"))
      .def("clear", &Obstacles::clear, doc("vpDepthObstacles::clear"));
}

void bindDetector(py::module_ &m)
{
  using Detector = vpObstacleDetector;
  using Targets = vpPlanarTargetDatabase;
  const std::string in = "vpObstacleDetector::";
  constexpr auto copy = py::return_value_policy::copy;
  bindSpec<vpObstacleDetectorSpec>(m);
  bindStruct<vpObstacleDetection>(m);
  bindClass<Detector>(m)
      .def(py::init([](Targets &targets, const vpCameraParameters &camera, const vpObstacleDetectorSpec &spec) {
             spec.validate();
             return std::make_unique<Detector>(std::exchange(targets, Targets(camera)), camera, spec);
           }),
           py::arg("targets"), py::arg("camera"), py::arg("spec") = vpObstacleDetectorSpec(),
           "targets: the photographs, of a database made for camera; they move into the detector, and the database is\n"
           "empty afterwards. camera: intrinsics of the images. spec: parameters.")
      .def_static("fastTargets", &Detector::fastTargets, doc(in + "fastTargets"))
      .def("process", &Detector::process, py::arg("image"), py::arg("fMc"), py::arg("time"), copy, Unlocked(),
           doc(in + "process"))
      .def("detections", &Detector::detections, copy, doc(in + "detections"))
      .def("targets", &Detector::targets, copy, doc(in + "targets"))
      .def("reset", &Detector::reset, doc(in + "reset"));
}
} // namespace

void bindPerception(py::module_ &m)
{
  bindTracks(m);
  bindDetector(m);
  bindDepth(m);
}
} // namespace visp_python
