/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file catchImageServo.cpp
 * \brief The whole chain from picture to motion: rendered views, vpPlanarTarget, law, plant with friction.
 */
#include "vpCatch.h"

#include "lab/servo/vpServoExperiment.h"

VISP_DIRECT_USING_NAMESPACE

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
