/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Clearance of an arm from solids and the ground by code independent of the scene, for verifying motions reported free.
#ifndef vpIndependentClearance_h
#define vpIndependentClearance_h

#include "vpAvoidanceTestKit.h"

#include <visp3/avoidance/vpCollisionScene.h>

#include <vector>

namespace vpAvoidanceTestKit
{
/*
 * Clearance without any code of the scene: frames of the links by their own product of transforms, distances of points
 * on the axes. The axis is cut into pieces; a point's distance changes by no more than it moves, so the distance of a
 * piece is known to half its length, and short pieces end in a search.
 */
class IndependentClearance
{
public:
  IndependentClearance(const vpArmModel &arm, const vpCollisionSceneSpec &spec) : m_arm(&arm), m_spec(&spec) {}

  // Least clearance of the pairs that vpCollisionScene checks for an arm without allowed contacts, if it is below
  // limit.
  [[nodiscard]] double clearance(const vpJointVector &q, const std::vector<vpSelfPair> &selfPairs, double limit) const
  {
    const std::vector<vpPlacedCapsule> capsules = place(q);
    double least = limit;
    for (std::size_t i = 0; i < capsules.size(); ++i) {
      const vpPlacedCapsule &c = capsules[i];
      if (c.halfLength < 0.) {
        continue; // Of the base.
      }
      if (m_spec->ground && m_arm->spec().capsules[i].link >= m_spec->ground->firstLink) { // of a unit normal
        const vpHalfSpace &ground = *m_spec->ground;
        least = std::min({least, ground.normal.dot(c.from) - ground.offset - c.radius,
                          ground.normal.dot(c.to) - ground.offset - c.radius});
      }
      for (const vpCollisionObject &object : m_spec->objects) {
        const vpRigidTransform oMf = object.pose.inverse();
        const double radii = c.radius + object.inflation;
        if ((c.centre - object.pose.p).norm() - c.halfLength - radii - extent(object.shape) < least) {
          const Vector3d from = oMf.R * c.from + oMf.p, to = oMf.R * c.to + oMf.p;
          least = std::min(least, below(object.shape, from, to, least + radii) - radii);
        }
      }
    }
    for (const vpSelfPair &pair : selfPairs) {
      const vpPlacedCapsule &a = capsules[static_cast<std::size_t>(pair.first)],
                            &b = capsules[static_cast<std::size_t>(pair.second)];
      // The other's axis as a capsule without radius, in its own frame.
      const double length = (b.to - b.from).norm();
      const vpCollisionShape axis = vpCollisionShape::capsule(b.radius, length);
      const Eigen::Matrix3d R = vpSO3::minimalRotation(b.to - b.from, Vector3d::UnitZ());
      const Vector3d from = R * (a.from - b.centre), to = R * (a.to - b.centre);
      least = std::min(least, below(axis, from, to, least + a.radius) - a.radius);
    }
    return least;
  }

private:
  // No point of the solid is farther from its origin.
  static double extent(const vpCollisionShape &shape)
  {
    return shape.type() == vpShapeType::Box ? 0.5 * shape.size().norm() : 0.5 * shape.length() + shape.radius();
  }

  [[nodiscard]] std::vector<vpPlacedCapsule> place(const vpJointVector &q) const
  {
    std::vector<Eigen::Isometry3d> links = {Eigen::Isometry3d::Identity()};
    const auto add = [&links](const auto &joint, double value) {
      Eigen::Isometry3d before = Eigen::Isometry3d::Identity(), after = before, motion = before;
      before.linear() = joint.before.R;
      before.translation() = joint.before.p;
      after.linear() = joint.after.R;
      after.translation() = joint.after.p;
      if (joint.type == vpJointType::Prismatic) {
        motion.translation().z() = value;
      }
      else {
        motion.linear() = Eigen::AngleAxisd(value, Vector3d::UnitZ()).toRotationMatrix();
      }
      links.push_back(links.back() * before * motion * after);
    };
    for (int i = 0; i <= m_arm->size(); ++i) {
      for (const vpArmFollower &follower : m_arm->spec().followers) {
        if (follower.place == i) {
          add(follower, follower.ratio * q(follower.joint) + follower.offset);
        }
      }
      if (i < m_arm->size()) {
        const vpArmJointSpec &joint = m_arm->spec().joints[static_cast<std::size_t>(i)];
        add(joint, q(i) + joint.offset);
      }
    }
    std::vector<vpPlacedCapsule> capsules;
    for (const vpArmCapsule &c : m_arm->spec().capsules) {
      vpPlacedCapsule result;
      result.from = links[static_cast<std::size_t>(c.link)] * c.from;
      result.to = links[static_cast<std::size_t>(c.link)] * c.to;
      result.centre = 0.5 * (result.from + result.to);
      result.halfLength = c.link == 0 ? -1. : 0.5 * (c.to - c.from).norm();
      result.radius = c.radius;
      capsules.push_back(result);
    }
    return capsules;
  }

  // Distance of a segment from a solid, exact to 1e-9 when it is below limit.
  static double below(const vpCollisionShape &shape, const Vector3d &from, const Vector3d &to, double limit)
  {
    const Vector3d middle = 0.5 * (from + to);
    const double half = 0.5 * (to - from).norm();
    if (pointDistance(shape, middle) - half >= limit) {
      return limit;
    }
    if (half > 0.02) {
      return below(shape, middle, to, below(shape, from, middle, limit));
    }
    return std::min(limit, segmentDistance(shape, from, to));
  }

  const vpArmModel *m_arm;
  const vpCollisionSceneSpec *m_spec;
};
} // namespace vpAvoidanceTestKit
#endif
