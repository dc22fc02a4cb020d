/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "contacts.h"

#include <visp3/avoidance/vpExactChecker.h>
#include <visp3/avoidance/vpExactShapes.h>
#include <visp3/core/vpException.h>

#include <algorithm>

namespace armProgram
{
namespace
{
//! The arm with two of its bodies only, which are then neighbours.
vpArmModel onlyBodies(const vpArmModel &arm, int first, int second)
{
  vpArmSpec spec = arm.spec();
  const auto isOther = [&](const auto &part) { return part.body != first && part.body != second; };
  spec.capsules.erase(std::remove_if(spec.capsules.begin(), spec.capsules.end(), isOther), spec.capsules.end());
  spec.shapes.erase(std::remove_if(spec.shapes.begin(), spec.shapes.end(), isOther), spec.shapes.end());
  spec.uncovered.clear();
  spec.allowedBodies.clear();
  return vpArmModel(spec);
}

//! \brief Decides pairs whose capsules touch.
class Decision
{
public:
  Decision(const vpArmModel &arm, const vpJointVector &q) : m_arm(&arm), m_q(q) {}

  //! False if the exact shapes of two bodies, or of one body and an object, do not touch.
  [[nodiscard]] bool touches(int first, int second, const vpCollisionObject *object = nullptr) const
  {
    if (first < 0 || second < 0) {
      return true;
    }
    try {
      const vpArmModel arm = onlyBodies(*m_arm, first, second);
      vpCollisionSceneSpec spec;
      spec.allowAdjacent = false;
      spec.exact = std::make_shared<const vpExactShapes>(arm);
      if (object != nullptr) {
        spec.objects = {*object};
      }
      const vpCollisionScene scene(arm, spec);
      return vpExactChecker(scene).inCollision(m_q, 0.);
    }
    catch (const vpException &) { // without FCL, or a mesh that cannot be read: capsules decide
      return true;
    }
  }

private:
  const vpArmModel *m_arm;
  vpJointVector m_q;
};
} // namespace

std::string linkName(const vpArmModel &arm, int link)
{
  return link == 0                  ? "base"
         : arm.spec().links.empty() ? "link " + std::to_string(link)
                                    : arm.spec().links[static_cast<std::size_t>(link - 1)].name;
}

std::string bodyOf(const vpArmModel &arm, int capsule)
{
  const vpArmCapsule &c = arm.spec().capsules[static_cast<std::size_t>(capsule)];
  return c.body >= 0 ? arm.spec().bodies[static_cast<std::size_t>(c.body)].name : linkName(arm, c.link);
}

std::set<Names> touchesAt(const vpCollisionScene &scene, const vpJointVector &q)
{
  const vpArmModel &arm = scene.arm();
  const Decision decision(arm, q);
  vpCollisionData data;
  scene.place(q, data);
  std::set<Names> touches, decided;
  const auto body = [&](int capsule) { return arm.spec().capsules[static_cast<std::size_t>(capsule)].body; };
  const auto add = [&](const Names &names, double distance, const auto &touching) {
    if (!(distance > 0.) && decided.insert(names).second && touching()) {
      touches.insert(names);
    }
  };
  for (const vpSelfPair &pair : scene.selfPairs()) {
    add({bodyOf(arm, pair.first), bodyOf(arm, pair.second)}, scene.selfPair(data, pair.first, pair.second).distance,
        [&] { return decision.touches(body(pair.first), body(pair.second)); });
  }
  for (int i = 0; i < scene.capsuleCount(); ++i) {
    for (int j = 0; j < scene.objectCount(); ++j) {
      if (scene.isChecked(i, j)) {
        add({bodyOf(arm, i), scene.object(j).name}, scene.pair(data, i, j).distance,
            [&] { return decision.touches(body(i), body(i), &scene.object(j)); });
      }
    }
    if (scene.ground() && scene.isCheckedWithGround(i)) {
      add({bodyOf(arm, i), "ground"}, scene.groundPair(data, i).distance, [] { return true; });
    }
  }
  return touches;
}
} // namespace armProgram
