/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/manipulator/vpSrdf.h>

#include "vpNumberText.h"
#include "vpReading.h"
#include "vpXmlOutline.h"

BEGIN_VISP_NAMESPACE

namespace
{
class Reader
{
public:
  explicit Reader(const std::string &file)
    : m_file(file), m_text(vpReadFileText(file)), m_elements(vpReadXmlOutline(m_text, file))
  {
    if (m_elements.front().name != "robot") {
      fail(m_elements.front(), "is element " + m_elements.front().name + ", must be robot");
    }
    m_srdf.robot = optional(m_elements.front(), "name");
    for (const vpXmlElement &element : m_elements) {
      if (element.parent == 0) {
        top(element);
      }
      else if (element.parent > 0 && m_elements[static_cast<std::size_t>(element.parent)].parent == 0) {
        inside(element, m_elements[static_cast<std::size_t>(element.parent)].name);
      }
    }
  }
  vpSrdf take() { return std::move(m_srdf); }

private:
  [[noreturn]] void fail(const vpXmlElement &element, const std::string &what) const
  {
    throw vpFileError(m_file + ": " + vpLineAndColumn(m_text, element.start) + ": " + what);
  }
  static std::string optional(const vpXmlElement &element, const char *field)
  {
    const auto found = element.attributes.find(field);
    return found == element.attributes.end() ? "" : found->second;
  }
  [[nodiscard]] std::string required(const vpXmlElement &element, const char *field) const
  {
    const std::string text = optional(element, field);
    if (text.empty()) {
      fail(element, "element " + element.name + " has no " + field);
    }
    return text;
  }
  void top(const vpXmlElement &element)
  {
    if (element.name == "group") {
      m_srdf.groups.emplace_back();
      m_srdf.groups.back().name = required(element, "name");
    }
    else if (element.name == "group_state") {
      m_srdf.states.push_back({required(element, "name"), optional(element, "group"), {}});
    }
    else if (element.name == "disable_collisions") {
      m_srdf.disabled.push_back({required(element, "link1"), required(element, "link2"), optional(element, "reason")});
    }
  }
  // Elements come in the order of the file, so these belong to the last group or state.
  void inside(const vpXmlElement &element, const std::string &parent)
  {
    if (parent == "group") {
      vpSrdfGroup &group = m_srdf.groups.back();
      if (element.name == "chain") {
        group.chains.emplace_back(required(element, "base_link"), required(element, "tip_link"));
      }
      else if (element.name == "link" || element.name == "joint" || element.name == "group") {
        std::vector<std::string> &list = element.name == "link"    ? group.links
                                         : element.name == "joint" ? group.joints
                                                                   : group.groups;
        list.push_back(required(element, "name"));
      }
    }
    else if (parent == "group_state" && element.name == "joint") {
      const std::string joint = required(element, "name"), text = required(element, "value");
      const std::optional<std::vector<double>> values = vpNumbersOf(text);
      if (!values || values->empty()) {
        fail(element, "value of joint " + joint + " is " + vpPrintable(text, 60) + ", must be a finite number");
      }
      if (values->size() == 1) {
        m_srdf.states.back().joints[joint] = values->front();
      }
    }
  }

  const std::string &m_file;
  std::string m_text;
  std::vector<vpXmlElement> m_elements;
  vpSrdf m_srdf;
};
} // namespace

vpSrdf vpLoadSrdf(const std::string &file)
{
  return vpReading([&] { return Reader(file).take(); });
}

END_VISP_NAMESPACE
