/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "casters.h"

#include <Eigen/LU>

#include <cmath>
#include <sstream>

namespace visp_python
{
static std::string text(py::handle object) { return py::str(object); }

std::string described(py::handle given)
{
  std::string type = py::str(py::type::handle_of(given).attr("__name__"));
  if (py::isinstance<py::array>(given)) {
    return "an array of shape " + text(given.attr("shape"));
  }
  return (type.find_first_of("aeiouAEIOU") == 0 ? "an " : "a ") + type;
}

Numbers numbers(py::handle given)
{
  if (py::isinstance<Numbers>(given)) {
    return py::reinterpret_borrow<Numbers>(given);
  }
  const py::array array = py::array::ensure(given);
  if (!array || std::string("iuf").find(array.dtype().kind()) == std::string::npos) {
    const std::string dtype = py::isinstance<py::array>(given) ? " with dtype " + text(array.dtype()) : "";
    throw py::type_error(described(given) + dtype + " was given, must be numbers");
  }
  return Numbers(array);
}

Numbers numbers(py::handle given, py::ssize_t rows, py::ssize_t columns)
{
  Numbers result = numbers(given);
  const bool flat = columns == 0;
  if (result.ndim() == (flat ? 1 : 2) && (rows < 0 || result.shape(0) == rows) &&
      (flat || columns < 0 || result.shape(1) == columns)) {
    return result;
  }
  const auto count = [](py::ssize_t n) { return n < 0 ? std::string("n") : std::to_string(n); };
  const std::string shape = "an array of shape " + text(result.attr("shape"));
  throw py::value_error(shape + " was given, must be " + count(rows) + (flat ? "" : " x " + count(columns)) +
                        " numbers");
}

Numbers poseNumbers(py::handle given)
{
  Numbers result = numbers(given, 4, 4);
  const Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> M(result.data());
  if (!M.allFinite()) {
    throw py::value_error("a pose was given that has a number that is not finite");
  }
  if (M(3, 0) != 0. || M(3, 1) != 0. || M(3, 2) != 0. || M(3, 3) != 1.) {
    throw py::value_error("a pose was given whose last row is not 0 0 0 1");
  }
  const Eigen::Matrix3d R = M.topLeftCorner<3, 3>();
  const double error = (R * R.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!(error <= 1e-6)) {
    std::ostringstream sentence;
    sentence << "a pose was given whose rotation is off by " << error << ", must be orthonormal to 1e-6";
    throw py::value_error(sentence.str());
  }
  if (R.determinant() < 0.) {
    throw py::value_error("a pose was given whose rotation is a reflection");
  }
  return result;
}

py::array_t<double> newArray(py::ssize_t size, const double *data) { return py::array_t<double>(size, data); }

py::array_t<double> newArray(py::ssize_t rows, py::ssize_t columns, const double *data)
{
  return py::array_t<double>({rows, columns}, data);
}

py::handle released(py::array array, py::return_value_policy policy)
{
  if (policy == py::return_value_policy::reference_internal) {
    py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  }
  return array.release();
}

py::array imagePixels(py::handle given, const py::dtype &dtype)
{
  if (!py::isinstance<py::array>(given)) {
    throw py::type_error(described(given) + " was given, an image is a 2-D array of " + text(dtype));
  }
  py::array pixels = py::reinterpret_borrow<py::array>(given);
  if (!pixels.dtype().equal(dtype)) {
    throw py::type_error("an image of " + text(pixels.dtype()) + " was given, must be " + text(dtype));
  }
  if (pixels.ndim() != 2 || pixels.size() == 0) {
    throw py::value_error(described(given) +
                          " was given, an image has 2 dimensions, rows and columns, and is not empty");
  }
  if (pixels.shape(0) > 65536 || pixels.shape(1) > 65536) {
    throw py::value_error(described(given) + " was given, an image has at most 65536 rows and columns");
  }
  if ((pixels.flags() & py::array::c_style) == 0) {
    pixels = py::array(pixels.attr("copy")("C"));
  }
  return pixels;
}
} // namespace visp_python
