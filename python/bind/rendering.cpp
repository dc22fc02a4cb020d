/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Rendered images: a photograph in a plane, an endless product, and a scene of obstacles, grey or as depths.
#include "records.h"

#include <visp3/avoidance/vpCollisionScene.h>
#include <visp3/core/vpCameraParameters.h>
#include <visp3/rendering/vpPlaneRenderer.h>
#include <visp3/rendering/vpProductPattern.h>
#include <visp3/rendering/vpSceneCamera.h>

namespace visp_python
{
namespace
{
using Grey = vpImage<unsigned char>;
constexpr auto copy = py::return_value_policy::copy;

void bindPlane(py::module_ &m)
{
  using Renderer = vpPlaneRenderer;
  bindSpec<vpCameraFaults>(m);
  bindClass<Renderer>(m)
      .def(py::init<const Grey &, double, double, const vpCameraParameters &, unsigned int, unsigned int>(),
           py::arg("photo"), py::arg("objectWidth"), py::arg("objectHeight"), py::arg("camera"), py::arg("width"),
           py::arg("height"), doc("vpPlaneRenderer::vpPlaneRenderer"))
      .def(
          "render",
          [](Renderer &self, const vpHomogeneousMatrix &cMo, const vpCameraFaults &faults, unsigned int seed) {
            Grey image;
            self.render(cMo, faults, seed, image);
            return image;
          },
          py::arg("cMo"), py::arg("faults") = vpCameraFaults(), py::arg("seed") = 1, Unlocked(),
          doc("vpPlaneRenderer::render"));
}

void bindProduct(py::module_ &m)
{
  using Product = vpProductPattern;
  bindEnum<vpProductShape>(m);
  bindSpec<vpProductPatternSpec>(m);
  bindRecord<vpPatternTruthCell>(m);
  bindClass<Product>(m)
      .def(py::init<const vpProductPatternSpec &>(), py::arg("spec") = vpProductPatternSpec(),
           doc("vpProductPattern::vpProductPattern"))
      .def("spec", &Product::spec, copy, doc("vpProductPattern::spec"))
      .def(
          "render",
          [](const Product &self, double x, double y, double vx, double vy, unsigned int frame) {
            Grey image;
            self.render(x, y, vx, vy, frame, image);
            return image;
          },
          py::arg("x"), py::arg("y"), py::arg("vx") = 0., py::arg("vy") = 0., py::arg("frame") = 0, Unlocked(),
          doc("vpProductPattern::render"))
      .def(
          "expected",
          [](const Product &self, double x, double y, double vx, double vy) {
            vpImage<float> image;
            self.expected(x, y, vx, vy, image);
            return image;
          },
          py::arg("x"), py::arg("y"), py::arg("vx") = 0., py::arg("vy") = 0., Unlocked(),
          doc("vpProductPattern::expected"))
      .def(
          "cells",
          [](const Product &self, double x, double y) {
            const std::vector<vpPatternTruthCell> cells = self.cells(x, y);
            return records(cells.data(), cells.size());
          },
          py::arg("x"), py::arg("y"),
          "True positions of all cells whose centre is in the image, an array of dtype PatternTruthCell, by row, then "
          "by column;\nmissing cells included. x, y: displacement of the product, px, as for render().");
}

void bindSceneCamera(py::module_ &m)
{
  using Camera = vpSceneCamera;
  bindStruct<vpScenePhoto>(m, false).def(
      py::init([](const std::string &object, const Grey &image, const Eigen::Vector2d &size) {
        return vpScenePhoto{object, image, size};
      }),
      py::arg("object"), py::arg("image"), py::arg("size"), "The fields.");
  bindStruct<vpSceneCameraSpec>(m);
  bindSpec<vpDepthFaults>(m);
  bindClass<Camera>(m)
      .def(py::init<const vpSceneCameraSpec &>(), py::arg("spec") = vpSceneCameraSpec(),
           doc("vpSceneCamera::vpSceneCamera"))
      .def("spec", &Camera::spec, copy, doc("vpSceneCamera::spec"))
      .def(
          "picture",
          [](Camera &self, const vpCollisionScene &scene, const vpRigidTransform &fMc, const vpCameraFaults &faults,
             unsigned int seed) {
            Grey image;
            self.picture(scene, fMc, faults, seed, image);
            return image;
          },
          py::arg("scene"), py::arg("fMc"), py::arg("faults") = vpCameraFaults(), py::arg("seed") = 1, Unlocked(),
          doc("vpSceneCamera::picture"))
      .def(
          "depth",
          [](Camera &self, const vpCollisionScene &scene, const vpRigidTransform &fMc, const vpDepthFaults &faults,
             unsigned int seed) {
            vpImage<float> image;
            self.depth(scene, fMc, faults, seed, image);
            return image;
          },
          py::arg("scene"), py::arg("fMc"), py::arg("faults") = vpDepthFaults(), py::arg("seed") = 1, Unlocked(),
          doc("vpSceneCamera::depth"));
}
} // namespace

void bindRendering(py::module_ &m)
{
  bindPlane(m);
  bindProduct(m);
  bindSceneCamera(m);
}
} // namespace visp_python
