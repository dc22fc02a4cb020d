/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpSceneRaster.h"

#include <visp3/direct_core/vpDirectCompat.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

BEGIN_VISP_NAMESPACE

namespace
{
/*!
 * Each body has hit(): the first intersection of the ray from + t along, t > 0, where it enters the body. It gives t,
 * infinity for none, and the normal there (of any length and sign).
 */
namespace vpRayCast
{
using Eigen::Vector3d;
constexpr double none = std::numeric_limits<double>::infinity();

//! Lower root of a t^2 + 2 b t + c; infinity if there is none above 0.
inline double enter(double a, double b, double c)
{
  const double under = b * b - a * c;
  if (!(under > 0.) || !(a > 0.)) {
    return none;
  }
  const double t = (-b - std::sqrt(under)) / a;
  return t > 0. ? t : none;
}

struct Sphere {
  double radius;
  [[nodiscard]] double hit(const Vector3d &from, const Vector3d &along, Vector3d &normal) const
  {
    const double t = enter(along.squaredNorm(), from.dot(along), from.squaredNorm() - radius * radius);
    normal = from + t * along;
    return t;
  }
};

//! Along z, centred; with round or flat ends.
struct Tube {
  double radius, half;
  bool isRound;
  [[nodiscard]] double hit(const Vector3d &from, const Vector3d &along, Vector3d &normal) const
  {
    const double a = along.head<2>().squaredNorm(), b = from.head<2>().dot(along.head<2>());
    const double side = enter(a, b, from.head<2>().squaredNorm() - radius * radius);
    double best = none;
    if (side < none && std::fabs(from.z() + side * along.z()) <= half) {
      best = side;
      normal = Vector3d(from.x() + side * along.x(), from.y() + side * along.y(), 0.);
    }
    for (const double sign : {-1., 1.}) {
      const Vector3d end(0., 0., sign * half);
      Vector3d n = end;
      const double t = isRound ? Sphere{radius}.hit(from - end, along, n) : lid(from, along, sign);
      if (t < best) {
        best = t;
        normal = n;
      }
    }
    // From inside an end sphere or the tube there is no entry.
    return best;
  }

private:
  [[nodiscard]] double lid(const Vector3d &from, const Vector3d &along, double sign) const
  {
    const double t = (sign * half - from.z()) / along.z();
    const bool isEntry = sign * along.z() < 0. && t > 0.;
    return isEntry && (from + t * along).head<2>().squaredNorm() <= radius * radius ? t : none;
  }
};

struct Box {
  Vector3d half;
  [[nodiscard]] double hit(const Vector3d &from, const Vector3d &along, Vector3d &normal) const
  {
    // A ray along a face gets an irrelevant slope instead of a division by 0.
    const auto slope = [](double d) { return 1. / (d == 0. ? 1e-300 : d); };
    const Vector3d inverse(slope(along.x()), slope(along.y()), slope(along.z()));
    const Vector3d middle = -from.cwiseProduct(inverse), reach = half.cwiseProduct(inverse).cwiseAbs();
    const Vector3d first = middle - reach, last = middle + reach;
    const double in = std::max({first.x(), first.y(), first.z()}), out = std::min({last.x(), last.y(), last.z()});
    if (!(in > 0.) || in > out) {
      return none;
    }
    normal = Vector3d(first.x() == in ? 1. : 0., first.y() == in ? 1. : 0., first.z() == in ? 1. : 0.);
    return in;
  }
};

//! Visible from both sides.
struct Triangle {
  Vector3d a, b, c;
  [[nodiscard]] double hit(const Vector3d &from, const Vector3d &along, Vector3d &normal) const
  {
    // Side of each edge on which the ray passes.
    const Vector3d p = a - from, q = b - from, r = c - from;
    const double ab = along.dot(p.cross(q)), bc = along.dot(q.cross(r)), ca = along.dot(r.cross(p));
    if (!((ab >= 0. && bc >= 0. && ca >= 0.) || (ab <= 0. && bc <= 0. && ca <= 0.))) {
      return none;
    }
    normal = (b - a).cross(c - a);
    const double t = normal.dot(p) / normal.dot(along);
    return t > 0. ? t : none; // false for NaN: the ray lies in the triangle's plane
  }
};
} // namespace vpRayCast

constexpr double nearest = 0.01;             // m; nearer bodies are not seen
constexpr double darkest = 0.45;             // of the object's tone, where the light comes from the side
const Eigen::Vector3d light(0.35, 0.5, 0.8); // in the base
constexpr double groundTone = 118.;

// Different objects look different, the same one looks the same in every run and on every machine.
double toneOf(const std::string &name)
{
  unsigned int hash = 2166136261U; // FNV-1a
  for (const char c : name) {
    hash = (hash ^ static_cast<unsigned char>(c)) * 16777619U;
  }
  return 90. + hash % 120U;
}

// Pixels of a sphere along one axis; false if it is outside the image.
bool range(double across, double along, double radius, double focal, double centre, int size, int &low, int &high)
{
  low = 0;
  high = size - 1;
  const double distance = std::hypot(across, along);
  if (distance <= radius * (1. + 1e-9)) {
    return true; // around the camera
  }
  const double middle = std::atan2(across, along), half = std::asin(radius / distance);
  constexpr double edge = 1.57; // rad; no image beyond it
  if (middle - half >= edge || middle + half <= -edge) {
    return false;
  }
  // One pixel more for rounding.
  if (middle - half > -edge) {
    low = static_cast<int>(std::clamp(focal * std::tan(middle - half) + centre - 1., 0., static_cast<double>(size)));
  }
  if (middle + half < edge) {
    high = static_cast<int>(std::clamp(focal * std::tan(middle + half) + centre + 1., -1., size - 1.));
  }
  return low <= high;
}
} // namespace

