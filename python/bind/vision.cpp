/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "records.h"

#include <visp3/pattern/vpPatternTracker.h>
#include <visp3/pattern/vpPlanarMicroscopeCalibration.h>
#include <visp3/pattern/vpTsaiCalibration.h>
#include <visp3/planar_target/vpPlanarTargetDatabase.h>
#include <visp3/core/vpCameraParameters.h>

#include <cmath>

namespace visp_python
{
namespace
{
using Image = vpImage<unsigned char>;

vpCameraParameters camera(double px, double py, double u0, double v0, double kud, double kdu)
{
  for (double x : {px, py, u0, v0, kud, kdu}) {
    if (!std::isfinite(x)) {
      throw py::value_error("a number of the camera is not finite");
    }
  }
  if (px <= 0. || py <= 0.) {
    throw py::value_error("px and py of the camera are " + std::to_string(px) + " and " + std::to_string(py) +
                          ", must be > 0");
  }
  vpCameraParameters made;
  if (kud != 0. || kdu != 0.) {
    made.initPersProjWithDistortion(px, py, u0, v0, kud, kdu);
  }
  else {
    made.initPersProjWithoutDistortion(px, py, u0, v0);
  }
  return made;
}

void bindCamera(py::module_ &m)
{
  using Camera = vpCameraParameters;
  Bound<Camera>(m, "CameraParameters",
                "Intrinsics of a camera, px: vpCameraParameters of ViSP. kud and kdu, px^-2: its distortion.")
      .def(py::init(&camera), py::arg("px"), py::arg("py"), py::arg("u0"), py::arg("v0"), py::arg("kud") = 0.,
           py::arg("kdu") = 0.,
           "Focal length over the width and height of a pixel, and principal point, px; without kud and kdu no "
           "distortion.")
      .def_property_readonly("px", &Camera::get_px, "Focal length over the width of a pixel, px.")
      .def_property_readonly("py", &Camera::get_py, "Focal length over the height of a pixel, px.")
      .def_property_readonly("u0", &Camera::get_u0, "Principal point, px to the right.")
      .def_property_readonly("v0", &Camera::get_v0, "Principal point, px down.")
      .def_property_readonly("kud", &Camera::get_kud, "Distortion from undistorted to distorted positions.")
      .def_property_readonly("kdu", &Camera::get_kdu, "Distortion from distorted to undistorted positions.");
}

void bindCovariance(py::module_ &m)
{
  bindStruct<vpPoseCovariance>(m)
      .def_property(
          "C", [](const vpPoseCovariance &self) { return newArray(6, 6, self.C.data()); },
          [](vpPoseCovariance &self, const Eigen::Matrix<double, 6, 6> &C) {
            Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(self.C.data()) = C;
          },
          doc("vpPoseCovariance::C"))
      .def("positionDeviation", &vpPoseCovariance::positionDeviation, doc("vpPoseCovariance::positionDeviation"))
      .def("rotationDeviation", &vpPoseCovariance::rotationDeviation, doc("vpPoseCovariance::rotationDeviation"));
}

void bindPlanarTarget(py::module_ &m)
{
  using Target = vpPlanarTarget;
  using Result = vpPlanarTargetResult;
  constexpr auto copy = py::return_value_policy::copy;
  bindEnum<vpKeypointType>(m);
  bindEnum<vpPlanarTargetStatus>(m);
  bindSpec<vpPlanarTargetSpec>(m);
  bindStruct<vpPlanarTargetEffort>(m);
  bindStruct<vpPlanarTargetRival>(m);
  bindStruct<Result>(m)
      .def_property_readonly(
          "homography", [](const Result &self) { return newArray(3, 3, self.homography.data()); },
          doc("vpPlanarTargetResult::homography"))
      .def("found", &Result::found, doc("vpPlanarTargetResult::found"));
  bindStruct<vpPlanarTargetSighting>(m);
  bindClass<Target>(m)
      .def(py::init<const Image &, double, double, const vpCameraParameters &, const vpPlanarTargetSpec &>(),
           py::arg("reference"), py::arg("width"), py::arg("height"), py::arg("camera"),
           py::arg("spec") = vpPlanarTargetSpec(), Unlocked(), doc("vpPlanarTarget::vpPlanarTarget"))
      .def("process", &Target::process, py::arg("image"), copy, Unlocked(), doc("vpPlanarTarget::process"))
      .def("acquire", &Target::acquire, py::arg("image"), copy, Unlocked(), doc("vpPlanarTarget::acquire"))
      .def(
          "track",
          [](Target &self, const Image &image, const std::optional<vpHomogeneousMatrix> &guess) {
            return guess ? self.track(image, *guess) : self.track(image);
          },
          py::arg("image"), py::arg("cMoGuess") = std::nullopt, Unlocked(),
          "Track only, from the last pose or from cMoGuess.")
      .def("reset", &Target::reset, doc("vpPlanarTarget::reset"))
      .def("result", &Target::result, copy, doc("vpPlanarTarget::result"))
      .def("width", &Target::width, doc("vpPlanarTarget::width"))
      .def("height", &Target::height, doc("vpPlanarTarget::height"));

  using Database = vpPlanarTargetDatabase;
  bindClass<Database>(m)
      .def(py::init<const vpCameraParameters &, const vpPlanarTargetSpec &>(), py::arg("camera"),
           py::arg("spec") = vpPlanarTargetSpec(), doc("vpPlanarTargetDatabase::vpPlanarTargetDatabase"))
      .def_static("fromFolder", &Database::fromFolder, py::arg("folder"), py::arg("camera"),
                  py::arg("spec") = vpPlanarTargetSpec(), Unlocked(), doc("vpPlanarTargetDatabase::fromFolder"))
      .def("add", &Database::add, py::arg("name"), py::arg("reference"), py::arg("width"), py::arg("height"),
           py::arg("depth") = 0., Unlocked(), doc("vpPlanarTargetDatabase::add"))
      .def("__len__", &Database::size, doc("vpPlanarTargetDatabase::size"))
      .def("process", &Database::process, py::arg("image"), copy, Unlocked(), doc("vpPlanarTargetDatabase::process"))
      .def("effort", &Database::effort, copy, doc("vpPlanarTargetDatabase::effort"))
      .def("sightings", &Database::sightings, copy, doc("vpPlanarTargetDatabase::sightings"))
      .def(
          "predict",
          [](Database &self, int i, const vpHomogeneousMatrix &cMo) {
            const int index = checkedIndex(i, static_cast<int>(self.size()), "target");
            self.predict(static_cast<std::size_t>(index), cMo);
          },
          py::arg("i"), py::arg("cMo"), doc("vpPlanarTargetDatabase::predict"))
      .def("reset", &Database::reset, doc("vpPlanarTargetDatabase::reset"));
}

void bindTracker(py::module_ &m)
{
  using Tracker = vpPatternTracker;
  constexpr auto copy = py::return_value_policy::copy;
  bindEnum<vpPatternStatus>(m);
  bindEnum<vpPatternReason>(m);
  bindEnum<vpPatternMethod>(m);
  bindEnum<vpPatternThreshold>(m);
  bindEnum<vpPatternDerivative>(m);
  bindEnum<vpPatternPolarity>(m);
  bindStruct<vpPatternTrackerSpec>(m).def("check", &vpPatternTrackerSpec::check, doc("vpPatternTrackerSpec::check"));
  bindStruct<vpPatternLattice>(m)
      .def("columnPitch", &vpPatternLattice::columnPitch, doc("vpPatternLattice::columnPitch"))
      .def("rowPitch", &vpPatternLattice::rowPitch, doc("vpPatternLattice::rowPitch"))
      .def("angle", &vpPatternLattice::angle, doc("vpPatternLattice::angle"));
  bindStruct<vpPatternFrame>(m)
      .def_property(
          "cells", [](const vpPatternFrame &frame) { return records(frame.cells.data(), frame.cells.size()); },
          [](vpPatternFrame &frame, const py::object &cells) { frame.cells = fromRecords<vpPatternCell>(cells); },
          doc("vpPatternFrame::cells"))
      .def("message", &vpPatternFrame::message, doc("vpPatternFrame::message"));
  bindClass<Tracker>(m)
      .def(py::init<unsigned int, unsigned int, const vpPatternTrackerSpec &>(), py::arg("width"), py::arg("height"),
           py::arg("spec") = vpPatternTrackerSpec(), doc("vpPatternTracker::vpPatternTracker"))
      .def("process", &Tracker::process, py::arg("image"), copy, Unlocked(), doc("vpPatternTracker::process"))
      .def("frame", &Tracker::frame, copy, doc("vpPatternTracker::frame"))
      .def("spec", &Tracker::spec, copy, doc("vpPatternTracker::spec"))
      .def("interrupt", &Tracker::interrupt, doc("vpPatternTracker::interrupt"))
      .def("reset", &Tracker::reset, doc("vpPatternTracker::reset"));
}

template <class Calibration, class Spec> Bound<Calibration> bindCalibration(py::module_ &m, const std::string &name)
{
  return bindClass<Calibration>(m)
      .def(py::init<unsigned int, unsigned int, const Spec &>(), py::arg("width"), py::arg("height"),
           py::arg("spec") = Spec(), doc(name + "::" + name))
      .def(
          "addView",
          [](Calibration &self, const py::object &points) { self.addView(fromRecords<vpCalibrationPoint>(points)); },
          py::arg("points"), doc(name + "::addView"))
      .def("viewCount", &Calibration::viewCount, doc(name + "::viewCount"))
      .def("compute", &Calibration::compute, Unlocked(), doc(name + "::compute"));
}

// The enums name their number of parameters, too.
template <class Parameter> Parameter checkedParameter(Parameter parameter, Parameter count)
{
  return static_cast<Parameter>(checkedIndex(parameter, count, "parameter"));
}

void bindCalibrations(py::module_ &m)
{
  bindEnum<vpFitVerdict>(m);
  bindStruct<vpFitTest>(m).def("message", &vpFitTest::message, py::arg("varianceFactor"), doc("vpFitTest::message"));
  bindStruct<vpCalibrationPitch>(m).def("check", &vpCalibrationPitch::check, doc("vpCalibrationPitch::check"));
  const auto fromFrame = [](const vpPatternFrame &frame, const vpCalibrationPitch &pitch) {
    const std::vector<vpCalibrationPoint> points = vpCalibrationPoints(frame, pitch);
    return records(points.data(), points.size());
  };
  const auto fromImage = [](const Image &image, const vpCalibrationPitch &pitch) {
    const std::vector<vpCalibrationPoint> points = vpCalibrationPoints(image, pitch);
    return records(points.data(), points.size());
  };
  m.def("calibrationPoints", fromFrame, py::arg("frame"), py::arg("pitch"), doc("vpCalibrationPoints"));
  m.def("calibrationPoints", fromImage, py::arg("image"), py::arg("pitch"),
        "The dots of a grid in an image as calibration points: an array with the fields of a CalibrationPoint.");

  bindEnum<vpKappa1Status>(m);
  bindStruct<vpMicroscopeCalibrationSpec>(m).def("check", &vpMicroscopeCalibrationSpec::check,
                                                 doc("vpMicroscopeCalibrationSpec::check"));
  bindStruct<vpMicroscopeCalibration>(m)
      .def("toPlane", &vpMicroscopeCalibration::toPlane, py::arg("u"), py::arg("v"),
           doc("vpMicroscopeCalibration::toPlane"))
      .def("toImage", &vpMicroscopeCalibration::toImage, py::arg("x"), py::arg("y"),
           doc("vpMicroscopeCalibration::toImage"))
      .def("pixelSizeUm", &vpMicroscopeCalibration::pixelSizeUm, doc("vpMicroscopeCalibration::pixelSizeUm"))
      .def("toCamera", &vpMicroscopeCalibration::toCamera, doc("vpMicroscopeCalibration::toCamera"));
  bindStruct<vpMicroscopePlacement>(m);
  bindEnum<vpMicroscopeParameter>(m);
  bindStruct<vpMicroscopeCalibrationResult>(m).def(
      "sigma",
      [](const vpMicroscopeCalibrationResult &self, vpMicroscopeParameter parameter) {
        return self.sigma(checkedParameter(parameter, vpMicroscopeParameterCount));
      },
      py::arg("parameter"), doc("vpMicroscopeCalibrationResult::sigma"));
  bindCalibration<vpPlanarMicroscopeCalibration, vpMicroscopeCalibrationSpec>(m, "vpPlanarMicroscopeCalibration");

  bindStruct<vpTsaiCalibrationSpec>(m).def("check", &vpTsaiCalibrationSpec::check, doc("vpTsaiCalibrationSpec::check"));
  bindEnum<vpTsaiParameter>(m);
  bindStruct<vpTsaiCalibrationResult>(m)
      .def(
          "sigma",
          [](const vpTsaiCalibrationResult &self, vpTsaiParameter parameter) {
            return self.sigma(checkedParameter(parameter, vpTsaiParameterCount));
          },
          py::arg("parameter"), doc("vpTsaiCalibrationResult::sigma"))
      .def("toCamera", &vpTsaiCalibrationResult::toCamera, doc("vpTsaiCalibrationResult::toCamera"));
  bindCalibration<vpTsaiCalibration, vpTsaiCalibrationSpec>(m, "vpTsaiCalibration");
}
} // namespace

void bindVision(py::module_ &m)
{
  bindCamera(m);
  bindCovariance(m);
  bindPlanarTarget(m);
  bindRecord<vpPatternCell>(m);
  bindRecord<vpCalibrationPoint>(m);
  bindTracker(m);
  bindCalibrations(m);
}
} // namespace visp_python
