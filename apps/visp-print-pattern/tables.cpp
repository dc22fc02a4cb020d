/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "tables.h"

#include "numberText.h"

#include <visp3/pattern/vpMicroscopeCalibration.h>

#include <cmath>
#include <locale>
#include <sstream>

namespace printPattern
{
namespace
{
using Json = nlohmann::ordered_json;

std::ostringstream table(const char *heading)
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(10);
  text << heading << "\n";
  return text;
}

//! Cells that never came to the nozzle.
int leftOf(const std::vector<vpPrintRun> &runs)
{
  int left = 0;
  for (const vpPrintRun &run : runs) {
    left += run.spec.rows * run.spec.cellsPerRow - run.metrics.printed - run.metrics.missed;
  }
  return left;
}

Json jsonOf(const Replica &replica, std::size_t number)
{
  const vpPrintExperimentSpec &spec = replica.runs.front().spec;
  Json json = {{"figure", replica.figure},
               {"name", replica.name},
               {"file", fileOf(replica, number)},
               {"frame_rate_hz", spec.frameRate},
               {"evaluate_from_frame", spec.evaluateFrom},
               {"mm_per_px", 1e-3 * spec.product.pixelSize},
               {"seeds", replica.runs.size()},
               {"rms_velocity_error", replica.rms_velocity_error}};
  if (replica.thesis > 0.) {
    json["thesis"] = replica.thesis;
    json["ratio"] = replica.rms_velocity_error / replica.thesis;
  }
  json["centre_velocity_error"] = replica.centre_velocity_error;
  return json;
}

Json jsonOf(const Identification &identification)
{
  const vpFrictionIdentification &found = identification.found;
  const auto value = [](double estimate, double sigma, double truth) {
    return Json{{"found", estimate}, {"sigma", sigma}, {"true", truth}};
  };
  const vpFrictionModel &truth = identification.truth;
  return {{"frames", identification.frames},
          {"message", found.message()},
          {"mass", value(found.model.mass, found.sigmaMass, truth.mass)},
          {"viscous", value(found.model.viscous, found.sigmaViscous, truth.viscous)},
          {"coulomb", value(found.model.coulomb, found.sigmaCoulomb, truth.coulomb)},
          {"stiction", value(found.model.stiction, found.sigmaStiction, truth.stiction)}};
}

Json jsonOf(const vpPrintExperimentSpec &spec, const std::string &sensor)
{
  return {{"controller", nameOf(spec.controller)},
          {"sensor", sensor},
          {"reference", nameOf(spec.reference.mode)},
          {"trigger", spec.trigger == vpPrintTriggerMethod::Horizon ? "horizon" : "thesis"},
          {"rows", spec.rows},
          {"cells_per_row", spec.cellsPerRow},
          {"drop_velocity_px_per_frame", spec.dropVelocity},
          {"pitch_px", {spec.product.pitchX, spec.product.pitchY}},
          {"flex_px", spec.product.flexAmplitudeX},
          {"flex_period_cells", spec.product.flexPeriodX},
          {"evaluate_from_frame", spec.evaluateFrom},
          {"jitter_px", spec.product.jitter},
          {"dust_per_view", spec.product.dust * 1.6},
          {"noise", spec.product.noise},
          {"vision_delay_frames", spec.visionDelay},
          {"travel_time_frames", spec.travelTime},
          {"dropped_frames", spec.dropped},
          {"frame_rate_hz", spec.frameRate},
          {"seed", spec.seed}};
}
} // namespace

std::string nameOf(vpPrintReferenceMode mode)
{
  switch (mode) {
  case vpPrintReferenceMode::FixedArrival:
    return "arrival";
  case vpPrintReferenceMode::LimitedVelocity:
    return "limited";
  case vpPrintReferenceMode::ConstantVelocity:
    return "constant";
  case vpPrintReferenceMode::CellVelocity:
    break;
  }
  return "centres";
}

std::string motionCsv(const vpPrintRun &run)
{
  std::ostringstream text =
      table("frame,row,x,y,vx,vy,reference_x,reference_vx,measured_vx,estimated_vx,force,cells,dropped");
  for (const vpPrintSample &s : run.samples) {
    text << s.frame << ',' << s.row << ',' << s.x << ',' << s.y << ',' << s.vx << ',' << s.vy << ','
         << s.referencePosition << ',' << s.referenceVelocity << ',' << s.measuredVelocity << ',' << s.estimatedVelocity
         << ',' << s.force << ',' << s.cells << ',' << (s.dropped ? 1 : 0) << "\n";
  }
  return text.str();
}

std::string dropsCsv(const vpPrintRun &run)
{
  std::ostringstream text = table("row,column,fire_frame,land_frame,error_x_um,error_y_um,vx,late");
  for (const vpPrintDrop &d : run.drops) {
    text << d.row << ',' << d.column << ',' << d.fireTime << ',' << d.landTime << ',' << d.errorX << ',' << d.errorY
         << ',' << d.velocity << ',' << (d.late ? 1 : 0) << "\n";
  }
  return text.str();
}

