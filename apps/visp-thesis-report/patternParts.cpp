/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Chapter 7 up to figure 7.11: performance of the camera and of the cell detection.
#include "patternItems.h"

namespace thesisReport
{
std::vector<Part> patternParts()
{
  const auto part = [](const char *id, const char *title, double cost, std::vector<Item> (*play)(const Setting &)) {
    return Part{"Chapter 7: product pattern-based visual servoing", {{id, title}}, cost, play};
  };
  Part rates = part("fig7.1", "high-speed vision systems and what interfaces carry", 8., frameRates);
  rates.entries.push_back({"eq7.2", "time of an image against its size"});
  return {rates,
          part("eq7.1", "trade-off of magnification and trackability", 2., trackability),
          part("table7.1", "thresholding algorithms", 6., thresholds),
          part("table7.2", "derivative operators", 2., derivatives),
          part("table7.3", "timing of the vision pipeline", 1., visionTiming),
          part("fig7.10", "mismatch of pixel locations by radial distortion", 0.5, distortion),
          part("table7.4", "calibration by an industrial grid and by the product", 3., calibrations),
          part("fig7.11", "output of the centre detection", 3., detection)};
}
} // namespace thesisReport
