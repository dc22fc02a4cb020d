/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpCollisionCore.h"
#include "vpExactQuery.h"
#include "vpTriangleSolid.h"

#include <fcl/fcl.h>

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
using Eigen::Vector3d;
constexpr double enclosed = 1e-6; // m: tolerance of a vertex in its capsule, for files that round
std::size_t at(int i) { return static_cast<std::size_t>(i); }

using Tree = fcl::BVHModel<fcl::OBBRSSd>;

// Triangles with a tree for FCL.
struct Solid {
  vpTriangleSolid shape;
  std::shared_ptr<Tree> tree;

  explicit Solid(vpTriangleSolid from) : shape(std::move(from)), tree(std::make_shared<Tree>())
  {
    std::vector<fcl::Triangle> triangles;
    for (const auto &t : shape.triangles) {
      triangles.emplace_back(at(t[0]), at(t[1]), at(t[2]));
    }
    tree->beginModel();
    tree->addSubModel(shape.vertices, triangles);
    tree->endModel();
  }
};

fcl::Transform3d transform(const vpRigidTransform &pose)
{
  fcl::Transform3d T = fcl::Transform3d::Identity();
  T.linear() = pose.R;
  T.translation() = pose.p;
  return T;
}

vpRigidTransform poseOf(const vpCollisionData &data, int link)
{
  return link > 0 ? data.arm.joint[at(link - 1)] : vpRigidTransform();
}

// Keeps in best the nearest pair of points that is nearer than best's distance plus radii.
void nearer(const Solid &a, const vpRigidTransform &atA, const Solid &b, const vpRigidTransform &atB, double radii,
            vpClearance &best)
{
  if (best.distance + radii <= 0.) {
    return;
  }
  const fcl::DistanceRequestd request(true);
  fcl::DistanceResultd result(best.distance + radii);
  fcl::distance(a.tree.get(), transform(atA), b.tree.get(), transform(atB), request, result);
  if (!(result.min_distance - radii < best.distance)) {
    return;
  }
  best.distance = std::max(0., result.min_distance - radii);
  best.onArm = result.nearest_points[0];
  best.onOther = result.nearest_points[1];
}

void touch(const Vector3d &where, vpClearance &best)
{
  best.distance = 0.;
  best.onArm = best.onOther = where;
}

// Parts of b inside a.
void inside(const Solid &a, const vpRigidTransform &atA, const Solid &b, const vpRigidTransform &atB, vpClearance &best)
{
  const vpRigidTransform aMb = atA.inverse() * atB;
  for (const Vector3d &part : b.shape.parts) {
    if (best.distance > 0. && a.shape.contains(aMb.R * part + aMb.p)) {
      touch(atB.R * part + atB.p, best);
    }
  }
}
} // namespace

struct vpExactBody {
  int link = 0;
  double thickness = 0.;
  std::vector<Solid> solids; // In the moving frame of the joint.
};

namespace
{
// Distance of a point from the axis of the nearest capsule of a body; how far it is outside all of them.
struct Nearness {
  double axis = std::numeric_limits<double>::infinity();
  double outside = std::numeric_limits<double>::infinity();
};

Nearness nearness(const vpArmSpec &spec, int body, const Vector3d &p)
{
  Nearness result;
  for (const vpArmCapsule &c : spec.capsules) {
    if (c.body == body) {
      const double distance = vpSegmentNearest::point(c.from, c.to, p).distance;
      result.axis = std::min(result.axis, distance);
      result.outside = std::min(result.outside, distance - c.radius);
    }
  }
  return result;
}

// Adds a shape in the link frame; how far it is outside the body's capsules, m.
double addShape(const vpArmModel &arm, const vpArmShape &shape, vpExactBody &body)
{
  const vpTriangleSolid solid = vpTriangleSolid::of(shape);
  double outside = 0.;
  for (const Vector3d &p : solid.vertices) {
    body.thickness = std::max(body.thickness, nearness(arm.spec(), shape.body, p).axis + solid.radius);
  }
  if (shape.kind == vpArmShapeKind::Sphere) { // the sphere itself: its solid is slightly larger
    outside = std::max(0., nearness(arm.spec(), shape.body, shape.pose.p).outside + shape.size(0));
  }
  else {
    for (const Vector3d &p : vpTriangleSolid::pointsOn(shape, solid)) {
      outside = std::max(outside, nearness(arm.spec(), shape.body, p).outside + solid.radius);
    }
  }
  vpTriangleSolid placed = solid;
  if (body.link > 0) {
    placed.move(arm.chain(body.link - 1).after);
  }
  body.solids.emplace_back(placed);
  return outside;
}

bool isSame(const vpArmCapsule &a, const vpArmCapsule &b)
{
  return a.link == b.link && a.from == b.from && a.to == b.to && a.radius == b.radius && a.body == b.body;
}
} // namespace

