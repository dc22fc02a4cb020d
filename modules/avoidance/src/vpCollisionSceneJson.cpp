/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/avoidance/vpCollisionSceneJson.h>

#include "vpJsonGeometry.h"
#include "vpReading.h"

#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
// Prefixes errors of value types with the file and the element.
template <class Make> auto located(const vpJsonObject &object, Make make) -> decltype(make())
{
  try {
    return make();
  }
  catch (const vpException &e) {
    throw vpException(e.getCode(), object.file() + ": " + object.path() + ": " + e.getStringMessage());
  }
}

std::string beside(const std::string &file, const std::string &name)
{
  const std::size_t slash = file.rfind('/');
  return name.empty() || name[0] == '/' || slash == std::string::npos ? name : file.substr(0, slash + 1) + name;
}

int whole(const vpJsonObject &object, const std::string &field, double value)
{
  if (value != std::floor(value) || std::fabs(value) > 1e6) {
    throw object.wrong(field, value, "a whole number");
  }
  return static_cast<int>(value);
}

vpTwist velocity(vpJsonObject &object)
{
  const Eigen::Vector3d v = vpJsonVector<3>(object, "linear_m_s");
  Eigen::Vector3d w = Eigen::Vector3d::Zero();
  if (object.has("angular_rad_s")) {
    w = vpJsonVector<3>(object, "angular_rad_s");
  }
  return vpTwist(v.x(), v.y(), v.z(), w.x(), w.y(), w.z());
}

vpTriangleMesh mesh(vpJsonObject &object)
{
  if (object.has("file")) {
    const std::string file = beside(object.file(), object.text("file"));
    const double scale = object.number("scale", 1.);
    return located(object, [&] { return vpTriangleMesh::load(file, scale); });
  }
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<int, 3>> triangles;
  for (const auto &row : object.rows("vertices_m", 3)) {
    vertices.emplace_back(row[0], row[1], row[2]);
  }
  for (const auto &row : object.rows("triangles", 3)) {
    const char *field = "triangles";
    triangles.push_back({whole(object, field, row[0]), whole(object, field, row[1]), whole(object, field, row[2])});
  }
  return located(object, [&] { return vpTriangleMesh(vertices, triangles, "mesh"); });
}

vpOctree octree(vpJsonObject &object)
{
  if (object.has("file")) {
    const std::string file = beside(object.file(), object.text("file"));
    return located(object, [&] { return vpOctree::load(file); });
  }
  std::vector<vpOctreeCell> cells;
  for (const auto &row : object.rows("cells_m", 4)) {
    cells.push_back({{row[0], row[1], row[2]}, row[3]});
  }
  return located(object, [&] { return vpOctree(cells, "octree"); });
}

vpCollisionShape shape(vpJsonObject &object, std::vector<std::string> &warnings)
{
  const std::string kind = object.text("shape");
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
    const Eigen::Vector3d size = vpJsonVector<3>(object, "size_m");
    return located(object, [&] { return vpCollisionShape::box(size); });
  }
  if (kind == "mesh") {
    const bool sheet = object.flag("surface", false);
    const vpTriangleMesh surface = mesh(object);
    if (sheet && !surface.message().empty()) {
      warnings.push_back(object.file() + ": " + object.path() + ": " + surface.message());
    }
    return located(object,
                   [&] { return vpCollisionShape::mesh(surface, sheet ? vpMeshUse::Surface : vpMeshUse::Solid); });
  }
  if (kind == "octree") {
    return vpCollisionShape::octree(octree(object));
  }
  throw object.wrong("shape", object.value("shape"), "sphere, capsule, box, cylinder, mesh or octree");
}

//! Reads the photograph of an object; it identifies the object, so it must be unique.
void photo(vpJsonObject &object, const vpCollisionObject &carrier, vpCollisionSceneFile &scene)
{
  if (!object.has("photo")) {
    return;
  }
  const std::string target = object.text("photo");
  if (carrier.shape.type() != vpShapeType::Box) {
    throw object.wrong("photo", object.value("photo"), "on a box");
  }
  for (const vpObjectPhoto &other : scene.photos) {
    if (other.target == target) {
      throw object.wrong("photo", object.value("photo"), "another one than object " + other.object + " carries");
    }
  }
  scene.photos.push_back({carrier.name, target});
}

vpCollisionObject obstacle(vpJsonObject &object, vpCollisionSceneFile &scene)
{
  vpCollisionObject result;
  result.name = object.text("name");
  result.shape = shape(object, scene.warnings);
  object.optional("pose", [&](vpJsonObject &field) { result.pose = vpJsonTransform<vpRigidTransform>(field); });
  object.optional("velocity", [&](vpJsonObject &field) { result.velocity = velocity(field); });
  result.inflation = object.number("inflation_m", 0.);
  photo(object, result, scene);
  if (object.has("allowed_links")) {
    for (const double link : object.numbers("allowed_links")) {
      scene.spec.allowedContacts.push_back({result.name, whole(object, "allowed_links", link)});
    }
  }
  return result;
}

vpHalfSpace ground(vpJsonObject &object)
{
  vpHalfSpace space;
  space.normal = vpJsonVector<3>(object, "normal");
  space.offset = object.number("offset_m", 0.);
  space.firstLink = whole(object, "first_link", object.number("first_link", space.firstLink));
  return space;
}

vpJointVector joints(vpJsonObject &object, const char *field)
{
  const std::vector<double> numbers = object.numbers(field);
  if (numbers.empty() || numbers.size() > static_cast<std::size_t>(vpArmMaxJoints)) {
    throw object.wrong(field, object.value(field), "a list of 1 to " + std::to_string(vpArmMaxJoints) + " numbers");
  }
  return Eigen::Map<const Eigen::VectorXd>(numbers.data(), static_cast<Eigen::Index>(numbers.size()));
}

vpMotionTask task(vpJsonObject &object)
{
  vpMotionTask result;
  result.name = object.text("name");
  result.start = joints(object, "start_rad");
  result.goal = joints(object, "goal_rad");
  if (result.start.size() != result.goal.size()) {
    throw object.wrong("goal_rad", object.value("goal_rad"), "a list of as many numbers as start_rad");
  }
  return result;
}
vpCollisionSceneFile load(const std::string &file)
{
  const nlohmann::json content = vpReadJson(file);
  vpJsonObject top(content, file, "");
  vpCollisionSceneFile scene;
  scene.spec.source = file;
  scene.name = top.text("name");
  top.ignore("comment");
  top.optional("ground", [&](vpJsonObject &object) { scene.spec.ground = ground(object); });
  if (top.has("allowed_link_pairs")) {
    for (const auto &row : top.rows("allowed_link_pairs", 2)) {
      scene.spec.allowedLinks.emplace_back(whole(top, "allowed_link_pairs", row[0]),
                                           whole(top, "allowed_link_pairs", row[1]));
    }
  }
  if (top.has("ignored_bodies")) {
    scene.spec.ignoredBodies = top.texts("ignored_bodies");
  }
  top.each("objects", [&](vpJsonObject &object) { scene.spec.objects.push_back(obstacle(object, scene)); });
  if (top.has("tasks")) {
    top.each("tasks", [&](vpJsonObject &object) { scene.tasks.push_back(task(object)); });
  }
  top.finish();
  return scene;
}
} // namespace

vpCollisionSceneFile vpLoadCollisionScene(const std::string &file)
{
  return vpReading([&] { return load(file); });
}

END_VISP_NAMESPACE
