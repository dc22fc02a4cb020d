/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpJsonObject.h
 * \brief Reading JSON files strictly, for the modules that have files of their own. Not installed: only their .cpp files
 * include it.
 */
#ifndef vpJsonObject_h
#define vpJsonObject_h

#include <visp3/core/vpException.h>
#include <visp3/direct_core/vpDirectCompat.h>

#include <nlohmann/json.hpp>

#include <Eigen/Geometry>

#include <cmath>
#include <fstream>
#include <set>
#include <string>
#include <vector>

BEGIN_VISP_NAMESPACE

/*!
 * \throw vpException (ioError) when the file cannot be read, (badValue) with the place when it is no JSON.
 */
inline nlohmann::json vpParseJsonFile(const std::string &file)
{
  std::ifstream in(file);
  if (!in) {
    throw vpException(vpException::ioError, "%s: cannot be read", file.c_str());
  }
  try {
    return nlohmann::json::parse(in);
  }
  catch (const nlohmann::json::exception &e) {
    std::string why = e.what();
    const std::size_t prefix = why.find("] ");
    why = prefix == std::string::npos ? why : why.substr(prefix + 2);
    throw vpException(vpException::badValue, "%s: %s", file.c_str(), why.c_str());
  }
}

/*!
 * \brief One object of a JSON file, with its place in it for messages. Every field that is asked for is known; done() refuses
 * the others, so that a misspelt one does not go unseen.
 */
class vpJsonObject
{
public:
  static constexpr double degree = M_PI / 180.; //!< rad.

  vpJsonObject(const nlohmann::json &value, const std::string &file, const std::string &place)
    : m_value(value), m_file(file), m_place(place)
  {
    if (!value.is_object()) {
      fail(m_place.empty() ? "the file" : m_place, "must be an object");
    }
  }
  vpJsonObject(const vpJsonObject &) = delete;
  vpJsonObject &operator=(const vpJsonObject &) = delete;

  [[noreturn]] void fail(const std::string &what, const std::string &why) const
  {
    throw vpException(vpException::badValue, "%s: %s %s", m_file.c_str(), what.c_str(), why.c_str());
  }
  [[nodiscard]] bool has(const char *field) const { return m_value.contains(field); }
  [[nodiscard]] std::string place(const char *field) const { return m_place.empty() ? field : m_place + "." + field; }
  [[nodiscard]] const std::string &file() const { return m_file; }

  const nlohmann::json &get(const char *field)
  {
    m_known.insert(field);
    if (!has(field)) {
      fail(place(field), "is missing");
    }
    return m_value[field];
  }
  [[nodiscard]] const std::string &where() const { return m_place; }
  double number(const char *field) { return number(get(field), place(field)); }
  double number(const char *field, double otherwise)
  {
    m_known.insert(field);
    return has(field) ? number(field) : otherwise;
  }
  bool flag(const char *field, bool otherwise)
  {
    m_known.insert(field);
    if (!has(field)) {
      return otherwise;
    }
    if (!get(field).is_boolean()) {
      fail(place(field), "must be true or false");
    }
    return get(field).get<bool>();
  }
  std::string string(const char *field)
  {
    const nlohmann::json &value = get(field);
    if (!value.is_string()) {
      fail(place(field), "must be a text");
    }
    return value.get<std::string>();
  }
  template <int N> Eigen::Matrix<double, N, 1> vector(const char *field)
  {
    const nlohmann::json &value = get(field);
    if (!value.is_array() || value.size() != static_cast<std::size_t>(N)) {
      fail(place(field), "must be a list of " + std::to_string(N) + " numbers");
    }
    Eigen::Matrix<double, N, 1> v;
    for (int i = 0; i < N; ++i) {
      v(i) = number(value[static_cast<std::size_t>(i)], place(field) + "[" + std::to_string(i) + "]");
    }
    return v;
  }
  std::vector<double> numbers(const char *field) { return numbers(get(field), place(field)); }
  std::vector<std::vector<double>> rows(const char *field)
  {
    std::vector<std::vector<double>> all;
    const nlohmann::json &list = get(field);
    if (!list.is_array()) {
      fail(place(field), "must be a list");
    }
    for (std::size_t i = 0; i < list.size(); ++i) {
      all.push_back(numbers(list[i], place(field) + "[" + std::to_string(i) + "]"));
    }
    return all;
  }
  // Every element of a list of objects, with its place.
  template <class Function> void each(const char *field, Function function)
  {
    const nlohmann::json &list = get(field);
    if (!list.is_array()) {
      fail(place(field), "must be a list");
    }
    for (std::size_t i = 0; i < list.size(); ++i) {
      vpJsonObject object(list[i], m_file, place(field) + "[" + std::to_string(i) + "]");
      function(object);
      object.done();
    }
  }
  // A field that is an object and may be left out.
  template <class Function> void optional(const char *field, Function function)
  {
    m_known.insert(field);
    if (has(field)) {
      vpJsonObject object(m_value[field], m_file, place(field));
      function(object);
      object.done();
    }
  }
  /*!
   * A pose: `translation_m`, and if wanted `rotation_deg`, a rotation vector.
   */
  template <class Transform> Transform transform()
  {
    Transform T;
    T.p = vector<3>("translation_m");
    m_known.insert("rotation_deg");
    if (has("rotation_deg")) {
      const Eigen::Vector3d e = vpJsonObject::degree * vector<3>("rotation_deg");
      if (e.norm() > 0.) {
        T.R = Eigen::AngleAxisd(e.norm(), e.normalized()).toRotationMatrix();
      }
    }
    return T;
  }
  void ignore(const char *field) { m_known.insert(field); }
  void done() const
  {
    for (const auto &item : m_value.items()) {
      if (m_known.count(item.key()) == 0) {
        fail(place(item.key().c_str()), "is not a known field");
      }
    }
  }

private:
  std::vector<double> numbers(const nlohmann::json &value, const std::string &where) const
  {
    if (!value.is_array()) {
      fail(where, "must be a list of numbers");
    }
    std::vector<double> v;
    for (std::size_t i = 0; i < value.size(); ++i) {
      v.push_back(number(value[i], where + "[" + std::to_string(i) + "]"));
    }
    return v;
  }
  double number(const nlohmann::json &value, const std::string &where) const
  {
    if (!value.is_number()) {
      fail(where, "must be a number");
    }
    return value.get<double>();
  }

  const nlohmann::json &m_value;
  const std::string &m_file;
  std::string m_place;
  std::set<std::string> m_known;
};

END_VISP_NAMESPACE
#endif
