/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/avoidance/vpArmCover.h>

#include "vpArmCoverCache.h"
#include "vpBodyMesh.h"
#include "vpFieldCheck.h"

#include <visp3/core/vpException.h>

#include <algorithm>

BEGIN_VISP_NAMESPACE

namespace
{
bool has(const std::vector<std::string> &names, const std::string &name)
{
  return std::find(names.begin(), names.end(), name) != names.end();
}

// Covers the bodies of one arm.
class Coverer
{
public:
  Coverer(const vpArmModel &arm, const vpArmCoverSpec &spec) : m_spec(spec), m_arm(arm.spec()), m_cache(spec.cacheFile)
  {
    vpFieldCheck("the covers of an arm")
        .require(spec.capsules >= 1 && spec.capsules <= 8, "capsules", spec.capsules, "1 to 8");
    for (const std::string &name : spec.ignored) {
      if (std::none_of(m_arm.bodies.begin(), m_arm.bodies.end(), [&](const vpArmBody &b) { return b.name == name; }) &&
          !has(m_arm.uncovered, name)) {
        throw vpException(vpException::badValue, "ignored body %s is no body of %s", name.c_str(), arm.label().c_str());
      }
    }
  }

  void cover(int body)
  {
    const std::string &name = m_arm.bodies[static_cast<std::size_t>(body)].name;
    if (has(m_spec.ignored, name)) {
      removeCapsules(body);
      leave(name);
      return;
    }
    if (std::none_of(m_arm.shapes.begin(), m_arm.shapes.end(),
                     [body](const vpArmShape &s) { return s.body == body; })) {
      return;
    }
    vpBodyMesh shapes;
    try {
      shapes = vpMakeBodyMesh(m_arm, body);
    }
    catch (const vpException &e) {
      m_warnings.push_back("body " + name + " stays uncovered: " + e.getStringMessage());
      leave(name);
      return;
    }
    take(body, shapes);
  }

  vpArmCover result()
  {
    const std::string unwritten = m_cache.save();
    if (!unwritten.empty()) {
      m_warnings.push_back(unwritten);
    }
    return {vpArmModel(m_arm), m_covers, m_warnings};
  }

private:
  void removeCapsules(int body)
  {
    auto &all = m_arm.capsules;
    all.erase(std::remove_if(all.begin(), all.end(), [body](const vpArmCapsule &c) { return c.body == body; }),
              all.end());
  }
  void leave(const std::string &name)
  {
    if (!has(m_arm.uncovered, name)) {
      m_arm.uncovered.push_back(name);
    }
  }
  void take(int body, const vpBodyMesh &shapes)
  {
    const vpArmBody &owner = m_arm.bodies[static_cast<std::size_t>(body)];
    vpBodyCover report;
    report.body = owner.name;
    report.link = owner.link;
    std::vector<vpArmCapsule> capsules = shapes.spheres;
    if (shapes.mesh) {
      const vpCapsuleCover fitted = coverOf(owner.name, *shapes.mesh, report);
      report.overhang = fitted.overhang;
      report.volumeRatio = fitted.volumeRatio;
      report.radius = fitted.radius;
      capsules.insert(capsules.end(), fitted.capsules.begin(), fitted.capsules.end());
    }
    else {
      for (const vpArmCapsule &c : shapes.spheres) {
        report.radius = std::max(report.radius, c.radius);
      }
    }
    report.count = static_cast<int>(capsules.size());
    removeCapsules(body);
    for (vpArmCapsule &c : capsules) {
      c.link = owner.link;
      c.body = body;
      m_arm.capsules.push_back(c);
    }
    auto &uncovered = m_arm.uncovered;
    uncovered.erase(std::remove(uncovered.begin(), uncovered.end(), owner.name), uncovered.end());
    m_covers.push_back(report);
  }

  vpCapsuleCover coverOf(const std::string &body, const vpTriangleMesh &mesh, vpBodyCover &report)
  {
    const std::string key = vpCoverKey(mesh, m_spec.capsules, m_spec.seed);
    const vpCachedCover *cached = m_cache.find(body);
    const bool edited = cached != nullptr && vpCapsulesKey(cached->cover.capsules) != cached->fitted;
    if (cached != nullptr && (edited || cached->unchecked || cached->key == key)) {
      report.fromCache = true;
      report.edited = edited;
      return verified(body, mesh, *cached, report);
    }
    vpCapsuleCoverSpec spec;
    spec.count = m_spec.capsules;
    spec.seed = m_spec.seed;
    vpCachedCover now;
    now.key = key;
    now.cover = vpFitCapsules(mesh, spec);
    now.fitted = vpCapsulesKey(now.cover.capsules);
    m_cache.set(body, now);
    return now.cover;
  }
  // What the file says about the cover may be of the capsules before they were edited.
  vpCapsuleCover verified(const std::string &body, const vpTriangleMesh &mesh, const vpCachedCover &cached,
                          vpBodyCover &report)
  {
    const vpCoverProof proof = vpProveCover(mesh, cached.cover.capsules);
    if (!proof.enclosed) {
      const std::string sentence =
          m_cache.file() + ": the capsules of body " + body + " do not certainly enclose it: " + proof.message;
      if (!cached.unchecked) {
        throw vpException(vpException::badValue, sentence);
      }
      report.unchecked = true;
      m_warnings.push_back(sentence);
    }
    return report.edited || cached.unchecked ? vpMeasureCover(mesh, cached.cover.capsules) : cached.cover;
  }

  const vpArmCoverSpec &m_spec;
  vpArmSpec m_arm;
  vpArmCoverCache m_cache;
  std::vector<vpBodyCover> m_covers;
  std::vector<std::string> m_warnings;
};
} // namespace

vpArmCover vpCoverArm(const vpArmModel &arm, const vpArmCoverSpec &spec)
{
  Coverer coverer(arm, spec);
  for (int i = 0; i < static_cast<int>(arm.spec().bodies.size()); ++i) {
    coverer.cover(i);
  }
  return coverer.result();
}

END_VISP_NAMESPACE
