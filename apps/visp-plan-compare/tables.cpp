/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "tables.h"

#include "numberText.h"

namespace planCompare
{
namespace
{
constexpr int DIGITS = 7;

void cell(std::string &row, double value)
{
  row += ',';
  row += vpApp::number(value, DIGITS);
}

void place(std::string &row, const Eigen::Vector3d &p)
{
  for (int i = 0; i < 3; ++i) {
    cell(row, p(i));
  }
}

std::string quoted(const std::string &text)
{
  std::string result = "\"";
  for (const char c : text) {
    result += c == '"' ? "\"\"" : std::string(1, c);
  }
  return result + "\"";
}
} // namespace

std::string runsCsv(const Results &results)
{
  std::string csv = "scene,variant,seed,method,success,min_clearance_m,goal_error_m,duration_s,peak_v,peak_a,peak_jerk,"
                    "jerk_integral,path_length,replan_ms_p50,replan_ms_p95,replan_ms_p99,plan_ms,stops,false_stops,"
                    "collisions_moving,collisions_standing,joint_v_violations,joint_a_violations,tool_v_violations,"
                    "tool_a_violations,status\n";
  for (const Record &r : results.records) {
    const vpAvoidanceMetrics &m = r.metrics;
    std::string row = quoted(r.scene) + "," + quoted(r.variant) + "," + std::to_string(r.seed) + "," + r.method;
    for (const double value :
         {m.success ? 1. : 0., m.min_clearance_m, m.goal_error_m, m.duration_s, m.peak_v, m.peak_a, m.peak_jerk,
          m.jerk_integral, m.path_length, m.replan_ms_p50, m.replan_ms_p95, m.replan_ms_p99, 1000. * r.planTime}) {
      cell(row, value);
    }
    for (const int value : {m.stops, m.false_stops, m.collisions_moving, m.collisions_standing, m.joint_v_violations,
                            m.joint_a_violations, m.tool_v_violations, m.tool_a_violations}) {
      row += "," + std::to_string(value);
    }
    csv += row + "," + quoted(m.status) + "\n";
  }
  return csv;
}

std::string logCsv(const vpAvoidanceRun &run)
{
  std::string csv = "time_s";
  for (const char *group : {"q_", "command_"}) {
    for (const vpArmJointSpec &joint : run.spec.arm->spec().joints) {
      csv += std::string(",") + group + joint.name;
    }
  }
  csv += ",tool_x_m,tool_y_m,tool_z_m,wanted_x_m,wanted_y_m,wanted_z_m,goal_x_m,goal_y_m,goal_z_m,goal_distance_m,"
         "clearance_m,nearest,status,stopping,new_image,look_ms\n";
  for (const vpAvoidanceSample &s : run.samples) {
    std::string row = vpApp::number(s.time, DIGITS);
    for (const vpJointVector *joints : {&s.q, &s.command}) {
      for (Eigen::Index i = 0; i < joints->size(); ++i) {
        cell(row, (*joints)(i));
      }
    }
    place(row, s.tool);
    place(row, s.wanted);
    place(row, s.goal);
    cell(row, s.goalDistance);
    cell(row, s.clearance.distance);
    row += "," + quoted(s.nearest) + "," + vpToString(s.status) + (s.stopping ? ",1" : ",0") + (s.newImage ? ",1" : ",0");
    cell(row, 1000. * s.lookTime);
    csv += row + "\n";
  }
  return csv;
}

std::string logName(const std::string &scene, const std::string &method)
{
  return "log/" + vpApp::fileName(scene) + "-" + vpApp::fileName(method) + ".csv";
}
} // namespace planCompare
