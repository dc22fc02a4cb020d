/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Spots that differ from the levels around them, for any illumination and number of grey levels.
#ifndef vpLatticeSpots_h
#define vpLatticeSpots_h

#include "vpRunLabels.h"

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

END_VISP_NAMESPACE
#endif
