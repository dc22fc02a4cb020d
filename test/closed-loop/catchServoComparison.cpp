/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file catchServoComparison.cpp
 * \brief The comparison of thesis section 5.4: all laws on the plants A, B and D, printed beside a prototype's figures.
 *
 * The prototype was another program, with other random points, an unknown cycle on plant A, and an object of unknown
 * size. The tolerances here are what these unknowns can change: on plant A, cycles of 10 to 100 Hz move the largest
 * image error by up to 3 px (pbvs1-rot2 and kyrki-decoupled: 8 px), another set of points by about 1 px.
 */
#include "vpCatch.h"

#include <visp3/core/vpMath.h>
#include "lab/servo/vpServoExperiment.h"

#include <algorithm>
#include <cmath>
#include <vector>
#include <string>
#include <cstdio>
#include <map>

VISP_DIRECT_USING_NAMESPACE

namespace
{
// A law that plans has limits of its own and waits for a plan: catchPlannedServo.
std::vector<std::string> lawsWithoutPlan()
{
  std::vector<std::string> ids = vpServoLaw::ids();
  const auto plans = [](const std::string &id) { return vpServoLaw::create(id)->plansMotion(); };
  ids.erase(std::remove_if(ids.begin(), ids.end(), plans), ids.end());
  return ids;
}

//! One row of the prototype's table.
struct Prototype {
  const char *law;
  double maxA, maxB, rmsB, endB, outD, yawD; // px, px, px, deg, s, deg
};

const Prototype prototypes[] = {
    {"pbvs1", 13.6, 80, 72, 5.5, 3.9, 34.5},
    {"pbvs1-rot2", 114.7, 87, 36, 2.2, 0, 46.7},
    {"ibvs", 1.3, 82, 74, 6.2, 12.3, 29.3},
    {"hybrid25d", 1.7, 80, 72, 5.5, 5.9, 34.5},
    {"kyrki-decoupled", 155.8, 244, 132, 5.9, 21.6, 32.4},
    {"kyrki", 1.8, 80, 72, 5.4, 4.4, 34.2},
    {"kyrki-rot2", 2.5, 40, 37, 2.7, 0, 45.8},
    {"ff-sum", 11.5, 41, 37, 2.7, 0, 45.7},
    {"ff-lookat", 1.2, 40, 38, 2.7, 0, 45.7},
    {"ff-lookat-pi", 1.2, 59, 18, 0.15, 0, 57.0},
};

// The size of the object, m, is that of the task unless it is given.
vpServoRunSpec specOf(const std::string &law, const std::string &plant, unsigned int seed = 1, double size = 0.)
{
  vpServoRunSpec spec;
  spec.law = law;
  spec.plant = vpServoPlant::byName(plant);
  spec.seed = seed;
  if (size > 0.) {
    spec.task.objectWidth = spec.task.objectHeight = size;
  }
  return spec;
}

const vpServoMetrics &figures(const std::string &law, const std::string &plant, unsigned int seed = 1, double size = 0.)
{
  static std::map<std::string, vpServoMetrics> done;
  const std::string key = law + ' ' + plant + ' ' + std::to_string(seed) + ' ' + std::to_string(size);
  const auto found = done.find(key);
  if (found != done.end()) {
    return found->second;
  }
  return done[key] = runServoExperiment(specOf(law, plant, seed, size)).metrics;
}

bool isInViewAtPose2(const std::string &law, double size)
{
  const vpServoRun run = runServoExperiment(specOf(law, "D", 1, size));
  const auto next =
      std::find_if(run.samples.begin(), run.samples.end(), [](const vpServoSample &s) { return s.segment > 0; });
  return next != run.samples.begin() && next != run.samples.end() && (next - 1)->inView;
}

// What Coulomb friction leaves of the rotation error of a proportional law with this gain, deg.
double frictionError(const std::string &plant, double gain)
{
  return vpMath::deg(vpServoPlant::byName(plant).deadband / gain);
}

double tolerance(double value, double absolute) { return std::max(absolute, 0.03 * std::fabs(value)); }
} // namespace

