/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/avoidance/vpFclChecker.h>
#include <visp3/core/vpException.h>
#include <visp3/direct_core/vpSO3.h>

#include <fcl/fcl.h>

#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
using Geometry = std::shared_ptr<fcl::CollisionGeometryd>;

struct Body {
  Geometry geometry;
  fcl::Transform3d local = fcl::Transform3d::Identity(); // In the object's frame.
};

fcl::Transform3d transform(const Eigen::Matrix3d &R, const Eigen::Vector3d &p)
{
  fcl::Transform3d T = fcl::Transform3d::Identity();
  T.linear() = R;
  T.translation() = p;
  return T;
}

Geometry meshOf(const vpTriangleMesh &mesh)
{
  auto model = std::make_shared<fcl::BVHModel<fcl::OBBRSSd>>();
  std::vector<fcl::Triangle> triangles;
  for (const auto &t : mesh.triangles()) {
    triangles.emplace_back(static_cast<std::size_t>(t[0]), static_cast<std::size_t>(t[1]),
                           static_cast<std::size_t>(t[2]));
  }
  model->beginModel();
  model->addSubModel(mesh.vertices(), triangles);
  model->endModel();
  return model;
}

// FCL's octree uses octomap's, with leaves of equal size.
Geometry octreeOf(const vpOctree &octree)
{
  double finest = std::numeric_limits<double>::infinity();
  for (const vpOctreeCell &cell : octree.cells()) {
    finest = std::min(finest, cell.size);
  }
  auto tree = std::make_shared<octomap::OcTree>(std::isfinite(finest) ? finest : 0.1);
  for (const vpOctreeCell &cell : octree.cells()) {
    const int n = std::max(1, static_cast<int>(std::lround(cell.size / finest)));
    for (int k = 0; k < n * n * n; ++k) {
      const Eigen::Vector3d step(k % n, k / n % n, k / n / n);
      const Eigen::Vector3d p = cell.centre + finest * (step - Eigen::Vector3d::Constant(0.5 * (n - 1)));
      tree->updateNode(p.x(), p.y(), p.z(), true, true);
    }
  }
  tree->updateInnerOccupancy();
  tree->prune();
  return std::make_shared<fcl::OcTreed>(std::shared_ptr<const octomap::OcTree>(tree));
}

Geometry geometryOf(const vpCollisionShape &shape)
{
  switch (shape.type()) {
  case vpShapeType::Sphere:
    return std::make_shared<fcl::Sphered>(shape.radius());
  case vpShapeType::Capsule:
    return std::make_shared<fcl::Capsuled>(shape.radius(), shape.length());
  case vpShapeType::Box:
    return std::make_shared<fcl::Boxd>(shape.size());
  case vpShapeType::Cylinder:
    return std::make_shared<fcl::Cylinderd>(shape.radius(), shape.length());
  case vpShapeType::Mesh:
    return meshOf(shape.mesh());
  default:
    return octreeOf(shape.octree());
  }
}
} // namespace

struct vpFclChecker::Bodies {
  std::vector<Geometry> capsules;
  std::vector<Geometry> objects;
  std::vector<fcl::Transform3d> at; // Poses of the capsules in the base.

  void place(const vpCollisionScene &scene, const vpCollisionData &data)
  {
    for (std::size_t i = 0; i < capsules.size(); ++i) {
      const vpPlacedCapsule &c = data.capsules[i];
      const Eigen::Vector3d axis = c.to - c.from;
      at[i] = transform(axis.norm() > 0. ? vpSO3::minimalRotation(Eigen::Vector3d::UnitZ(), axis)
                                         : Eigen::Matrix3d(Eigen::Matrix3d::Identity()),
                        c.centre);
    }
    static_cast<void>(scene);
  }

  static double distance(const Geometry &a, const fcl::Transform3d &atA, const Geometry &b, const fcl::Transform3d &atB,
                         vpClearance &pair)
  {
    fcl::DistanceRequestd request;
    request.enable_nearest_points = true;
    fcl::DistanceResultd result;
    const double d = fcl::distance(a.get(), atA, b.get(), atB, request, result);
    pair.onArm = result.nearest_points[0];
    pair.onOther = result.nearest_points[1];
    return std::max(d, 0.);
  }
  static bool touch(const Geometry &a, const fcl::Transform3d &atA, const Geometry &b, const fcl::Transform3d &atB)
  {
    const fcl::CollisionRequestd request;
    fcl::CollisionResultd result;
    return fcl::collide(a.get(), atA, b.get(), atB, request, result) > 0;
  }

