/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpUrdfText.h"

#include "vpFileText.h"
#include "vpXmlOutline.h"

#include <filesystem>
#include <set>

namespace
{
std::string suffixOf(const std::string &file)
{
  std::string suffix = std::filesystem::path(file).extension().string();
  for (char &c : suffix) {
    c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return suffix;
}

// Refuses a file that xacro has to expand. Old versions of xacro left calls of unknown macros in their output: these
// are told and left out; what they stood for is not in the file.
void refuseXacro(const std::vector<vpXmlElement> &elements, const std::string &file, vpWarningList &warnings)
{
  static const std::set<std::string> directives = {"include", "macro", "property",     "arg",     "if",
                                                   "unless",  "call",  "insert_block", "element", "attribute"};
  bool isXacro = suffixOf(file) == ".xacro";
  for (const vpXmlElement &element : elements) {
    if (element.name.compare(0, 6, "xacro:") == 0) {
      isXacro = isXacro || directives.count(element.name.substr(6)) > 0;
      warnings.add("calls of xacro macros that were never expanded are left out: ", element.name, "");
    }
    for (const auto &field : element.attributes) {
      isXacro = isXacro || field.second.find("${") != std::string::npos || field.second.find("$(") != std::string::npos;
    }
  }
  if (isXacro) {
    throw vpFileError(file + ": is written in xacro, expand it by the command: xacro " + file + " -o robot.urdf");
  }
}

// As the value of an attribute.
std::string encoded(const std::string &text)
{
  std::string value;
  for (const char c : text) {
    value += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '"' ? "&quot;" : std::string(1, c);
  }
  return value;
}

class Preparation
{
public:
  Preparation(const std::string &text, const std::string &file, vpWarningList &warnings)
    : m_elements(vpReadXmlOutline(text, file)), m_warnings(warnings)
  {
    refuseXacro(m_elements, file, warnings);
    m_out.text = text;
    if (m_elements.front().name == "robot") {
      name(file);
      for (std::size_t i = 1; i < m_elements.size(); ++i) {
        const vpXmlElement &element = m_elements[i];
        if (element.parent == 0 && (element.name == "link" || element.name == "joint")) {
          m_names.insert(attribute(element, "name"));
          if (element.name == "link") {
            m_links.push_back(attribute(element, "name"));
          }
        }
        else if (element.parent > 0 && parent(element).parent == 0 && parent(element).name == "joint") {
          partOfJoint(element, attribute(parent(element), "name"));
        }
      }
      roots();
    }
    for (auto piece = m_pieces.rbegin(); piece != m_pieces.rend(); ++piece) {
      m_out.text.insert(piece->first, piece->second);
    }
  }
  vpUrdfText take() { return std::move(m_out); }

private:
  static std::string attribute(const vpXmlElement &element, const std::string &field)
  {
    const auto found = element.attributes.find(field);
    return found == element.attributes.end() ? "" : found->second;
  }
  [[nodiscard]] const vpXmlElement &parent(const vpXmlElement &element) const
  {
    return m_elements[static_cast<std::size_t>(element.parent)];
  }
  void complete(const vpXmlElement &element, const char *field, const std::string &value)
  {
    if (element.attributes.count(field) == 0) {
      m_pieces[element.afterName] += std::string(" ") + field + "=\"" + encoded(value) + "\"";
    }
  }
  void name(const std::string &file)
  {
    const vpXmlElement &robot = m_elements.front();
    std::string stem = std::filesystem::path(file).stem().string();
    for (char &c : stem) {
      c = c == '%' ? '_' : c; // see vpReadXmlOutline()
    }
    complete(robot, "name", stem);
    if (robot.attributes.count("name") == 0) {
      m_warnings.add("the robot has no name, the file's is taken: ", stem, "");
    }
  }
  void partOfJoint(const vpXmlElement &element, const std::string &joint)
  {
    vpUrdfGiven &given = m_out.given[joint];
    if (element.name == "child") {
      m_children.insert(attribute(element, "link"));
    }
    else if (element.name == "limit") {
      given.lower = element.attributes.count("lower") > 0;
      given.upper = element.attributes.count("upper") > 0;
      complete(element, "effort", "0");
      complete(element, "velocity", "0");
    }
    else if (element.name == "safety_controller") {
      given.softLower = element.attributes.count("soft_lower_limit") > 0;
      given.softUpper = element.attributes.count("soft_upper_limit") > 0;
      complete(element, "k_velocity", "0");
    }
  }
  // A name that neither a link nor a joint has.
  std::string freeName(std::string name)
  {
    while (!m_names.insert(name).second) {
      name += "_";
    }
    return name;
  }
  void roots()
  {
    for (const std::string &link : m_links) {
      if (m_children.count(link) == 0) {
        m_out.roots.push_back(link);
      }
    }
    if (m_out.roots.size() < 2) {
      return;
    }
    m_out.joinedRoot = freeName("roots");
    std::string piece = "<link name=\"" + m_out.joinedRoot + "\"/>";
    for (const std::string &root : m_out.roots) {
      piece += "<joint name=\"" + freeName("above_" + std::to_string(m_names.size())) +
               R"(" type="fixed"><parent link=")" + m_out.joinedRoot + "\"/><child link=\"" + encoded(root) +
               "\"/></joint>";
    }
    m_pieces[m_elements[1].start] = piece;
  }

  std::vector<vpXmlElement> m_elements;
  vpWarningList &m_warnings;
  vpUrdfText m_out;
  std::map<std::size_t, std::string> m_pieces; // to be inserted, by position
  std::vector<std::string> m_links;
  std::set<std::string> m_children; // links below a joint
  std::set<std::string> m_names;
};
} // namespace

vpUrdfText vpPrepareUrdf(const std::string &text, const std::string &file, vpWarningList &warnings)
{
  return Preparation(text, file, warnings).take();
}
