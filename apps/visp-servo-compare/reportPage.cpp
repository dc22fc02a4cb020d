/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "reportPage.h"
#include "appMain.h"

#include "catalogue.h"
#include "findings.h"
#include "format.h"
#include "htmlReport.h"
#include "tables.h"

#include <visp3/core/vpMath.h>
#include <visp3/core/vpPoseVector.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace servoCompare
{
namespace
{
using vpApp::HtmlCell;
using vpApp::HtmlReport;
using vpApp::HtmlTable;

std::string plural(std::size_t count, const std::string &noun)
{
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

std::string poseText(const vpHomogeneousMatrix &M)
{
  const vpPoseVector p(M);
  return "position (" + fixed(p[0], 3) + ", " + fixed(p[1], 3) + ", " + fixed(p[2], 3) + ") m, rotation (" +
         fixed(vpMath::deg(p[3]), 1) + ", " + fixed(vpMath::deg(p[4]), 1) + ", " + fixed(vpMath::deg(p[5]), 1) +
         ") deg";
}

//! Names of the poses in visiting order: "1 - 2 - 1 - 3" for the task of the thesis.
std::string routeOf(const vpServoTask &task)
{
  std::string route = "start";
  for (const vpServoSegment &segment : task.segments) {
    const vpPoseVector way(segment.cdMo * task.initial.inverse());
    if (std::all_of(way.data, way.data + way.size(), [](double value) { return std::abs(value) < 1e-6; })) {
      route = segment.name; // the start is one of the poses
    }
  }
  for (const vpServoSegment &segment : task.segments) {
    route += " - " + segment.name;
  }
  return route;
}

void writeAnswer(HtmlReport &page, const Plan &plan, const Results &results)
{
  const Findings findings = findingsOf(plan, results);
  page.highlight(findings.answer);
  page.list(findings.more);
}

void writeWhat(HtmlReport &page, const Plan &plan, const Results &results)
{
  const vpServoTask &task = plan.scenario.task;
  double duration = 0.;
  for (const vpServoSegment &segment : task.segments) {
    duration += segment.duration;
  }
  page.section("What was run");
  page.paragraph("A camera on a robot looks at a flat object and visits the poses " + routeOf(task) +
                 " one after another, " + number(duration, 3) + " s in all. " + plural(plan.laws.size(), "law") +
                 " on " + plural(plan.scenario.plants.size(), "plant") + " (simulated robots), " +
                 plural(results.runs().size(), "run") +
                 "; every law has the same task, gains, limits, latency and noise" +
                 (plan.repetitions > 1 ? ", and " + std::to_string(plan.repetitions) + " seeds. Numbers are medians."
                                       : ", and the same seed."));
  page.paragraph(
      "\"The thesis\" is \"Direct Methods for Vision-Based Robot Control\", whose section 5.4 compares PBVS, Kyrki's "
      "law and its own on a real robot with friction; its figures are repeated below as far as the laws were run.");
  if (!plan.scenario.description.empty()) {
    page.paragraph(plan.scenario.description);
  }
  std::vector<std::string> items;
  if (plan.arm) {
    items.push_back("The camera is in the hand of an arm: " + sentenceOf(*plan.arm));
  }
  for (const vpServoPlant &plant : plan.scenario.plants) {
    items.push_back("Plant " + plant.name + ": " + sentenceOf(plant, plan.arm != nullptr));
  }
  page.list(items);
  page.paragraph(
      "Simulated and real: the robots, their friction and latency and all motions are simulated. The picture on "
      "the object is a real photograph (" +
      std::filesystem::path(plan.target.file).filename().string() +
      "). Every view of it is rendered from that photograph; no picture here was taken by a robot's camera. By "
      "\"points\" a law gets the object's feature points with noise, through a homography; by \"image\" it gets "
      "what the vision of visp-direct measures in rendered views.");
}

void writeTables(HtmlReport &page, const Plan &plan, const Results &results)
{
  page.section("Laws and plants");
  const std::string ideal = fixed(results.runs().front().metrics.ideal_yaw_range_deg, 1);
  const std::string seeds = plan.repetitions > 1
                                ? " Median and, in brackets, range over " + std::to_string(plan.repetitions) + " seeds."
                                : "";
  for (const std::string &measure : plan.measures) {
    page.table(mainTable(plan, results, measure),
               "Measured by " + measure +
                   ". max px, rms px: distance of the object's centre from its desired image position. end "
                   "deg: largest true rotation error at the end of a segment; left: what the last measurement still "
                   "shows of it, deg, "
                   "which the law has left; expected: root mean square of it by that measurement and its covariance, "
                   "deg. yaw deg: range of yaw covered, ideal is " +
                   ideal +
                   ". out s: time with a corner of the object out of the image. The best of a column has a green mark, "
                   "the worst "
                   "a red one." +
                   seeds);
  }
  page.beginDetails("Further figures: settling time, translation, path, speeds");
  for (const std::string &measure : plan.measures) {
    page.table(
        furtherTable(plan, results, measure),
        "Measured by " + measure +
            ". settle s: mean time of a segment until the error stays below 2 deg and 5 mm, its "
            "duration if never. end mm: largest translation error at the end of a segment. Speeds are those executed." +
            seeds);
  }
  page.endDetails();
  HtmlTable laws;
  laws.header = {{HtmlCell("law", "left"), HtmlCell("name", "left"), HtmlCell("what it does", "left")}};
  for (const std::string &law : plan.laws) {
    const LawInfo info = lawInfo(law);
    laws.rows.push_back({HtmlCell(law, "left"), HtmlCell(info.name, "left"), HtmlCell(info.sentence, "left wrap")});
  }
  page.beginDetails("The laws in a sentence each");
  page.table(laws, "The same ids as in --law and summary.json.");
  page.endDetails();
}

void addFigure(HtmlReport &page, const Figure &figure)
{
  page.picture(vpApp::dataUri("image/svg+xml", figure.svg), figure.title, figure.title + ". " + figure.caption);
}

void writeFigures(HtmlReport &page, const ReportParts &parts)
{
  page.section("Figures");
  page.paragraph(
      "Numbered as in the thesis where they repeat one of its figures. A law has the same colour everywhere.");
  for (const Figure &figure : parts.figures) {
    addFigure(page, figure);
  }
}

void writeArm(HtmlReport &page, const Plan &plan, const Results &results, const std::vector<Figure> &figures)
{
  page.section("The arm");
  page.paragraph(
      "The law's twist becomes joint velocities within all limits every 5 ms; where joints are to spare, what is left "
      "of them moves without moving the camera (self-motion). On plants with friction the drives follow by torques at "
      "1 kHz: PD control with gravity, no friction compensation, friction that sticks. Masses, gains and friction of "
      "the "
      "AMOR arm are assumed, the thesis does not give them.");
  page.paragraph(
      plan.arm->spec.drives.reference == vpDriveReference::Measured
          ? "These drives (--drive measured) add the commanded velocity to the measured position, (3.18) of the "
            "thesis: a velocity too small for friction does not move a joint, and the law has to raise it. Drives that "
            "integrate in open loop (--drive integrated) hide friction from the law."
          : "These drives (--drive integrated) integrate the commanded velocity in open loop: a joint that sticks is "
            "pushed harder until it moves, and laws without an integral end about as near to the goal as those with "
            "one. "
            "This does not hold for drives that start from the measured position (--drive measured).");
  page.table(armTable(plan, results),
             "By law and plant, measured by " + plan.mainMeasure() +
                 ". limit margin: least distance of a joint from a position limit, and which; 0 means that it was held "
                 "there. speed, acceleration: largest part of a joint's limit that was commanded; 100 is the limit "
                 "itself, which is never exceeded. self-motion: way the joints made for their own good. slowed: less "
                 "motion than asked for, by limits or near singularities; blocked: none. The status names a "
                 "joint that did not follow or a drive at its limit, with the torque that is missing.");
  page.table(jointErrorTable(plan, results, armLaw(plan)),
             "How well the joints follow their commands, with " + armLaw(plan) + " (mm for sliding joints).");
  for (const Figure &figure : figures) {
    addFigure(page, figure);
  }
}

void writeStep(HtmlReport &page, const Plan &plan, const Results &results, const Figure &figure)
{
  const vpTwistShaperLimits &limits = plan.scenario.shape;
  page.section("The step at the start");
  page.paragraph(
      "A servo law answers an error with a velocity in proportion to it. At t = 0, and whenever the goal changes, the "
      "robot is asked to jump to that velocity within one cycle; section 6.1.1 of the thesis calls it an infinite "
      "acceleration. A shaper (vpTwistShaper) behind any law makes a ramp of the jump. Here its limits are " +
      number(limits.linearAcceleration, 4) + " m/s^2 and " + number(limits.angularAcceleration, 4) +
      " rad/s^2, with a jerk of at most " + number(limits.linearJerk, 4) + " m/s^3 and " +
      number(limits.angularJerk, 4) +
      " rad/s^3. Every run was made twice, with the law's own twist (raw) and with the shaper (shaped). Only this "
      "section describes the shaped runs.");
  page.list(stepFindings(plan, results));
  addFigure(page, figure);
  bool first = true;
  for (const std::string &measure : plan.measures) {
    for (const vpServoPlant &plant : plan.scenario.plants) {
      const HtmlTable table = stepTable(plan, results, plant, measure);
      if (table.rows.empty()) {
        continue;
      }
      const std::string where = "plant " + plant.name + ", measured by " + measure;
      if (!first) {
        page.beginDetails("The same on " + where);
      }
      page.table(table, "Raw and shaped on " + where +
                            ". m/s2, rad/s2: largest change of the commanded twist from one cycle to the next, divided "
                            "by the cycle of " +
                            number(1000. / plant.loopRate, 3) +
                            " ms. max px, end deg, end mm, settle s, out s: as in the tables above." +
                            (plan.repetitions > 1 ? " Medians over the seeds." : ""));
      if (!first) {
        page.endDetails();
      }
      first = false;
    }
  }
}

void writeFilm(HtmlReport &page, const Plan &plan, const ReportParts &parts, vpApp::OutputFolder &out)
{
  page.section("What the camera sees");
  page.picture(
      vpApp::dataUri("image/jpeg", parts.filmStrip.jpeg), "Rows of views, one for each law",
      "Figure 5.11 again: the way to pose " + plan.scenario.task.segments.front().name + " on plant " +
          plan.hardPlant().name +
          "; the last column is the end of the segment. Rows: " + enumerate(parts.filmStrip.laws) +
          ". Yellow: the object; blue: its desired position. A red frame: a corner is "
          "out of the view. In the thesis these are photographs by the robot's camera; here they are rendered.");
  std::vector<HtmlReport::Video> videos;
  bool forBrowsers = true;
  for (const ReplayVideo &video : parts.videos) {
    forBrowsers = forBrowsers && video.forBrowsers;
    videos.push_back({vpApp::dataUri("video/mp4", vpApp::readFile(out.file(video.name))), video.caption});
  }
  if (!forBrowsers) {
    page.paragraph(
        "This FFmpeg has no H.264 encoder: the videos are MPEG-4 part 2, which browsers do not play; open the "
        "files in video/ with a media player.");
  }
  page.videos(videos);
}

void writeParameters(HtmlReport &page, const Plan &plan, const ReportParts &parts)
{
  const vpServoTask &task = plan.scenario.task;
  const vpServoGains &gains = plan.scenario.gains;
  const vpCameraFaults &faults = plan.scenario.faults;
  page.section("Parameters of every run");
  std::vector<std::pair<std::string, std::string>> facts = {
      {"Task", task.name + ": " + routeOf(task)},
      {"Start, object in the camera", poseText(task.initial)},
  };
  for (const vpServoSegment &segment : task.segments) {
    facts.emplace_back("Pose " + segment.name + ", object in the camera, " + number(segment.duration, 3) + " s",
                       poseText(segment.cdMo));
  }
  const std::vector<std::pair<std::string, std::string>> rest = {
      {"Camera", "f = (" + number(task.camera.get_px(), 5) + ", " + number(task.camera.get_py(), 5) + ") px, centre (" +
                     number(task.camera.get_u0(), 5) + ", " + number(task.camera.get_v0(), 5) + ") px, " +
                     std::to_string(task.width) + "x" + std::to_string(task.height) + " px, no distortion"},
      {"Object", fixed(1000. * task.objectWidth, 1) + " x " + fixed(1000. * task.objectHeight, 1) + " mm, " +
                     std::to_string(task.pointCount) +
                     " feature points; how soon it leaves the view depends on this size, which "
                     "the thesis does not give"},
      {"Photo (real)", plan.target.file + ", used at " + std::to_string(plan.target.photo.getWidth()) + "x" +
                           std::to_string(plan.target.photo.getHeight()) + " px, grey" +
                           (plan.target.remark.empty() ? "" : ". " + plan.target.remark)},
      {"Rendered views for measure image", "grey noise " + number(faults.noise, 3) + ", blur " +
                                               number(faults.blur, 3) + " px, gain " + number(faults.gain, 3) +
                                               ", bias " + number(faults.bias, 3) + ", occlusion " +
                                               number(faults.occlusion, 3) + "; ideal on plants without pixel noise"},
      {"Gains, the same for every law",
       "lambda " + number(gains.lambda, 4) + " 1/s, rotation factor " + number(gains.rotation, 4) + ", kappa " +
           number(gains.kappa, 4) + ", saturation " + number(gains.saturation, 4) + " rad, integral " +
           number(gains.integral, 4) + " 1/s^2 up to " + number(gains.integralLimit, 4) +
           " rad/s; laws with -rot2 and ff-lookat have twice the rotation gain built in"},
      {"Seed", plan.repetitions == 1
                   ? std::to_string(plan.seed)
                   : std::to_string(plan.seed) + " to " + std::to_string(plan.seed + plan.repetitions - 1) +
                         "; figures, videos and logs show the first, any other is repeated with --seed"},
      {"Program", "visp-servo-compare " + vpApp::versionText()},
      {"Command line", parts.commandLine},
      {"Wall time", fixed(parts.wallTime, 0) + " s"},
  };
  if (plan.arm) {
    facts.emplace_back("Robot", plan.arm->model.label() + ": " + sentenceOf(*plan.arm));
  }
  facts.insert(facts.end(), rest.begin(), rest.end());
  page.facts(facts, "Rotations are theta u; frames as in ViSP: z along the optical axis, x right, y down.");

  HtmlTable plants;
  plants.header = {{HtmlCell("plant"), HtmlCell("loop Hz"), HtmlCell("vision Hz"), HtmlCell("latency ms"),
                    HtmlCell("noise px"), HtmlCell("lag ms"), HtmlCell("friction rad/s"), HtmlCell("limit m/s"),
                    HtmlCell("limit rad/s")}};
  for (const vpServoPlant &p : plan.scenario.plants) {
    plants.rows.push_back({HtmlCell(p.name), HtmlCell(number(p.loopRate, 4)), HtmlCell(number(p.visionRate, 4)),
                           HtmlCell(number(1000. * p.latency, 4)), HtmlCell(number(p.pixelNoise, 4)),
                           HtmlCell(number(1000. * p.lag, 4)), HtmlCell(number(p.deadband, 4)),
                           HtmlCell(number(p.maxLinear, 4)), HtmlCell(number(p.maxAngular, 4))});
  }
  page.table(plants, plan.arm
                         ? "The plants. On an arm lag and friction come from its joints: friction 0.1 stands for "
                           "that of the arm's file, 0.2 for twice that. Limits scale the whole twist."
                         : "The plants. Friction is seen as a velocity that each rotation axis loses. Limits scale "
                           "the whole twist.");
  page.paragraph(
      "Beside this page: summary.json (all figures of all runs), log/ (one CSV file for each run), figure/ (the "
      "drawings as SVG), video/ (the films).");
}
} // namespace

std::string reportPage(const Plan &plan, const Results &results, const ReportParts &parts, vpApp::OutputFolder &out)
{
  HtmlReport page("Visual servoing laws compared", "visp-servo-compare " + vpApp::versionText() + ": " +
                                                       plural(plan.laws.size(), "law") + " on task " +
                                                       plan.scenario.task.name);
  writeAnswer(page, plan, results);
  writeWhat(page, plan, results);
  writeTables(page, plan, results);
  writeFigures(page, parts);
  if (plan.arm) {
    writeArm(page, plan, results, parts.armFigures);
  }
  if (parts.step) {
    writeStep(page, plan, results, *parts.step);
  }
  writeFilm(page, plan, parts, out);
  writeParameters(page, plan, parts);
  return page.html();
}
} // namespace servoCompare
