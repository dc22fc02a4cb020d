/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "viewData.h"

#include <visp3/avoidance/vpTriangleMesh.h>
#include <visp3/core/vpException.h>

#include <array>
#include <cmath>
#include <cstdint>

namespace vpApp
{
using Json = nlohmann::ordered_json;

namespace
{
template <class Vector> Json listOf(const Vector &numbers)
{
  return std::vector<double>(numbers.data(), numbers.data() + numbers.size());
}

void append(std::string &bytes, const void *data, std::size_t size)
{
  bytes.append(static_cast<const char *>(data), size);
}

//! Binary STL, in metres.
std::string stlOf(const vpTriangleMesh &mesh)
{
  std::string bytes(80, ' ');
  const auto count = static_cast<std::uint32_t>(mesh.triangles().size());
  append(bytes, &count, sizeof count);
  for (const std::array<int, 3> &triangle : mesh.triangles()) {
    std::array<float, 12> numbers{}; // the normal stays 0: it follows from the corners
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const Eigen::Vector3d &vertex = mesh.vertices()[static_cast<std::size_t>(triangle[corner])];
      for (std::size_t k = 0; k < 3; ++k) {
        numbers[3 + 3 * corner + k] = static_cast<float>(vertex[static_cast<Eigen::Index>(k)]);
      }
    }
    append(bytes, numbers.data(), sizeof numbers);
    bytes.append(2, '\0');
  }
  return bytes;
}

const char *shapeName(vpArmShapeKind kind)
{
  constexpr std::array<const char *, 4> names = {"sphere", "cylinder", "box", "mesh"};
  return names[static_cast<std::size_t>(kind)];
}

const char *kindOf(vpShapeType type)
{
  constexpr std::array<const char *, 6> names = {"sphere", "capsule", "box", "cylinder", "mesh", "octree"};
  return names[static_cast<std::size_t>(type)];
}

Json jointsOf(const vpArmModel &arm)
{
  Json joints = Json::array();
  for (const vpArmJointSpec &joint : arm.spec().joints) {
    const bool bounded = joint.type != vpJointType::Continuous;
    joints.push_back({{"name", joint.name},
                      {"type", nameOf(joint.type)},
                      {"limits", bounded ? Json{joint.lower, joint.upper} : Json(nullptr)},
                      {"velocity", std::isfinite(joint.velocity) ? Json(joint.velocity) : Json(nullptr)}});
  }
  return joints;
}

//! Joints and followers, which move the links one after the other.
Json chainOf(const vpArmModel &arm)
{
  Json chain = Json::array();
  for (int k = 0; k < arm.links(); ++k) {
    const vpArmChainJoint &joint = arm.chain(k);
    chain.push_back({{"step", rowsOf(joint.step)},
                     {"after", rowsOf(joint.after)},
                     {"prismatic", joint.isPrismatic},
                     {"joint", joint.joint},
                     {"ratio", joint.ratio},
                     {"offset", joint.offset}});
  }
  return chain;
}

Json capsulesOf(const vpArmModel &arm)
{
  Json capsules = Json::array();
  for (const vpArmCapsule &capsule : arm.spec().capsules) {
    capsules.push_back({{"link", capsule.link},
                        {"from", listOf(capsule.from)},
                        {"to", listOf(capsule.to)},
                        {"radius", capsule.radius}});
  }
  return capsules;
}
} // namespace

const char *nameOf(vpJointType type)
{
  return type == vpJointType::Revolute ? "revolute" : type == vpJointType::Continuous ? "continuous" : "prismatic";
}

Json rowsOf(const vpRigidTransform &pose)
{
  Json rows = Json::array();
  for (int i = 0; i < 3; ++i) {
    rows.push_back({pose.R(i, 0), pose.R(i, 1), pose.R(i, 2), pose.p(i)});
  }
  rows.push_back({0., 0., 0., 1.});
  return rows;
}

void writeArm(OutputFolder &out, const vpArmModel &model)
{
  const vpArmSpec &spec = model.spec();
  Json shapes = Json::array(), missing = Json::array();
  for (const vpArmShape &shape : spec.shapes) {
    Json json = {{"link", spec.bodies[static_cast<std::size_t>(shape.body)].link},
                 {"kind", shapeName(shape.kind)},
                 {"size", listOf(shape.size)},
                 {"file", nullptr},
                 {"pose", rowsOf(shape.pose)}};
    if (shape.kind == vpArmShapeKind::Mesh) {
      try {
        const std::string file = "mesh/" + std::to_string(shapes.size()) + ".stl";
        out.write(file, stlOf(vpTriangleMesh::load(shape.file, shape.size)));
        json["file"] = file;
        json["size"] = {1., 1., 1.};
      }
      catch (const vpException &error) {
        missing.push_back(error.what());
        continue;
      }
    }
    shapes.push_back(json);
  }
  const Json arm = {{"name", spec.name},
                    {"home", listOf(model.home())},
                    {"tool_link", model.toolLink()},
                    {"tool", rowsOf(spec.tool)},
                    {"camera_link", model.cameraLink()},
                    {"camera", rowsOf(spec.cameraLink < 0 ? spec.tool * spec.camera : spec.camera)},
                    {"joints", jointsOf(model)},
                    {"chain", chainOf(model)},
                    {"shapes", shapes},
                    {"capsules", capsulesOf(model)},
                    {"missing", missing}};
  out.write("arm.json", arm.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
}

Json objectData(OutputFolder &out, const vpCollisionObject &object, const std::string &file)
{
  const vpCollisionShape &shape = object.shape;
  const double more = object.inflation;
  Json json = {{"name", object.name}, {"kind", kindOf(shape.type())}, {"pose", rowsOf(object.pose)}};
  switch (shape.type()) {
  case vpShapeType::Box:
    json["size"] = listOf(Eigen::Vector3d(shape.size().array() + 2. * more));
    break;
  case vpShapeType::Mesh:
    json["file"] = file + ".stl";
    out.write(file + ".stl", stlOf(shape.mesh()));
    break;
  case vpShapeType::Octree:
    json["cells"] = Json::array();
    for (const vpOctreeCell &cell : shape.octree().cells()) {
      json["cells"].push_back({cell.centre.x(), cell.centre.y(), cell.centre.z(), cell.size});
    }
    break;
  default:
    json["radius"] = shape.radius() + more;
    if (shape.type() != vpShapeType::Sphere) {
      json["length"] = shape.length() + (shape.type() == vpShapeType::Cylinder ? 2. * more : 0.);
    }
  }
  return json;
}
} // namespace vpApp