std::string landingCsv(const Landing &landing)
{
  std::ostringstream text = table("error_um");
  for (const double error : landing.errors) {
    text << error << "\n";
  }
  return text.str();
}

std::string distortionCsv()
{
  constexpr double pixel = 4.5, reference = 200.; // um; px, where the share is meant
  std::ostringstream text = table("distance_px,mismatch_1_px,mismatch_0.5_px,mismatch_0.2_px,mismatch_0.1_px");
  vpMicroscopeCalibration microscope;
  microscope.scaleX = microscope.scaleY = 1e6 / pixel;
  for (double r = 0.; r <= reference; r += 4.) {
    text << r;
    for (const double share : {0.01, 0.005, 0.002, 0.001}) {
      microscope.kappa1 = share / (reference * reference);
      text << ',' << microscope.toPlane(r, 0.)[0] * microscope.scaleX - r;
    }
    text << "\n";
  }
  return text.str();
}

std::string fileOf(const Replica &replica, std::size_t number)
{
  return "thesis/" + (replica.figure.empty() ? "run-" + std::to_string(number + 1) : "figure-" + replica.figure) +
         ".csv";
}

std::vector<std::string> findings(const Results &results)
{
  const std::vector<vpPrintRun> &runs = results.runs;
  const Landing &landing = results.landing;
  const int printed = sumOf(runs, &vpPrintMetrics::printed), left = leftOf(runs);
  std::vector<std::string> lines = {std::to_string(printed) + (printed == 1 ? " cell" : " cells") + " printed, " +
                                    std::to_string(sumOf(runs, &vpPrintMetrics::missed)) + " missed, " +
                                    std::to_string(sumOf(runs, &vpPrintMetrics::doubled)) + " printed twice."};
  if (!landing.errors.empty()) {
    const std::size_t drops = landing.errors.size();
    lines.push_back("Drops land " + vpApp::number(landing.p50, 3) + " um from the centre (median), 99 % within " +
                    vpApp::number(landing.p99, 3) + " um, the worst " + vpApp::number(landing.max, 3) + " um off; " +
                    std::to_string(std::lround(landing.within * static_cast<double>(drops))) + " of " +
                    std::to_string(drops) + " are within the tolerance of 10 um.");
  }
  if (left > 0) {
    lines.push_back(std::to_string(left) + (left == 1 ? " cell" : " cells") +
                    " never came to the nozzle: the run was ended by --frames, or the controller stopped short of the "
                    "last cell.");
  }
  const double gain = meanOf(runs, &vpPrintMetrics::gain_over_constant);
  lines.push_back(vpApp::number(meanOf(runs, &vpPrintMetrics::throughput_cells_per_s), 3) + " cells a second, " +
                  vpApp::number(100. * std::fabs(gain), 3) + (gain >= 0. ? " % faster" : " % slower") +
                  " between the cells of a row than at the constant velocity at which the drops fall.");
  return lines;
}

Json summaryOf(const Options &options, const Results &results, const std::string &commandLine, double wallTime)
{
  const std::vector<vpPrintRun> &runs = results.runs;
  bool complete = true;
  for (const vpPrintRun &run : runs) {
    complete = complete && run.metrics.complete;
  }
  Json summary = {
      {"version", VISP_DIRECT_VERSION},
      {"command", commandLine},
      {"runs", runs.size()},
      {"rms_velocity_error", rmsOf(runs, &vpPrintMetrics::rms_velocity_error)},
      {"rms_true_velocity_error", rmsOf(runs, &vpPrintMetrics::rms_true_velocity_error)},
      {"centre_velocity_error", rmsOf(runs, &vpPrintMetrics::centre_velocity_error)},
      {"landing_error_um", {{"p50", results.landing.p50}, {"p99", results.landing.p99}, {"max", results.landing.max}}},
      {"landed_within_10um", results.landing.within},
      {"printed", sumOf(runs, &vpPrintMetrics::printed)},
      {"missed", sumOf(runs, &vpPrintMetrics::missed)},
      {"doubled", sumOf(runs, &vpPrintMetrics::doubled)},
      {"left", leftOf(runs)},
      {"throughput_cells_per_s", meanOf(runs, &vpPrintMetrics::throughput_cells_per_s)},
      {"gain_over_constant", meanOf(runs, &vpPrintMetrics::gain_over_constant)},
      {"complete", complete},
      {"spec", jsonOf(options.spec, options.sensor)}};
  if (results.identification) {
    summary["identification"] = jsonOf(*results.identification);
  }
  Json replicas = Json::array();
  for (const auto *list : {&results.replicas, &results.observers}) {
    for (const Replica &replica : *list) {
      replicas.push_back(jsonOf(replica, replicas.size()));
    }
  }
  if (!replicas.empty()) {
    summary["thesis"] = replicas;
  }
  summary["findings"] = findings(results);
  summary["wall_time_s"] = wallTime;
  return summary;
}
} // namespace printPattern
