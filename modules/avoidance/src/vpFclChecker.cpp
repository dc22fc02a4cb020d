/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/avoidance/vpFclChecker.h>
#include <visp3/core/vpException.h>
#include <visp3/direct_core/vpSO3.h>

#include <fcl/fcl.h>

#include <cmath>
#include <cstdint>
#include <vector>

BEGIN_VISP_NAMESPACE

namespace
{
using Geometry = std::shared_ptr<fcl::CollisionGeometryd>;

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

// A body with the box of its shape where it is: FCL's own is that of the bounding ball.
class Object : public fcl::CollisionObjectd
{
public:
  explicit Object(const Geometry &geometry) : fcl::CollisionObjectd(geometry) {}
  void place(const fcl::Transform3d &at)
  {
    setTransform(at);
    switch (cgeom->getNodeType()) {
    case fcl::GEOM_CAPSULE:
      aabb = boxOf<fcl::Capsuled>(at);
      break;
    case fcl::GEOM_BOX:
      aabb = boxOf<fcl::Boxd>(at);
      break;
    case fcl::GEOM_CYLINDER:
      aabb = boxOf<fcl::Cylinderd>(at);
      break;
    default:
      computeAABB();
    }
  }

private:
  template <class Shape> [[nodiscard]] fcl::AABBd boxOf(const fcl::Transform3d &at) const
  {
    fcl::AABBd box;
    fcl::computeBV(static_cast<const Shape &>(*cgeom), at, box);
    return box;
  }
};

using Objects = std::vector<std::unique_ptr<Object>>;
} // namespace

// The objects are in FCL's broad phase. A question of collision pads the capsules and asks collide(); distances and
// nearest points are for clearance() alone.
struct vpFclChecker::Bodies {
  Objects capsules, padded, objects;   // padded: of one padding at a time
  std::vector<fcl::Transform3d> at;    // Poses of the capsules in the base.
  std::vector<vpRigidTransform> poses; // of the objects in the broad phase
  fcl::DynamicAABBTreeCollisionManagerd manager;
  double padding = 0.;

  // After place(): the padded capsules, where the arm is.
  void pad(double wanted)
  {
    for (std::size_t i = 0; i < padded.size(); ++i) {
      if (padding != wanted) {
        const auto &plain = static_cast<const fcl::Capsuled &>(*capsules[i]->collisionGeometry());
        padded[i] = std::make_unique<Object>(std::make_shared<fcl::Capsuled>(plain.radius + wanted, plain.lz));
      }
      padded[i]->place(at[i]);
    }
    padding = wanted;
  }

  void place(const vpCollisionScene &scene, const vpCollisionData &data)
  {
    for (std::size_t i = 0; i < capsules.size(); ++i) {
      const vpPlacedCapsule &c = data.capsules[i];
      const Eigen::Vector3d axis = c.to - c.from;
      at[i] = transform(axis.norm() > 0. ? vpSO3::minimalRotation(Eigen::Vector3d::UnitZ(), axis)
                                         : Eigen::Matrix3d(Eigen::Matrix3d::Identity()),
                        c.centre);
      capsules[i]->place(at[i]);
    }
    bool moved = false;
    for (std::size_t j = 0; j < objects.size(); ++j) {
      const vpRigidTransform &pose = scene.object(static_cast<int>(j)).pose;
      if (poses[j].R != pose.R || poses[j].p != pose.p) {
        poses[j] = pose;
        objects[j]->place(transform(pose.R, pose.p));
        moved = true;
      }
    }
    if (moved) {
      manager.update();
    }
  }
  [[nodiscard]] int indexOf(const fcl::CollisionObjectd *object) const
  {
    return static_cast<int>(reinterpret_cast<std::uintptr_t>(object->getUserData()));
  }

