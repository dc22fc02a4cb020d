/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file records.h
 * \brief Many small structs as one numpy array with named fields: `frame.cells["x"]`.
 */
#ifndef records_h
#define records_h

#include "binding.h"

#include <cstring>

namespace visp_python
{
//! The dtype of a struct of numbers, with the names of its fields.
template <class T> const py::dtype &recordType()
{
  static const py::dtype *const type = [] {
    py::list names, formats, offsets;
    const T sample{};
    Reflect<T>::each([&](const char *name, auto member, const char *) {
      names.append(name);
      formats.append(py::dtype::of<std::decay_t<decltype(sample.*member)>>());
      offsets.append(reinterpret_cast<const char *>(&(sample.*member)) - reinterpret_cast<const char *>(&sample));
    });
    return new py::dtype(names, formats, offsets, sizeof(T)); // never freed: Python may be gone before
  }();
  return *type;
}

//! Makes the dtype known as the struct's name.
template <class T> void bindRecord(py::module_ &m) { m.attr(Reflect<T>::name) = recordType<T>(); }

//! A new array with these elements.
template <class T> py::array records(const T *first, std::size_t count)
{
  py::array array(recordType<T>(), std::vector<py::ssize_t>{static_cast<py::ssize_t>(count)});
  if (count > 0) {
    std::memcpy(array.mutable_data(), first, count * sizeof(T));
  }
  return array;
}

//! The elements of such an array. \throw TypeError naming the dtype that is needed.
template <class T> std::vector<T> fromRecords(const py::object &given)
{
  if (!py::isinstance<py::array>(given) || !given.cast<py::array>().dtype().equal(recordType<T>())) {
    throw py::type_error(described(given) + " was given, must be an array of dtype visp_direct." + Reflect<T>::name);
  }
  const py::array array = py::array::ensure(given, py::array::c_style);
  if (array.ndim() != 1) {
    throw py::value_error(described(given) + " was given, must have one dimension");
  }
  std::vector<T> elements(static_cast<std::size_t>(array.size()));
  if (!elements.empty()) {
    std::memcpy(static_cast<void *>(elements.data()), array.data(), elements.size() * sizeof(T));
  }
  return elements;
}
} // namespace visp_python
#endif
