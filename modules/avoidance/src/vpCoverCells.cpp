/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpCoverCells.h"

#include <visp3/core/vpException.h>

#include <Eigen/Geometry>

#include <map>

BEGIN_VISP_NAMESPACE

namespace vpCover
{
namespace
{
constexpr std::size_t mostCells = 2000000;
constexpr double shortestEdge = 0.02, shareOfMesh = 0.12, cubeEdge = 0.01; // m, -, m

// Halves edges; triangles that share an edge share its middle.
class Halving
{
public:
  explicit Halving(const vpTriangleMesh &mesh, double longest)
    : m_label(mesh.label()), m_points(mesh.vertices()), m_triangles(mesh.triangles())
  {
    for (std::size_t i = 0; i < m_triangles.size();) {
      i += halve(i, longest) ? 0 : 1;
    }
  }
  Points takePoints() && { return std::move(m_points); }
  [[nodiscard]] const std::vector<std::array<int, 3>> &triangles() const { return m_triangles; }

private:
  int middle(int a, int b)
  {
    const auto found = m_middles.emplace(std::minmax(a, b), static_cast<int>(m_points.size()));
    if (found.second) {
      const Eigen::Vector3d p = 0.5 * (m_points[at(a)] + m_points[at(b)]);
      m_points.push_back(p);
    }
    return found.first->second;
  }
  bool halve(std::size_t i, double longest)
  {
    const std::array<int, 3> t = m_triangles[i];
    std::size_t edge = 0;
    double length = 0.;
    for (std::size_t k = 0; k < 3; ++k) {
      const double now = (m_points[at(t[k])] - m_points[at(t[(k + 1) % 3])]).norm();
      if (now > length) {
        length = now;
        edge = k;
      }
    }
    if (length <= longest) {
      return false;
    }
    if (m_triangles.size() >= mostCells) {
      throw vpException(vpException::badValue, "%s: has more than %lu pieces of at most %g m", m_label.c_str(),
                        static_cast<unsigned long>(mostCells), longest);
    }
    const int from = t[edge], to = t[(edge + 1) % 3], tip = t[(edge + 2) % 3], half = middle(from, to);
    m_triangles[i] = {from, half, tip};
    m_triangles.push_back({half, to, tip});
    return true;
  }

