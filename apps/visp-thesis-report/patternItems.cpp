/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Chapter 7 up to figure 7.11: performance of the camera and of the cell detection.
#include "patternItems.h"

#include <algorithm>
#include <cmath>

namespace thesisReport
{
namespace
{
constexpr std::size_t ROUND = 60; // images of one cycle
constexpr int WARM_UP = 3;        // cycles for learning and preparing the template
constexpr double NEAR = 2.;       // px: a centre farther from its cell counts as not found

void compare(const std::vector<vpPatternTruthCell> &truth, const std::vector<vpPatternCell> &cells,
             CentreErrors &errors)
{
  std::size_t whole = 0;
  for (const vpPatternTruthCell &cell : truth) {
    if (!cell.complete) {
      continue;
    }
    ++whole;
    const auto found = std::find_if(cells.begin(), cells.end(), [&](const vpPatternCell &c) {
      return c.valid && std::hypot(c.x - cell.x, c.y - cell.y) < NEAR;
    });
    if (found != cells.end()) {
      ++errors.found;
      errors.x.add(found->x - cell.x);
      errors.y.add(found->y - cell.y);
    }
  }
  errors.whole += whole;
  errors.most = std::max(errors.most, whole);
}
} // namespace

std::vector<Part> patternParts()
{
  const auto part = [](const char *id, const char *title, double cost, std::vector<Item> (*play)(const Setting &)) {
    return Part{"Chapter 7: product pattern-based visual servoing", {{id, title}}, cost, play};
  };
  Part lens = part("fig7.10", "mismatch of pixel locations by radial distortion", 0.5, distortion);
  Part drops = part("fig7.3", "way during the flight of a drop, and what it allows", 0.1, dropDelay);
  lens.random = drops.random = false;
  Part rates = part("fig7.1", "high-speed vision systems and what interfaces carry", 8., frameRates);
  rates.entries.push_back({"eq7.2", "time of an image against its size"});
  return {rates,
          drops,
          part("eq7.1", "trade-off of magnification and trackability", 2., trackability),
          part("table7.1", "thresholding algorithms", 6., thresholds),
          part("table7.2", "derivative operators", 2., derivatives),
          part("table7.3", "timing of the vision pipeline", 1., visionTiming),
          lens,
          part("table7.4", "calibration by an industrial grid and by the product", 3., calibrations),
          part("fig7.11", "output of the centre detection", 3., detection)};
}

vpProductPatternSpec thesisProduct(unsigned int seed)
{
  vpProductPatternSpec spec;
  spec.noise = 4.;
  spec.seed = seed;
  return spec;
}

CentreErrors centreErrors(const vpProductPattern &product, const vpPatternTrackerSpec &options, int images,
                          const std::function<void(double)> &progress)
{
  vpPatternTracker tracker(product.spec().width, product.spec().height, options);
  vpImage<unsigned char> image;
  CentreErrors errors;
  bool learned = options.method != vpPatternMethod::GaussNewton;
  double x = 0., y = 0.;
  for (int k = 0, counted = 0; counted < images; ++k) {
    const double vx = 4. + 1.5 * std::sin(0.07 * k), vy = 0.37; // px/frame: all sub-pixel phases occur
    x += vx;
    y += vy;
    product.render(x, y, vx, vy, static_cast<unsigned int>(k), image);
    const vpPatternFrame &frame = tracker.process(image);
    learned = learned || frame.status == vpPatternStatus::Tracking || k > 2 * images;
    if (learned) {
      compare(product.cells(x, y), frame.cells, errors);
      progress(static_cast<double>(++counted) / images);
    }
  }
  return errors;
}

std::vector<vpImage<unsigned char>> roundTrip(const vpProductPatternSpec &spec, double amplitude)
{
  const vpProductPattern product(spec);
  std::vector<vpImage<unsigned char>> images(ROUND);
  for (std::size_t k = 0; k < ROUND; ++k) {
    const double phase = 2. * M_PI * static_cast<double>(k) / ROUND, rate = 2. * M_PI / ROUND * amplitude;
    product.render(amplitude * std::sin(phase), 0.3 * amplitude * std::cos(phase), rate * std::cos(phase),
                   -0.3 * rate * std::sin(phase), static_cast<unsigned int>(k), images[k]);
  }
  return images;
}

TrackingTime timeTracking(const std::vector<vpImage<unsigned char>> &images, const vpPatternTrackerSpec &options,
                          std::size_t least)
{
  vpPatternTracker tracker(images.front().getWidth(), images.front().getHeight(), options);
  const std::size_t rounds = WARM_UP + (least + images.size() - 1) / images.size();
  TrackingTime time;
  for (std::size_t k = 0; k < rounds * images.size(); ++k) {
    const double begin = coreSeconds();
    const vpPatternFrame &frame = tracker.process(images[k % images.size()]);
    const double end = coreSeconds();
    if (k >= WARM_UP * images.size()) {
      time.us.add(1e6 * (end - begin));
      time.locked += frame.status == vpPatternStatus::Tracking ? 1. : 0.;
      time.cells += frame.validCells;
    }
  }
  time.locked /= static_cast<double>(time.us.count());
  time.cells /= static_cast<double>(time.us.count());
  time.pitchX = tracker.frame().lattice.columnPitch();
  return time;
}
} // namespace thesisReport
