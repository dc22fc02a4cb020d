/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/avoidance/vpCollisionSceneJson.h>
#include <visp3/core/vpException.h>

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
  [[nodiscard]] const std::string &where() const { return m_place; }
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
  std::vector<double> numbers(const char *field) { return numbers(get(field), place(field)); }
  std::vector<std::vector<double>> rows(const char *field)
  {
    std::vector<std::vector<double>> all;
    const json &list = get(field);
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
  std::vector<double> numbers(const json &value, const std::string &where) const
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

// What a value type says about its numbers gets the file and the element in front.
template <class Make> auto located(const Object &object, Make make) -> decltype(make())
{
  try {
    return make();
  }
  catch (const vpException &e) {
    throw vpException(e.getCode(), "%s: %s: %s", object.file().c_str(), object.where().c_str(), e.getMessage());
  }
}

std::string beside(const std::string &file, const std::string &name)
{
  const std::size_t slash = file.rfind('/');
  return name.empty() || name[0] == '/' || slash == std::string::npos ? name : file.substr(0, slash + 1) + name;
}

int whole(const Object &object, const std::string &place, double value)
{
  if (value != std::floor(value) || std::fabs(value) > 1e6) {
    object.fail(place, "must hold whole numbers");
  }
  return static_cast<int>(value);
}

vpRigidTransform pose(Object &object)
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

vpTwist velocity(Object &object)
{
  const Eigen::Vector3d v = object.vector<3>("linear_m_s");
  Eigen::Vector3d w = Eigen::Vector3d::Zero();
  object.ignore("angular_rad_s");
  if (object.has("angular_rad_s")) {
    w = object.vector<3>("angular_rad_s");
  }
  return vpTwist(v.x(), v.y(), v.z(), w.x(), w.y(), w.z());
}

vpTriangleMesh mesh(Object &object)
{
  if (object.has("file")) {
    const std::string file = beside(object.file(), object.string("file"));
    const double scale = object.number("scale", 1.);
    return located(object, [&] { return vpTriangleMesh::load(file, scale); });
  }
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<int, 3>> triangles;
  for (const auto &row : object.rows("vertices_m")) {
    if (row.size() != 3) {
      object.fail(object.place("vertices_m"), "must be a list of lists of 3 numbers");
    }
    vertices.emplace_back(row[0], row[1], row[2]);
  }
  for (const auto &row : object.rows("triangles")) {
    if (row.size() != 3) {
      object.fail(object.place("triangles"), "must be a list of lists of 3 numbers");
    }
    const std::string place = object.place("triangles");
    triangles.push_back({whole(object, place, row[0]), whole(object, place, row[1]), whole(object, place, row[2])});
  }
  return located(object, [&] { return vpTriangleMesh(vertices, triangles, "mesh"); });
}

vpOctree octree(Object &object)
{
  if (object.has("file")) {
    const std::string file = beside(object.file(), object.string("file"));
    return located(object, [&] { return vpOctree::load(file); });
  }
  std::vector<vpOctreeCell> cells;
  for (const auto &row : object.rows("cells_m")) {
    if (row.size() != 4) {
      object.fail(object.place("cells_m"), "must be a list of lists of 4 numbers");
    }
    cells.push_back({{row[0], row[1], row[2]}, row[3]});
  }
  return located(object, [&] { return vpOctree(cells, "octree"); });
}

vpCollisionShape shape(Object &object, std::vector<std::string> &warnings)
{
  const std::string kind = object.string("shape");
  if (kind == "sphere") {
    const double radius = object.number("radius_m");
    return located(object, [&] { return vpCollisionShape::sphere(radius); });
  }
  if (kind == "capsule" || kind == "cylinder") {
    const double radius = object.number("radius_m"), length = object.number("length_m");
    return located(object, [&] {
      return kind == "capsule" ? vpCollisionShape::capsule(radius, length) : vpCollisionShape::cylinder(radius, length);
    });
  }
  if (kind == "box") {
    const Eigen::Vector3d size = object.vector<3>("size_m");
    return located(object, [&] { return vpCollisionShape::box(size); });
  }
  if (kind == "mesh") {
    const vpTriangleMesh surface = mesh(object);
    if (!surface.sentence().empty()) {
      warnings.push_back(object.file() + ": " + object.where() + ": " + surface.sentence());
    }
    return vpCollisionShape::mesh(surface);
  }
  if (kind == "octree") {
    return vpCollisionShape::octree(octree(object));
  }
  object.fail(object.place("shape"), "is " + kind + ", must be sphere, capsule, box, cylinder, mesh or octree");
}

vpCollisionObject obstacle(Object &object, vpCollisionSceneFile &scene)
{
  vpCollisionObject result;
  result.name = object.string("name");
  result.shape = shape(object, scene.warnings);
  object.optional("pose", [&](Object &field) { result.pose = pose(field); });
  object.optional("velocity", [&](Object &field) { result.velocity = velocity(field); });
  result.inflation = object.number("inflation_m", 0.);
  object.ignore("allowed_links");
  if (object.has("allowed_links")) {
    for (const double link : object.numbers("allowed_links")) {
      scene.spec.allowedContacts.push_back({result.name, whole(object, object.place("allowed_links"), link)});
    }
  }
  return result;
}

vpHalfSpace ground(Object &object)
{
  vpHalfSpace space;
  space.normal = object.vector<3>("normal");
  space.offset = object.number("offset_m", 0.);
  space.firstLink = whole(object, object.place("first_link"), object.number("first_link", space.firstLink));
  return space;
}

vpJointVector joints(Object &object, const char *field)
{
  const std::vector<double> numbers = object.numbers(field);
  if (numbers.empty() || numbers.size() > static_cast<std::size_t>(vpArmMaxJoints)) {
    object.fail(object.place(field), "must have 1 to 8 numbers");
  }
  return Eigen::Map<const Eigen::VectorXd>(numbers.data(), static_cast<Eigen::Index>(numbers.size()));
}

vpMotionTask task(Object &object)
{
  vpMotionTask result;
  result.name = object.string("name");
  result.start = joints(object, "start_rad");
  result.goal = joints(object, "goal_rad");
  if (result.start.size() != result.goal.size()) {
    object.fail(object.place("goal_rad"), "must have as many numbers as start_rad");
  }
  return result;
}

json parsed(const std::string &file)
{
  std::ifstream in(file);
  if (!in) {
    throw vpException(vpException::ioError, "%s: cannot be read", file.c_str());
  }
  try {
    return json::parse(in);
  }
  catch (const json::exception &e) {
    std::string why = e.what();
    const std::size_t prefix = why.find("] ");
    why = prefix == std::string::npos ? why : why.substr(prefix + 2);
    throw vpException(vpException::badValue, "%s: %s", file.c_str(), why.c_str());
  }
}
} // namespace

vpCollisionSceneFile vpLoadCollisionScene(const std::string &file)
{
  const json content = parsed(file);
  Object top(content, file, "");
  vpCollisionSceneFile scene;
  scene.spec.source = file;
  scene.name = top.string("name");
  top.ignore("comment");
  top.optional("ground", [&](Object &object) { scene.spec.ground = ground(object); });
  top.ignore("allowed_link_pairs");
  if (top.has("allowed_link_pairs")) {
    for (const auto &row : top.rows("allowed_link_pairs")) {
      if (row.size() != 2) {
        top.fail("allowed_link_pairs", "must be a list of lists of 2 numbers");
      }
      scene.spec.allowedLinks.emplace_back(whole(top, "allowed_link_pairs", row[0]),
                                           whole(top, "allowed_link_pairs", row[1]));
    }
  }
  top.each("objects", [&](Object &object) { scene.spec.objects.push_back(obstacle(object, scene)); });
  top.ignore("tasks");
  if (top.has("tasks")) {
    top.each("tasks", [&](Object &object) { scene.tasks.push_back(task(object)); });
  }
  top.done();
  return scene;
}

END_VISP_NAMESPACE
