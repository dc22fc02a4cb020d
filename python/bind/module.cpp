/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#define VISP_DIRECT_DOCSTRINGS
#include "scene.h"

#include <visp3/core/vpException.h>
#include <visp3/robot/vpRobotException.h>

#include <algorithm>
#include <stdexcept>

namespace visp_python
{
const char *doc(const std::string &name)
{
  const auto *found =
      std::find_if(std::begin(docstrings), std::end(docstrings), [&](auto &row) { return name == row[0]; });
  if (found == std::end(docstrings)) {
    throw std::logic_error("no header has a docstring of " + name);
  }
  return (*found)[1];
}

int checkedIndex(int i, int count, const char *what)
{
  if (i < 0 || i >= count) {
    throw py::index_error(std::string(what) + " " + std::to_string(i) + " does not exist, there are " +
                          std::to_string(count));
  }
  return i;
}

void checkJoints(const char *name, Eigen::Index size, int joints)
{
  if (size != joints) {
    throw py::value_error(std::string(name) + " has " + std::to_string(size) + " numbers, the arm has " +
                          std::to_string(joints) + " joints");
  }
}

void setFields(const py::object &self, const py::kwargs &values)
{
  for (const auto &value : values) {
    if (!py::hasattr(self, value.first)) {
      throw py::type_error(std::string(py::str(py::type::of(self).attr("__name__"))) + " has no field " +
                           std::string(py::str(value.first)));
    }
    py::setattr(self, value.first, value.second);
  }
}

std::string represented(const py::object &self)
{
  std::string text = py::str(py::type::of(self).attr("__name__"));
  text += "(";
  const char *separator = "";
  for (const py::handle &name : self.attr("_fields")) {
    text += separator + std::string(py::str(name)) + "=" + std::string(py::repr(self.attr(name)));
    separator = ", ";
  }
  std::replace(text.begin(), text.end(), '\n', ' '); // of arrays: signatures with such defaults are one line
  return text + ")";
}

// The sentences are ours, the types are those that a Python user expects.
static void translate(std::exception_ptr error)
{
  try {
    std::rethrow_exception(error);
  }
  catch (const vpRobotException &e) { // has codes of its own
    const bool isValue = const_cast<vpRobotException &>(e).getCode() == vpRobotException::positionOutOfRangeError;
    PyErr_SetString(isValue ? PyExc_ValueError : PyExc_RuntimeError, e.what());
  }
  catch (const vpException &e) {
    const int code = const_cast<vpException &>(e).getCode();
    PyObject *type = PyExc_RuntimeError;
    if (code == vpException::badValue || code == vpException::dimensionError) {
      type = PyExc_ValueError;
    }
    else if (code == vpException::ioError) {
      type = PyExc_OSError;
    }
    else if (code == vpException::notImplementedError || code == vpException::functionNotImplementedError) {
      type = PyExc_NotImplementedError;
    }
    PyErr_SetString(type, e.what());
  }
}
} // namespace visp_python

PYBIND11_MODULE(_core, m)
{
  using namespace visp_python;
  m.doc() = "The compiled part of visp_direct.";
  py::register_exception_translator(&translate);
  m.attr("__version__") = VISP_DIRECT_VERSION;
  bindTrajectory(m);
  bindVision(m);
  bindServo(m);
  bindPrinting(m);
  bindObservers(m);
  bindArm(m);
  bindScene(m);
  bindPerception(m);
  bindMotion(m);
  bindServoing(m);
  bindSimulation(m);
  bindRendering(m);
}
