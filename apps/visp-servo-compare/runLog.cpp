/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "runLog.h"

#include "catalogue.h"
#include "format.h"

#include "viewData.h"

#include <visp3/core/vpMath.h>
#include <visp3/core/vpPoseVector.h>
#include <visp3/manipulator/vpArmKinematics.h>
#include <visp3/manipulator/vpTwistAxes.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>

namespace servoCompare
{
namespace
{
constexpr const char *HEADER =
    "time_s,segment,tx_m,ty_m,tz_m,tux_rad,tuy_rad,tuz_rad,"
    "commanded_vx_mps,commanded_vy_mps,commanded_vz_mps,commanded_wx_radps,commanded_wy_radps,commanded_wz_radps,"
    "actual_vx_mps,actual_vy_mps,actual_vz_mps,actual_wx_radps,actual_wy_radps,actual_wz_radps,"
    "reference_yaw_rad,goal_yaw_rad,yaw_rad,rotation_error_rad,translation_error_m,"
    "u_px,v_px,image_error_u_px,image_error_v_px,image_error_px,in_view,measured,new_frame,status";

void append(std::string &csv, double value)
{
  char text[32];
  std::snprintf(text, sizeof(text), "%.7g,", value);
  csv += text;
}

//! Columns of the arm, if there is one: the joints at the end of the cycle.
std::string armHeader(const vpServoRun &run)
{
  std::string header;
  if (!run.arm.empty()) {
    for (const char *quantity : {"q", "wanted", "velocity", "command", "torque"}) {
      for (const vpArmJointSpec &joint : run.spec.arm->model.spec().joints) {
        header += std::string(",") + quantity + "_" + fileName(joint.name);
      }
    }
    header += ",limit_margin,manipulability,self_motion_radps,arm_status";
  }
  return header;
}

void appendArm(std::string &csv, const vpArmSample &s)
{
  csv += ',';
  for (const vpJointVector *joints : {&s.q, &s.wanted, &s.velocity, &s.command, &s.torque}) {
    for (Eigen::Index i = 0; i < joints->size(); ++i) {
      append(csv, (*joints)(i));
    }
  }
  append(csv, s.limitMargin);
  append(csv, s.manipulability);
  append(csv, s.selfMotion);
  csv += vpToString(s.status);
}

using Json = nlohmann::ordered_json;

Json jsonOf(const vpHomogeneousMatrix &M)
{
  const vpPoseVector pose(M);
  return {{"position_m", {pose[0], pose[1], pose[2]}},
          {"rotation_deg", {vpMath::deg(pose[3]), vpMath::deg(pose[4]), vpMath::deg(pose[5])}}};
}

Json jsonOf(const vpServoGains &gains)
{
  return {{"lambda", gains.lambda},     {"rotation", gains.rotation},
          {"kappa", gains.kappa},       {"saturation_rad", gains.saturation},
          {"integral", gains.integral}, {"integral_limit_radps", gains.integralLimit}};
}

Json jsonOf(const vpServoPlant &plant)
{
  return {{"name", plant.name},
          {"loop_rate_hz", plant.loopRate},
          {"vision_rate_hz", plant.visionRate},
          {"latency_s", plant.latency},
          {"pixel_noise_px", plant.pixelNoise},
          {"lag_s", plant.lag},
          {"deadband_radps", plant.deadband},
          {"max_linear_mps", plant.maxLinear},
          {"max_angular_radps", plant.maxAngular}};
}

Json jsonOf(const vpCameraFaults &faults)
{
  return {{"noise", faults.noise},
          {"blur_px", faults.blur},
          {"gain", faults.gain},
          {"bias", faults.bias},
          {"occlusion", faults.occlusion}};
}

Json jsonOf(const vpTwistShaperLimits &limits)
{
  return {{"linear_acceleration_mps2", limits.linearAcceleration},
          {"linear_jerk_mps3", limits.linearJerk},
          {"angular_acceleration_radps2", limits.angularAcceleration},
          {"angular_jerk_radps3", limits.angularJerk}};
}

Json jsonOf(const vpServoTask &task)
{
  Json segments = Json::array();
  for (const vpServoSegment &segment : task.segments) {
    Json item = jsonOf(segment.cdMo);
    item["name"] = segment.name;
    item["duration_s"] = segment.duration;
    segments.push_back(item);
  }
  return {{"name", task.name},
          {"camera",
           {{"px", task.camera.get_px()},
            {"py", task.camera.get_py()},
            {"u0", task.camera.get_u0()},
            {"v0", task.camera.get_v0()},
            {"width", task.width},
            {"height", task.height}}},
          {"object", {{"width_m", task.objectWidth}, {"height_m", task.objectHeight}, {"points", task.pointCount}}},
          {"start", jsonOf(task.initial)},
          {"segments", segments}};
}

Json jsonOf(const vpJointVector &joints) { return std::vector<double>(joints.data(), joints.data() + joints.size()); }

Json jsonOf(const vpArmModel &model, const vpArmMetrics &m)
{
  Json item = {{"joint_rms", jsonOf(m.joint_rms)},
               {"peak_velocity_share", m.peak_velocity_share},
               {"peak_acceleration_share", m.peak_acceleration_share},
               {"least_manipulability", m.least_manipulability},
               {"self_motion_rad", m.self_motion_rad},
               {"limited_s", m.limited_s},
               {"blocked_s", m.blocked_s},
               {"saturated_s", m.saturated_s},
               {"status", m.status}};
  if (m.least_margin_joint >= 0) {
    item["least_limit_margin"] = m.least_limit_margin;
    item["least_margin_joint"] = model.spec().joints[static_cast<std::size_t>(m.least_margin_joint)].name;
  }
  if (m.shortfall.joint >= 0) {
    item["missing_torque"] = m.shortfall.missing();
    item["missing_torque_joint"] = model.spec().joints[static_cast<std::size_t>(m.shortfall.joint)].name;
  }
  return item;
}

Json jsonOf(const vpServoArm &arm)
{
  Json joints = Json::array();
  for (const vpArmJointSpec &joint : arm.model.spec().joints) {
    joints.push_back(joint.name);
  }
  vpArmData data;
  vpArmKinematics::forward(arm.model, arm.spec.start, data);
  return {{"name", arm.model.spec().name},
          {"sentence", sentenceOf(arm)},
          {"file", arm.model.spec().source},
          {"joints", joints},
          {"start", jsonOf(arm.spec.start)},
          {"camera_at_start", vpApp::rowsOf(vpArmKinematics::camera(arm.model, data))},
          {"limits", arm.spec.redundancy.policy == vpLimitPolicy::StopJoints ? "stop" : "scale"},
          {"drive", arm.spec.drives.reference == vpDriveReference::Measured ? "measured" : "integrated"},
          {"free_axes", vpAxesInWords(arm.spec.free)}};
}

Json jsonOf(const Plan &plan, const vpServoRun &run)
{
  const vpServoMetrics &m = run.metrics;
  Json item = {{"law", run.spec.law},
               {"plant", run.spec.plant.name},
               {"measure", run.spec.measure},
               {"seed", run.spec.seed},
               {"shaped", run.spec.shape.has_value()},
               {"max_image_error_px", m.max_image_error_px},
               {"rms_image_error_px", m.rms_image_error_px},
               {"end_rotation_deg", m.end_rotation_deg},
               {"end_translation_mm", m.end_translation_mm},
               {"expected_end_rotation_deg", m.expected_end_rotation_deg},
               {"expected_end_translation_mm", m.expected_end_translation_mm},
               {"left_end_rotation_deg", m.left_end_rotation_deg},
               {"left_end_translation_mm", m.left_end_translation_mm},
               {"yaw_range_deg", m.yaw_range_deg},
               {"ideal_yaw_range_deg", m.ideal_yaw_range_deg},
               {"out_of_view_s", m.out_of_view_s},
               {"settle_s", m.settle_s},
               {"path_length_m", m.path_length_m},
               {"peak_linear_mps", m.peak_linear_mps},
               {"peak_angular_radps", m.peak_angular_radps},
               {"peak_linear_acceleration_mps2", m.peak_linear_acceleration_mps2},
               {"peak_angular_acceleration_radps2", m.peak_angular_acceleration_radps2},
               {"peak_linear_jerk_mps3", m.peak_linear_jerk_mps3},
               {"peak_angular_jerk_radps3", m.peak_angular_jerk_radps3},
               {"rms_linear_jerk_mps3", m.rms_linear_jerk_mps3},
               {"rms_angular_jerk_radps3", m.rms_angular_jerk_radps3},
               {"bounds_exceeded_cycles", m.bounds_exceeded_cycles},
               {"view_losses", m.view_losses},
               {"deadlock_cycles", m.deadlock_cycles},
               {"status", m.status},
               {"gains", jsonOf(run.spec.gains)},
               {"plant_parameters", jsonOf(run.spec.plant)}};
  if (run.spec.measure == "image") {
    item["image_faults"] = jsonOf(run.spec.faults);
  }
  if (run.spec.shape) {
    item["shape"] = jsonOf(*run.spec.shape);
  }
  if (run.armMetrics) {
    item["arm"] = jsonOf(run.spec.arm->model, *run.armMetrics);
  }
  if (run.spec.seed == plan.seed) {
    item["log"] = logName(run.spec);
  }
  return item;
}
} // namespace

std::string logName(const vpServoRunSpec &spec)
{
  return "log/" +
         fileName(spec.law + "-" + spec.plant.name + "-" + spec.measure + "-seed" + std::to_string(spec.seed) +
                  (spec.shape ? "-shaped" : "")) +
         ".csv";
}

std::string csvOf(const vpServoRun &run)
{
  std::string csv = HEADER + armHeader(run) + "\n";
  csv.reserve((run.arm.empty() ? 320 : 800) * (run.samples.size() + 1));
  for (std::size_t row = 0; row < run.samples.size(); ++row) {
    const vpServoSample &s = run.samples[row];
    append(csv, s.time);
    csv += fileName(run.spec.task.segments[s.segment].name) + ",";
    const vpPoseVector pose(s.wMc);
    for (unsigned int i = 0; i < 6; ++i) {
      append(csv, pose[i]);
    }
    for (const vpTwist *twist : {&s.commanded, &s.actual}) {
      for (std::size_t i = 0; i < 6; ++i) {
        append(csv, (*twist)[i]);
      }
    }
    for (const double value : {s.referenceYaw, s.goalYaw, s.yaw, s.rotationError, s.translationError, s.u, s.v,
                               s.imageErrorU, s.imageErrorV, std::hypot(s.imageErrorU, s.imageErrorV)}) {
      append(csv, value);
    }
    csv += s.inView ? "1," : "0,";
    csv += s.measured ? "1," : "0,";
    csv += s.newFrame ? "1," : "0,";
    csv += vpToString(s.status);
    if (row < run.arm.size()) {
      appendArm(csv, run.arm[row]);
    }
    csv += '\n';
  }
  return csv;
}

Json summaryOf(const Plan &plan, const Results &results, const Making &making)
{
  const Scenario &scenario = plan.scenario;
  Json runs = Json::array(), laws = Json::array(), plants = Json::array(), videos = Json::array();
  for (const vpServoRun &run : results.runs()) {
    runs.push_back(jsonOf(plan, run));
  }
  for (const std::string &law : plan.laws) {
    laws.push_back({{"id", law}, {"sentence", sentenceOf(law)}});
  }
  for (const vpServoPlant &plant : scenario.plants) {
    plants.push_back(jsonOf(plant));
    plants.back()["sentence"] = sentenceOf(plant, plan.arm != nullptr);
  }
  for (const ReplayVideo &video : making.videos) {
    videos.push_back(
        {{"law", video.law}, {"file", video.file}, {"speed_up", video.speedUp}, {"for_browsers", video.forBrowsers}});
  }
  Json summary = {{"program", "visp-servo-compare"},
                  {"version", VISP_DIRECT_VERSION},
                  {"visp_version", std::to_string(VISP_VERSION_MAJOR) + "." + std::to_string(VISP_VERSION_MINOR) + "." +
                                       std::to_string(VISP_VERSION_PATCH)},
                  {"command_line", making.commandLine},
                  {"wall_time_s", making.wallTime},
                  {"data", "simulated robots; the target is a photograph, its views are rendered"},
                  {"target", plan.target.file},
                  {"target_remark", plan.target.remark},
                  {"description", scenario.description},
                  {"seed", plan.seed},
                  {"repetitions", plan.repetitions},
                  {"task", jsonOf(scenario.task)},
                  {"gains", jsonOf(scenario.gains)},
                  {"image_faults", jsonOf(scenario.faults)},
                  {"laws", laws},
                  {"plants", plants},
                  {"runs", runs},
                  {"film_strip", {{"laws", making.strip.laws}, {"times_s", making.strip.times}}},
                  {"videos", videos}};
  if (plan.shaped) {
    summary["shape"] = jsonOf(scenario.shape);
  }
  if (plan.arm) {
    summary["robot"] = jsonOf(*plan.arm);
  }
  return summary;
}
} // namespace servoCompare
