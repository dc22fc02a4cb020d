/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "selfPairs.h"

#include "appMain.h"
#include "numberText.h"

#include <visp3/avoidance/vpExactShapes.h>
#include <visp3/avoidance/vpSelfCollisionStatistics.h>
#include <visp3/core/vpException.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <set>

namespace vpApp
{
namespace
{
namespace fs = std::filesystem;
constexpr int SAMPLES = 10000;
constexpr int CAPSULE_SAMPLES = 1000; // of the capsules alone

//! \brief FNV-1a over everything that decides contacts.
class Fingerprint
{
public:
  void add(double value)
  {
    std::uint64_t bits;
    std::memcpy(&bits, &value, sizeof(bits));
    for (int i = 0; i < 64; i += 8) {
      addByte(static_cast<unsigned char>(bits >> i));
    }
  }
  void add(const std::string &text)
  {
    std::for_each(text.begin(), text.end(), [this](char c) { addByte(static_cast<unsigned char>(c)); });
    addByte(0);
  }
  template <class Matrix> void addAll(const Matrix &matrix)
  {
    for (Eigen::Index i = 0; i < matrix.size(); ++i) {
      add(matrix.data()[i]);
    }
  }
  void add(const vpRigidTransform &pose)
  {
    addAll(pose.R);
    addAll(pose.p);
  }
  [[nodiscard]] std::string text() const
  {
    char digits[17];
    std::snprintf(digits, sizeof(digits), "%016llx", static_cast<unsigned long long>(m_hash));
    return digits;
  }

private:
  void addByte(unsigned char byte) { m_hash = (m_hash ^ byte) * 0x100000001b3ULL; }
  std::uint64_t m_hash = 0xcbf29ce484222325ULL;
};

//! A mesh file is known by its name and by the capsules, which were fitted to its content.
std::string fingerprintOf(const vpArmSpec &arm)
{
  Fingerprint print;
  for (const vpArmJointSpec &joint : arm.joints) {
    print.add(static_cast<double>(joint.type));
    print.add(joint.before);
    print.add(joint.after);
    for (const double value : {joint.offset, joint.lower, joint.upper}) {
      print.add(value);
    }
  }
  for (const vpArmFollower &follower : arm.followers) {
    print.add(static_cast<double>(follower.type));
    print.add(follower.before);
    print.add(follower.after);
    for (const double value : {1. * follower.joint, follower.ratio, follower.offset, 1. * follower.place}) {
      print.add(value);
    }
  }
  for (const vpArmBody &body : arm.bodies) {
    print.add(body.name);
    print.add(static_cast<double>(body.link));
  }
  for (const vpArmCapsule &capsule : arm.capsules) {
    print.addAll(capsule.from);
    print.addAll(capsule.to);
    print.add(capsule.radius);
    print.add(static_cast<double>(capsule.body));
  }
  for (const vpArmShape &shape : arm.shapes) {
    print.add(static_cast<double>(shape.kind));
    print.addAll(shape.size);
    print.add(shape.pose);
    print.add(shape.file);
  }
  return print.text();
}

std::shared_ptr<const vpExactShapes> exactShapesOf(const vpArmModel &arm)
{
  try {
    return arm.spec().shapes.empty() ? nullptr : std::make_shared<const vpExactShapes>(arm);
  }
  catch (const vpException &) { // without FCL
    return nullptr;
  }
}

vpSelfCollisionStatistics statisticsOf(const vpArmModel &arm, const std::shared_ptr<const vpExactShapes> &exact,
                                       const fs::path &folder, std::vector<std::string> &warnings)
{
  const fs::path file = folder / (fileName(arm.spec().name) + "." + fingerprintOf(arm.spec()) + ".pairs.json");
  std::error_code ignored;
  if (!folder.empty() && fs::exists(file, ignored)) {
    return vpSelfCollisionStatistics::load(file.string());
  }
  vpSelfCollisionStatistics statistics = vpSampleBodyPairs(arm, exact, SAMPLES);
  try {
    if (!folder.empty()) {
      statistics.save(file.string());
    }
  }
  catch (const vpException &error) {
    warnings.push_back(sentenceOf(error));
  }
  return statistics;
}
} // namespace

vpSelfCollisionStatistics capsuleContacts(const vpArmModel &arm, double clearance)
{
  vpArmSpec grown = arm.spec();
  for (vpArmCapsule &capsule : grown.capsules) {
    capsule.radius += 0.5 * clearance;
  }
  vpSelfCollisionStatistics statistics = vpSampleBodyPairs(vpArmModel(grown), nullptr, CAPSULE_SAMPLES);
  std::set<std::pair<std::string, std::string>> allowed;
  for (const auto &[first, second] : arm.spec().allowedBodies) {
    allowed.insert({first, second});
    allowed.insert({second, first});
  }
  std::vector<vpBodyPairStatistics> &pairs = statistics.pairs;
  pairs.erase(std::remove_if(pairs.begin(), pairs.end(),
                             [&allowed](const vpBodyPairStatistics &pair) {
                               return allowed.count({pair.first, pair.second}) > 0;
                             }),
              pairs.end());
  return statistics;
}

SelfPairs findSelfPairs(const vpArmModel &arm, const std::filesystem::path &folder)
{
  SelfPairs pairs;
  const std::shared_ptr<const vpExactShapes> exact = exactShapesOf(arm);
  if (exact == nullptr) {
    return pairs;
  }
  const vpSelfCollisionStatistics capsules = capsuleContacts(arm, keptClearance);
  const auto isNear = [](const vpBodyPairStatistics &pair) { return pair.touching > 0; };
  if (std::none_of(capsules.pairs.begin(), capsules.pairs.end(), isNear)) {
    return pairs;
  }
  const vpSelfCollisionStatistics shapes = statisticsOf(arm, exact, folder, pairs.warnings);
  std::vector<std::string> always, never, meant;
  for (const vpBodyPairStatistics &pair : shapes.pairs) {
    const auto found = std::find_if(capsules.pairs.begin(), capsules.pairs.end(), [&pair](const auto &other) {
      return other.first == pair.first && other.second == pair.second;
    });
    if (found == capsules.pairs.end() || !isNear(*found)) {
      continue;
    }
    const std::string names = pair.first + " - " + pair.second;
    const vpContactRule rule = shapes.rule(pair);
    if (rule == vpContactRule::Always) {
      always.push_back(names);
    }
    else if (pair.exact && pair.touching == 0) {
      never.push_back(names);
    }
    else if (pair.exact && rule == vpContactRule::Default && capsules.rule(*found) == vpContactRule::Always) {
      meant.push_back(names + " (in " + number(100. * pair.touching / shapes.samples, 2) + " %)");
    }
    else {
      continue;
    }
    pairs.allowed.emplace_back(pair.first, pair.second);
  }
  const std::string samples = " of " + std::to_string(shapes.samples) + " random configurations: ";
  if (!always.empty()) {
    pairs.warnings.push_back("not checked, as the bodies touch in nearly all" + samples + enumerate(always));
  }
  if (!never.empty()) {
    pairs.warnings.push_back("not checked, as only the capsules come near, the bodies touch in none" + samples +
                             enumerate(never) + "; so they touch in less than " + number(300. / shapes.samples, 2) +
                             " % of all, with 95 % confidence");
  }
  if (!meant.empty()) {
    pairs.warnings.push_back("not checked, as the bodies touch where all joints are at 0 or the limit next to it, "
                             "which is taken as meant, and "
                             "their capsules are nearly always within " +
                             number(1000. * keptClearance, 2) + " mm, although they touch in some only" + samples +
                             enumerate(meant) + "; --srdf or --allowed-pairs decides otherwise");
  }
  return pairs;
}
} // namespace vpApp
