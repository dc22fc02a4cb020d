/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "page.h"

#include "numberText.h"
#include "robot.h"
#include "viewData.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace armProgram
{
namespace
{
using Json = nlohmann::ordered_json;
using Row = std::vector<std::string>;
using vpApp::nameOf;

std::string limitText(double value) { return std::isfinite(value) ? vpApp::number(value, 4) : "unknown"; }

//! Columns aligned, two spaces between them.
std::string table(const std::vector<Row> &rows)
{
  std::vector<std::size_t> widths;
  for (const Row &row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i < row.size(); ++i) {
      widths[i] = std::max(widths[i], row[i].size());
    }
  }
  std::string text;
  for (const Row &row : rows) {
    std::string line = " ";
    for (std::size_t i = 0; i < row.size(); ++i) {
      line += " " + row[i] + std::string(widths[i] - row[i].size() + 1, ' ');
    }
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

double massOf(const vpArmModel &arm)
{
  double mass = 0.;
  for (const vpArmLinkSpec &link : arm.spec().links) {
    mass += link.mass;
  }
  return mass;
}

//! Where a frame is that is not at the end.
//! \param link : Of the tool or the camera; -1: it is at the end.
std::string carrierText(const vpArmModel &arm, const std::string &what, int link)
{
  if (link < 0) {
    return "";
  }
  const std::vector<std::string> behind = vpApp::jointsBehind(arm, link);
  return "  the " + what + " is on link " + std::to_string(link) +
         (behind.empty() ? "" : "; not moved by " + vpApp::enumerate(behind)) + "\n";
}

std::string jointTable(const vpArmModel &arm, const Description &description)
{
  std::vector<Row> rows = {
      {"joint", "type", "lower", "upper", "from", "velocity", "from", "acceleration", "from", "torque", "home"}};
  for (std::size_t i = 0; i < arm.spec().joints.size(); ++i) {
    const vpArmJointSpec &joint = arm.spec().joints[i];
    const LimitSource &from = description.sources[i];
    const bool bounded = joint.type != vpJointType::Continuous;
    rows.push_back({joint.name, nameOf(joint.type), bounded ? vpApp::number(joint.lower, 4) : "-",
                    bounded ? vpApp::number(joint.upper, 4) : "-", from.position, limitText(joint.velocity),
                    from.velocity, limitText(joint.acceleration), from.acceleration, limitText(joint.torque),
                    vpApp::number(arm.home()(static_cast<int>(i)), 4)});
  }
  std::string text = "Joints (rad or m, and s, Nm or N)\n" + table(rows);
  for (const vpArmFollower &follower : arm.spec().followers) {
    text += "  " + follower.name + " follows: " + vpApp::number(follower.ratio, 4) + " times " +
            arm.spec().joints[static_cast<std::size_t>(follower.joint)].name + " plus " +
            vpApp::number(follower.offset, 4) + "\n";
  }
  return text + carrierText(arm, "tool", arm.spec().toolLink) + carrierText(arm, "camera", arm.spec().cameraLink);
}

std::string massText(const vpArmModel &arm, int link)
{
  if (link == 0 || arm.spec().links.empty()) {
    return "-";
  }
  const vpArmLinkSpec &spec = arm.spec().links[static_cast<std::size_t>(link - 1)];
  return spec.hasMass ? vpApp::number(spec.mass, 4) + " kg" : "unknown";
}

std::string linkTable(const vpArmModel &arm, const Description &description)
{
  std::vector<Row> rows = {
      {"body", "on link", "mass of link", "checked as", "capsules", "overhang", "of radius", "volume/hull"}};
  int before = -1;
  for (const Link &link : description.links) {
    Row row = {link.name, link.link == 0 ? "base" : std::to_string(link.link),
               link.link == before ? "" : massText(arm, link.link), link.geometry,
               link.covers > 0 ? std::to_string(link.covers) : ""};
    if (link.fit) {
      row.insert(row.end(),
                 {vpApp::fixed(1000. * link.fit->overhang, 1) + " mm",
                  vpApp::fixed(1000. * link.fit->radius, 1) + " mm", vpApp::fixed(link.fit->volumeRatio, 2)});
    }
    before = link.link;
    rows.push_back(row);
  }
  return "What collision checks see (cover: capsules; mesh: known, not covered; none: no shape is known)\n" +
         table(rows);
}

//! Wraps names to lines of at most 110 characters after an indented heading.
std::string wrapped(const std::string &heading, const std::vector<std::string> &names)
{
  constexpr std::size_t widest = 110;
  std::string text, line = "  " + heading + ":";
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string word = " " + names[i] + (i + 1 < names.size() ? "," : "");
    if (line.size() + word.size() > widest) {
      text += line + "\n";
      line = "     ";
    }
    line += word;
  }
  return text + line + "\n";
}

//! Checked pairs by body, the others by reason.
std::string pairText(const Description &description)
{
  std::map<std::string, std::vector<std::string>> checked, skipped;
  std::size_t count = 0;
  for (const Pair &pair : description.pairs) {
    if (pair.reason.empty()) {
      checked[pair.first].push_back(pair.second);
      ++count;
    }
    else {
      skipped[pair.reason].push_back(pair.first + " - " + pair.second);
    }
  }
  std::string text = std::to_string(count) + " pairs of bodies are checked against each other\n";
  for (const auto &[body, others] : checked) {
    text += wrapped(body, others);
  }
  text += std::to_string(description.pairs.size() - count) + " pairs are not\n";
  for (const auto &[reason, pairs] : skipped) {
    text += wrapped(reason, pairs);
  }
  return text;
}

std::string listText(const std::string &heading, const std::vector<std::string> &sentences)
{
  std::string text = sentences.empty() ? "" : heading + "\n";
  for (const std::string &sentence : sentences) {
    text += "  " + sentence + "\n";
  }
  return text;
}

std::string poseText(const vpRigidTransform &pose)
{
  std::vector<Row> rows;
  for (int i = 0; i < 3; ++i) {
    Row row;
    for (int j = 0; j < 3; ++j) {
      row.push_back(vpApp::fixed(pose.R(i, j), 6));
    }
    row.push_back(vpApp::fixed(pose.p(i), 6));
    rows.push_back(row);
  }
  return "Tool in the base: rotation, position (m)\n" + table(rows);
}

std::string answerText(const Answers &answers)
{
  std::string text = answers.pose ? poseText(*answers.pose) : "";
  if (answers.touches) {
    std::vector<Row> rows;
    for (const auto &[first, second] : *answers.touches) {
      rows.push_back({first, second});
    }
    text += (rows.empty() ? "Nothing touches\n" : "Touching\n") + table(rows);
  }
  return text;
}

Json finite(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json jsonOf(const vpArmJointSpec &joint, const LimitSource &from, double home)
{
  const bool bounded = joint.type != vpJointType::Continuous;
  return {{"name", joint.name},
          {"type", nameOf(joint.type)},
          {"lower", bounded ? Json(joint.lower) : Json(nullptr)},
          {"upper", bounded ? Json(joint.upper) : Json(nullptr)},
          {"velocity", finite(joint.velocity)},
          {"acceleration", finite(joint.acceleration)},
          {"torque", finite(joint.torque)},
          {"home", home},
          {"from", {{"position", from.position}, {"velocity", from.velocity}, {"acceleration", from.acceleration}}}};
}

Json followersOf(const vpArmSpec &arm)
{
  Json list = Json::array();
  for (const vpArmFollower &follower : arm.followers) {
    list.push_back({{"name", follower.name},
                    {"type", nameOf(follower.type)},
                    {"follows", arm.joints[static_cast<std::size_t>(follower.joint)].name},
                    {"ratio", follower.ratio},
                    {"offset", follower.offset}});
  }
  return list;
}

Json jsonOf(const Link &link)
{
  Json json = {{"name", link.name}, {"link", link.link}, {"geometry", link.geometry}, {"covers", link.covers}};
  if (link.fit) {
    json["overhang_m"] = link.fit->overhang;
    json["radius_m"] = link.fit->radius;
    json["volume_ratio"] = link.fit->volumeRatio;
  }
  return json;
}

Json jsonOf(const std::set<Names> &pairs)
{
  Json list = Json::array();
  for (const auto &[first, second] : pairs) {
    list.push_back({first, second});
  }
  return list;
}
} // namespace

std::string textOf(const vpApp::Robot &robot, const Description &description, const Answers &answers)
{
  const vpArmModel &arm = *robot.arm;
  const auto n = static_cast<std::size_t>(arm.size());
  return arm.spec().name + ": " + std::to_string(n) + (n == 1 ? " joint" : " joints") + ", reach " +
         vpApp::fixed(description.reach, 2) + " m, " +
         (arm.hasMasses() ? "moving mass " + vpApp::number(massOf(arm), 4) + " kg" : "masses unknown") + "\n\n" +
         jointTable(arm, description) + "\n" + linkTable(arm, description) +
         (description.coverFile.empty() ? "" : "  capsules are kept in " + description.coverFile + "\n") + "\n" +
         pairText(description) + listText("\nWarnings", description.warnings) +
         listText("\nNot usable", description.problems) + (answers.pose || answers.touches ? "\n" : "") +
         answerText(answers);
}

nlohmann::ordered_json jsonOf(const vpApp::Robot &robot, const Description &description, const Answers &answers)
{
  const vpArmModel &arm = *robot.arm;
  Json joints = Json::array(), links = Json::array(), checked = Json::array(), skipped = Json::array();
  for (std::size_t i = 0; i < arm.spec().joints.size(); ++i) {
    joints.push_back(jsonOf(arm.spec().joints[i], description.sources[i], arm.home()(static_cast<int>(i))));
  }
  for (const Link &link : description.links) {
    links.push_back(jsonOf(link));
  }
  for (const Pair &pair : description.pairs) {
    if (pair.reason.empty()) {
      checked.push_back({pair.first, pair.second});
    }
    else {
      skipped.push_back({pair.first, pair.second, pair.reason});
    }
  }
  Json json = {{"name", arm.spec().name},
               {"joints", joints},
               {"followers", followersOf(arm.spec())},
               {"tool_link", arm.toolLink()},
               {"camera_link", arm.cameraLink()},
               {"links", links},
               {"checked_pairs", checked},
               {"skipped_pairs", skipped},
               {"reach_m", description.reach},
               {"mass_kg", arm.hasMasses() ? Json(massOf(arm)) : Json(nullptr)},
               {"cover_file", description.coverFile.empty() ? Json(nullptr) : Json(description.coverFile)},
               {"warnings", description.warnings},
               {"problems", description.problems}};
  if (answers.pose) {
    json["pose"] = vpApp::rowsOf(*answers.pose);
  }
  if (answers.touches) {
    json["touches"] = jsonOf(*answers.touches);
  }
  return json;
}

nlohmann::ordered_json jsonOf(const std::string &problem)
{
  return {{"joints", Json::array()}, {"links", Json::array()}, {"problems", {problem}}};
}
} // namespace armProgram
