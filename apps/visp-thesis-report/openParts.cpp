/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// What the thesis leaves open: where the combined law of (5.28) is stable, and whether the encoder of section 9.2 is good enough.
#include "part.h"

#include "numberText.h"

#include <visp3/core/vpExponentialMap.h>
#include <visp3/core/vpMath.h>
#include <visp3/core/vpThetaUVector.h>
#include <visp3/feedforward/vpFeedforwardStability.h>
#include <visp3/feedforward/vpServoLaw.h>
#include <visp3/printing/vpMotionForecast.h>
#include <visp3/printing/vpMotionKalmanFilter.h>
#include <visp3/trajectory/vpMotionFamily.h>

#include <algorithm>
#include <cmath>
#include <random>

VISP_DIRECT_USING_NAMESPACE

namespace thesisReport
{
namespace
{
using vpApp::number;

constexpr double KAPPA = 1.;
constexpr unsigned int AXES = 60; // of the sampled rotations

double margin(double bearing, double rotation)
{
  return vpFeedforwardSumStabilityMargin(vpMath::rad(bearing), vpMath::rad(rotation), KAPPA, AXES);
}

//! The rotation up to which the margin is positive, deg. \param bearing : deg.
double lastStable(double bearing)
{
  double low = 0., high = 179.;
  if (margin(bearing, high) > 0.) {
    return high;
  }
  while (high - low > 0.5) {
    const double middle = 0.5 * (low + high);
    (margin(bearing, middle) > 0. ? low : high) = middle;
  }
  return low;
}

constexpr double WIDEST = 84., BEARING_STEP = 4.; // deg, object aside
constexpr unsigned int STARTS = 300;              // outside the region
constexpr int GRID = 22;                          // places a side, for the least margin in a field
constexpr double CYCLE = 0.01;                    // s
constexpr int CYCLES = 6000;
constexpr double NEAR = 0.01;         // rad and m: arrived
constexpr double IN_FRONT = 1e-3;     // m: nearer than this the object is not seen
constexpr double GOAL_DISTANCE = 0.5; // m

//! Ends of ff-sum from random starts, on a robot that moves as commanded.
struct Ends {
  unsigned int arrived = 0, unseen = 0; //!< Unseen: the object came behind the camera.
};

//! A view of the object \e bearing aside, with \e rotation to the goal about any axis. Angles in rad.
vpHomogeneousMatrix viewOf(double bearing, double rotation, std::mt19937_64 &rng)
{
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  const double z = 0.3 + 0.7 * uniform(rng), direction = 2. * M_PI * uniform(rng), aside = z * std::tan(bearing);
  vpColVector axis(3);
  for (unsigned int i = 0; i < 3; ++i) {
    axis[i] = normal(rng);
  }
  axis *= rotation / std::sqrt(axis.sumSquare());
  return {vpTranslationVector(aside * std::cos(direction), aside * std::sin(direction), z),
          vpThetaUVector(axis[0], axis[1], axis[2])};
}

void drive(vpHomogeneousMatrix cMo, Ends &ends)
{
  vpServoGoal goal;
  goal.cdMo = vpHomogeneousMatrix(0., 0., GOAL_DISTANCE, 0., 0., 0.);
  goal.points = {{0., 0., GOAL_DISTANCE}};
  const auto law = vpServoLaw::create("ff-sum");
  law->setGoal(goal);
  vpServoMeasurement seen;
  seen.valid = true;
  for (int cycle = 0; cycle < CYCLES; ++cycle) {
    const double z = cMo[2][3];
    if (z < IN_FRONT) {
      ++ends.unseen;
      return;
    }
    const vpHomogeneousMatrix left = goal.cdMo * cMo.inverse();
    if (left.getThetaUVector().getTheta() < NEAR && std::sqrt(left.getTranslationVector().sumSquare()) < NEAR) {
      ++ends.arrived;
      return;
    }
    seen.cMo = cMo;
    seen.points = {{cMo[0][3] / z, cMo[1][3] / z, z}};
    const vpServoCommand command = law->step(seen, CYCLE);
    if (!vpIsWorking(command.status)) {
      return;
    }
    cMo = vpExponentialMap::direct(command.v.toColVector(), CYCLE).inverse() * cMo;
  }
}

//! From starts at which the margin is not positive. \param stable : Last stable rotation at each bearing, deg.
Ends fromOutside(const std::vector<double> &stable)
{
  std::mt19937_64 rng(531);
  std::uniform_real_distribution<double> bearings(0., WIDEST), rotations(0., 179.);
  Ends ends;
  for (unsigned int started = 0; started < STARTS;) {
    const double bearing = bearings(rng), rotation = rotations(rng);
    if (rotation > stable[static_cast<std::size_t>(bearing / BEARING_STEP)]) {
      drive(viewOf(vpMath::rad(bearing), vpMath::rad(rotation), rng), ends);
      ++started;
    }
  }
  return ends;
}

//! Least margin over a grid of bearings and rotations up to the given ones, deg.
double leastMargin(double widest, double farthest)
{
  double least = HUGE_VAL;
  for (int i = 0; i <= GRID; ++i) {
    for (int k = 1; k <= GRID; ++k) {
      least = std::min(least, margin(widest * i / GRID, farthest * k / GRID));
    }
  }
  return least;
}

std::vector<Item> stability(const Setting &)
{
  std::vector<double> bearings, rotations;
  for (double bearing = 0.; bearing <= WIDEST; bearing += BEARING_STEP) {
    bearings.push_back(bearing);
    rotations.push_back(margin(bearing, 0.5) > 0. ? lastStable(bearing) : 0.);
  }
  const Ends ends = fromOutside(rotations);
  Item item;
  item.id = "eq5.31";
  item.quantities = {
      {"least margin, bearing up to 84 deg and rotation up to 179 deg", "1", 0., margin(WIDEST, 179.),
       Tolerance::atLeast(), Good::Neither,
       "The proof is that of PBVS; the image term has an interaction matrix of its own, whose symmetric part is not "
       "positive everywhere. The proof fails; of the law see the rows of the starts.",
       "Smallest eigenvalue of the symmetric part, over sampled axes; where it is not positive nothing is proven."},
      {"share of the starts without a positive margin that arrive", "1", 1., static_cast<double>(ends.arrived) / STARTS,
       Tolerance::atLeast(), Good::Neither, "In the others the object comes behind the camera, and no image shows it.",
       std::to_string(STARTS) +
           " random starts up to 84 deg aside and 179 deg from the goal, on a robot that moves as commanded. In " +
           std::to_string(ends.unseen) + " of them the object comes behind the camera."},
      {"the same, of those whose object stays in front of the camera", "1", std::nullopt,
       static_cast<double>(ends.arrived) / (STARTS - ends.unseen), Tolerance::factor(1.1), Good::Neither, "", ""},
      {"least margin within the field of view of 44 deg, rotation up to 57 deg", "1", 0., leastMargin(22., 57.),
       Tolerance::atLeast(), Good::Neither, "", "The task of section 5.4.2."},
      {"largest rotation with a positive margin, object in the middle", "deg", std::nullopt, rotations.front(),
       Tolerance::factor(1.1), Good::Neither, "", ""},
      {"largest rotation with a positive margin, object 44 deg aside", "deg", std::nullopt, lastStable(44.),
       Tolerance::factor(1.1), Good::Neither, "", ""}};
  item.remarks = {"While the margin is positive the rotation error decreases. The thesis claims it for every pose.",
                  "Outside the region every start arrives that keeps the object in front of the camera, and " +
                      std::to_string(ends.unseen) + " of " + std::to_string(STARTS) + " do not."};
  item.parameters = {{"law", "ff-sum, kappa = 1, any slopes of the saturation"}};
  vpApp::Plot plot;
  plot.title = "Region in which ff-sum is known to be stable";
  plot.xLabel = "angle between optical axis and object (deg)";
  plot.yLabel = "rotation to the goal (deg)";
  plot.fromZero = true;
  addCurve(plot, "stable below", bearings, rotations);
  plot.marks = {{22., "edge of the image of section 5.4.2"}};
  addPlot(item, "region", plot.title, "Below the curve the margin of vpFeedforwardSumStabilityMargin() is positive.",
          {plot});
  return {item};
}

constexpr double FRAMES = 1200., BEGIN = 60.; // frames of 1/1600 s; the errors count from the second on
constexpr double CELL = 9.78, PITCH = 48.9;   // frames and px from centre to centre
constexpr double ENCODER_RATE = 10e3 / 1600.; // readings a frame
constexpr double STEP = 8. / 4.5;             // px: 8 um
constexpr double VISION_DELAY = 1.28;         // frames
constexpr double EFFECTIVE_CELLS = 2.;        // of the thesis's sensor
enum class Sensors { Camera, Encoder, Both };

//! Place and velocity of the stage as planned from centre to centre, px and px/frame.
std::pair<double, double> stageAt(double t)
{
  const double i = std::floor(t / CELL);
  vpTrajectorySegment segment;
  segment.begin = CELL * i;
  segment.duration = CELL;
  segment.p = vpMotionFamily::pointToPoint({0., 4., 0., 0.}, {PITCH, 4., 0., 0.}, 3).at(CELL);
  segment.p[0] = PITCH * i;
  const auto place = [&](double when) { return vpEvaluatePieces(&segment, 1, when); };
  const auto state = place(t);
  return {state[0], state[1]};
}

//! Rms error of the velocity at each frame, px/frame, with what has arrived by then.
double velocityError(Sensors sensors, double sigma, double processNoise, double scale, unsigned int seed)
{
  vpMotionKalmanSpec spec;
  spec.processNoise = processNoise;
  spec.maxDelay = 2.;
  spec.gate = HUGE_VAL;
  if (sensors == Sensors::Both) {
    spec.encoderScaleSigma = 0.01;
    spec.encoderOffsetSigma = STEP;
  }
  vpMotionKalmanFilter filter(spec);
  filter.reset(0., 0., 4.);
  std::mt19937_64 rng(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  const double offset = STEP * uniform(rng);
  double sum = 0., count = 0., encoder = 0.;
  for (double frame = 1.; frame < FRAMES; ++frame) {
    for (; encoder <= frame * ENCODER_RATE; ++encoder) {
      const double t = encoder / ENCODER_RATE;
      const double value = STEP * std::floor(((1. + scale) * stageAt(t).first + offset) / STEP) + 0.5 * STEP;
      if (sensors != Sensors::Camera) {
        filter.add({vpMotionReadingKind::Encoder, t, value, STEP / std::sqrt(12.)});
      }
    }
    const double exposed = frame - VISION_DELAY, seen = stageAt(exposed).first + sigma * normal(rng);
    if (sensors != Sensors::Encoder && exposed > 0.) {
      filter.add({vpMotionReadingKind::Position, exposed, seen, sigma});
    }
    if (frame >= BEGIN) {
      sum += std::pow(filter.at(frame).velocity - stageAt(frame).second, 2);
      ++count;
    }
  }
  return std::sqrt(sum / count);
}

//! Standard deviation of the velocity between the centres, px/frame.
double variation()
{
  Spread velocities;
  for (double t = 0.; t < CELL; t += 0.01) {
    velocities.add(stageAt(t).second);
  }
  return velocities.sigma();
}

//! With the process noise that suits these sensors best.
double bestError(Sensors sensors, double sigma, double scale, unsigned int seed)
{
  double best = HUGE_VAL;
  for (int k = -16; k <= 2; ++k) {
    best = std::min(best, velocityError(sensors, sigma, std::pow(10., 0.5 * k), scale, seed));
  }
  return best;
}

std::vector<Item> encoder(const Setting &setting)
{
  const double thesis = 0.18 / std::sqrt(EFFECTIVE_CELLS), tracker = 0.0153 / std::sqrt(EFFECTIVE_CELLS), scale = 2e-3;
  const double camera = bestError(Sensors::Camera, thesis, scale, setting.seed);
  setting.progress(0.3);
  const double both = bestError(Sensors::Both, thesis, scale, setting.seed);
  setting.progress(0.5);
  const double alone = bestError(Sensors::Encoder, thesis, 0., setting.seed);
  setting.progress(0.6);
  const double good = bestError(Sensors::Camera, tracker, scale, setting.seed);
  const double goodBoth = bestError(Sensors::Both, tracker, scale, setting.seed);
  Item item;
  item.id = "sec9.2";
  const std::string how =
      "Rms at each frame, with what has arrived by then; every filter with the best of 19 process noises.";
  item.quantities = {{"velocity error, encoder and camera over camera alone, detection of the thesis", "1", 1.,
                      both / camera, Tolerance::atMost(), Good::Smaller, "", how},
                     {"variation of the true velocity", "px/frame", std::nullopt, variation(), Tolerance::factor(1.1),
                      Good::Neither, "", "Standard deviation: what an estimate that is always the mean would have."},
                     {"velocity error, camera alone, detection of the thesis", "px/frame", std::nullopt, camera,
                      Tolerance::factor(1.1), Good::Neither, "", how},
                     {"velocity error, encoder and camera, detection of the thesis", "px/frame", std::nullopt, both,
                      Tolerance::factor(1.1), Good::Neither, "", how},
                     {"velocity error, encoder alone, its scale known exactly", "px/frame", std::nullopt, alone,
                      Tolerance::factor(1.1), Good::Neither, "", how},
                     {"velocity error, encoder and camera over camera alone, vpPatternTracker", "1", std::nullopt,
                      goodBoth / good, Tolerance::factor(1.1), Good::Neither, "",
                      "Camera alone: " + number(good, 2) + " px/frame."}};
  item.remarks = {
      "The thesis asks for a finer and faster encoder than the image sensor and leaves open whether 8 um at 10 kHz do: "
      "8 um are " +
          number(STEP, 3) + " px, ten times the detection's deviation, but without the delay of the image. " +
          std::string(both < camera ? "They improve the estimate" : "They do not improve the estimate") +
          " with the thesis's detection, and " + (goodBoth < good ? "improve it" : "do not improve it") +
          " with vpPatternTracker.",
      "The filters do not know the planned motion. The observer of visp-print-pattern knows it and does without an "
      "encoder."};
  item.parameters = {{"motion", "from centre to centre in 9.78 frames, 4 px/frame there, 5 on average, as planned"},
                     {"camera", "1600 Hz, 1.28 frames late, deviation 0.18 px (thesis) or 0.0153 px (vpPatternTracker) "
                                "of a cell, two effective cells"},
                     {"encoder", "10 kHz, steps of 8 um, scale off by 0.2 % and estimated, no slip"},
                     {"filter", "vpMotionKalmanFilter, constant acceleration"}};
  return {item};
}
} // namespace

std::vector<Part> stabilityParts()
{
  return {{"Chapter 5: feedforward visual servoing",
           {{"eq5.31", "where the combined law is stable"}},
           3.,
           stability,
           false}};
}

std::vector<Part> recommendationParts()
{
  return {{"Chapter 9: recommendations", {{"sec9.2", "an encoder beside the camera"}}, 3., encoder}};
}
} // namespace thesisReport
