/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/manipulator/vpArmJson.h>

#include "vpJsonGeometry.h"
#include "vpReading.h"

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr double degree = M_PI / 180.;

vpJointType typeOf(vpJsonObject &object)
{
  const std::string type = object.text("type");
  if (type != "continuous" && type != "revolute" && type != "prismatic") {
    throw object.wrong("type", object.value("type"), "revolute, continuous or prismatic");
  }
  return type == "prismatic"    ? vpJointType::Prismatic
         : type == "continuous" ? vpJointType::Continuous
                                : vpJointType::Revolute;
}

// Name, type, frames and offset: all that a joint and a follower have in common.
vpArmJointSpec tableRow(vpJsonObject &object, bool isModified)
{
  const vpJointType type = typeOf(object);
  const bool slides = type == vpJointType::Prismatic;
  const auto row = isModified ? vpArmJointSpec::modifiedDH : vpArmJointSpec::standardDH;
  vpArmJointSpec spec =
      row(object.number("a_m"), degree * object.number("alpha_deg"), slides ? 0. : object.number("d_m"), 0.);
  if (slides) {
    spec.before.R *=
        Eigen::AngleAxisd(degree * object.number("theta_deg"), Eigen::Vector3d::UnitZ()).toRotationMatrix();
    spec.offset = object.number("d_offset_m", 0.);
  }
  else {
    spec.offset = degree * object.number("theta_offset_deg", 0.);
  }
  spec.type = type;
  spec.name = object.text("name");
  return spec;
}

// Position limits in the file are in degrees for revolute joints, in metres for prismatic ones.
vpArmJointSpec joint(vpJsonObject &object, bool isModified)
{
  vpArmJointSpec spec = tableRow(object, isModified);
  if (spec.type != vpJointType::Continuous) {
    const bool slides = spec.type == vpJointType::Prismatic;
    const double unit = slides ? 1. : degree;
    spec.lower = unit * object.number(slides ? "lower_m" : "lower_deg");
    spec.upper = unit * object.number(slides ? "upper_m" : "upper_deg");
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

// Joints and followers in the order of the chain. A follower may name a joint that comes after it.
void readChain(vpJsonObject &top, bool isModified, vpArmSpec &spec)
{
  std::vector<std::string> followed, places;
  top.each("joints", [&](vpJsonObject &object) {
    if (!object.has("follows")) {
      spec.joints.push_back(joint(object, isModified));
      return;
    }
    const vpArmJointSpec row = tableRow(object, isModified);
    spec.followers.push_back({row.name, row.type, row.before, row.after, -1, object.number("ratio", 1.), row.offset,
                              static_cast<int>(spec.joints.size())});
    followed.push_back(object.text("follows"));
    places.push_back(object.wrong("follows", object.value("follows"), "the name of a joint that follows none").what());
  });
  for (std::size_t i = 0; i < followed.size(); ++i) {
    const auto at = std::find_if(spec.joints.begin(), spec.joints.end(),
                                 [&](const vpArmJointSpec &joint) { return joint.name == followed[i]; });
    if (at == spec.joints.end()) {
      throw vpException(vpException::badValue, places[i]);
    }
    spec.followers[i].joint = static_cast<int>(at - spec.joints.begin());
  }
}

vpArmLinkSpec link(vpJsonObject &object)
{
  vpArmLinkSpec spec;
  spec.name = object.text("name");
  spec.hasMass = object.has("mass_kg");
  if (spec.hasMass) {
    spec.mass = object.number("mass_kg");
    spec.com = vpJsonVector<3>(object, "com_m");
    const Eigen::Matrix<double, 6, 1> I = vpJsonVector<6>(object, "inertia_kg_m2");
    spec.inertia << I(0), I(3), I(4), I(3), I(1), I(5), I(4), I(5), I(2);
  }
  return spec;
}

int linkNumber(vpJsonObject &object, int least)
{
  const double link = object.number("link");
  if (link != std::floor(link) || link < least || link > 100.) {
    throw object.wrong("link", object.value("link"), "a whole number, at least " + std::to_string(least));
  }
  return static_cast<int>(link);
}

vpArmCapsule capsule(vpJsonObject &object)
{
  vpArmCapsule spec;
  spec.link = linkNumber(object, 0);
  spec.from = vpJsonVector<3>(object, "from_m");
  spec.to = vpJsonVector<3>(object, "to_m");
  spec.radius = object.number("radius_m");
  return spec;
}

// The end effector or the camera, and the link that carries it, if it is named.
void frame(vpJsonObject &top, const char *name, vpRigidTransform &pose, int &link)
{
  top.optional(name, [&](vpJsonObject &object) {
    pose = vpJsonTransform<vpRigidTransform>(object);
    link = object.has("link") ? linkNumber(object, 1) : -1;
  });
}

vpArmModel load(const std::string &file)
{
  const nlohmann::json content = vpReadJson(file);
  vpJsonObject top(content, file, "");
  vpArmSpec spec;
  spec.source = file;
  spec.name = top.text("name");
  top.ignore("comment");
  const std::string convention = top.text("dh", "standard");
  if (convention != "standard" && convention != "modified") {
    throw top.wrong("dh", top.value("dh"), "standard or modified");
  }
  readChain(top, convention == "modified", spec);
  if (top.has("links")) {
    top.each("links", [&](vpJsonObject &object) { spec.links.push_back(link(object)); });
  }
  if (top.has("capsules")) {
    top.each("capsules", [&](vpJsonObject &object) { spec.capsules.push_back(capsule(object)); });
  }
  if (top.has("uncovered")) {
    spec.uncovered = top.texts("uncovered");
  }
  frame(top, "tool", spec.tool, spec.toolLink);
  frame(top, "camera", spec.camera, spec.cameraLink);
  if (top.has("home")) {
    const std::vector<double> home = top.numbers("home");
    if (home.size() > static_cast<std::size_t>(vpArmMaxJoints)) {
      throw top.wrong("home", top.value("home"), "a list of at most " + std::to_string(vpArmMaxJoints) + " numbers");
    }
    spec.home = Eigen::Map<const Eigen::VectorXd>(home.data(), static_cast<Eigen::Index>(home.size()));
  }
  top.finish();
  return vpArmModel(spec);
}
} // namespace

vpArmModel vpLoadArmJson(const std::string &file)
{
  return vpReading([&] { return load(file); });
}

END_VISP_NAMESPACE