  static double distance(const Object &a, const fcl::CollisionObjectd &b, vpClearance &pair)
  {
    fcl::DistanceRequestd request;
    request.enable_nearest_points = true;
    fcl::DistanceResultd result;
    const double d = fcl::distance(&a, &b, request, result);
    pair.onArm = result.nearest_points[0];
    pair.onOther = result.nearest_points[1];
    return std::max(d, 0.);
  }
  static bool touch(const fcl::CollisionObjectd &a, const fcl::CollisionObjectd &b)
  {
    const fcl::CollisionRequestd request;
    fcl::CollisionResultd result;
    return fcl::collide(&a, &b, request, result) > 0;
  }

  [[nodiscard]] static double largestInflation(const vpCollisionScene &scene)
  {
    double largest = 0.;
    for (int j = 0; j < scene.objectCount(); ++j) {
      largest = std::max(largest, scene.object(j).inflation);
    }
    return largest;
  }

  bool touchesObject(const vpCollisionScene &scene, double margin) const
  {
    for (std::size_t i = 0; i < capsules.size(); ++i) {
      bool found = false;
      auto take = [&](const fcl::CollisionObjectd *a, const fcl::CollisionObjectd *b) {
        const int j = indexOf(a == padded[i].get() ? b : a);
        if (scene.isChecked(static_cast<int>(i), j)) {
          const double wanted = std::max(0., margin + scene.object(j).inflation);
          vpClearance pair;
          const Object &object = *objects[static_cast<std::size_t>(j)];
          found = wanted == padding ? touch(*padded[i], object)
                  : wanted > 0.     ? !(distance(*capsules[i], object, pair) > wanted)
                                    : touch(*capsules[i], object);
        }
        return found;
      };
      manager.collide(padded[i].get(), &take, [](fcl::CollisionObjectd *a, fcl::CollisionObjectd *b, void *data) {
        return (*static_cast<decltype(take) *>(data))(a, b);
      });
      if (found) {
        return true;
      }
    }
    return false;
  }

  bool touchesItself(const vpCollisionScene &scene, double margin) const
  {
    const double wanted = std::max(0., margin);
    for (const vpSelfPair &self : scene.selfPairs()) {
      const auto i = static_cast<std::size_t>(self.first), k = static_cast<std::size_t>(self.second);
      vpClearance pair;
      if (padded[i]->getAABB().overlap(capsules[k]->getAABB()) &&
          (wanted == padding ? touch(*padded[i], *capsules[k])
           : wanted > 0.     ? !(distance(*capsules[i], *capsules[k], pair) > wanted)
                             : touch(*capsules[i], *capsules[k]))) {
        return true;
      }
    }
    return false;
  }

  // Keeps the pair if it is nearer. Returns the distance that another must be below.
  static double keep(double cutoff, vpClearance pair, vpClearance &best)
  {
    if (pair.distance < std::min(cutoff, best.distance)) {
      best = pair;
      const Eigen::Vector3d gap = pair.onArm - pair.onOther;
      best.normal = gap.norm() > 0. ? Eigen::Vector3d(gap.normalized()) : Eigen::Vector3d::UnitZ();
    }
    return std::min(cutoff, best.distance);
  }

  void nearestObject(const vpCollisionScene &scene, double cutoff, vpClearance &best) const
  {
    const double inflation = largestInflation(scene);
    for (std::size_t i = 0; i < capsules.size(); ++i) {
      auto take = [&](const fcl::CollisionObjectd *a, const fcl::CollisionObjectd *b, double &below) {
        vpClearance pair;
        pair.kind = vpCollisionKind::Object;
        pair.capsule = static_cast<int>(i);
        pair.other = indexOf(a == capsules[i].get() ? b : a);
        if (scene.isChecked(pair.capsule, pair.other)) {
          pair.distance = distance(*capsules[i], *objects[static_cast<std::size_t>(pair.other)], pair) -
                          scene.object(pair.other).inflation;
          below = keep(cutoff, pair, best) + inflation;
        }
        return false;
      };
      manager.distance(capsules[i].get(), &take,
                       [](fcl::CollisionObjectd *a, fcl::CollisionObjectd *b, void *data, double &below) {
                         return (*static_cast<decltype(take) *>(data))(a, b, below);
                       });
    }
  }

