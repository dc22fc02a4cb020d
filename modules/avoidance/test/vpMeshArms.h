/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Public arms with meshes: covered by capsules, with their exact shapes, in random scenes.
#ifndef vpMeshArms_h
#define vpMeshArms_h

#include "vpAvoidanceTestKit.h"
#include "vpCaseFile.h"
#include "vpCatch.h"

#include <visp3/avoidance/vpArmCover.h>
#include <visp3/avoidance/vpExactShapes.h>

#include <filesystem>
#include <map>
#include <memory>

namespace vpMeshArms
{
using namespace vpAvoidanceTestKit;

struct Robot {
  const char *name, *urdf, *srdf, *base, *tip;
};
inline const Robot panda = {"panda", "panda_description/urdf/panda.urdf", "panda_description/srdf/panda.srdf",
                            "panda_link0", "panda_hand"};
inline const Robot ur5 = {"ur5", "ur_description/urdf/ur5_robot.urdf", "ur_description/srdf/ur5.srdf", "base_link",
                          "ee_link"};
inline const Robot tiago = {"tiago", "tiago_description/robots/tiago_no_hand.urdf", "", "torso_lift_link",
                            "arm_tool_link"};

inline std::string fileOf(const std::string &name)
{
  return vpTestSupport::caseFile("example-robot-data/robots/" + name);
}

// The robot with three capsules a body, and its exact shapes; nothing where the public files are missing.
struct Loaded {
  std::unique_ptr<vpArmModel> arm;
  std::shared_ptr<const vpExactShapes> exact;
};

inline Loaded read(const Robot &robot, double gap, int capsules)
{
  Loaded loaded;
  const std::string file = fileOf(robot.urdf);
  if (!file.empty()) {
    vpArmUrdfSpec spec;
    spec.base = robot.base;
    spec.tip = robot.tip;
    spec.srdf = *robot.srdf == '\0' ? "" : fileOf(robot.srdf);
    spec.holdOthers = robot.urdf == tiago.urdf; // head, torso and wheels
    if (robot.urdf == panda.urdf) {
      spec.held = {{"panda_finger_joint1", gap}, {"panda_finger_joint2", gap}};
    }
    spec.acceleration = 10.;
    spec.packagePaths = {vpTestSupport::caseFile("")};
    vpArmCoverSpec cover;
    cover.capsules = capsules;
    cover.cacheFile =
        (std::filesystem::temp_directory_path() / ("catchExactArms-covers-" + std::to_string(capsules) + ".json"))
            .string();
    loaded.arm = std::make_unique<vpArmModel>(vpCoverArm(vpLoadArmUrdf(file, spec), cover).arm);
    loaded.exact = std::make_shared<vpExactShapes>(*loaded.arm);
    CHECK(loaded.exact->warnings().empty());
  }
  return loaded;
}

inline const Loaded &load(const Robot &robot)
{
  static std::map<std::string, Loaded> known;
  const auto found = known.find(robot.name);
  return found != known.end() ? found->second : known.emplace(robot.name, read(robot, 0., 3)).first->second;
}

inline vpCollisionSceneSpec sceneOf(const Loaded &robot, std::mt19937_64 &rng, int objects)
{
  vpCollisionSceneSpec spec = randomScene(rng, objects, 1.);
  for (vpCollisionObject &object : spec.objects) {
    object.inflation = 0.;
    object.pose.p += 0.3 * object.pose.p.normalized();
  }
  spec.ignoredBodies = robot.arm->spec().uncovered;
  spec.exact = robot.exact;
  return spec;
}
} // namespace vpMeshArms
#endif
