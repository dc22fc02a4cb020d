/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "runLog.h"

#include "format.h"

#include <visp3/core/vpPoseVector.h>

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
} // namespace servoCompare
