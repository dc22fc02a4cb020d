/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Small URDFs for tests, made of pieces. VP_URDF_TEST, the name of the test program, begins the names of their files.
#ifndef vpUrdfTestKit_h
#define vpUrdfTestKit_h

#include "vpArmTestKit.h"
#include "vpTestFile.h"

#include <visp3/core/vpException.h>

#include <functional>

namespace vpUrdfTestKit
{
using namespace vpArmTestKit;

//! A file of a test program, which may run beside others.
struct File : vpTestSupport::File {
  File(const std::string &name, const std::string &content)
    : vpTestSupport::File(std::string(VP_URDF_TEST) + "-" + name, content)
  {}
};

inline std::string joint(const std::string &name, const std::string &type, const std::string &parent,
                         const std::string &child, const std::string &rest = "")
{
  return "<joint name='" + name + "' type='" + type + "'><parent link='" + parent + "'/><child link='" + child + "'/>" +
         rest + "</joint>\n";
}

inline std::string limit(const std::string &fields) { return "<axis xyz='0 0 1'/><limit " + fields + "/>"; }

inline const std::string good = limit("lower='-1' upper='2' velocity='3' effort='4'");
inline const std::string ball = "<collision><geometry><sphere radius='0.1'/></geometry></collision>";
inline const std::string mass =
    "<inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial>";

inline std::string link(const std::string &name, const std::string &content = ball)
{
  return "<link name='" + name + "'>" + content + "</link>\n";
}

//! Two links with the given joint between them, and anything else.
inline std::string twoLinks(const std::string &ofJoint, const std::string &more = "",
                            const std::string &type = "revolute")
{
  return "<robot name='r'>" + link("base") + link("arm") + joint("j", type, "base", "arm", ofJoint) + more + "</robot>";
}

inline vpArmModel load(const std::string &urdf, vpArmUrdfSpec spec = {})
{
  const File file("own.urdf", urdf);
  return vpLoadArmUrdf(file.name(), spec);
}

inline std::string errorOf(const std::function<void()> &action)
{
  try {
    action();
  }
  catch (const vpException &e) {
    return e.getStringMessage();
  }
  return "no error";
}

inline std::string errorOf(const std::string &urdf, const vpArmUrdfSpec &spec = {})
{
  return errorOf([&] { static_cast<void>(load(urdf, spec)); });
}

using Sentences = std::vector<std::string>;

inline vpArmUrdfSpec toTip(const std::string &tip)
{
  vpArmUrdfSpec spec;
  spec.tip = tip;
  return spec;
}
} // namespace vpUrdfTestKit
#endif
