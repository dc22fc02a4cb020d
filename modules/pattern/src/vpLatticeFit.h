/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The regular lattice of a set of spots that may contain outliers.
#ifndef vpLatticeFit_h
#define vpLatticeFit_h

#include "vpPatternSpot.h"

#include <visp3/pattern/vpPatternFrame.h>

#include <array>
#include <utility>
#include <vector>

BEGIN_VISP_NAMESPACE

//! origin + column * a + row * b, in px.
struct vpLattice {
  double ox = 0., oy = 0., ax = 0., ay = 0., bx = 0., by = 0.;
  double x(double row, double column) const { return ox + column * ax + row * bx; }
  double y(double row, double column) const { return oy + column * ay + row * by; }
  //! Row and column, not rounded, of a point.
  void invert(double px, double py, double &row, double &column) const;
  //! Remainder of a vector (px) after subtracting whole pitches.
  void reduce(double &dx, double &dy) const;
};

class vpLatticeFit
{
public:
  explicit vpLatticeFit(std::size_t maxSpots);

  //! Keep the spots of the most common size; false when fewer than four are alike.
  bool keepAlike(std::vector<vpPatternSpot> &spots);
  //! Remove spots whose size differs from those around them, because of dirt.
  static void removeDirty(std::vector<vpPatternSpot> &spots);
  //! Lattice of the spots, whose strays are removed. \e a points right, \e b down. False: no two periods each way, see trouble();
  //! the spots are what they were.
  bool fit(std::vector<vpPatternSpot> &spots, double minPitch, vpLattice &lattice);
  //! Keep the spots of the size last found by keepAlike(); false when there are none.
  bool keepKnown(std::vector<vpPatternSpot> &spots) const;
  //! Fit a known lattice to spots that are too few to determine one. False when they are not on one lattice.
  bool shift(const std::vector<vpPatternSpot> &spots, vpLattice &lattice) const;
  //! Why fit() has just failed, as far as the nearest neighbours of the spots in the middle show it; NoLattice if they do not.
  vpPatternReason trouble(const std::vector<vpPatternSpot> &spots) const;
  int medianWidth() const { return m_width; }
  int medianHeight() const { return m_height; }

private:
  void findSeeds(const std::vector<vpPatternSpot> &spots);
  bool direction(const std::vector<vpPatternSpot> &spots, bool down, double minPitch, double &vx, double &vy);
  int commonestArea(double tolerance) const;
  bool isLikeMedian(const vpPatternSpot &spot) const;
  void walk(const std::vector<vpPatternSpot> &spots, std::size_t seed, const vpLattice &lattice);
  std::size_t nearest(const std::vector<vpPatternSpot> &spots, double x, double y, double reach) const;
  bool solve(const std::vector<vpPatternSpot> &spots, vpLattice &lattice) const;

  //! A spot reached by the walk: its lattice indices, and the steps to its neighbours.
  struct Node {
    bool reached = false;
    int row = 0, column = 0;
    double ax = 0., ay = 0., bx = 0., by = 0.;
  };
  std::vector<int> m_sorted;
  std::vector<std::pair<double, std::size_t>> m_seeds; // squared distance from the middle, index
  std::vector<Node> m_nodes;                           // one per spot
  std::vector<std::size_t> m_reached;                  // in the order of the walk
  int m_width = 0, m_height = 0;
};

END_VISP_NAMESPACE
#endif
