/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file catchImageServo.cpp
 * \brief The whole chain from picture to motion: rendered views, vpPlanarTarget, law, plant with friction.
 * VISP_DIRECT_LONG_TESTS=10 runs each photograph with ten seeds; without it, even and odd seeds share the photographs.
 */
#include "vpCaseFile.h"
#include "vpCatch.h"

#include <visp3/core/vpIoTools.h>
#include <visp3/core/vpMath.h>
#include <visp3/direct_core/vpQuantile.h>
#include "lab/servo/vpServoExperiment.h"

#include <algorithm>
#include <cstdlib>
#include <iostream>

VISP_DIRECT_USING_NAMESPACE

namespace
{
// Photographs of all kinds: paintings, fruit, a front of a house, plants, an animal, a landscape, a toy on blank ground.
std::vector<std::string> photographs()
{
  const std::string opencv = VISP_DIRECT_OPENCV_SAMPLES;
  std::vector<std::string> there;
  for (const std::string &file :
       {vpTestSupport::vispImage("Klimt/Klimt.png"), vpTestSupport::vispImage("mbt/cube/image0000.pgm"),
        vpTestSupport::vispImage("mbt-depth/castel/chateau.ppm"), opencv + "/home.jpg", opencv + "/fruits.jpg",
        opencv + "/graf1.png", opencv + "/aloeL.jpg", opencv + "/baboon.jpg", opencv + "/starry_night.jpg",
        opencv + "/leuvenA.jpg"}) {
    if (vpIoTools::checkFilename(file)) {
      there.push_back(file);
    }
    else {
      vpTestSupport::skip(file + " is not installed (Debian packages opencv-doc, visp-images-data)");
    }
  }
  return there;
}

//! What is seen of an error over what was expected of it, at the ends of all segments.
struct EndErrors {
  std::vector<double> ratios;
  double most = 0.;

  void add(double error, double expected)
  {
    ratios.push_back(error / expected);
    most = std::max(most, ratios.back());
  }
};
} // namespace

TEST_CASE("from pictures the camera reaches its goal in spite of friction, latency and noise", "[image]")
{
  vpServoRunSpec spec;
  spec.law = "ff-lookat-pi+cbf";
  spec.measure = "image";
  spec.target = VISP_DIRECT_DATA_DIR "/target/box.png";
  spec.plant = vpServoPlant::byName("B");
  spec.faults.noise = 3.;
  spec.faults.blur = 0.7;
  spec.faults.occlusion = 0.1;
  spec.task.segments.resize(1);
  spec.task.segments[0].duration = 5.;
  const vpServoRun run = runServoExperiment(spec);
  int frames = 0, found = 0;
  for (const vpServoSample &s : run.samples) {
    frames += s.newFrame;
    found += s.newFrame && s.measured;
  }
  CHECK(frames == 49);
  CHECK(found == frames);
  CHECK(run.metrics.status == "ok");
  CHECK(run.metrics.out_of_view_s == 0.);
  CHECK(run.metrics.end_rotation_deg < 1.);
  CHECK(run.metrics.end_translation_mm < 5.); // e^-5 of 0.22 m is 1.5 mm
  CHECK(run.metrics.max_image_error_px < 80.);
}

// A measurement's error is independent of what it shows, so the true error has the mean square |e|^2 + tr C given what the
// measurement shows, e, and the covariance C of its error. |e| is what the law has left: after 8 s of the double pole of
// ff-lookat-pi at -1 / s the friction of 0.1 rad/s leaves 0.1 t exp(-t) rad = 0.015 deg, and what was left before it.
TEST_CASE("ten photographs: the camera ends within 0.25 deg, and within three deviations of what is expected",
          "[image]")
{
  const auto seeds = static_cast<unsigned int>(vpTestSupport::longer(1));
  const auto turns =
      static_cast<unsigned int>(std::max(1, 4 / vpTestSupport::longer(2))); // every second photograph, or all
  const std::vector<std::string> files = photographs();
  EndErrors rotation, position;
  for (std::size_t i = 0; i < files.size(); ++i) {
    if ((i + vpTestSupport::seed()) % turns != 0) {
      continue;
    }
    const std::string &file = files[i];
    double worst = 0., vision = 0.;
    for (unsigned int seed = 1; seed <= seeds; ++seed) {
      vpServoRunSpec spec;
      spec.measure = "image";
      spec.target = file;
      spec.plant = vpServoPlant::byName("B");
      spec.faults.noise = 2.;
      spec.faults.blur = 0.5;
      spec.seed = 1000U * vpTestSupport::seed() + seed;
      const vpServoRun run = runServoExperiment(spec);
      CAPTURE(file, spec.seed);
      CHECK(run.metrics.status == "ok");
      CHECK(run.metrics.end_rotation_deg < 0.25);
      worst = std::max(worst, run.metrics.end_rotation_deg);
      for (std::size_t i = 0; i < run.samples.size(); ++i) {
        const vpServoSample &s = run.samples[i];
        if (i + 1 < run.samples.size() && run.samples[i + 1].segment == s.segment) {
          continue;
        }
        CAPTURE(s.time, s.rotationError, s.seenRotationError, s.rotationDeviation, s.translationError,
                s.seenTranslationError, s.translationDeviation);
        rotation.add(s.rotationError, std::hypot(s.seenRotationError, s.rotationDeviation));
        position.add(s.translationError, std::hypot(s.seenTranslationError, s.translationDeviation));
        CHECK(rotation.ratios.back() < 3.);
        CHECK(position.ratios.back() < 3.);
        // Of the measurement alone. At worst the whole of its variance is on one axis: once in 100,000 times beyond 4.42.
        CHECK(std::abs(s.rotationError - s.seenRotationError) < 4.42 * s.rotationDeviation);
        CHECK(std::abs(s.translationError - s.seenTranslationError) < 4.42 * s.translationDeviation);
        vision = std::max(vision, vpMath::deg(s.rotationDeviation));
      }
    }
    std::cout << vpIoTools::getName(file) << ": ends within " << worst << " deg; deviation of the vision " << vision
              << "\n";
  }
  if (files.empty()) {
    return;
  }
  std::cout << "error over expected, median and most: rotation " << vpMedian(rotation.ratios) << ", " << rotation.most
            << "; position " << vpMedian(position.ratios) << ", " << position.most << "\n";
  // Not blown up.
  CHECK(vpMedian(rotation.ratios) > 0.5);
  CHECK(vpMedian(rotation.ratios) < 1.5);
  CHECK(vpMedian(position.ratios) > 0.5);
  CHECK(vpMedian(position.ratios) < 1.5);
}
