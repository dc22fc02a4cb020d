/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "page.h"

#include "armPicture.h"

#include <visp3/core/vpException.h>
#include <visp3/manipulator/vpArmKinematics.h>

#include <array>

namespace armProgram
{
namespace
{
//! Links in turn, so that neighbours differ.
constexpr std::array<const char *, 4> COLOURS = {"#e9ecef", "#a9c1d9", "#f2d0a4", "#b7d3b0"};

vpCollisionShape shapeOf(const vpArmShape &shape)
{
  switch (shape.kind) {
  case vpArmShapeKind::Sphere:
    return vpCollisionShape::sphere(shape.size.x());
  case vpArmShapeKind::Cylinder:
    return vpCollisionShape::cylinder(shape.size.x(), shape.size.y());
  case vpArmShapeKind::Box:
    return vpCollisionShape::box(shape.size);
  default:
    return vpCollisionShape::mesh(vpTriangleMesh::load(shape.file, shape.size), vpMeshUse::Surface);
  }
}

std::vector<vpApp::ArmPart> partsOf(const vpArmModel &arm, const vpArmData &data)
{
  std::vector<vpApp::ArmPart> parts;
  for (const vpArmShape &shape : arm.spec().shapes) {
    try {
      const int link = arm.spec().bodies[static_cast<std::size_t>(shape.body)].link;
      const vpRigidTransform place = vpArmKinematics::link(arm, data, link);
      vpApp::ArmPart part;
      part.object.shape = shapeOf(shape);
      part.object.pose.R = place.R * shape.pose.R;
      part.object.pose.p = place.R * shape.pose.p + place.p;
      part.colour = COLOURS[static_cast<std::size_t>(link) % COLOURS.size()];
      parts.push_back(part);
    }
    catch (const vpException &) { // a mesh that cannot be read; the warnings name it
    }
  }
  return parts;
}

vpApp::ArmTrace throughJoints(const vpArmModel &arm, const vpArmData &data)
{
  vpApp::ArmTrace trace;
  trace.colour = "#1d3557";
  trace.label = "through the joints to the tool";
  trace.points.push_back(Eigen::Vector3d::Zero());
  for (int i = 0; i < arm.links(); ++i) {
    trace.points.push_back(data.joint[static_cast<std::size_t>(i)].p);
  }
  trace.points.push_back(data.tool.p);
  return trace;
}
} // namespace

std::string pictureOf(const vpApp::Robot &robot)
{
  const vpArmModel &arm = *robot.arm;
  vpArmData data;
  vpArmKinematics::forward(arm, arm.home(), data);
  vpApp::ArmPicture picture;
  picture.title = arm.spec().name + " at home";
  picture.views = {vpApp::ArmView::Front, vpApp::ArmView::Side};
  picture.parts = partsOf(arm, data);
  picture.ghosts = {{arm.home(), "#44546a", picture.parts.empty() ? 0.6 : 0.18}};
  picture.traces = {throughJoints(arm, data)};
  return vpApp::armPictureSvg(arm, picture);
}
} // namespace armProgram
