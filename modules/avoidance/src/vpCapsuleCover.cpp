/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpCoverFit.h"
#include "vpCoverMeasure.h"
#include "vpFieldCheck.h"

#include <visp3/manipulator/vpArmTypes.h>

#include <sstream>

BEGIN_VISP_NAMESPACE

namespace
{
using vpCover::at;

constexpr int mostCapsules = 8;
constexpr double worthIt = 0.98;       // one more capsule must lower the slack as far
constexpr double smallestPiece = 1e-4; // of a triangle that is not proven, m

void requireCapsules(const std::vector<vpArmCapsule> &capsules)
{
  if (capsules.empty()) {
    throw vpException(vpException::badValue, "a cover has no capsule");
  }
  for (std::size_t i = 0; i < capsules.size(); ++i) {
    const vpArmCapsule &c = capsules[i];
    const bool near = (c.from.array().abs() <= vpLargestLength).all() && (c.to.array().abs() <= vpLargestLength).all();
    if (!near || !(c.radius > 0.) || !(c.radius <= vpLargestLength)) {
      throw vpException(vpException::badValue,
                        "capsule %lu of a cover has the radius %g m or an end beyond %g m, must be > 0 and within",
                        static_cast<unsigned long>(i), c.radius, vpLargestLength);
    }
  }
}

using Triangle = std::array<Eigen::Vector3d, 3>;

bool holds(const vpArmCapsule &c, const Eigen::Vector3d *corners, std::size_t count)
{
  return std::all_of(corners, corners + count,
                     [&c](const Eigen::Vector3d &p) { return vpCover::axisDistance(p, c) <= c.radius; });
}

bool anyHolds(const std::vector<vpArmCapsule> &capsules, const Eigen::Vector3d *corners, std::size_t count)
{
  return std::any_of(capsules.begin(), capsules.end(), [&](const vpArmCapsule &c) { return holds(c, corners, count); });
}

// Halves a triangle until each piece lies in one capsule. False at a piece too small to go on, or with a corner
// outside.
bool isCovered(const std::vector<vpArmCapsule> &capsules, const Triangle &t)
{
  if (anyHolds(capsules, t.data(), 3)) {
    return true;
  }
  std::size_t edge = 0;
  double longest = 0.;
  for (std::size_t k = 0; k < 3; ++k) {
    const double length = (t[k] - t[(k + 1) % 3]).norm();
    if (length > longest) {
      longest = length;
      edge = k;
    }
    if (vpCover::distance(t[k], capsules) > 0.) {
      return false;
    }
  }
  if (longest < smallestPiece) {
    return false;
  }
  const Eigen::Vector3d from = t[edge], to = t[(edge + 1) % 3], tip = t[(edge + 2) % 3], middle = 0.5 * (from + to);
  return isCovered(capsules, {from, middle, tip}) && isCovered(capsules, {middle, to, tip});
}

std::string sentence(const vpTriangleMesh &mesh, const vpCoverProof &proof)
{
  std::ostringstream text;
  text << mesh.label() << ": ";
  if (proof.outside > 0.) {
    text << "the point (" << proof.point.x() << ", " << proof.point.y() << ", " << proof.point.z() << ") m is "
         << 1e3 * proof.outside << " mm outside the capsules";
  }
  else {
    text << "near the point (" << proof.point.x() << ", " << proof.point.y() << ", " << proof.point.z()
         << ") m no single capsule holds the surface";
  }
  return text.str();
}

vpCoverProof prove(const vpTriangleMesh &mesh, const vpCover::Cells &cells, const std::vector<vpArmCapsule> &capsules)
{
  vpCoverProof proof;
  proof.enclosed = true;
  for (const vpCover::Cell &cell : cells.cells) {
    std::array<Eigen::Vector3d, 8> corners;
    for (std::size_t k = 0; k < cell.size; ++k) {
      corners[k] = cells.points[at(cell.corners[k])];
    }
    if (cell.size == 3 ? isCovered(capsules, {corners[0], corners[1], corners[2]})
                       : anyHolds(capsules, corners.data(), cell.size)) {
      continue;
    }
    if (proof.enclosed) {
      proof.enclosed = false;
      proof.point = cell.centre;
    }
    for (std::size_t k = 0; k <= cell.size; ++k) {
      const Eigen::Vector3d &p = k < cell.size ? corners[k] : cell.centre;
      const double d = vpCover::distance(p, capsules);
      if (d > proof.outside) {
        proof.outside = d;
        proof.point = p;
      }
    }
  }
  if (!proof.enclosed) {
    proof.message = sentence(mesh, proof);
  }
  else if (mesh.isWatertight() && vpCover::mayHaveHollow(capsules)) {
    proof.enclosed = false;
    proof.message = mesh.label() + ": more than three capsules that all touch one another may enclose a hollow";
  }
  return proof;
}
} // namespace

vpCapsuleCover vpFitCapsules(const vpTriangleMesh &mesh, const vpCapsuleCoverSpec &spec)
{
  const vpFieldCheck check("the cover by capsules");
  check.require(spec.count >= 1 && spec.count <= mostCapsules, "count", spec.count, "1 to 8");
  check.notNegative("enough", spec.enough, "m");
  const vpCover::Cells cells(mesh);
  vpCover::Fit fit(mesh, cells, spec.seed);
  std::vector<vpArmCapsule> best;
  double least = std::numeric_limits<double>::infinity();
  for (int k = 1; k <= spec.count; ++k) {
    const std::vector<vpArmCapsule> capsules = fit.next();
    if (fit.slack() < worthIt * least && (k <= 3 || prove(mesh, cells, capsules).enclosed)) {
      least = fit.slack();
      best = capsules;
    }
    if (vpCover::overhangOf(mesh, best) <= spec.enough) {
      break;
    }
  }
  return vpCover::measured(mesh, best);
}

vpCapsuleCover vpMeasureCover(const vpTriangleMesh &mesh, const std::vector<vpArmCapsule> &capsules)
{
  requireCapsules(capsules);
  return vpCover::measured(mesh, capsules);
}

vpCoverProof vpProveCover(const vpTriangleMesh &mesh, const std::vector<vpArmCapsule> &capsules)
{
  requireCapsules(capsules);
  return prove(mesh, vpCover::Cells(mesh), capsules);
}

END_VISP_NAMESPACE
