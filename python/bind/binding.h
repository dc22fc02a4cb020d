/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file binding.h
 * \brief Classes of the package: structs and enums from what python/bind/headers.py reads in the headers, docstrings too.
 */
#ifndef binding_h
#define binding_h

#include "casters.h"
#include "reflection.h" // generated

#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace visp_python
{
//! For methods without arguments: a call with None in place of the object, T.method(None), is a TypeError.
struct NotNone {
};
} // namespace visp_python

namespace pybind11
{
namespace detail
{
template <> struct process_attribute<visp_python::NotNone> : process_attribute_default<visp_python::NotNone> {
  static void init(const visp_python::NotNone &, function_record *record) { append_self_arg_if_needed(record); }
};
} // namespace detail
} // namespace pybind11

namespace visp_python
{
//! A class whose methods have all NotNone.
template <class T, class... Options> class Bound : public py::class_<T, Options...>
{
public:
  using Base = py::class_<T, Options...>;
  using Base::Base;

  template <class... Args> Bound &def(Args &&...args)
  {
    Base::def(std::forward<Args>(args)..., NotNone());
    return *this;
  }
  template <class... Args> Bound &def_static(Args &&...args)
  {
    Base::def_static(std::forward<Args>(args)...);
    return *this;
  }
  template <class... Args> Bound &def_property(Args &&...args)
  {
    Base::def_property(std::forward<Args>(args)...);
    return *this;
  }
  template <class... Args> Bound &def_property_readonly(Args &&...args)
  {
    Base::def_property_readonly(std::forward<Args>(args)...);
    return *this;
  }
};

using Unlocked = py::call_guard<py::gil_scoped_release>; //!< For calls that take long.

//! Docstring of "vpServoLaw::setGoal" in the headers. \throw std::logic_error when there is none, at import.
const char *doc(const std::string &name);
//! \throw IndexError "axis 7 does not exist, there are 6".
int checkedIndex(int i, int count, const char *what);
//! \throw ValueError "q has 3 numbers, the arm has 7 joints".
void checkJoints(const char *name, Eigen::Index size, int joints);
//! Sets the fields of \e self by name. \throw TypeError "ServoGains has no field lamda".
void setFields(const py::object &self, const py::kwargs &values);
//! "ServoGains(lambda_=1.0, rotation=1.0)".
std::string represented(const py::object &self);

template <class M> struct IsTuple : std::false_type {};
template <class M> struct IsTuple<std::vector<M>> : std::negation<std::is_base_of<Eigen::MatrixBase<M>, M>> {};
template <std::size_t N> struct IsTuple<std::array<bool, N>> : std::true_type {};
template <class M> struct IsShared : std::false_type {};
template <class M> struct IsShared<std::shared_ptr<const M>> : std::true_type {
  using type = M;
};
//! Left out: they need the number of valid elements beside them, and their structs are bound with it by hand.
template <class M> struct IsLeftOut : std::is_pointer<M> {};
template <class M, std::size_t N>
struct IsLeftOut<std::array<M, N>> : std::bool_constant<!std::is_arithmetic_v<M> && !std::is_same_v<M, vpImagePoint>> {
};

/*!
 * A field. Lists are tuples, so that append() is an error and not without effect.
 */
template <class Class, class T, class M> void bindField(Class &bound, const char *name, M T::*member, const char *text)
{
  if constexpr (IsLeftOut<M>::value) {
    return;
  }
  else if constexpr (IsTuple<M>::value) {
    const auto get = [member](const T &self) {
      return py::tuple(py::cast(self.*member, py::return_value_policy::copy));
    };
    bound.def_property(
        name, get, [member](T &self, const M &value) { self.*member = value; }, text);
  }
  else if constexpr (IsShared<M>::value) {
    using Shared = std::shared_ptr<typename IsShared<M>::type>;
    const auto get = [member](const T &self) {
      return std::const_pointer_cast<typename IsShared<M>::type>(self.*member);
    };
    bound.def_property(
        name, get, [member](T &self, const Shared &value) { self.*member = value; }, text);
  }
  else {
    bound.def_readwrite(name, member, text);
  }
  bound.attr("_fields").template cast<py::list>().append(name);
}

//! A struct with all its public fields, made by no arguments or by fields as keywords.
template <class T, class... Options> Bound<T, Options...> bindStruct(py::module_ &m, bool constructible = true)
{
  Bound<T, Options...> bound(m, Reflect<T>::name, Reflect<T>::doc);
  bound.attr("_fields") = py::list();
  Reflect<T>::each([&bound](const char *name, auto member, const char *text) { bindField(bound, name, member, text); });
  bound.def("__repr__", &represented);
  if constexpr (std::is_default_constructible_v<T>) {
    if (constructible) {
      bound.def(py::init([](const py::kwargs &values) {
                  auto made = std::make_unique<T>();
                  setFields(py::cast(made.get(), py::return_value_policy::reference), values);
                  return made;
                }),
                "Fields by keyword; those left out have their defaults.");
    }
  }
  return bound;
}

//! Parameters with validate(); \e names: those of its arguments.
template <class Spec, class... Names> Bound<Spec> bindSpec(py::module_ &m, const Names &...names)
{
  return bindStruct<Spec>(m).def("validate", &Spec::validate, names...,
                                 doc(std::string("vp") + Reflect<Spec>::name + "::validate"));
}

//! No value is made from a number.
inline void closeEnum(const py::object &bound)
{
  py::delattr(bound, "__init__");
  py::delattr(bound, "__setstate__");
}

//! An enum with all its values, and no others.
template <class E> py::enum_<E> bindEnum(py::module_ &m)
{
  py::enum_<E> bound(m, Reflect<E>::name, Reflect<E>::doc);
  Reflect<E>::each([&bound](const char *name, E value, const char *text) { bound.value(name, value, text); });
  closeEnum(bound);
  return bound;
}

//! A class whose methods are bound by hand.
template <class T, class... Options> Bound<T, Options...> bindClass(py::module_ &m)
{
  return Bound<T, Options...>(m, Reflect<T>::name, Reflect<T>::doc);
}

//! Raises what a law written in Python has raised in its last step.
void raiseErrorOf(const vpServoLaw &law);

void bindTrajectory(py::module_ &m);
void bindServo(py::module_ &m);
void bindVision(py::module_ &m);
void bindPrinting(py::module_ &m);
void bindObservers(py::module_ &m);
void bindArm(py::module_ &m);
void bindScene(py::module_ &m);
void bindMotion(py::module_ &m);
void bindServoing(py::module_ &m);
void bindSimulation(py::module_ &m);
void bindRendering(py::module_ &m);
} // namespace visp_python
#endif
