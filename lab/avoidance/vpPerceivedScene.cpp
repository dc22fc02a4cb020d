/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "lab/avoidance/vpPerceivedScene.h"

#include <visp3/core/vpException.h>

#include <algorithm>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr double rounding = 1e-9; // s

std::unique_ptr<vpObstacleSensor> makeSensor(const vpAvoidanceRunSpec &spec)
{
  if (spec.sight == vpObstacleSight::Custom) {
    auto sensor = spec.makeSensor(spec.seed);
    if (!sensor) {
      throw vpException(vpException::badValue, "makeSensor of the avoidance experiment made no sensor");
    }
    return sensor;
  }
  std::vector<std::string> names;
  for (const vpMovingObstacle &obstacle : spec.obstacles) {
    names.push_back(obstacle.object.name);
  }
  return std::make_unique<vpPoseSensor>(names, spec.poses, spec.seed);
}
} // namespace

vpPerceivedScene::vpPerceivedScene(const vpAvoidanceRunSpec &spec)
  : m_spec(&spec), m_scene(*spec.arm, spec.scene), m_sensor(makeSensor(spec)), m_tracks(spec.tracks)
{}

bool vpPerceivedScene::isExposed(double t)
{
  if (t < m_nextFrame / m_spec->visionRate - rounding) {
    return false;
  }
  m_nextFrame += 1.;
  return !isCovered(t);
}

bool vpPerceivedScene::isCovered(double t) const
{
  return std::any_of(m_spec->covered.begin(), m_spec->covered.end(),
                     [t](const std::pair<double, double> &c) { return t >= c.first && t < c.second; });
}

void vpPerceivedScene::copyExactly(const vpTrueScene &truth)
{
  for (const vpMovingObstacle &obstacle : m_spec->obstacles) {
    const int from = truth.scene().find(obstacle.object.name);
    int to = m_scene.find(obstacle.object.name);
    if (from >= 0 && to < 0) {
      to = m_scene.add(truth.scene().object(from));
    }
    else if (from < 0 && to >= 0) {
      m_scene.remove(to);
    }
    if (from >= 0) {
      static_cast<void>(m_scene.moveObject(to, truth.scene().object(from).pose));
      static_cast<void>(m_scene.setVelocity(to, truth.scene().object(from).velocity));
    }
  }
}

bool vpPerceivedScene::update(double t, const vpTrueScene &truth, const vpJointVector &q)
{
  const bool exposed = isExposed(t);
  if (m_spec->sight == vpObstacleSight::Exact) {
    m_scene.advance(t - m_now);
    m_now = t;
    if (exposed) {
      copyExactly(truth);
    }
    return exposed;
  }
  if (exposed) {
    Result result;
    result.arrival = t + m_spec->latency;
    truth.scene().place(q, m_data);
    m_sensor->look(truth.scene(), m_data, t, result.sightings);
    m_pending.push_back(std::move(result));
  }
  bool arrived = false;
  while (!m_pending.empty() && m_pending.front().arrival <= t + rounding) {
    for (const vpObjectSighting &sighting : m_pending.front().sightings) {
      m_tracks.add(sighting);
    }
    m_pending.pop_front();
    arrived = true;
  }
  m_tracks.advance(t);
  static_cast<void>(m_tracks.applyTo(m_scene));
  if (m_spec->watchTracks) {
    m_spec->watchTracks(t, m_tracks.tracks());
  }
  return arrived;
}

END_VISP_NAMESPACE