vpSceneRaster::vpSceneRaster(const vpCameraParameters &camera, unsigned int width, unsigned int height)
  : m_camera(camera), m_width(static_cast<int>(width)), m_height(static_cast<int>(height)), m_depth(height, width)
{}

vpSceneRaster::Window vpSceneRaster::window(const Eigen::Vector3d &centre, double radius) const
{
  Window w{0, 0, -1, -1};
  int left, right, top, bottom;
  if (centre.z() + radius > nearest &&
      range(centre.x(), centre.z(), radius, m_camera.get_px(), m_camera.get_u0(), m_width, left, right) &&
      range(centre.y(), centre.z(), radius, m_camera.get_py(), m_camera.get_v0(), m_height, top, bottom)) {
    w = {left, top, right, bottom};
  }
  return w;
}

// The image bounds of a box's corners have far fewer pixels than its sphere, if all are in front of the camera.
void vpSceneRaster::drawBox(const Eigen::Vector3d &half, const vpRigidTransform &cMo)
{
  Window w = window(cMo.p, half.norm());
  double left = m_width, right = -1., top = m_height, bottom = -1.;
  bool isInFront = true;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d signs(i % 2 == 0 ? -1. : 1., i / 2 % 2 == 0 ? -1. : 1., i / 4 == 0 ? -1. : 1.);
    const Eigen::Vector3d corner = cMo.R * half.cwiseProduct(signs) + cMo.p;
    isInFront = isInFront && corner.z() > nearest;
    const double u = m_camera.get_px() * corner.x() / corner.z() + m_camera.get_u0();
    const double v = m_camera.get_py() * corner.y() / corner.z() + m_camera.get_v0();
    left = std::min(left, u);
    right = std::max(right, u);
    top = std::min(top, v);
    bottom = std::max(bottom, v);
  }
  if (isInFront) {
    w.left = std::max(w.left, static_cast<int>(std::max(left - 1., 0.)));
    w.right = std::min(w.right, static_cast<int>(std::min(right + 1., m_width - 1.)));
    w.top = std::max(w.top, static_cast<int>(std::max(top - 1., 0.)));
    w.bottom = std::min(w.bottom, static_cast<int>(std::min(bottom + 1., m_height - 1.)));
  }
  drawIn(w, vpRayCast::Box{half}, cMo);
}

template <class Body>
void vpSceneRaster::drawBody(const Body &body, const vpRigidTransform &cMo, const Eigen::Vector3d &centre,
                             double radius)
{
  drawIn(window(centre, radius), body, cMo);
}

