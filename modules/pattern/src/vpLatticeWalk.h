/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// From spot to spot by the steps of a lattice, and the resulting measures of the lattice.
#ifndef vpLatticeWalk_h
#define vpLatticeWalk_h

#include "vpLatticeSpots.h"

#include <Eigen/Core>

#include <vector>

BEGIN_VISP_NAMESPACE

// The spots with an index by position.
class vpSpotIndex
{
public:
  explicit vpSpotIndex(const std::vector<vpLatticeSpot> &spots);
  // Index of the spot nearest to a position, within reach; -1 when there is none.
  [[nodiscard]] int nearest(const Eigen::Vector2d &place, double reach) const;
  // Whether a position lies in the bounding box of all spots.
  [[nodiscard]] bool inView(const Eigen::Vector2d &place) const;
  [[nodiscard]] Eigen::Vector2d size() const { return m_high - m_low; }
  [[nodiscard]] Eigen::Vector2d place(std::size_t i) const { return {m_spots[i].x, m_spots[i].y}; }
  [[nodiscard]] std::size_t count() const { return m_spots.size(); }
  [[nodiscard]] const std::vector<vpLatticeSpot> &spots() const { return m_spots; }

private:
  [[nodiscard]] int cell(double x, int axis) const;

  const std::vector<vpLatticeSpot> &m_spots; // owned by the caller
  Eigen::Vector2d m_low, m_high;
  double m_cell = 1.;
  int m_cells[2] = {1, 1};
  std::vector<std::vector<int>> m_lists;
};

class vpLatticeWalk
{
public:
  struct Node {
    bool on = false;
    int row = 0, column = 0;
    Eigen::Vector2d a = Eigen::Vector2d::Zero(), b = Eigen::Vector2d::Zero(); // steps to the neighbours here
  };

  // From a seed, with local steps, also over one missing spot.
  vpLatticeWalk(const vpSpotIndex &index, std::size_t seed, const Eigen::Vector2d &a, const Eigen::Vector2d &b);
  // Share of the single steps to positions in view that end at a spot.
  [[nodiscard]] double occupancy() const;
  // Fits a lattice bent to second order and removes outliers. False when it is not determined. Steps at a position: a,
  // b.
  bool fit(const Eigen::Vector2d &middle, Eigen::Vector2d &a, Eigen::Vector2d &b, double &rms);
  // Whether most nodes lie in one row or column: a row among outliers.
  [[nodiscard]] bool isRow() const;
  [[nodiscard]] int count() const;
  [[nodiscard]] const std::vector<Node> &nodes() const { return m_nodes; }

private:
  const vpSpotIndex &m_index; // owned by the caller
  std::vector<Node> m_nodes;  // one for each spot
};

END_VISP_NAMESPACE
#endif
