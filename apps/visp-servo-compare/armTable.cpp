/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "armTable.h"

#include "format.h"

#include <visp3/core/vpMath.h>

#include <cmath>

namespace servoCompare
{
namespace
{
using vpApp::HtmlCell;
using vpApp::HtmlTable;

constexpr double THESIS_JOINT_RMS[] = {6.4, 8.6, 5.2, 12.5, 8.2, 8.5, 6.4}; // mrad, table 8.1

std::string marginText(const vpArmModel &model, const vpArmMetrics &m)
{
  if (m.least_margin_joint < 0) {
    return "no limits";
  }
  const bool slides = model.isPrismatic(m.least_margin_joint);
  const double margin = std::max(0., m.least_limit_margin);
  return (slides ? fixed(1000. * margin, 1) + " mm" : fixed(vpMath::deg(margin), 1)) + " (" +
         model.spec().joints[static_cast<std::size_t>(m.least_margin_joint)].name + ")";
}
} // namespace

HtmlTable armTable(const Plan &plan, const Results &results)
{
  HtmlTable table;
  table.header = {{HtmlCell("law", "left"), HtmlCell("plant"), HtmlCell("limit margin deg"), HtmlCell("speed %"),
                   HtmlCell("acceleration %"), HtmlCell("worst joint rms mrad"), HtmlCell("least manipulability"),
                   HtmlCell("self-motion rad"), HtmlCell("slowed s"), HtmlCell("blocked s"),
                   HtmlCell("status", "left")}};
  for (const vpServoPlant &plant : plan.scenario.plants) {
    for (const std::string &law : plan.laws) {
      const vpServoRun *run = results.find(law, plant.name, plan.mainMeasure());
      if (run == nullptr || !run->armMetrics) {
        continue;
      }
      const vpArmMetrics &m = *run->armMetrics;
      table.rows.push_back(
          {HtmlCell(law, "left"), HtmlCell(plant.name), HtmlCell(marginText(plan.arm->model, m)),
           HtmlCell(fixed(100. * m.peak_velocity_share, 0)), HtmlCell(fixed(100. * m.peak_acceleration_share, 0)),
           HtmlCell(fixed(1000. * m.joint_rms.maxCoeff(), 2)), HtmlCell(fixed(m.least_manipulability, 4)),
           HtmlCell(fixed(m.self_motion_rad, 2)), HtmlCell(fixed(m.limited_s, 2)), HtmlCell(fixed(m.blocked_s, 2)),
           HtmlCell(m.status, "left wrap")});
    }
  }
  return table;
}

HtmlTable jointErrorTable(const Plan &plan, const Results &results, const std::string &law)
{
  const vpArmModel &model = plan.arm->model;
  HtmlTable table;
  HtmlTable::Row header{HtmlCell("joint rms mrad", "left")};
  for (const vpArmJointSpec &joint : model.spec().joints) {
    header.emplace_back(joint.name);
  }
  table.header = {header};
  if (model.spec().name == "AMOR" && model.size() == 7) {
    HtmlTable::Row thesis{HtmlCell("thesis, table 8.1", "left")};
    for (const double rms : THESIS_JOINT_RMS) {
      thesis.emplace_back(fixed(rms, 1));
    }
    table.rows.push_back(thesis);
  }
  for (const vpServoPlant &plant : plan.scenario.plants) {
    const vpServoRun *run = results.find(law, plant.name, plan.mainMeasure());
    if (run == nullptr || !run->armMetrics) {
      continue;
    }
    HtmlTable::Row row{HtmlCell("plant " + plant.name + ", " + law, "left")};
    for (int i = 0; i < model.size(); ++i) {
      row.emplace_back(fixed(1000. * run->armMetrics->joint_rms(i), 2));
    }
    table.rows.push_back(row);
  }
  return table;
}
} // namespace servoCompare