  // Calls take(a, at a, b, at b, inflation, pair) for every pair that must not touch, until it returns true.
  template <class Take> void each(const vpCollisionScene &scene, Take take) const
  {
    for (int j = 0; j < scene.objectCount(); ++j) {
      const vpCollisionObject &object = scene.object(j);
      const fcl::Transform3d there = transform(object.pose.R, object.pose.p);
      for (int i = 0; i < scene.capsuleCount(); ++i) {
        if (scene.isChecked(i, j) &&
            give(i, objects[static_cast<std::size_t>(j)], there, object.inflation, vpCollisionKind::Object, j, take)) {
          return;
        }
      }
    }
    for (const vpSelfPair &pair : scene.selfPairs()) {
      const std::size_t k = static_cast<std::size_t>(pair.second);
      if (give(pair.first, capsules[k], at[k], 0., vpCollisionKind::Self, pair.second, take)) {
        return;
      }
    }
  }

private:
  template <class Take>
  bool give(int i, const Geometry &other, const fcl::Transform3d &there, double inflation, vpCollisionKind kind,
            int index, Take &take) const
  {
    vpClearance pair;
    pair.kind = kind;
    pair.capsule = i;
    pair.other = index;
    const std::size_t k = static_cast<std::size_t>(i);
    return take(capsules[k], at[k], other, there, inflation, pair);
  }
};

vpFclChecker::vpFclChecker(const vpCollisionScene &scene) : m_scene(&scene), m_bodies(std::make_unique<Bodies>())
{
  for (int i = 0; i < scene.capsuleCount(); ++i) {
    const vpArmCapsule &c = scene.capsule(i);
    m_bodies->capsules.push_back(std::make_shared<fcl::Capsuled>(c.radius, (c.to - c.from).norm()));
  }
  m_bodies->at.resize(m_bodies->capsules.size());
  for (int j = 0; j < scene.objectCount(); ++j) {
    m_bodies->objects.push_back(geometryOf(scene.object(j).shape));
  }
}

vpFclChecker::~vpFclChecker() = default;

bool vpFclChecker::inCollision(const vpJointVector &q, double margin)
{
  m_scene->place(q, m_data);
  if (!m_data.placed || std::isnan(margin)) {
    return true;
  }
  m_bodies->place(*m_scene, m_data);
  bool found = false;
  m_bodies->each(*m_scene, [&](const Geometry &a, const fcl::Transform3d &atA, const Geometry &b,
                               const fcl::Transform3d &atB, double inflation, vpClearance &pair) {
    found = inflation + margin > 0. ? !(Bodies::distance(a, atA, b, atB, pair) > inflation + margin)
                                    : Bodies::touch(a, atA, b, atB);
    return found;
  });
  for (int i = 0; i < m_scene->capsuleCount() && !found; ++i) {
    found = m_scene->isCheckedWithGround(i) && !(m_scene->groundPair(m_data, i).distance > margin);
  }
  return found;
}

vpClearance vpFclChecker::clearance(const vpJointVector &q, double cutoff)
{
  m_scene->place(q, m_data);
  if (!m_data.placed || std::isnan(cutoff)) {
    return m_scene->clearance(m_data, cutoff); // reports the error
  }
  m_bodies->place(*m_scene, m_data);
  vpClearance best;
  m_bodies->each(*m_scene, [&](const Geometry &a, const fcl::Transform3d &atA, const Geometry &b,
                               const fcl::Transform3d &atB, double inflation, vpClearance &pair) {
    pair.distance = Bodies::distance(a, atA, b, atB, pair) - inflation;
    if (pair.distance < std::min(cutoff, best.distance)) {
      best = pair;
      const Eigen::Vector3d gap = pair.onArm - pair.onOther;
      best.normal = gap.norm() > 0. ? Eigen::Vector3d(gap.normalized()) : Eigen::Vector3d::UnitZ();
    }
    return false;
  });
  for (int i = 0; i < m_scene->capsuleCount(); ++i) {
    if (m_scene->isCheckedWithGround(i)) {
      const vpClearance pair = m_scene->groundPair(m_data, i);
      best = pair.distance < std::min(cutoff, best.distance) ? pair : best;
    }
  }
  return best;
}

END_VISP_NAMESPACE
