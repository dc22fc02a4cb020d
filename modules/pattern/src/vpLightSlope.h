/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// How the light changes over the image, from the cells and the gaps between them: with one level for the whole image the edges of a cell
// move inwards where it is darker, and outwards where it is brighter, and the centre with them.
#ifndef vpLightSlope_h
#define vpLightSlope_h

#include "vpLatticeFit.h"

BEGIN_VISP_NAMESPACE

class vpLightSlope
{
public:
  vpLightSlope(unsigned int width, unsigned int height, std::size_t maxCells);

  //! False, and nothing changes: too few cells.
  bool see(const vpImage<unsigned char> &image, const std::vector<vpPatternSpot> &spots, const vpLattice &lattice);
  bool isKnown() const { return m_images > 0; }
  //! The level that is \e middle in the middle of the image and changes with the light.
  vpEdgeLevel level(double middle) const;
  void clear();

private:
  struct Sample {
    double x, y, value; // x and y from the middle of the image, px
  };
  struct Plane {
    double value = 0., slopeX = 0., slopeY = 0.;
  };
  void add(const vpImage<unsigned char> &image, double x, double y, int halfWidth, int halfHeight);
  bool fit(Plane &plane) const;

  double m_middleX, m_middleY;
  std::vector<Sample> m_samples;
  int m_images = 0;
  double m_slopeX = 0., m_slopeY = 0.; // share per px, smoothed over the images
};

END_VISP_NAMESPACE
#endif
