/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Spots of a threshold image by run-length labels; storage of fixed size. The centre of a spot from its edges: half maximum, and Algorithm 7.4 as printed and corrected.
#ifndef vpPatternSpot_h
#define vpPatternSpot_h

#include <visp3/core/vpImage.h>
#include <visp3/direct_core/vpDirectCompat.h>
#include <visp3/pattern/vpPatternTrackerSpec.h>

#include <vector>

BEGIN_VISP_NAMESPACE

//! A connected spot: bounding box, inclusive, and the centre of its four edges.
struct vpPatternSpot {
  int left = 0, right = 0, top = 0, bottom = 0;
  int area = 0;
  double x = 0., y = 0.;
  int width() const { return right - left + 1; }
  int height() const { return bottom - top + 1; }
};

class vpRunLabels
{
public:
  static constexpr int leastArea = 9; //!< Minimum area of a cell, px.

  vpRunLabels(unsigned int width, unsigned int height, std::size_t maxSpots);

  //! Spots that do not touch the border and have at least \e minArea pixels. False: more runs or spots than the
  //! capacity. \e bright: spots are the values above the threshold, otherwise those up to it.
  bool find(const vpImage<unsigned char> &image, int threshold, bool bright, int minArea);
  std::vector<vpPatternSpot> &spots() { return m_spots; }
  const std::vector<vpPatternSpot> &spots() const { return m_spots; }

private:
  struct Run {
    int begin, end, label; // columns begin <= x < end
  };
  bool scanRow(const unsigned char *row, int threshold, bool bright);
  int root(int label);
  void join(int a, int b);

  int m_width, m_height;
  std::size_t m_maxSpots;
  std::vector<Run> m_runs;
  std::vector<int> m_parent;
  std::vector<vpPatternSpot> m_boxes; // one per label
  std::vector<vpPatternSpot> m_spots;
};

//! A grey value that changes linearly over the image: value + slopeX * x + slopeY * y.
struct vpEdgeLevel {
  double value = 0., slopeX = 0., slopeY = 0.;
};

//! Crossings of the grey value with \e level on all four sides. False when a side has no crossing.
bool vpHalfMaximumCentre(const vpImage<unsigned char> &image, const vpEdgeLevel &level, vpPatternSpot &spot);
//! Algorithm 7.4 as printed: (7.12) with the width of the box, parabola (7.14), crossing of the diagonals (7.17).
bool vpThesisCentre(const vpImage<unsigned char> &image, vpPatternDerivative derivative, vpPatternSpot &spot);
//! Algorithm 7.4 with w - 1 for w in (7.12), a guarded parabola, and the left and right edges measured too.
bool vpThesisCentreFixed(const vpImage<unsigned char> &image, vpPatternDerivative derivative, vpPatternSpot &spot);

END_VISP_NAMESPACE
#endif