  const std::string &m_label;
  Points m_points;
  std::vector<std::array<int, 3>> m_triangles;
  std::map<std::pair<int, int>, int> m_middles;
};

// Cubes inside a surface with holes: far enough from it to lie inside as a whole.
void addCubes(const vpTriangleMesh &mesh, const Eigen::AlignedBox3d &box, Cells &cells)
{
  const double half = 0.5 * cubeEdge, diagonal = half * std::sqrt(3.);
  const Eigen::Vector3d count = (box.sizes() / cubeEdge).array().floor();
  if (count.prod() > static_cast<double>(mostCells)) {
    throw vpException(vpException::badValue, "%s: has holes and is too large for cubes of %g m: %g x %g x %g m",
                      mesh.label().c_str(), cubeEdge, box.sizes().x(), box.sizes().y(), box.sizes().z());
  }
  for (double x = box.min().x() + half; x < box.max().x(); x += cubeEdge) {
    for (double y = box.min().y() + half; y < box.max().y(); y += cubeEdge) {
      for (double z = box.min().z() + half; z < box.max().z(); z += cubeEdge) {
        const Eigen::Vector3d p(x, y, z);
        if (mesh.data().nearest(p, p, diagonal).distance < diagonal || std::fabs(windingNumber(mesh, p)) < 0.5) {
          continue;
        }
        Cell cell;
        cell.size = 8;
        cell.centre = p;
        for (int k = 0; k < 8; ++k) {
          cell.corners[at(k)] = static_cast<int>(cells.points.size());
          cells.points.push_back(
              p + half * Eigen::Vector3d((k & 1) != 0 ? 1. : -1., (k & 2) != 0 ? 1. : -1., (k & 4) != 0 ? 1. : -1.));
        }
        cells.cells.push_back(cell);
      }
    }
  }
}
} // namespace

double distance(const Eigen::Vector3d &p, const std::vector<vpArmCapsule> &capsules)
{
  double least = std::numeric_limits<double>::infinity();
  for (const vpArmCapsule &c : capsules) {
    least = std::min(least, axisDistance(p, c) - c.radius);
  }
  return least;
}

double farthest(const Points &points, const Eigen::Vector3d &from, const Eigen::Vector3d &to)
{
  const Eigen::Vector3d along = to - from;
  const double squaredLength = along.squaredNorm();
  double most = 0.;
  for (const Eigen::Vector3d &p : points) {
    most = std::max(most, squaredDistance(p, from, along, squaredLength));
  }
  return std::sqrt(most);
}

Points directions(int count)
{
  Points all;
  for (int i = 0; i < count; ++i) {
    const double z = 1. - (2 * i + 1.) / count, angle = i * M_PI * (3. - std::sqrt(5.)), s = std::sqrt(1. - z * z);
    all.emplace_back(s * std::cos(angle), s * std::sin(angle), z);
  }
  return all;
}

Cells::Cells(const vpTriangleMesh &mesh)
{
  const Eigen::AlignedBox3d box = boxOf(mesh);
  Halving halving(mesh, std::max(shortestEdge, shareOfMesh * box.sizes().maxCoeff()));
  const std::vector<std::array<int, 3>> triangles = halving.triangles();
  points = std::move(halving).takePoints();
  for (const auto &t : triangles) {
    Cell cell;
    cell.size = 3;
    std::copy(t.begin(), t.end(), cell.corners.begin());
    cell.centre = (points[at(t[0])] + points[at(t[1])] + points[at(t[2])]) / 3.;
    cells.push_back(cell);
  }
  if (!mesh.isWatertight()) {
    addCubes(mesh, box, *this);
  }
}

/*
 * Sum of the solid angles of the triangles over 4 pi (van Oosterom and Strackee, 1983). The half angles are added as
 * factors of a complex number, with the full turns counted: one atan2 instead of one a triangle.
 */
double windingNumber(const vpTriangleMesh &mesh, const Eigen::Vector3d &p)
{
  const Points &v = mesh.vertices();
  double re = 1., im = 0., turns = 0.;
  for (const auto &t : mesh.triangles()) {
    const Eigen::Vector3d a = v[at(t[0])] - p, b = v[at(t[1])] - p, c = v[at(t[2])] - p;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    const double sine = a.dot(b.cross(c)), cosine = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
    const double newRe = re * cosine - im * sine, newIm = re * sine + im * cosine;
    turns += im >= 0. && sine >= 0. && newIm < 0. ? 1. : im < 0. && sine < 0. && newIm >= 0. ? -1. : 0.;
    const double size = std::hypot(newRe, newIm);
    if (size > 0.) { // else the point is a corner
      re = newRe / size;
      im = newIm / size;
    }
  }
  return (std::atan2(im, re) + 2. * M_PI * turns) / (2. * M_PI);
}

Place placeOf(const vpTriangleMesh &mesh, const Eigen::Vector3d &p)
{
  const double d = mesh.data().nearest(p, p, std::numeric_limits<double>::infinity()).distance;
  return {std::fabs(d), mesh.isWatertight() ? d < 0. : std::fabs(windingNumber(mesh, p)) > 0.5};
}

bool mayHaveHollow(const std::vector<vpArmCapsule> &capsules)
{
  std::vector<vpArmCapsule> left = capsules;
  const auto touches = [](const vpArmCapsule &a, const vpArmCapsule &b) {
    return vpSegmentNearest::segment(a.from, a.to, b.from, b.to).distance <= a.radius + b.radius + 2. * rounding;
  };
  for (std::size_t before = left.size() + 1; left.size() < before;) {
    before = left.size();
    for (std::size_t i = 0; i < left.size(); ++i) {
      const auto neighbours =
          std::count_if(left.begin(), left.end(), [&](const vpArmCapsule &other) { return touches(left[i], other); });
      if (neighbours <= 3) { // itself and two
        left.erase(left.begin() + static_cast<std::ptrdiff_t>(i));
        break;
      }
    }
  }
  return !left.empty();
}
} // namespace vpCover

END_VISP_NAMESPACE
