/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file casters.h
 * \brief Arguments and results of the bindings as numpy arrays: vectors, matrices, poses, twists, images.
 *
 * What does not fit raises ValueError or TypeError with a sentence. A result is an array of its own; an array that is a
 * field of a struct is a copy that cannot be written to, so that `spec.home[0] = 1` is an error and not without effect.
 */
#ifndef casters_h
#define casters_h

#include <visp3/core/vpHomogeneousMatrix.h>
#include <visp3/core/vpImage.h>
#include <visp3/core/vpImagePoint.h>
#include <visp3/direct_core/vpTwist.h>
#include <visp3/manipulator/vpArmTypes.h>
#include <visp3/trajectory/vpPolynomial.h>

#include <Eigen/Core>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <string>
#include <type_traits>
#include <vector>

namespace visp_python
{
namespace py = pybind11;
using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;
template <class T> using ImageArray = py::array_t<T, py::array::c_style>;

//! "an array of shape (3, 4)", "a str": what was given, for messages.
std::string described(py::handle given);
//! Numbers of an array or a sequence; other dtypes than integers and floats are a TypeError.
Numbers numbers(py::handle given);
//! Numbers of a shape; -1: any length. \throw ValueError "an array of shape (3,) was given, must be 4 x 4 numbers".
Numbers numbers(py::handle given, py::ssize_t rows, py::ssize_t columns = 0);
//! The same, as a pose: checks that it is one.
Numbers poseNumbers(py::handle given);
//! A new array with these numbers.
py::array_t<double> newArray(py::ssize_t size, const double *data);
//! A new two-dimensional array, with these numbers (row-major) if given.
py::array_t<double> newArray(py::ssize_t rows, py::ssize_t columns, const double *data);
//! Array of a field: read-only when it belongs to a struct.
py::handle released(py::array array, py::return_value_policy policy);
//! Checks dtype, dimensions and size of an image; copies it only when its pixels are not in sequence.
py::array imagePixels(py::handle given, const py::dtype &dtype);
} // namespace visp_python