template <class Body> void vpSceneRaster::drawIn(const Window &w, const Body &body, const vpRigidTransform &cMo)
{
  const Eigen::Matrix3d oRc = cMo.R.transpose();
  const Eigen::Vector3d from = -(oRc * cMo.p), lit = oRc * m_light;
  const Eigen::Vector3d step = m_camera.get_px_inverse() * oRc.col(0);
  for (int r = w.top; r <= w.bottom; ++r) {
    float *depth = m_depth[static_cast<unsigned int>(r)];
    const Eigen::Vector3d first = oRc * ray(0., r);
    for (int c = w.left; c <= w.right; ++c) {
      Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
      const double t = body.hit(from, first + c * step, normal);
      if (!(t >= nearest) || t >= static_cast<double>(depth[c])) {
        continue;
      }
      depth[c] = static_cast<float>(t);
      if (m_grey != nullptr) {
        const double shade = darkest + (1. - darkest) * std::fabs(normal.dot(lit)) / normal.norm();
        (*m_grey)[static_cast<unsigned int>(r)][c] = static_cast<unsigned char>(m_tone * shade);
      }
    }
  }
}

void vpSceneRaster::drawObject(const vpCollisionObject &object, const vpRigidTransform &cMf)
{
  const vpRigidTransform cMo = cMf * object.pose;
  const vpCollisionShape &shape = object.shape;
  const double half = 0.5 * shape.length();
  m_tone = toneOf(object.name);
  switch (shape.type()) {
  case vpShapeType::Sphere:
    drawBody(vpRayCast::Sphere{shape.radius()}, cMo, cMo.p, shape.radius());
    return;
  case vpShapeType::Capsule:
    drawBody(vpRayCast::Tube{shape.radius(), half, true}, cMo, cMo.p, shape.radius() + half);
    return;
  case vpShapeType::Cylinder:
    drawBody(vpRayCast::Tube{shape.radius(), half, false}, cMo, cMo.p, std::hypot(shape.radius(), half));
    return;
  case vpShapeType::Box:
    drawBox(0.5 * shape.size(), cMo);
    return;
  case vpShapeType::Mesh: {
    const std::vector<Eigen::Vector3d> &vertices = shape.mesh().vertices();
    for (const std::array<int, 3> &t : shape.mesh().triangles()) {
      const Eigen::Vector3d &a = vertices[static_cast<std::size_t>(t[0])],
                            &b = vertices[static_cast<std::size_t>(t[1])],
                            &c = vertices[static_cast<std::size_t>(t[2])];
      const Eigen::Vector3d centre = (a + b + c) / 3.;
      const double radius =
          std::sqrt(std::max({(a - centre).squaredNorm(), (b - centre).squaredNorm(), (c - centre).squaredNorm()}));
      drawBody(vpRayCast::Triangle{a, b, c}, cMo, cMo.R * centre + cMo.p, radius);
    }
    return;
  }
  case vpShapeType::Octree:
    for (const vpOctreeCell &cell : shape.octree().cells()) {
      const vpRigidTransform cMcell = cMo * vpRigidTransform{Eigen::Matrix3d::Identity(), cell.centre};
      drawBox(Eigen::Vector3d::Constant(0.5 * cell.size), cMcell);
    }
    return;
  }
}

// The ground is invisible from below.
void vpSceneRaster::drawGround(const vpHalfSpace &ground, const vpRigidTransform &fMc)
{
  const double height = ground.normal.dot(fMc.p) - ground.offset;
  const Eigen::Vector3d down = fMc.R.transpose() * ground.normal;
  for (int r = 0; r < m_height && height > 0.; ++r) {
    float *depth = m_depth[static_cast<unsigned int>(r)];
    for (int c = 0; c < m_width; ++c) {
      const double t = -height / down.dot(ray(c, r));
      if (t >= nearest && t < static_cast<double>(depth[c])) {
        depth[c] = static_cast<float>(t);
        if (m_grey != nullptr) {
          (*m_grey)[static_cast<unsigned int>(r)][c] = static_cast<unsigned char>(groundTone);
        }
      }
    }
  }
}

void vpSceneRaster::draw(const vpCollisionScene &scene, const vpRigidTransform &fMc, vpImage<unsigned char> *grey)
{
  m_depth = std::numeric_limits<float>::infinity();
  m_grey = grey;
  const vpRigidTransform cMf = fMc.inverse();
  m_light = cMf.R * light.normalized();
  for (int i = 0; i < scene.objectCount(); ++i) {
    drawObject(scene.object(i), cMf);
  }
  if (scene.ground()) {
    drawGround(*scene.ground(), fMc);
  }
}

END_VISP_NAMESPACE
