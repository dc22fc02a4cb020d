/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpCoverFit.h"

#include <Eigen/Geometry>

BEGIN_VISP_NAMESPACE

namespace vpCover
{
namespace
{
constexpr double side = 18.;      // points along an edge of the cube that has the volume of the mesh's box
constexpr double onMesh = 5e-4;   // nearer points have no weight, m
constexpr double weightAt = 0.01; // distance of weight 1, m
} // namespace

Field::Field(const vpTriangleMesh &mesh)
{
  Eigen::AlignedBox3d box = boxOf(mesh);
  const Eigen::Vector3d grow = Eigen::Vector3d::Constant(0.15 * box.sizes().maxCoeff() + 0.01);
  const Eigen::AlignedBox3d grown(box.min() - grow, box.max() + grow);
  const double h = std::cbrt(grown.sizes().prod() / (side * side * side * 1.2));
  for (double x = grown.min().x() + 0.5 * h; x < grown.max().x(); x += h) {
    for (double y = grown.min().y() + 0.5 * h; y < grown.max().y(); y += h) {
      for (double z = grown.min().z() + 0.5 * h; z < grown.max().z(); z += h) {
        const Eigen::Vector3d p(x, y, z);
        const double near = std::fabs(mesh.data().nearest(p, p, std::numeric_limits<double>::infinity()).distance);
        if (near < onMesh || (box.contains(p) && placeOf(mesh, p).inside)) {
          continue;
        }
        m_x.push_back(static_cast<float>(x));
        m_y.push_back(static_cast<float>(y));
        m_z.push_back(static_cast<float>(z));
        m_weight.push_back(static_cast<float>(near * near / (weightAt * weightAt)));
      }
    }
  }
  for (std::vector<float> *numbers : {&m_x, &m_y, &m_z, &m_weight}) {
    numbers->resize((numbers->size() + lanes - 1) / lanes * lanes, 0.F);
  }
  reset();
}

void Field::take(const vpArmCapsule &c)
{
  const Eigen::Vector3d along = c.to - c.from;
  const double squaredLength = along.squaredNorm();
  for (std::size_t i = 0; i < m_x.size(); ++i) {
    const Eigen::Vector3d p(static_cast<double>(m_x[i]), static_cast<double>(m_y[i]), static_cast<double>(m_z[i]));
    if (squaredDistance(p, c.from, along, squaredLength) <= c.radius * c.radius) {
      m_left[i] = 0.F;
    }
  }
}

double Field::cost(const vpArmCapsule &c) const
{
  const Eigen::Vector3f from = c.from.cast<float>(), along = (c.to - c.from).cast<float>();
  const float ax = from.x(), ay = from.y(), az = from.z(), dx = along.x(), dy = along.y(), dz = along.z();
  const float squaredLength = along.squaredNorm(), inverse = squaredLength > 1e-12F ? 1.F / squaredLength : 0.F;
  const float r2 = static_cast<float>(c.radius * c.radius);
  std::array<float, lanes> sums{};
  for (std::size_t i = 0; i < m_x.size(); i += lanes) {
    for (std::size_t k = 0; k < lanes; ++k) {
      const float px = m_x[i + k] - ax, py = m_y[i + k] - ay, pz = m_z[i + k] - az;
      float s = (px * dx + py * dy + pz * dz) * inverse;
      s = s < 0.F ? 0.F : s;
      s = s > 1.F ? 1.F : s;
      const float ex = px - s * dx, ey = py - s * dy, ez = pz - s * dz;
      sums[k] += ex * ex + ey * ey + ez * ez <= r2 ? m_left[i + k] : 0.F;
    }
  }
  double sum = 0.;
  for (const float lane : sums) {
    sum += static_cast<double>(lane);
  }
  return sum + 1e-9 * M_PI * c.radius * c.radius * ((c.to - c.from).norm() + 4. / 3. * c.radius);
}
} // namespace vpCover

END_VISP_NAMESPACE
