/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpSceneCheck.h"

#include "vpPlausible.h"
#include "vpPrintable.h"

#include <visp3/avoidance/vpExactShapes.h>
#include <visp3/core/vpException.h>

#include <algorithm>
#include <cmath>
#include <sstream>

BEGIN_VISP_NAMESPACE

namespace
{
std::size_t at(int i) { return static_cast<std::size_t>(i); }

std::string text(double value)
{
  std::ostringstream out;
  out << value;
  return out.str();
}

constexpr double fastest = 1e3; // m/s or rad/s: largest plausible object velocity

void checkCapsules(const vpArmModel &arm, const std::string &source)
{
  const std::size_t count = arm.spec().capsules.size();
  if (count == 0 || count > at(vpArmMaxCapsules)) {
    vpSceneFail(source, arm.label() + " has " + std::to_string(count) + " capsules, must have 1 to " +
                            std::to_string(vpArmMaxCapsules));
  }
}

void checkGround(const vpHalfSpace &ground, const std::string &source)
{
  const double length = ground.normal.norm();
  if (!std::isfinite(length) || !(length > 0.)) {
    vpSceneFail(source, "ground has no normal");
  }
  if (!(std::fabs(ground.offset) <= vpLargestLength)) {
    vpSceneFail(source, "offset of the ground is " + text(ground.offset) + " m, must be within " +
                            text(vpLargestLength) + " m");
  }
}

// A body that no check sees must be ignored by name.
void checkBodies(const vpArmModel &arm, const vpCollisionSceneSpec &spec)
{
  const std::vector<std::string> &uncovered = arm.spec().uncovered;
  const auto has = [](const std::vector<std::string> &names, const std::string &name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  for (const std::string &body : uncovered) {
    if (!has(spec.ignoredBodies, body)) {
      vpSceneFail(spec.source,
                  "body " + body + " of " + arm.label() +
                      " has a shape that no capsule covers and no check would see; cover it or ignore it by name");
    }
  }
  for (const std::string &body : spec.ignoredBodies) {
    if (!has(uncovered, body)) {
      vpSceneFail(spec.source, "ignored body " + body + " is not one of the uncovered bodies of " + arm.label());
    }
  }
}

void checkLinks(const vpArmModel &arm, const vpCollisionSceneSpec &spec)
{
  const auto inRange = [&arm](int link, int low) { return link >= low && link <= arm.links(); };
  const std::string range = std::to_string(arm.links());
  for (const auto &pair : spec.allowedLinks) {
    if (!inRange(pair.first, 0) || !inRange(pair.second, 0) || pair.first == pair.second) {
      vpSceneFail(spec.source, "allowed pair of links " + std::to_string(pair.first) + " and " +
                                   std::to_string(pair.second) + ", must be two of 0 to " + range);
    }
  }
  for (const vpAllowedContact &contact : spec.allowedContacts) {
    if (!inRange(contact.link, 1)) {
      vpSceneFail(spec.source, "allowed contact of object " + contact.object + " with link " +
                                   std::to_string(contact.link) + ", must be 1 to " + range);
    }
  }
  if (spec.ground && !inRange(spec.ground->firstLink, 1)) {
    vpSceneFail(spec.source,
                "first link of the ground is " + std::to_string(spec.ground->firstLink) + ", must be 1 to " + range);
  }
}

} // namespace

void vpSceneFail(const std::string &source, const std::string &sentence)
{
  // Names may come from a file.
  throw vpException(vpException::badValue, vpPrintable((source.empty() ? "scene" : source) + ": " + sentence));
}

// Written such that NaN is rejected, here and below.
bool vpIsPlausible(const vpTwist &velocity) noexcept
{
  return std::all_of(velocity.data(), velocity.data() + 6, [](double v) { return std::fabs(v) <= fastest; });
}

bool vpIsLength(double value) noexcept { return value >= 0. && value <= vpLargestLength; }

void vpCheckObject(const std::string &source, const vpCollisionObject &object)
{
  if (object.name.empty()) {
    vpSceneFail(source, "an object has no name");
  }
  if (!vpIsRigid(object.pose)) {
    vpSceneFail(source, "pose of object " + object.name + " is not a rotation and a finite translation");
  }
  if (!vpIsPlace(object.pose)) {
    vpSceneFail(source, "object " + object.name + " is " + text(object.pose.p.cwiseAbs().maxCoeff()) +
                            " m away, must be within " + text(vpLargestLength) + " m");
  }
  if (!vpIsPlausible(object.velocity)) {
    vpSceneFail(source,
                "velocity of object " + object.name + " is not finite or above " + text(fastest) + " m/s or rad/s");
  }
  if (!vpIsLength(object.inflation)) {
    vpSceneFail(source, "inflation of object " + object.name + " is " + text(object.inflation) + " m, must be 0 to " +
                            text(vpLargestLength));
  }
}

void vpCheckArm(const vpArmModel &arm, const vpCollisionSceneSpec &spec)
{
  checkCapsules(arm, spec.source);
  checkBodies(arm, spec);
  checkLinks(arm, spec);
  if (spec.exact && !spec.exact->isOf(arm)) {
    vpSceneFail(spec.source, "the exact shapes were made for another arm than " + arm.label());
  }
  if (spec.ground) {
    checkGround(*spec.ground, spec.source);
  }
}

END_VISP_NAMESPACE