vpExactShapes::vpExactShapes(const vpArmModel &arm) : m_capsules(arm.spec().capsules)
{
  const vpArmSpec &spec = arm.spec();
  for (const vpArmBody &body : spec.bodies) {
    m_names.push_back(body.name);
  }
  std::vector<std::unique_ptr<vpExactBody>> bodies(spec.bodies.size());
  std::vector<double> outside(spec.bodies.size(), 0.);
  for (const vpArmShape &shape : spec.shapes) {
    const bool covered = std::any_of(spec.capsules.begin(), spec.capsules.end(),
                                     [&shape](const vpArmCapsule &c) { return c.body == shape.body; });
    if (!covered) {
      continue;
    }
    std::unique_ptr<vpExactBody> &body = bodies[at(shape.body)];
    if (!body) {
      body = std::make_unique<vpExactBody>();
      body->link = spec.bodies[at(shape.body)].link;
    }
    outside[at(shape.body)] = std::max(outside[at(shape.body)], addShape(arm, shape, *body));
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies[i] && !(outside[i] <= enclosed)) {
      m_warnings.push_back(arm.label() + ": the shape of body " + m_names[i] + " is " +
                           std::to_string(1e3 * outside[i]) + " mm outside its capsules, which are checked instead");
      bodies[i].reset();
    }
    m_bodies.push_back(std::move(bodies[i]));
  }
}

vpExactShapes::~vpExactShapes() = default;

bool vpExactShapes::has(int i) const noexcept { return i >= 0 && at(i) < m_bodies.size() && m_bodies[at(i)]; }

double vpExactShapes::thickness(int i) const noexcept { return has(i) ? m_bodies[at(i)]->thickness : 0.; }

bool vpExactShapes::isOf(const vpArmModel &arm) const noexcept
{
  const vpArmSpec &spec = arm.spec();
  return m_names.size() == spec.bodies.size() && m_capsules.size() == spec.capsules.size() &&
         std::equal(m_names.begin(), m_names.end(), spec.bodies.begin(),
                    [](const std::string &name, const vpArmBody &body) { return name == body.name; }) &&
         std::equal(m_capsules.begin(), m_capsules.end(), spec.capsules.begin(), isSame);
}

const vpExactBody &vpExactShapes::body(int i) const noexcept { return *m_bodies[at(i)]; }

struct vpExactQuery::Objects {
  unsigned long revision = 0;
  std::vector<std::unique_ptr<Solid>> solids;

  const Solid &at(const vpCollisionScene &scene, int i)
  {
    if (revision != scene.revision()) {
      solids.clear();
      solids.resize(static_cast<std::size_t>(scene.objectCount()));
      revision = scene.revision();
    }
    std::unique_ptr<Solid> &solid = solids[static_cast<std::size_t>(i)];
    if (!solid) {
      solid = std::make_unique<Solid>(vpTriangleSolid::of(scene.object(i).shape));
    }
    return *solid;
  }
};

vpExactQuery::vpExactQuery() : m_objects(std::make_unique<Objects>()) {}
vpExactQuery::~vpExactQuery() = default;

namespace
{
void toObject(const vpCollisionScene &scene, const Solid &solid, const vpRigidTransform &pose, const Solid &object,
              int i, bool within, vpClearance &best)
{
  const vpCollisionCore &core = scene.core(i);
  nearer(solid, pose, object, core.pose, solid.shape.radius + core.radius, best);
  if (!within) {
    return;
  }
  inside(solid, pose, object, core.pose, best);
  for (const Vector3d &part : solid.shape.parts) {
    const Vector3d p = pose.R * part + pose.p;
    if (best.distance > 0. && core.nearest(p, p, 1e-9).distance <= 0.) {
      touch(p, best);
    }
  }
}

void toGround(const vpHalfSpace &ground, const Solid &solid, const vpRigidTransform &pose, vpClearance &best)
{
  for (const Vector3d &vertex : solid.shape.vertices) {
    const Vector3d p = pose.R * vertex + pose.p;
    const double height = ground.normal.dot(p) - ground.offset - solid.shape.radius;
    if (height < best.distance) {
      best.distance = height;
      best.onArm = p;
      best.onOther = p - (height + solid.shape.radius) * ground.normal;
    }
  }
}
} // namespace

vpClearance vpExactQuery::clearance(const vpCollisionScene &scene, const vpCollisionData &data, const vpExactPair &pair,
                                    double cutoff, bool within)
{
  vpClearance best;
  best.distance = cutoff;
  const vpExactBody &body = scene.exact()->body(pair.body);
  const vpRigidTransform pose = poseOf(data, body.link);
  for (const Solid &solid : body.solids) {
    if (pair.kind == vpCollisionKind::Object) {
      toObject(scene, solid, pose, m_objects->at(scene, pair.other), pair.other, within, best);
      continue;
    }
    if (pair.kind == vpCollisionKind::Ground) {
      toGround(*scene.ground(), solid, pose, best);
      continue;
    }
    const vpExactBody &inner = scene.exact()->body(pair.other);
    const vpRigidTransform there = poseOf(data, inner.link);
    for (const Solid &other : inner.solids) {
      nearer(solid, pose, other, there, solid.shape.radius + other.shape.radius, best);
      if (within) {
        inside(solid, pose, other, there, best);
        inside(other, there, solid, pose, best);
      }
    }
  }
  if (!(best.distance < cutoff)) {
    return {};
  }
  best.kind = pair.kind;
  best.capsule = pair.kind == vpCollisionKind::Self ? pair.inner : pair.capsule;
  best.other = pair.kind == vpCollisionKind::Self ? pair.capsule : pair.other;
  if (pair.kind == vpCollisionKind::Self) {
    std::swap(best.onArm, best.onOther);
  }
  const Vector3d gap = best.onArm - best.onOther;
  best.normal = pair.kind == vpCollisionKind::Ground ? scene.ground()->normal
                : gap.norm() > 0.                    ? Vector3d(gap.normalized())
                                                     : Vector3d(Vector3d::UnitZ());
  return best;
}

END_VISP_NAMESPACE
