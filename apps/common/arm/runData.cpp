/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "runData.h"

#include "numberText.h"
#include "viewData.h"

#include <visp3/manipulator/vpArmKinematics.h>

#include <cmath>

namespace vpApp
{
using Json = nlohmann::ordered_json;

namespace
{
constexpr int DIGITS = 7;
constexpr double TRACK_STEP = 0.05; // s

//! Tool positions at the commanded configurations, m.
std::vector<Eigen::Vector3d> commandedWay(const vpAvoidanceRun &run)
{
  std::vector<Eigen::Vector3d> way;
  vpArmData data;
  for (const vpAvoidanceSample &s : run.samples) {
    vpArmKinematics::forward(*run.spec.arm, s.commanded, data);
    way.push_back(data.tool.p);
  }
  return way;
}

//! Places of an obstacle over time.
Json trackOf(const vpMovingObstacle &obstacle, double end)
{
  Json times = Json::array(), places = Json::array();
  const int steps = static_cast<int>(std::ceil(end / TRACK_STEP));
  for (int i = 0; i <= steps; ++i) {
    vpRigidTransform pose;
    vpTwist unused;
    const double t = i * TRACK_STEP;
    obstacle.stateAt(t, pose, unused);
    times.push_back(t);
    places.push_back({pose.p.x(), pose.p.y(), pose.p.z()});
  }
  return {{"t", times}, {"p", places}};
}
} // namespace

CsvRow &CsvRow::operator<<(double value) { return add(std::isfinite(value) ? number(value, DIGITS) : ""); }

CsvRow &CsvRow::operator<<(const vpJointVector &q)
{
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    *this << q(i);
  }
  return *this;
}

CsvRow &CsvRow::operator<<(const std::string &text)
{
  std::string quoted = "\"";
  for (const char c : text) {
    quoted += c == '"' ? "\"\"" : std::string(1, c);
  }
  return add(quoted + "\"");
}

CsvRow &CsvRow::add(const std::string &cell)
{
  m_text += m_begun ? "," + cell : cell;
  m_begun = true;
  return *this;
}

Rates ratesOf(const std::vector<Eigen::Vector3d> &places, double period)
{
  Rates rates;
  Eigen::Vector3d before = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Eigen::Vector3d v = i == 0 ? before : Eigen::Vector3d((places[i] - places[i - 1]) / period);
    rates.speed.push_back(v.norm());
    rates.acceleration.push_back((v - before).norm() / period);
    before = v;
  }
  return rates;
}

std::string samplesCsv(const vpAvoidanceRun &run)
{
  std::string csv = "time_s";
  for (const char *group : {"q_", "commanded_", "command_"}) {
    for (const vpArmJointSpec &joint : run.spec.arm->spec().joints) {
      csv += std::string(",") + group + joint.name;
    }
  }
  csv += ",tool_x_m,tool_y_m,tool_z_m,wanted_x_m,wanted_y_m,wanted_z_m,goal_x_m,goal_y_m,goal_z_m,goal_distance_m,"
         "clearance_m,nearest,status,stopping,new_image,commanded_speed_mps,commanded_acceleration_mps2,look_ms\n";
  const Rates rates = ratesOf(commandedWay(run), run.spec.methodSpec.period);
  for (std::size_t i = 0; i < run.samples.size(); ++i) {
    const vpAvoidanceSample &s = run.samples[i];
    CsvRow row;
    row << s.time << s.q << s.commanded << s.command << s.tool << s.wanted << s.goal << s.goalDistance
        << s.clearance.distance << s.nearest << vpToString(s.status) << s.stopping << s.newImage << rates.speed[i]
        << rates.acceleration[i] << 1000. * s.lookTime;
    csv += row.line();
  }
  return csv;
}

Json metricsJson(const vpAvoidanceMetrics &m)
{
  return {{"success", m.success},
          {"min_clearance_m", m.min_clearance_m},
          {"goal_error_m", m.goal_error_m},
          {"duration_s", m.duration_s},
          {"peak_v", m.peak_v},
          {"peak_a", m.peak_a},
          {"peak_jerk", m.peak_jerk},
          {"jerk_integral", m.jerk_integral},
          {"path_length", m.path_length},
          {"replan_ms_p50", m.replan_ms_p50},
          {"replan_ms_p95", m.replan_ms_p95},
          {"replan_ms_p99", m.replan_ms_p99},
          {"stops", m.stops},
          {"false_stops", m.false_stops},
          {"collisions_moving", m.collisions_moving},
          {"collisions_standing", m.collisions_standing},
          {"joint_v_violations", m.joint_v_violations},
          {"joint_a_violations", m.joint_a_violations},
          {"tool_v_violations", m.tool_v_violations},
          {"tool_a_violations", m.tool_a_violations},
          {"status", m.status}};
}

Json sceneData(OutputFolder &out, const vpAvoidanceRunSpec &spec, double end, const std::string &mesh)
{
  Json objects = Json::array();
  const auto add = [&](const vpCollisionObject &object, bool known) {
    objects.push_back(objectData(out, object, mesh + std::to_string(objects.size())));
    objects.back()["known"] = known;
  };
  for (const vpCollisionObject &object : spec.scene.objects) {
    add(object, true);
  }
  for (const vpMovingObstacle &obstacle : spec.obstacles) {
    add(obstacle.object, false);
    Json &json = objects.back();
    json["there_s"] = {obstacle.appears, std::isfinite(obstacle.vanishes) ? Json(obstacle.vanishes) : Json(nullptr)};
    if (obstacle.object.velocity.linearNorm() > 0.) {
      json["track"] = trackOf(obstacle, end);
    }
  }
  const auto &ground = spec.scene.ground;
  const bool isLevel = ground && ground->normal.normalized().z() > 0.999;
  return {{"ground", isLevel ? Json(ground->offset) : Json(nullptr)}, {"objects", objects}};
}
} // namespace vpApp
