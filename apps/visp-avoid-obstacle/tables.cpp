/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "tables.h"

#include "numberText.h"

#include <cmath>

namespace avoidObstacle
{
namespace
{
constexpr int DIGITS = 7;

//! One row, cell by cell.
class Row
{
public:
  Row &operator<<(double value) { return add(std::isfinite(value) ? vpApp::number(value, DIGITS) : ""); }
  Row &operator<<(const Eigen::Vector3d &p) { return *this << p.x() << p.y() << p.z(); }
  Row &operator<<(const vpJointVector &q)
  {
    for (Eigen::Index i = 0; i < q.size(); ++i) {
      *this << q(i);
    }
    return *this;
  }
  Row &operator<<(bool value) { return add(value ? "1" : "0"); }
  Row &operator<<(int value) { return add(std::to_string(value)); }
  Row &operator<<(const char *word) { return add(word); }
  Row &operator<<(const std::string &text)
  {
    std::string quoted = "\"";
    for (const char c : text) {
      quoted += c == '"' ? "\"\"" : std::string(1, c);
    }
    return add(quoted + "\"");
  }
  [[nodiscard]] std::string line() const { return m_text + "\n"; }

private:
  Row &add(const std::string &cell)
  {
    m_text += m_begun ? "," + cell : cell;
    m_begun = true;
    return *this;
  }
  std::string m_text;
  bool m_begun = false;
};
} // namespace

std::string samplesCsv(const vpAvoidanceRun &run)
{
  std::string csv = "time_s";
  for (const char *group : {"q_", "commanded_", "command_"}) {
    for (const vpArmJointSpec &joint : run.spec.arm->spec().joints) {
      csv += std::string(",") + group + joint.name;
    }
  }
  csv += ",tool_x_m,tool_y_m,tool_z_m,wanted_x_m,wanted_y_m,wanted_z_m,goal_x_m,goal_y_m,goal_z_m,goal_distance_m,"
         "clearance_m,nearest,status,stopping,new_image,look_ms\n";
  for (const vpAvoidanceSample &s : run.samples) {
    Row row;
    row << s.time << s.q << s.commanded << s.command << s.tool << s.wanted << s.goal << s.goalDistance
        << s.clearance.distance << s.nearest << vpToString(s.status) << s.stopping << s.newImage << 1000. * s.lookTime;
    csv += row.line();
  }
  return csv;
}

std::string tracksCsv(const SensorLog &sensorLog)
{
  std::string csv = "time_s,object,status,resting,x_m,y_m,z_m,velocity_x_mps,velocity_y_mps,velocity_z_mps,"
                    "position_sigma_m,velocity_sigma_mps,inflation_m,confidence,age_s,sightings,restarts,error_m\n";
  for (const TrackRow &r : sensorLog.tracks) {
    const vpObjectTrack &t = r.track;
    Row row;
    row << r.time << t.name << vpToString(t.status) << t.resting << t.pose.p
        << Eigen::Vector3d(t.velocity[0], t.velocity[1], t.velocity[2]) << t.positionSigma << t.velocitySigma
        << t.inflation << t.confidence << t.age << t.sightings << t.restarts << r.error;
    csv += row.line();
  }
  return csv;
}

std::string framesCsv(const SensorLog &sensorLog)
{
  std::string csv = "time_s,covered,object,seen,error_m,angle_error_rad,sigma_m,sentence\n";
  for (const Frame &frame : sensorLog.frames) {
    for (const Sight &s : frame.sights) {
      Row row;
      row << frame.time << frame.covered << s.object << s.seen << (s.seen ? s.error : NAN)
          << (s.seen ? s.angleError : NAN) << (s.seen ? s.sigma : NAN) << s.message;
      csv += row.line();
    }
  }
  return csv;
}
} // namespace avoidObstacle
