/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Spots that differ from the levels around them, for any illumination and number of grey levels (vpLatticeSpots.cpp), and
// the basis of the lattice among spots with outliers and gaps.
#ifndef vpLatticeSearch_h
#define vpLatticeSearch_h

#include "vpPatternSpot.h"

#include <visp3/pattern/vpDotLattice.h>

#include <Eigen/Core>

#include <vector>

BEGIN_VISP_NAMESPACE

struct vpLatticeSpot {
  double x = 0., y = 0.; // centre, weighted by amplitude
  double amplitude = 0.; // mean over the threshold
  double level = 0.;     // grey value between spot and surroundings
  vpPatternSpot box;
};

class vpLatticeSpots
{
public:
  static constexpr std::size_t most = 20000;

  // window: px, odd; larger than a pitch.
  vpLatticeSpots(const vpImage<unsigned char> &image, int window);
  // Spots of one polarity whose areas are those of the most common within the factor alike.
  [[nodiscard]] std::vector<vpLatticeSpot> find(bool bright, double alike);

private:
  void measureLevels(int window);
  [[nodiscard]] double noise() const;
  [[nodiscard]] double above(std::size_t pixel, bool bright) const;

  const vpImage<unsigned char> &m_image; // owned by the caller
  double m_least = 0.;                   // minimum contrast above the noise
  std::vector<float> m_low, m_high;      // local levels; equal where there is no contrast
  vpRunLabels m_labels;
};

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

struct vpLatticeFound {
  vpDotLatticeKind kind = vpDotLatticeKind::None;
  Eigen::Vector2d a = Eigen::Vector2d::Zero(), b = Eigen::Vector2d::Zero();
  double score = 0., occupancy = 0., rms = 0.;
  const char *why = "there are fewer than four spots of like size"; // when there is none
  std::vector<std::size_t> spots;                                   // on the lattice
  std::vector<int> rows, columns;                                   // of each of those
};

// Rows and columns; middle: where a and b are determined, px.
[[nodiscard]] vpLatticeFound vpSearchLattice(const std::vector<vpLatticeSpot> &spots, const Eigen::Vector2d &middle);
// Smallest possible step: at least the width of a spot.
[[nodiscard]] double vpLeastStep(const std::vector<vpLatticeSpot> &spots);

END_VISP_NAMESPACE
#endif
