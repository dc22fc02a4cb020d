/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The true shapes of an arm by FCL: primitives as FCL has them, meshes as read, in frames of the links.
#ifndef vpExactOracle_h
#define vpExactOracle_h

#include "vpAvoidanceTestKit.h"

#include <visp3/avoidance/vpExactShapes.h>

#include <Eigen/LU>
#include <fcl/fcl.h>

#include <set>

namespace vpAvoidanceTestKit
{
class ExactOracle
{
public:
  ExactOracle(const vpArmModel &arm, const vpCollisionScene &scene) : m_arm(&arm)
  {
    for (const vpArmShape &shape : arm.spec().shapes) {
      Part part{geometry(shape), shape.body, arm.spec().bodies[index(shape.body)].link, shape.pose, nullptr};
      if (shape.kind == vpArmShapeKind::Mesh) {
        part.mesh = std::make_shared<vpTriangleMesh>(vpTriangleMesh::load(shape.file, shape.size));
      }
      m_shapes.push_back(part);
    }
    for (const vpSelfPair &pair : scene.selfPairs()) {
      m_pairs.insert({scene.capsule(pair.first).body, scene.capsule(pair.second).body});
    }
    for (int j = 0; j < scene.objectCount(); ++j) {
      for (int i = 0; i < scene.capsuleCount(); ++i) {
        if (!scene.isChecked(i, j)) {
          m_allowed.insert({scene.capsule(i).body, j}); // on the base, or an allowed contact
        }
      }
      m_objects.push_back({geometry(scene.object(j).shape), j, 0, scene.object(j).pose, nullptr});
    }
  }

  //! Takes the poses of the objects from a scene with the same ones.
  void follow(const vpCollisionScene &scene)
  {
    for (int j = 0; j < scene.objectCount(); ++j) {
      m_objects[index(j)].pose = scene.object(j).pose;
    }
  }

  //! True if a body touches an object that it must not touch, or another body that it must not touch. Surfaces only:
  //! not what is inside.
  [[nodiscard]] bool touches(const vpJointVector &q) const
  {
    vpArmData data;
    vpArmKinematics::forward(*m_arm, q, data);
    for (std::size_t i = 0; i < m_shapes.size(); ++i) {
      const fcl::Transform3d at = place(data, m_shapes[i]);
      for (const Part &object : m_objects) {
        if (m_allowed.count({m_shapes[i].body, object.body}) == 0 &&
            collide(m_shapes[i], at, object, transform(object.pose))) {
          return true;
        }
      }
      for (std::size_t k = 0; k < m_shapes.size(); ++k) {
        if (m_pairs.count({m_shapes[i].body, m_shapes[k].body}) > 0 &&
            collide(m_shapes[i], at, m_shapes[k], place(data, m_shapes[k]))) {
          return true;
        }
      }
    }
    return false;
  }

  //! True if a body has a point inside the mesh of another one that it must not touch: by the parity of crossings.
  [[nodiscard]] bool isHidden(const vpJointVector &q) const
  {
    vpArmData data;
    vpArmKinematics::forward(*m_arm, q, data);
    for (const Part &outer : m_shapes) {
      for (const Part &inner : m_shapes) {
        const bool checked = m_pairs.count({outer.body, inner.body}) > 0 || m_pairs.count({inner.body, outer.body}) > 0;
        const Vector3d p = inner.mesh ? inner.mesh->vertices().front() : Vector3d(Vector3d::Zero());
        if (outer.mesh && checked && isInside(*outer.mesh, place(data, outer).inverse() * (place(data, inner) * p))) {
          return true;
        }
      }
    }
    return false;
  }

private:
  static bool isInside(const vpTriangleMesh &mesh, const Vector3d &p)
  {
    const Vector3d ray(0.31, 0.52, 0.79);
    bool inside = false;
    for (const auto &t : mesh.triangles()) {
      Eigen::Matrix3d M; // p + s ray = a + u (b - a) + v (c - a)
      const Vector3d &a = mesh.vertices()[index(t[0])];
      M << -ray, mesh.vertices()[index(t[1])] - a, mesh.vertices()[index(t[2])] - a;
      const Vector3d suv = M.fullPivLu().solve(p - a);
      inside = inside != (suv.minCoeff() > 0. && suv(1) + suv(2) < 1.);
    }
    return inside;
  }
  struct Part {
    std::shared_ptr<fcl::CollisionGeometryd> geometry;
    int body;
    int link;
    vpRigidTransform pose; // in the link
    std::shared_ptr<vpTriangleMesh> mesh;
  };

  static std::size_t index(int i) { return static_cast<std::size_t>(i); }

  static std::shared_ptr<fcl::CollisionGeometryd> geometry(const vpTriangleMesh &mesh,
                                                           const Vector3d &scale = Vector3d::Ones())
  {
    auto model = std::make_shared<fcl::BVHModel<fcl::OBBRSSd>>();
    std::vector<fcl::Triangle> triangles;
    for (const auto &t : mesh.triangles()) {
      triangles.emplace_back(index(t[0]), index(t[1]), index(t[2]));
    }
    model->beginModel();
    std::vector<Vector3d> vertices;
    for (const Vector3d &v : mesh.vertices()) {
      vertices.push_back(scale.cwiseProduct(v));
    }
    model->addSubModel(vertices, triangles);
    model->endModel();
    return model;
  }
  static std::shared_ptr<fcl::CollisionGeometryd> geometry(const vpArmShape &shape)
  {
    switch (shape.kind) {
    case vpArmShapeKind::Sphere:
      return std::make_shared<fcl::Sphered>(shape.size(0));
    case vpArmShapeKind::Cylinder:
      return std::make_shared<fcl::Cylinderd>(shape.size(0), shape.size(1));
    case vpArmShapeKind::Box:
      return std::make_shared<fcl::Boxd>(shape.size);
    default:
      return geometry(vpTriangleMesh::load(shape.file), shape.size);
    }
  }
  static std::shared_ptr<fcl::CollisionGeometryd> geometry(const vpCollisionShape &shape)
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
    default:
      return geometry(shape.mesh());
    }
  }
  static fcl::Transform3d transform(const vpRigidTransform &pose)
  {
    fcl::Transform3d T = fcl::Transform3d::Identity();
    T.linear() = pose.R;
    T.translation() = pose.p;
    return T;
  }
  [[nodiscard]] fcl::Transform3d place(const vpArmData &data, const Part &part) const
  {
    const vpRigidTransform link = part.link > 0 ? vpArmKinematics::link(*m_arm, data, part.link) : vpRigidTransform();
    return transform(link * part.pose);
  }
  static bool collide(const Part &a, const fcl::Transform3d &atA, const Part &b, const fcl::Transform3d &atB)
  {
    const fcl::CollisionRequestd request;
    fcl::CollisionResultd result;
    return fcl::collide(a.geometry.get(), atA, b.geometry.get(), atB, request, result) > 0;
  }

  const vpArmModel *m_arm;
  std::vector<Part> m_shapes, m_objects;
  std::set<std::pair<int, int>> m_pairs, m_allowed;
};
} // namespace vpAvoidanceTestKit
#endif
