/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The arms of the tests as independently built KDL chains. A test that includes this needs KDL and urdfdom.
#ifndef vpKdlTestKit_h
#define vpKdlTestKit_h

#include "vpArmTestKit.h"

#include <kdl/chain.hpp>
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

namespace vpArmTestKit
{
//! AMOR from the printed table by KDL's own DH frames, with the offset, tool and masses of data/robot.
inline KDL::Chain kdlAmor(bool withTool = true, double offset2 = pi)
{
  const double a[] = {0.0623, 0., 0.097, 0., 0.0502, 0., 0.}, d[] = {0.155, 0., 0.41946, 0., 0.3582, 0., 0.07};
  const double alpha[] = {-pi / 2., -pi / 2., pi / 2., -pi / 2., pi / 2., -pi / 2., 0.};
  const double mass[] = {2.6, 2.4, 2.0, 1.6, 1.2, 0.8, 0.9};
  KDL::Chain chain;
  for (int i = 0; i < 7; ++i) {
    KDL::Frame end = KDL::Frame::DH(a[i], alpha[i], d[i], i == 1 ? offset2 : 0.);
    // Midpoint of the link, in the frame at its end.
    const KDL::Vector com = 0.5 * end.Inverse().p;
    const double I = 0.005 * mass[i];
    if (i == 6 && withTool) {
      const KDL::Frame tool(KDL::Vector(0., 0., 0.1755));
      end = end * tool;
      chain.addSegment(
          KDL::Segment(KDL::Joint(KDL::Joint::RotZ), end,
                       KDL::RigidBodyInertia(mass[i], tool.Inverse() * com, KDL::RotationalInertia(I, I, I))));
    }
    else {
      chain.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::RotZ), end,
                                    KDL::RigidBodyInertia(mass[i], com, KDL::RotationalInertia(I, I, I))));
    }
  }
  return chain;
}

inline KDL::Frame kdlFrame(const urdf::Pose &pose)
{
  return {KDL::Rotation::Quaternion(pose.rotation.x, pose.rotation.y, pose.rotation.z, pose.rotation.w),
          KDL::Vector(pose.position.x, pose.position.y, pose.position.z)};
}

inline KDL::RigidBodyInertia kdlBody(const urdf::Link &link)
{
  if (!link.inertial) {
    return KDL::RigidBodyInertia::Zero();
  }
  const urdf::Inertial &from = *link.inertial;
  const KDL::Frame at = kdlFrame(from.origin);
  const KDL::RotationalInertia I(from.ixx, from.iyy, from.izz, from.ixy, from.ixz, from.iyz);
  return at * KDL::RigidBodyInertia(from.mass, KDL::Vector::Zero(), I);
}

//! A chain directly from urdfdom's tree, with masses: moving joints about their own axes, fixed segments unchanged.
inline KDL::Chain kdlChain(const urdf::ModelInterface &tree, const std::string &base, const std::string &tip)
{
  std::vector<KDL::Segment> segments;
  for (urdf::LinkConstSharedPtr link = tree.getLink(tip); link->name != base; link = link->getParent()) {
    const urdf::Joint &joint = *link->parent_joint;
    const KDL::Frame at = kdlFrame(joint.parent_to_joint_origin_transform);
    const KDL::Vector axis = at.M * KDL::Vector(joint.axis.x, joint.axis.y, joint.axis.z);
    segments.emplace_back(joint.name,
                          joint.type == urdf::Joint::FIXED ? KDL::Joint(joint.name, KDL::Joint::None)
                          : joint.type == urdf::Joint::PRISMATIC
                              ? KDL::Joint(joint.name, at.p, axis, KDL::Joint::TransAxis)
                              : KDL::Joint(joint.name, at.p, axis, KDL::Joint::RotAxis),
                          at, kdlBody(*link));
  }
  KDL::Chain chain;
  std::for_each(segments.rbegin(), segments.rend(), [&](const KDL::Segment &segment) { chain.addSegment(segment); });
  return chain;
}

inline KDL::Chain kdlSixAxes() { return kdlChain(*urdf::parseURDFFile(dataFile("generic-6r.urdf")), "base", "tool"); }
} // namespace vpArmTestKit
#endif
