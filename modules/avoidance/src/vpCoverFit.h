/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Search of the capsules that enclose all cells with the least weighted volume outside the mesh.
#ifndef vpCoverFit_h
#define vpCoverFit_h

#include "vpCoverCells.h"

#include <random>

BEGIN_VISP_NAMESPACE

namespace vpCover
{
// Points outside the mesh on a grid, each with its squared distance from the mesh as weight.
class Field
{
public:
  explicit Field(const vpTriangleMesh &mesh);
  // Makes all points count again.
  void reset() { m_left = m_weight; }
  // Points in the capsule cost nothing from now on.
  void take(const vpArmCapsule &c);
  // Sum of the weights in the capsule, plus a little for its volume, where there is no point.
  [[nodiscard]] double cost(const vpArmCapsule &c) const;

private:
  static constexpr std::size_t lanes = 8; // the number of points is a multiple: sums in registers
  std::vector<float> m_x, m_y, m_z, m_weight, m_left;
};

// A capsule and the cells that lie in it.
struct Cluster {
  std::vector<int> cells;
  vpArmCapsule capsule;
};

class Fit
{
public:
  // mesh and cells must outlive this.
  Fit(const vpTriangleMesh &mesh, const Cells &cells, unsigned int seed);
  // A cover by one capsule, at the next call by up to two, and so on: the one of least slack so far.
  std::vector<vpArmCapsule> next();
  // Overhang times squared volume of the last cover, m^7.
  [[nodiscard]] double slack() const { return m_slack; }

private:
  using Clusters = std::vector<Cluster>;

  double uniform();
  vpArmCapsule along(const Points &points, const Eigen::Vector3d &axis, double excess) const;
  vpArmCapsule capsuleOf(const Points &all, int steps, const vpArmCapsule *start = nullptr);
  void improve(const Points &extreme, int steps, vpArmCapsule &best, double least);
  [[nodiscard]] Points extremes(const Points &points) const;
  [[nodiscard]] Points pointsOf(const std::vector<int> &cells) const;
  [[nodiscard]] Points centresOf(const std::vector<int> &cells) const;
  void takeAllBut(const Clusters &clusters, std::size_t j);
  double costOf(const Clusters &clusters);
  double split(const Clusters &clusters, std::size_t j, Cluster &first, Cluster &second);
  [[nodiscard]] Clusters assigned(const Clusters &clusters) const;
  void alternate(Clusters &clusters);
  Clusters byMeans(std::size_t count);
  [[nodiscard]] double slackOf(const std::vector<vpArmCapsule> &capsules) const;
  void keep(Clusters &&clusters);

  const vpTriangleMesh &m_mesh;
  const Cells &m_cells;
  Field m_field;
  std::mt19937_64 m_random;
  Points m_directions;
  std::vector<Eigen::Vector3d> m_axes; // tried for the first capsule
  Clusters m_best;
  double m_slack = 0.;
  std::size_t m_count = 0;
};
} // namespace vpCover

END_VISP_NAMESPACE
#endif
