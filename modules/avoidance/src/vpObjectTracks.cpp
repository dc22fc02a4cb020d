/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/avoidance/vpObjectTracks.h>

#include "vpFieldCheck.h"
#include "vpPlausible.h"
#include "vpTrackFilter.h"

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr vpFieldCheck fields("the object tracks");
constexpr double farAhead = 60.; // s: longest plausible gap between images

bool isSigma(double value) { return value >= 1e-9 && value <= 1e3; } // its square and the inverse of that are usable

bool isGood(const vpObjectSighting &sighting)
{
  return !sighting.name.empty() && vpIsTime(sighting.time) && vpIsPlace(sighting.pose) &&
         isSigma(sighting.positionSigma) && isSigma(sighting.angleSigma);
}

bool isSame(const vpCollisionShape &a, const vpCollisionShape &b)
{
  if (a.type() != b.type() || a.radius() != b.radius() || a.length() != b.length() || a.size() != b.size()) {
    return false;
  }
  return a.type() == vpShapeType::Mesh     ? &a.mesh().data() == &b.mesh().data()
         : a.type() == vpShapeType::Octree ? &a.octree().data() == &b.octree().data()
                                           : true;
}

//! Distance of the farthest point from the shape's origin, m.
double reach(const vpCollisionShape &shape)
{
  double farthest = 0.;
  switch (shape.type()) {
  case vpShapeType::Sphere:
    return shape.radius();
  case vpShapeType::Capsule:
    return 0.5 * shape.length() + shape.radius();
  case vpShapeType::Box:
    return 0.5 * shape.size().norm();
  case vpShapeType::Cylinder:
    return std::hypot(0.5 * shape.length(), shape.radius());
  case vpShapeType::Mesh:
    for (const Eigen::Vector3d &vertex : shape.mesh().vertices()) {
      farthest = std::max(farthest, vertex.norm());
    }
    return farthest;
  case vpShapeType::Octree:
    for (const vpOctreeCell &cell : shape.octree().cells()) {
      farthest = std::max(farthest, (cell.centre.cwiseAbs().array() + 0.5 * cell.size).matrix().norm());
    }
    return farthest;
  }
  return farthest;
}

vpCollisionObject toObject(const vpObjectTrack &track)
{
  vpCollisionObject object;
  object.name = track.name;
  object.shape = track.shape;
  object.pose = track.pose;
  object.velocity = track.velocity;
  object.inflation = track.inflation;
  return object;
}
} // namespace

void vpObjectTrackSpec::validate() const
{
  fields.positive("acceleration", acceleration, "m/s^2");
  fields.positive("angularAcceleration", angularAcceleration, "rad/s^2");
  fields.positive("persistence", persistence, "s");
  fields.notNegative("restAcceleration", restAcceleration, "m/s^2");
  fields.positive("startVelocity", startVelocity, "m/s");
  fields.positive("startTurn", startTurn, "rad/s");
  fields.positive("gate", gate);
  fields.in("doubts", doubts, {1});
  fields.notNegative("restSigmas", restSigmas);
  fields.positive("restSpeed", restSpeed, "m/s");
  fields.positive("restTurn", restTurn, "rad/s");
  fields.notNegative("inflationSigmas", inflationSigmas);
  fields.notNegative("maxInflation", maxInflation, "m");
  fields.notNegative("fresh", fresh, "s");
  fields.notNegative("coast", coast, "s");
  fields.require(forget > 0., "forget", forget, "> 0 s");
}

const char *vpToString(vpTrackStatus status)
{
  switch (status) {
  case vpTrackStatus::New:
    return "New";
  case vpTrackStatus::Tracked:
    return "Tracked";
  case vpTrackStatus::Coasting:
    return "Coasting";
  case vpTrackStatus::Lost:
    break;
  }
  return "Lost";
}

vpObjectTracks::vpObjectTracks(const vpObjectTrackSpec &spec) : m_spec(spec) { m_spec.validate(); }
vpObjectTracks::vpObjectTracks(const vpObjectTracks &other) = default;
vpObjectTracks::vpObjectTracks(vpObjectTracks &&other) noexcept = default;
vpObjectTracks &vpObjectTracks::operator=(const vpObjectTracks &other) = default;
vpObjectTracks &vpObjectTracks::operator=(vpObjectTracks &&other) noexcept = default;
vpObjectTracks::~vpObjectTracks() = default;

