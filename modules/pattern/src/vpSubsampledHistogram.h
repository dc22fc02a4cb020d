/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Histogram of the grey values of an image, for its threshold.
#ifndef vpSubsampledHistogram_h
#define vpSubsampledHistogram_h

#include <visp3/core/vpImage.h>
#include <visp3/pattern/vpPatternThreshold.h>

BEGIN_VISP_NAMESPACE

// Every second row and column of large images, which suffices for the threshold. Two at a time: neighbours often have
// the same value, and a count that was just written cannot be read at once.
inline vpPatternHistogram vpSubsampledHistogram(const vpImage<unsigned char> &image)
{
  vpPatternHistogram h{}, other{};
  const unsigned int step = image.getSize() > 4096 ? 2 : 1, width = image.getWidth();
  for (unsigned int y = 0; y < image.getHeight(); y += step) {
    const unsigned char *row = image[y];
    unsigned int x = y / step % step;
    for (; x + step < width; x += 2 * step) {
      ++h[row[x]];
      ++other[row[x + step]];
    }
    if (x < width) {
      ++h[row[x]];
    }
  }
  for (std::size_t g = 0; g < h.size(); ++g) {
    h[g] += other[g];
  }
  return h;
}

END_VISP_NAMESPACE
#endif
