/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Contributions that the thesis never puts into a visual loop of their own: the pose from one reference image (chapter 4),
// and direct trajectory generation (chapter 6).
#include "part.h"

#include "visp-servo-compare/plan.h"

#include "lab/servo/vpReferenceExperiment.h"

#include <visp3/core/vpMath.h>
#include <visp3/direct_core/vpQuantile.h>

#include <cmath>

namespace thesisReport
{
namespace
{
constexpr const char *PBVS = "pbvs1", *KYRKI = "kyrki-decoupled", *FEEDFORWARD = "ff-sum", *OURS = "ff-lookat-pi";
constexpr int STARTS = 6;
constexpr unsigned int TAUGHT = 25; // images averaged for the reference
constexpr double NOISE = 0.5;       // px

//! Median figures of a law over random starts.
struct FromImage {
  double rotation = 0., outOfView = 0., settled = 0., distance = 0., arrived = 0.; // deg, s, s, share of d, share
};

FromImage fromImage(const std::string &law, const char *plant, const Setting &setting)
{
  vpReferenceRunSpec spec;
  spec.law = law;
  spec.plant = vpServoPlant::byName(plant);
  std::vector<double> rotation, settled, distance;
  FromImage result;
  for (int i = 0; i < STARTS; ++i) {
    std::mt19937_64 rng(setting.seed + static_cast<unsigned int>(i));
    const vpReferenceStart start = vpReferenceStart::draw(rng);
    std::shared_ptr<const vpReferencePose> pose;
    const vpReferenceRun run =
        runReferenceExperiment(start, seePoints(start, NOISE, TAUGHT, vpReferencePoseSpec(), rng(), pose), spec);
    rotation.push_back(vpMath::deg(run.endRotation));
    settled.push_back(std::min(run.settled, spec.duration));
    distance.push_back(std::fabs(run.endDistance / start.distance - 1.));
    result.outOfView += run.outOfView / STARTS;
    result.arrived += run.arrived() ? 1. / STARTS : 0.;
  }
  result.rotation = vpMedian(rotation);
  result.settled = vpMedian(settled);
  result.distance = vpMedian(distance);
  return result;
}

std::vector<Item> oneImage(const Setting &setting)
{
  const char *const perfect = "A", *const hard = "D";
  const std::vector<const char *> laws = {PBVS, KYRKI, FEEDFORWARD, OURS};
  std::vector<FromImage> ideal, disturbed;
  for (const char *law : laws) {
    ideal.push_back(fromImage(law, perfect, setting));
    disturbed.push_back(fromImage(law, hard, setting));
    setting.progress(static_cast<double>(ideal.size()) / static_cast<double>(laws.size()));
  }
  enum Law : std::size_t { Pbvs, Kyrki, Forward, Ours };
  Item item;
  item.id = "sec4.6";
  const std::string how = "Median of " + std::to_string(STARTS) + " random starts.";
  item.quantities = {{"figure 5.7 from one image: time to settle, feedforward over PBVS", "1", 1.,
                      ideal[Forward].settled / ideal[Pbvs].settled, Tolerance::atMost(0.05), Good::Smaller,
                      "Both decay with the same gain of the translation, which decides.",
                      how + " Within 2 deg and 2 % of the distance."},
                     {"figure 5.8 from one image: rotation error at the end, feedforward over kyrki-decoupled", "1", 1.,
                      disturbed[Forward].rotation / disturbed[Kyrki].rotation, Tolerance::atMost(), Good::Smaller,
                      "Friction of 0.2 rad/s on every axis stops both where their gain leaves it.", how},
                     {"figure 5.11 from one image: time out of view, feedforward minus PBVS", "s", 0.,
                      disturbed[Forward].outOfView - disturbed[Pbvs].outOfView, Tolerance::atMost(), Good::Smaller, "",
                      "Mean of " + std::to_string(STARTS) + " random starts."},
                     {"error of the distance to the plane at the end, perfect robot", "1", std::nullopt,
                      ideal[Ours].distance, Tolerance::factor(1.1), Good::Neither, "",
                      how + " Chapter 4: \"the estimation of the translation can only be observed up to a scale "
                            "factor\"; the motion of the "
                            "robot gives the scale."},
                     {"share of the starts that arrive, look-at feedforward with an integral, disturbed robot", "1",
                      std::nullopt, disturbed[Ours].arrived, Tolerance::factor(1.1), Good::Neither, "",
                      "Within 3 deg and 5 % of the distance."},
                     {"rotation error at the end, look-at feedforward with an integral, disturbed robot", "deg",
                      std::nullopt, disturbed[Ours].rotation, Tolerance::factor(1.1), Good::Neither, "", how}};
  item.remarks = {
      "Section 4.5 measures the pose from one reference image at rest; sections 5.4 and 8.3 use it in a loop and do "
      "not say where its scale comes from. Here the loop runs without any size: the distance to the plane is "
      "estimated with the motion of the robot.",
      "The thesis's sentences are on the loop of section 5.4 and on other measures (yaw error, yaw range); here they "
      "are tried on this loop with the measures that the rows name."};
  item.parameters = {
      {"starts", "d from 0.2 to 1 m, tilt up to 0.6 rad, rotations up to 60 deg, 30 points with 0.5 px of noise"},
      {"reference", std::to_string(TAUGHT) + " images, averaged"},
      {"robots", "plants A and D of figures 5.6 to 5.11, 15 s"}};
  return {item};
}

constexpr const char *OPEN = "dtg", *PLANNED = "ff-dtg";

//! Every law of \e names on a plant, within the limits if \e bounded.
std::vector<vpServoRun> visualRuns(const std::vector<std::string> &names, const char *plant, bool bounded,
                                   const Setting &setting)
{
  servoCompare::Options options;
  options.laws = names;
  options.plants = {plant};
  options.measures = {"points"};
  options.bounded = bounded;
  options.seed = setting.seed;
  std::vector<vpServoRun> runs;
  for (const vpServoRunSpec &spec : servoCompare::makePlan(options).runs) {
    runs.push_back(runServoExperiment(spec));
  }
  return runs;
}

vpApp::PlotCurve speedOf(const vpServoRun &run)
{
  vpApp::PlotCurve curve{run.spec.law, colourOf(run.spec.law), vpApp::PlotStyle::Solid, 2., {}, {}};
  for (const vpServoSample &s : run.samples) {
    if (s.segment == 0) {
      curve.x.push_back(s.time);
      curve.y.push_back(s.commanded.linearNorm());
    }
  }
  return curve;
}

std::vector<Item> plannedInLoop(const Setting &setting)
{
  const vpServoRun raw = visualRuns({PBVS}, "A", false, setting).front();
  setting.progress(0.2);
  const std::vector<vpServoRun> ideal = visualRuns({PBVS, OPEN, PLANNED}, "A", true, setting);
  setting.progress(0.6);
  const std::vector<vpServoRun> disturbed = visualRuns({PBVS, OPEN, PLANNED, OURS}, "D", true, setting);
  const vpServoMotionLimits limits = *ideal.front().spec.bounds;
  enum Law : std::size_t { Pbvs, Open, Planned, Ours };
  Item item;
  item.id = "fig6.1";
  const auto exceeded = [&](const std::string &robot, const vpServoRun &run) {
    Quantity quantity{run.spec.law + ": cycles beyond a limit, " + robot,
                      "1",
                      0.,
                      run.metrics.bounds_exceeded_cycles,
                      Tolerance::atMost(),
                      Good::Smaller,
                      "",
                      "Of the commanded speed, acceleration and jerk, in 24 s. Of several seeds the largest."};
    quantity.never = true;
    return quantity;
  };
  item.quantities = {
      {"acceleration of motion from an error alone over the limit, PBVS", "1", 1.,
       raw.metrics.peak_linear_acceleration_mps2 / limits.linearAcceleration, Tolerance::atLeast(), Good::Neither, "",
       "The thesis: infinite. Here the step of one cycle of 10 ms: it doubles with the rate of the loop."},
      exceeded("perfect robot", ideal[Open]),
      exceeded("perfect robot", ideal[Planned]),
      exceeded("disturbed robot", disturbed[Open]),
      exceeded("disturbed robot", disturbed[Planned]),
      {"rms jerk, ff-dtg over PBVS within the same limits, disturbed robot", "1", 1.,
       disturbed[Planned].metrics.rms_linear_jerk_mps3 / disturbed[Pbvs].metrics.rms_linear_jerk_mps3,
       Tolerance::atMost(), Good::Smaller, "", "PBVS behind a limiter and a shaper."},
      {"figure 5.9 by ff-dtg: yaw range, disturbed robot", "deg", std::nullopt,
       disturbed[Planned].metrics.yaw_range_deg, Tolerance::factor(1.1), Good::Neither, "",
       "Look-at feedforward with an integral, within the same limits: " +
           std::to_string(std::lround(disturbed[Ours].metrics.yaw_range_deg)) + " deg."},
      {"figure 5.9 by dtg: yaw range, disturbed robot", "deg", std::nullopt, disturbed[Open].metrics.yaw_range_deg,
       Tolerance::factor(1.1), Good::Neither, "",
       "The open plan leaves what friction takes; ff-dtg adds the feedback of the measured pose."}};
  item.remarks = {
      "Chapter 6 shows direct trajectory generation on one joint, with given goals. Here its goal is what the "
      "camera measures, in the task of section 5.4.2, and position and rotation are planned within limits "
      "(visp-servo-compare --law dtg,ff-dtg --bounded)."};
  item.parameters = {{"limits", "0.25 m/s, 0.5 m/s^2, 5 m/s^3; 1 rad/s, 2 rad/s^2, 20 rad/s^3"},
                     {"object", "averaged over images for every law"}};
  vpApp::Plot plot = vpApp::timePlot("Speed of the camera on the way to pose 2, perfect robot", "m/s", 380);
  plot.curves = {speedOf(raw), speedOf(ideal[Planned])};
  plot.curves.front().label += ", without limits";
  addPlot(item, "speed", plot.title, "Motion from the error begins with a step, the planned one with rest. First seed.",
          {plot});
  return {item};
}
} // namespace

std::vector<Part> referenceParts()
{
  return {
      {"Chapter 4: 3D vision", {{"sec4.6", "servoing from one reference image without known size"}}, 10., oneImage}};
}

std::vector<Part> plannedServoParts()
{
  return {{"Chapter 6: direct trajectory generation",
           {{"fig6.1", "motion from an error and planned motion in the visual loop"}},
           8.,
           plannedInLoop}};
}
} // namespace thesisReport
