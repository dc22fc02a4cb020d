/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/core/vpException.h>
#include <visp3/manipulator/vpArmJson.h>

#include <nlohmann/json.hpp>

#include <Eigen/Geometry>

#include <cmath>
#include <fstream>
#include <set>

BEGIN_VISP_NAMESPACE

namespace
{
using nlohmann::json;
constexpr double degree = M_PI / 180.;

// One object of the file, with its place in it for messages.
class Object
{
public:
  Object(const json &value, const std::string &file, const std::string &place)
    : m_value(value), m_file(file), m_place(place)
  {
    if (!value.is_object()) {
      fail(m_place.empty() ? "the file" : m_place, "must be an object");
    }
  }
  Object(const Object &) = delete;
  Object &operator=(const Object &) = delete;

  [[noreturn]] void fail(const std::string &what, const std::string &why) const
  {
    throw vpException(vpException::badValue, "%s: %s %s", m_file.c_str(), what.c_str(), why.c_str());
  }
  [[nodiscard]] bool has(const char *field) const { return m_value.contains(field); }
  [[nodiscard]] std::string place(const char *field) const { return m_place.empty() ? field : m_place + "." + field; }
  [[nodiscard]] const std::string &file() const { return m_file; }

  const json &get(const char *field)
  {
    m_known.insert(field);
    if (!has(field)) {
      fail(place(field), "is missing");
    }
    return m_value[field];
  }
  double number(const char *field) { return number(get(field), place(field)); }
  double number(const char *field, double otherwise)
  {
    m_known.insert(field);
    return has(field) ? number(field) : otherwise;
  }
  std::string string(const char *field)
  {
    const json &value = get(field);
    if (!value.is_string()) {
      fail(place(field), "must be a text");
    }
    return value.get<std::string>();
  }
  template <int N> Eigen::Matrix<double, N, 1> vector(const char *field)
  {
    const json &value = get(field);
    if (!value.is_array() || value.size() != static_cast<std::size_t>(N)) {
      fail(place(field), "must be a list of " + std::to_string(N) + " numbers");
    }
    Eigen::Matrix<double, N, 1> v;
    for (int i = 0; i < N; ++i) {
      v(i) = number(value[static_cast<std::size_t>(i)], place(field) + "[" + std::to_string(i) + "]");
    }
    return v;
  }
  vpJointVector numbers(const char *field, std::size_t most)
  {
    const json &value = get(field);
    if (!value.is_array() || value.size() > most) {
      fail(place(field), "must be a list of at most " + std::to_string(most) + " numbers");
    }
    vpJointVector v(static_cast<Eigen::Index>(value.size()));
    for (std::size_t i = 0; i < value.size(); ++i) {
      v(static_cast<Eigen::Index>(i)) = number(value[i], place(field) + "[" + std::to_string(i) + "]");
    }
    return v;
  }
  // Every element of a list of objects, with its place.
  template <class Function> void each(const char *field, Function function)
  {
    const json &list = get(field);
    if (!list.is_array()) {
      fail(place(field), "must be a list");
    }
    for (std::size_t i = 0; i < list.size(); ++i) {
      Object object(list[i], m_file, place(field) + "[" + std::to_string(i) + "]");
      function(object);
      object.done();
    }
  }
  // A field that is an object and may be left out.
  template <class Function> void optional(const char *field, Function function)
  {
    m_known.insert(field);
    if (has(field)) {
      Object object(m_value[field], m_file, place(field));
      function(object);
      object.done();
    }
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
  double number(const json &value, const std::string &where) const
  {
    if (!value.is_number()) {
      fail(where, "must be a number");
    }
    return value.get<double>();
  }

  const json &m_value;
  const std::string &m_file;
  std::string m_place;
  std::set<std::string> m_known;
};

vpRigidTransform frame(Object &object)
{
  vpRigidTransform T;
  T.p = object.vector<3>("translation_m");
  object.ignore("rotation_deg");
  if (object.has("rotation_deg")) {
    const Eigen::Vector3d e = degree * object.vector<3>("rotation_deg");
    if (e.norm() > 0.) {
      T.R = Eigen::AngleAxisd(e.norm(), e.normalized()).toRotationMatrix();
    }
  }
  return T;
}

// Limits of turning joints are degrees in the file, those of sliding ones metres.
vpArmJointSpec joint(Object &object)
{
  const std::string type = object.string("type");
  const bool slides = type == "prismatic";
  const double unit = slides ? 1. : degree;
  vpArmJointSpec spec = vpArmJointSpec::standardDH(object.number("a_m"), degree * object.number("alpha_deg"),
                                                   slides ? 0. : object.number("d_m"), 0.);
  if (slides) {
    spec.before.R = Eigen::AngleAxisd(degree * object.number("theta_deg"), Eigen::Vector3d::UnitZ()).toRotationMatrix();
    spec.offset = object.number("d_offset_m", 0.);
  }
  else {
    spec.offset = degree * object.number("theta_offset_deg", 0.);
  }
  spec.name = object.string("name");
  if (type == "continuous") {
    spec.type = vpJointType::Continuous;
  }
  else if (type == "revolute" || slides) {
    spec.type = slides ? vpJointType::Prismatic : vpJointType::Revolute;
    spec.lower = unit * object.number(slides ? "lower_m" : "lower_deg");
    spec.upper = unit * object.number(slides ? "upper_m" : "upper_deg");
  }
  else {
    object.fail(object.place("type"), "is " + type + ", must be revolute, continuous or prismatic");
  }
  const double infinity = std::numeric_limits<double>::infinity();
  spec.velocity = object.number("velocity", infinity);
  spec.acceleration = object.number("acceleration", infinity);
  spec.torque = object.number("torque", infinity);
  spec.rotorInertia = object.number("rotor_inertia", 0.);
  spec.viscous = object.number("viscous", 0.);
  spec.coulomb = object.number("coulomb", 0.);
  spec.kp = object.number("kp", 0.);
  spec.kd = object.number("kd", 0.);
  return spec;
}

vpArmLinkSpec link(Object &object)
{
  vpArmLinkSpec spec;
  spec.name = object.string("name");
  spec.hasMass = object.has("mass_kg");
  object.ignore("mass_kg");
  if (spec.hasMass) {
    spec.mass = object.number("mass_kg");
    spec.com = object.vector<3>("com_m");
    const Eigen::Matrix<double, 6, 1> I = object.vector<6>("inertia_kg_m2");
    spec.inertia << I(0), I(3), I(4), I(3), I(1), I(5), I(4), I(5), I(2);
  }
  return spec;
}

vpArmCapsule capsule(Object &object)
{
  vpArmCapsule spec;
  const double link = object.number("link");
  if (link != std::floor(link) || std::fabs(link) > 100.) {
    object.fail(object.place("link"), "must be a whole number");
  }
  spec.link = static_cast<int>(link);
  spec.from = object.vector<3>("from_m");
  spec.to = object.vector<3>("to_m");
  spec.radius = object.number("radius_m");
  return spec;
}
} // namespace

vpArmModel vpLoadArmJson(const std::string &file)
{
  std::ifstream in(file);
  if (!in) {
    throw vpException(vpException::ioError, "%s: cannot be read", file.c_str());
  }
  json content;
  try {
    content = json::parse(in);
  }
  catch (const json::exception &e) {
    std::string why = e.what();
    const std::size_t prefix = why.find("] ");
    why = prefix == std::string::npos ? why : why.substr(prefix + 2);
    throw vpException(vpException::badValue, "%s: %s", file.c_str(), why.c_str());
  }
  Object top(content, file, "");
  vpArmSpec spec;
  spec.source = file;
  spec.name = top.string("name");
  top.ignore("comment");
  top.each("joints", [&](Object &object) { spec.joints.push_back(joint(object)); });
  top.ignore("links");
  if (top.has("links")) {
    top.each("links", [&](Object &object) { spec.links.push_back(link(object)); });
  }
  top.ignore("capsules");
  if (top.has("capsules")) {
    top.each("capsules", [&](Object &object) { spec.capsules.push_back(capsule(object)); });
  }
  top.optional("tool", [&](Object &object) { spec.tool = frame(object); });
  top.optional("camera", [&](Object &object) { spec.camera = frame(object); });
  top.ignore("home");
  if (top.has("home")) {
    spec.home = top.numbers("home", vpArmMaxJoints);
  }
  top.done();
  return vpArmModel(spec);
}

END_VISP_NAMESPACE