TEST_CASE("the table of the comparison", "[comparison]")
{
  std::printf("Here / prototype (- : not measured). Object 0.18 x 0.18 m, seed 1, ideal yaw range 56.8 deg.\n"
              "%-16s %-2s  %15s %15s %13s %15s %13s %s\n",
              "law", "", "max image px", "rms image px", "end deg", "out of view s", "yaw deg", "end mm");
  const auto cell = [](double here, double prototype, int places) {
    char text[32];
    if (std::isnan(prototype)) {
      std::snprintf(text, sizeof(text), "%.*f /     -", places, here);
    }
    else {
      std::snprintf(text, sizeof(text), "%.*f / %5.*f", places, here, places, prototype);
    }
    return std::string(text);
  };
  for (const std::string &law : lawsWithoutPlan()) {
    Prototype p = {law.c_str(), NAN, NAN, NAN, NAN, NAN, NAN};
    for (const Prototype &known : prototypes) {
      p = law == known.law ? known : p;
    }
    for (const char *plant : {"A", "B", "D"}) {
      const vpServoMetrics &m = figures(law, plant);
      const bool a = *plant == 'A', b = *plant == 'B', d = *plant == 'D';
      std::printf("%-16s %-2s  %15s %15s %13s %15s %13s %6.1f\n", a ? law.c_str() : "", plant,
                  cell(m.max_image_error_px, a ? p.maxA : (b ? p.maxB : NAN), 1).c_str(),
                  cell(m.rms_image_error_px, b ? p.rmsB : NAN, 1).c_str(),
                  cell(m.end_rotation_deg, b ? p.endB : NAN, 2).c_str(),
                  cell(m.out_of_view_s, d ? p.outD : NAN, 1).c_str(),
                  cell(m.yaw_range_deg, d ? p.yawD : NAN, 1).c_str(), m.end_translation_mm);
      CHECK(m.status == "ok");
    }
  }
  std::fflush(stdout);
  for (const Prototype &p : prototypes) {
    CAPTURE(p.law);
    CHECK(figures(p.law, "A").max_image_error_px == Approx(p.maxA).margin(tolerance(p.maxA, 3.)));
    if (std::string(p.law) != "ff-lookat-pi") {
      CHECK(figures(p.law, "B").max_image_error_px == Approx(p.maxB).margin(tolerance(p.maxB, 3.)));
      CHECK(figures(p.law, "B").rms_image_error_px == Approx(p.rmsB).margin(tolerance(p.rmsB, 2.5)));
    }
    else { // its anti-windup is better than the prototype's: no memory of the friction of the other direction
      CHECK(figures(p.law, "B").max_image_error_px < p.maxB + 3.);
      CHECK(figures(p.law, "B").rms_image_error_px < p.rmsB + 2.5);
    }
    CHECK(figures(p.law, "B").end_rotation_deg == Approx(p.endB).margin(0.6));
    CHECK(figures(p.law, "D").yaw_range_deg == Approx(p.yawD).margin(1.5));
    CHECK(figures(p.law, "D").out_of_view_s == Approx(p.outD).margin(2.5));
  }
}

TEST_CASE("on the perfect plant every law does the task, and two of them show the object badly", "[comparison]")
{
  for (const std::string &law : lawsWithoutPlan()) {
    const vpServoMetrics &m = figures(law, "A");
    CAPTURE(law);
    CHECK(m.end_rotation_deg < 0.1);
    CHECK(m.end_translation_mm < 0.5);
    CHECK((m.out_of_view_s > 0.) == (law == "kyrki-decoupled"));
    CHECK(m.yaw_range_deg == Approx(56.8).margin(0.3));
    CHECK(m.ideal_yaw_range_deg == Approx(56.78).margin(0.01));
    const bool showsBadly = law == "kyrki-decoupled" || law == "pbvs1-rot2"; // rotates too late, or too early
    CHECK((m.max_image_error_px > 100.) == showsBadly);
  }
  CHECK(figures("ff-lookat", "A").max_image_error_px < 0.5); // an object that starts at its place stays there
  CHECK(figures("ff-lookat-pi", "A").max_image_error_px < 0.5);
}

TEST_CASE("with friction only the integral reaches the pose", "[comparison]")
{
  const std::string plant = GENERATE("B", "D");
  CHECK(figures("ff-lookat-pi", plant).end_rotation_deg < 0.2);
  for (unsigned int seed = 1; seed <= 5; ++seed) {
    CAPTURE(plant, seed);
    // Worst of three ends. One frame's pose has an angular noise of 0.2 deg at poses 2 and 3 and 0.6 deg at pose 1
    // (root mean square); the law smooths it. Of 40 seeds 4 (B) and 2 (D) end beyond 0.2 deg, at 0.28 deg at most.
    CHECK(figures("ff-lookat-pi", plant, seed).end_rotation_deg < 0.35);
    CHECK(figures("ff-lookat-pi", plant, seed).yaw_range_deg == Approx(56.8).margin(0.5));
    CHECK(figures("ff-lookat-pi", plant, seed).out_of_view_s == 0.);
    // The others stop where friction holds them: deadband / gain, whatever the law.
    for (const char *law : {"pbvs1", "pbvs2", "hybrid25d", "kyrki"}) {
      CAPTURE(law);
      CHECK(figures(law, plant, seed).end_rotation_deg == Approx(frictionError(plant, 1.)).epsilon(0.08));
    }
    for (const char *law : {"pbvs1-rot2", "kyrki-rot2", "ff-lookat", "ff-sum"}) { // ff-sum: 1 + kappa
      CAPTURE(law);
      CHECK(figures(law, plant, seed).end_rotation_deg == Approx(frictionError(plant, 2.)).epsilon(0.08));
    }
  }
}