  void nearestSelf(const vpCollisionScene &scene, double cutoff, vpClearance &best) const
  {
    for (const vpSelfPair &self : scene.selfPairs()) {
      const Object &a = *capsules[static_cast<std::size_t>(self.first)];
      const Object &b = *capsules[static_cast<std::size_t>(self.second)];
      if (a.getAABB().distance(b.getAABB()) < std::min(cutoff, best.distance)) {
        vpClearance pair;
        pair.kind = vpCollisionKind::Self;
        pair.capsule = self.first;
        pair.other = self.second;
        pair.distance = distance(a, b, pair);
        keep(cutoff, pair, best);
      }
    }
  }
};

vpFclChecker::vpFclChecker(const vpCollisionScene &scene) : m_scene(&scene), m_bodies(std::make_unique<Bodies>())
{
  Bodies &bodies = *m_bodies;
  for (int i = 0; i < scene.capsuleCount(); ++i) {
    const vpArmCapsule &c = scene.capsule(i);
    const auto geometry = std::make_shared<fcl::Capsuled>(c.radius, (c.to - c.from).norm());
    bodies.capsules.push_back(std::make_unique<Object>(geometry));
    bodies.padded.push_back(std::make_unique<Object>(geometry));
  }
  bodies.at.resize(bodies.capsules.size());
  for (int j = 0; j < scene.objectCount(); ++j) {
    const vpRigidTransform &pose = scene.object(j).pose;
    bodies.objects.push_back(std::make_unique<Object>(geometryOf(scene.object(j).shape)));
    bodies.objects.back()->place(transform(pose.R, pose.p));
    bodies.objects.back()->setUserData(reinterpret_cast<void *>(static_cast<std::uintptr_t>(j)));
    bodies.poses.push_back(pose);
    bodies.manager.registerObject(bodies.objects.back().get());
  }
  bodies.manager.setup();
}

vpFclChecker::~vpFclChecker() = default;

bool vpFclChecker::inCollision(const vpJointVector &q, double margin)
{
  m_scene->place(q, m_data);
  if (!m_data.placed || std::isnan(margin)) {
    return true;
  }
  if (margin > vpLargestLength) { // no capsule is so thick
    return clearance(q, std::numeric_limits<double>::infinity()).distance <= margin;
  }
  Bodies &bodies = *m_bodies;
  bodies.place(*m_scene, m_data);
  bodies.pad(std::max(0., margin + bodies.largestInflation(*m_scene)));
  return bodies.touchesObject(*m_scene, margin) || bodies.touchesItself(*m_scene, margin) || touchesGround(margin);
}

bool vpFclChecker::touchesGround(double margin) const
{
  for (int i = 0; i < m_scene->capsuleCount(); ++i) {
    if (m_scene->isCheckedWithGround(i) && !(m_scene->groundPair(m_data, i).distance > margin)) {
      return true;
    }
  }
  return false;
}

vpClearance vpFclChecker::clearance(const vpJointVector &q, double cutoff)
{
  m_scene->place(q, m_data);
  if (!m_data.placed || std::isnan(cutoff)) {
    return m_scene->clearance(m_data, cutoff); // reports the error
  }
  Bodies &bodies = *m_bodies;
  bodies.place(*m_scene, m_data);
  vpClearance best;
  bodies.nearestObject(*m_scene, cutoff, best);
  bodies.nearestSelf(*m_scene, cutoff, best);
  for (int i = 0; i < m_scene->capsuleCount(); ++i) {
    if (m_scene->isCheckedWithGround(i)) {
      const vpClearance pair = m_scene->groundPair(m_data, i);
      best = pair.distance < std::min(cutoff, best.distance) ? pair : best;
    }
  }
  return best;
}

END_VISP_NAMESPACE
