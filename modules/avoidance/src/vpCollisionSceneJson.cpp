/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/avoidance/vpCollisionSceneJson.h>

#include "vpJsonObject.h"

#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr double degree = vpJsonObject::degree;

// What a value type says about its numbers gets the file and the element in front.
template <class Make> auto located(const vpJsonObject &object, Make make) -> decltype(make())
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

int whole(const vpJsonObject &object, const std::string &place, double value)
{
  if (value != std::floor(value) || std::fabs(value) > 1e6) {
    object.fail(place, "must hold whole numbers");
  }
  return static_cast<int>(value);
}

vpTwist velocity(vpJsonObject &object)
{
  const Eigen::Vector3d v = object.vector<3>("linear_m_s");
  Eigen::Vector3d w = Eigen::Vector3d::Zero();
  object.ignore("angular_rad_s");
  if (object.has("angular_rad_s")) {
    w = object.vector<3>("angular_rad_s");
  }
  return vpTwist(v.x(), v.y(), v.z(), w.x(), w.y(), w.z());
}

vpTriangleMesh mesh(vpJsonObject &object)
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

vpOctree octree(vpJsonObject &object)
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

vpCollisionShape shape(vpJsonObject &object, std::vector<std::string> &warnings)
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
    const bool sheet = object.flag("surface", false);
    const vpTriangleMesh surface = mesh(object);
    if (sheet && !surface.sentence().empty()) {
      warnings.push_back(object.file() + ": " + object.where() + ": " + surface.sentence());
    }
    return located(object,
                   [&] { return vpCollisionShape::mesh(surface, sheet ? vpMeshUse::Surface : vpMeshUse::Solid); });
  }
  if (kind == "octree") {
    return vpCollisionShape::octree(octree(object));
  }
  object.fail(object.place("shape"), "is " + kind + ", must be sphere, capsule, box, cylinder, mesh or octree");
}

//! The photograph that an object carries; by it the object is recognised, so it is there only once.
void photo(vpJsonObject &object, const vpCollisionObject &carrier, vpCollisionSceneFile &scene)
{
  object.ignore("photo");
  if (!object.has("photo")) {
    return;
  }
  const std::string target = object.string("photo");
  if (carrier.shape.type() != vpShapeType::Box) {
    object.fail(object.place("photo"), "is " + target + ", must be on a box");
  }
  for (const vpObjectPhoto &other : scene.photos) {
    if (other.target == target) {
      object.fail(object.place("photo"), "is " + target + ", which object " + other.object + " carries already");
    }
  }
  scene.photos.push_back({carrier.name, target});
}

vpCollisionObject obstacle(vpJsonObject &object, vpCollisionSceneFile &scene)
{
  vpCollisionObject result;
  result.name = object.string("name");
  result.shape = shape(object, scene.warnings);
  object.optional("pose", [&](vpJsonObject &field) { result.pose = field.transform<vpRigidTransform>(); });
  object.optional("velocity", [&](vpJsonObject &field) { result.velocity = velocity(field); });
  result.inflation = object.number("inflation_m", 0.);
  photo(object, result, scene);
  object.ignore("allowed_links");
  if (object.has("allowed_links")) {
    for (const double link : object.numbers("allowed_links")) {
      scene.spec.allowedContacts.push_back({result.name, whole(object, object.place("allowed_links"), link)});
    }
  }
  return result;
}

vpHalfSpace ground(vpJsonObject &object)
{
  vpHalfSpace space;
  space.normal = object.vector<3>("normal");
  space.offset = object.number("offset_m", 0.);
  space.firstLink = whole(object, object.place("first_link"), object.number("first_link", space.firstLink));
  return space;
}

vpJointVector joints(vpJsonObject &object, const char *field)
{
  const std::vector<double> numbers = object.numbers(field);
  if (numbers.empty() || numbers.size() > static_cast<std::size_t>(vpArmMaxJoints)) {
    object.fail(object.place(field), "must have 1 to 8 numbers");
  }
  return Eigen::Map<const Eigen::VectorXd>(numbers.data(), static_cast<Eigen::Index>(numbers.size()));
}

vpMotionTask task(vpJsonObject &object)
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
} // namespace

vpCollisionSceneFile vpLoadCollisionScene(const std::string &file)
{
  const nlohmann::json content = vpParseJsonFile(file);
  vpJsonObject top(content, file, "");
  vpCollisionSceneFile scene;
  scene.spec.source = file;
  scene.name = top.string("name");
  top.ignore("comment");
  top.optional("ground", [&](vpJsonObject &object) { scene.spec.ground = ground(object); });
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
  top.each("objects", [&](vpJsonObject &object) { scene.spec.objects.push_back(obstacle(object, scene)); });
  top.ignore("tasks");
  if (top.has("tasks")) {
    top.each("tasks", [&](vpJsonObject &object) { scene.tasks.push_back(task(object)); });
  }
  top.done();
  return scene;
}

END_VISP_NAMESPACE