namespace pybind11
{
namespace detail
{
template <int R, int C, int O, int MR, int MC> struct type_caster<Eigen::Matrix<double, R, C, O, MR, MC>> {
  using Type = Eigen::Matrix<double, R, C, O, MR, MC>;
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  PYBIND11_TYPE_CASTER(Type, const_name("numpy.ndarray"));

  bool load(handle source, bool)
  {
    if (source.is_none()) {
      return false;
    }
    const auto given = visp_python::numbers(source, R, C == 1 ? 0 : C);
    const ssize_t rows = given.shape(0), columns = C == 1 ? 1 : given.shape(1);
    if ((MR != Eigen::Dynamic && rows > MR) || (MC != Eigen::Dynamic && columns > MC)) {
      throw value_error(visp_python::described(source) + " was given, has more than " + std::to_string(MR) +
                        " numbers");
    }
    value = Eigen::Map<const RowMajor>(given.data(), rows, columns);
    return true;
  }
  static handle cast(const Type &m, return_value_policy policy, handle)
  {
    auto array = C == 1 ? visp_python::newArray(m.rows(), nullptr) : visp_python::newArray(m.rows(), m.cols(), nullptr);
    Eigen::Map<RowMajor>(array.mutable_data(), m.rows(), m.cols()) = m;
    return visp_python::released(std::move(array), policy);
  }
};

//! A list of vectors is an array with one vector a row.
template <int R, int O, int MR> struct type_caster<std::vector<Eigen::Matrix<double, R, 1, O, MR, 1>>> {
  using Row = Eigen::Matrix<double, R, 1, O, MR, 1>;
  using Type = std::vector<Row>;
  PYBIND11_TYPE_CASTER(Type, const_name("numpy.ndarray"));

  bool load(handle source, bool)
  {
    if (source.is_none()) {
      return false;
    }
    const auto given = visp_python::numbers(source, -1, R);
    if (MR != Eigen::Dynamic && given.shape(1) > MR) {
      throw value_error(visp_python::described(source) + " was given, a row has more than " + std::to_string(MR) +
                        " numbers");
    }
    value.clear();
    for (ssize_t i = 0; i < given.shape(0); ++i) {
      value.push_back(Eigen::Map<const Eigen::VectorXd>(given.data(i), given.shape(1)));
    }
    return true;
  }
  static handle cast(const Type &rows, return_value_policy policy, handle)
  {
    const ssize_t columns = rows.empty() ? (R > 0 ? R : 0) : static_cast<ssize_t>(rows.front().size());
    auto array = visp_python::newArray(static_cast<ssize_t>(rows.size()), columns, nullptr);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (rows[i].size() != columns) {
        throw value_error("the configurations do not have equal sizes");
      }
      std::copy_n(rows[i].data(), columns, array.mutable_data() + static_cast<ssize_t>(i) * columns);
    }
    return visp_python::released(std::move(array), policy);
  }
};

template <std::size_t N> struct type_caster<std::array<double, N>> {
  using Type = std::array<double, N>;
  PYBIND11_TYPE_CASTER(Type, const_name("numpy.ndarray"));

  bool load(handle source, bool)
  {
    if (source.is_none()) {
      return false;
    }
    std::copy_n(visp_python::numbers(source, N).data(), N, value.data());
    return true;
  }
  static handle cast(const Type &x, return_value_policy policy, handle)
  {
    return visp_python::released(visp_python::newArray(N, x.data()), policy);
  }
};

template <> struct type_caster<vpTwist> {
  PYBIND11_TYPE_CASTER(vpTwist, const_name("numpy.ndarray"));

  bool load(handle source, bool)
  {
    if (source.is_none()) {
      return false;
    }
    std::copy_n(visp_python::numbers(source, 6).data(), 6, value.data());
    return true;
  }
  static handle cast(const vpTwist &v, return_value_policy policy, handle)
  {
    return visp_python::released(visp_python::newArray(6, v.data()), policy);
  }
};

template <> struct type_caster<vpPolynomial> { // coefficients, constant first
  PYBIND11_TYPE_CASTER(vpPolynomial, const_name("numpy.ndarray"));

  bool load(handle source, bool)
  {
    if (source.is_none()) {
      return false;
    }
    const auto given = visp_python::numbers(source, -1);
    const ssize_t count = given.shape(0);
    if (count < 1 || count > vpPolynomial::maxDegree + 1) {
      throw value_error(visp_python::described(source) + " was given, a polynomial has 1 to 15 coefficients");
    }
    value.setDegree(static_cast<int>(count) - 1);
    for (int k = 0; k < count; ++k) {
      value[k] = given.at(k);
    }
    return true;
  }
  static handle cast(const vpPolynomial &p, return_value_policy policy, handle)
  {
    return visp_python::released(visp_python::newArray(p.degree() + 1, p.data()), policy);
  }
};

template <> struct type_caster<vpRigidTransform> {
  PYBIND11_TYPE_CASTER(vpRigidTransform, const_name("numpy.ndarray"));

  bool load(handle source, bool)
  {
    if (source.is_none()) {
      return false;
    }
    const auto given = visp_python::poseNumbers(source);
    const Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> M(given.data());
    value = {M.topLeftCorner<3, 3>(), M.topRightCorner<3, 1>()};
    return true;
  }
  static handle cast(const vpRigidTransform &M, return_value_policy policy, handle)
  {
    auto array = visp_python::newArray(4, 4, nullptr);
    Eigen::Map<Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> numbers(array.mutable_data());
    numbers << M.R, M.p, 0., 0., 0., 1.;
    return visp_python::released(std::move(array), policy);
  }
};

template <> struct type_caster<vpHomogeneousMatrix> {
  PYBIND11_TYPE_CASTER(vpHomogeneousMatrix, const_name("numpy.ndarray"));

  bool load(handle source, bool)
  {
    if (source.is_none()) {
      return false;
    }
    std::copy_n(visp_python::poseNumbers(source).data(), 16, value.data);
    return true;
  }
  static handle cast(const vpHomogeneousMatrix &M, return_value_policy policy, handle)
  {
    return visp_python::released(visp_python::newArray(4, 4, M.data), policy);
  }
};

//! Corners and other image positions: one row (u, v) each, px.
template <std::size_t N> struct type_caster<std::array<vpImagePoint, N>> {
  using Type = std::array<vpImagePoint, N>;
  PYBIND11_TYPE_CASTER(Type, const_name("numpy.ndarray"));

  bool load(handle source, bool)
  {
    if (source.is_none()) {
      return false;
    }
    const auto given = visp_python::numbers(source, N, 2);
    for (std::size_t i = 0; i < N; ++i) {
      value[i] = vpImagePoint(given.at(i, 1), given.at(i, 0));
    }
    return true;
  }
  static handle cast(const Type &points, return_value_policy policy, handle)
  {
    auto array = visp_python::newArray(N, 2, nullptr);
    for (std::size_t i = 0; i < N; ++i) {
      array.mutable_at(i, 0) = points[i].get_u();
      array.mutable_at(i, 1) = points[i].get_v();
    }
    return visp_python::released(std::move(array), policy);
  }
};

//! An image is the array's own memory, seen by vpImage: nothing is copied when its pixels are in sequence. A result is a copy.
template <class Pixel> struct type_caster<vpImage<Pixel>> {
  static constexpr auto name = const_name("numpy.ndarray");
  template <class> using cast_op_type = const vpImage<Pixel> &;

  bool load(handle source, bool)
  {
    if (source.is_none()) {
      return false;
    }
    m_pixels = visp_python::imagePixels(source, dtype::of<Pixel>());
    m_image.init(static_cast<Pixel *>(const_cast<void *>(m_pixels.data())),
                 static_cast<unsigned int>(m_pixels.shape(0)), static_cast<unsigned int>(m_pixels.shape(1)), false);
    return true;
  }
  operator const vpImage<Pixel> &() const { return m_image; }
  static handle cast(const vpImage<Pixel> &image, return_value_policy policy, handle)
  {
    array_t<Pixel> pixels({image.getHeight(), image.getWidth()});
    std::copy_n(image.bitmap, image.getSize(), pixels.mutable_data());
    return visp_python::released(std::move(pixels), policy);
  }

private:
  array m_pixels; // keeps the memory
  vpImage<Pixel> m_image;
};
} // namespace detail
} // namespace pybind11
#endif