TEST_CASE("the benefit of the feedforward is the gain that it allows: kyrki-rot2 at the same gain ties", "[comparison]")
{
  const std::string plant = GENERATE("B", "D");
  const vpServoMetrics &lookAt = figures("ff-lookat", plant), &kyrki = figures("kyrki-rot2", plant);
  CAPTURE(plant);
  CHECK(kyrki.max_image_error_px == Approx(lookAt.max_image_error_px).epsilon(0.05));
  CHECK(kyrki.rms_image_error_px == Approx(lookAt.rms_image_error_px).epsilon(0.05));
  CHECK(kyrki.end_rotation_deg == Approx(lookAt.end_rotation_deg).epsilon(0.05));
  CHECK(kyrki.yaw_range_deg == Approx(lookAt.yaw_range_deg).margin(0.5));
  // PBVS at that gain turns as far, but takes the object across the image on the way.
  CHECK(figures("pbvs1-rot2", plant).end_rotation_deg == Approx(lookAt.end_rotation_deg).epsilon(0.08));
  CHECK(figures("pbvs1-rot2", "A").max_image_error_px > 50. * figures("ff-lookat", "A").max_image_error_px);
  CHECK(figures("pbvs1-rot2", "B").max_image_error_px > 2. * figures("ff-lookat", "B").max_image_error_px);
}

TEST_CASE("who loses the view with much friction", "[comparison]")
{
  for (unsigned int seed = 1; seed <= 5; ++seed) {
    CAPTURE(seed);
    for (const char *law : {"pbvs1", "pbvs2", "ibvs", "hybrid25d", "kyrki", "kyrki-decoupled"}) {
      CAPTURE(law);
      CHECK(figures(law, "D", seed).out_of_view_s > 2.);
    }
    for (const char *law : {"pbvs1-rot2", "kyrki-rot2", "ff-sum", "ff-lookat", "ff-lookat-pi"}) {
      CAPTURE(law);
      CHECK(figures(law, "D", seed).out_of_view_s == 0.);
    }
  }
  for (const char *plant : {"A", "B", "D"}) {
    for (const std::string &law : lawsWithoutPlan()) {
      CAPTURE(plant, law);
      CHECK(figures("kyrki-decoupled", plant).max_image_error_px >= figures(law, plant).max_image_error_px);
      CHECK(figures("kyrki-decoupled", plant).rms_image_error_px >= figures(law, plant).rms_image_error_px);
    }
  }
}

TEST_CASE("which law loses the view depends on the size of the object, the rest does not", "[comparison]")
{
  // 0.18 m was chosen because with it the losses are near the prototype's. With 0.16 m nearly all of them vanish.
  std::printf("Out of view on plant D with an object of 0.16 / 0.18 m:\n");
  for (const std::string &law : lawsWithoutPlan()) {
    const vpServoMetrics &small = figures(law, "D", 1, 0.16), &usual = figures(law, "D");
    std::printf("%-16s %5.1f / %5.1f s\n", law.c_str(), small.out_of_view_s, usual.out_of_view_s);
    CAPTURE(law);
    CHECK((small.out_of_view_s > 0.) == (law == "kyrki-decoupled"));
    CHECK(small.rms_image_error_px == Approx(usual.rms_image_error_px).epsilon(0.03));
    CHECK(small.end_rotation_deg == Approx(usual.end_rotation_deg).epsilon(0.03).margin(0.1));
    CHECK(small.yaw_range_deg == Approx(usual.yaw_range_deg).margin(0.5));
  }
  std::fflush(stdout);
  // At the end of pose 2, figure 5.11: with 0.18 m both laws keep it in view, with 0.22 m only the feedforward.
  CHECK(isInViewAtPose2("pbvs1", 0.18));
  CHECK(isInViewAtPose2("ff-sum", 0.18));
  CHECK_FALSE(isInViewAtPose2("pbvs1", 0.22));
  CHECK(isInViewAtPose2("ff-sum", 0.22));
}