const vpObjectTrack *vpObjectTracks::find(const std::string &name) const noexcept
{
  const auto found = std::find_if(m_tracks.begin(), m_tracks.end(),
                                  [&name](const vpObjectTrack &track) { return track.name == name; });
  return found == m_tracks.end() ? nullptr : &*found;
}

bool vpObjectTracks::add(const vpObjectSighting &sighting)
{
  if (!isGood(sighting) || (std::isfinite(m_now) && sighting.time > m_now + farAhead)) {
    return false;
  }
  const vpObjectTrack *const known = find(sighting.name);
  std::size_t i = m_tracks.size();
  if (known == nullptr) {
    m_tracks.emplace_back();
    m_tracks.back().name = sighting.name;
    m_filters.emplace_back(sighting, m_spec);
  }
  else {
    i = static_cast<std::size_t>(known - m_tracks.data());
    if (std::isfinite(m_now) &&
        m_filters[i].time() > m_now + farAhead) { // seen before the clock was known, with a wrong time
      m_filters[i] = vpTrackFilter(sighting, m_spec);
      m_filters[i].setReach(reach(m_tracks[i].shape));
    }
    if (sighting.time < m_filters[i].time()) {
      return false;
    }
    if (!m_filters[i].add(sighting, m_spec)) {
      refresh(i); // confidence has decreased
      return false;
    }
  }
  if (known == nullptr || !isSame(m_tracks[i].shape, sighting.shape)) {
    m_tracks[i].shape = sighting.shape;
    m_filters[i].setReach(reach(sighting.shape));
  }
  refresh(i);
  return true;
}

void vpObjectTracks::refresh(std::size_t i) noexcept
{
  vpObjectTrack &track = m_tracks[i];
  m_filters[i].predict(m_now, m_spec, track);
  const double sigma = std::hypot(track.positionSigma, track.angleSigma * m_filters[i].reach());
  track.inflation = std::min(m_spec.inflationSigmas * sigma, m_spec.maxInflation);
}

bool vpObjectTracks::advance(double now)
{
  if (!vpIsTime(now) || now < m_now) {
    return false;
  }
  const bool agrees = now > m_doubted && now <= m_doubted + farAhead; // not a stopped clock
  if (std::isfinite(m_now) && now > m_now + farAhead && !agrees) {
    m_doubted = now;
    return false;
  }
  m_doubted = std::numeric_limits<double>::quiet_NaN();
  m_now = now;
  for (std::size_t i = m_tracks.size(); i-- > 0;) {
    if (m_now - m_filters[i].time() > m_spec.forget) {
      m_tracks.erase(m_tracks.begin() + static_cast<std::ptrdiff_t>(i));
      m_filters.erase(m_filters.begin() + static_cast<std::ptrdiff_t>(i));
    }
    else {
      refresh(i);
    }
  }
  return true;
}

// Returns true if the list of objects changed.
bool vpObjectTracks::place(vpCollisionScene &scene, const vpObjectTrack &track)
{
  const int i = scene.find(track.name);
  const bool known = std::any_of(m_applied.begin(), m_applied.end(),
                                 [&track](const Applied &applied) { return applied.name == track.name; });
  if (!known) {
    m_applied.push_back({track.name, i < 0});
  }
  if (i >= 0 && isSame(scene.object(i).shape, track.shape)) {
    static_cast<void>(scene.moveObject(i, track.pose));
    static_cast<void>(scene.setVelocity(i, track.velocity));
    static_cast<void>(scene.setInflation(i, track.inflation));
    return false;
  }
  if (i >= 0) {
    scene.remove(i);
  }
  scene.add(toObject(track));
  return true;
}

// Removes objects whose tracks were dropped. Returns true if the list of objects changed.
bool vpObjectTracks::withdraw(vpCollisionScene &scene)
{
  bool changed = false;
  for (std::size_t k = m_applied.size(); k-- > 0;) {
    if (find(m_applied[k].name) != nullptr) {
      continue;
    }
    const int i = scene.find(m_applied[k].name);
    if (i >= 0 && m_applied[k].brought) {
      scene.remove(i);
      changed = true;
    }
    else if (i >= 0) {
      static_cast<void>(scene.setVelocity(i, vpTwist()));
    }
    m_applied.erase(m_applied.begin() + static_cast<std::ptrdiff_t>(k));
  }
  return changed;
}

bool vpObjectTracks::applyTo(vpCollisionScene &scene)
{
  bool changed = withdraw(scene);
  for (const vpObjectTrack &track : m_tracks) {
    changed = place(scene, track) || changed;
  }
  return changed;
}

END_VISP_NAMESPACE
