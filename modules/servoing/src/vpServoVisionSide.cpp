/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpServoVisionSide.h"

#include "vpRigidMotion.h"

#include <visp3/core/vpException.h>

#include <chrono>
#include <cmath>
#include <cstring>
#include <utility>

BEGIN_VISP_NAMESPACE

namespace
{
// The camera has moved if it went this far since the first of equal images: a pixel or more for most cameras.
constexpr double movedLength = 0.003; // m
constexpr double movedAngle = 0.005;  // rad

// FNV-1a over words of 8 bytes.
std::uint64_t hashOf(const vpImage<unsigned char> &image)
{
  constexpr std::uint64_t prime = 1099511628211ULL;
  std::uint64_t hash = 14695981039346656037ULL ^ image.getWidth();
  const std::size_t size = image.getSize();
  for (std::size_t i = 0; i < size; i += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, image.bitmap + i, std::min<std::size_t>(8, size - i));
    hash = (hash ^ word) * prime;
    hash ^= hash >> 32;
  }
  return hash;
}
} // namespace

vpServoVisionSide::vpServoVisionSide(const vpVisualServoSpec &spec)
  : m_maxPoints(spec.maxPoints), m_checker(vpServoLaw::create("pbvs1")),
    m_object(spec.objectChange, spec.objectTurnChange, spec.imageTimeout), m_objectMoves(spec.objectMoves)
{}

void vpServoVisionSide::set(std::unique_ptr<vpServoVision> vision)
{
  if (!vision) {
    throw vpException(vpException::badValue, "the vision of the visual servo is null, must be an object");
  }
  m_vision = std::move(vision);
}

vpServoVision &vpServoVisionSide::vision() const
{
  if (!m_vision) {
    throw vpException(vpException::notInitialized, "the visual servo has no vision, setVision() was not called");
  }
  return *m_vision;
}

void vpServoVisionSide::checkGoal(const vpServoGoal &goal)
{
  m_checker->setGoal(goal);
  if (goal.points.size() > m_maxPoints) {
    throw vpException(vpException::dimensionError, "the goal has %zu points, maxPoints of the visual servo is %u",
                      goal.points.size(), m_maxPoints);
  }
}

void vpServoVisionSide::setGoal(const vpServoGoal &goal, vpServoExchange &exchange)
{
  checkGoal(goal);
  exchange.goals.back() = goal;
  exchange.goals.publish();
}

// A start allows a new clock.
bool vpServoVisionSide::isNewer(double time, vpServoExchange &exchange)
{
  const unsigned int epoch = exchange.epoch.load(std::memory_order_relaxed);
  if (epoch != m_epoch) {
    m_epoch = epoch;
    m_object.reset();
    m_lastTime = -std::numeric_limits<double>::infinity();
  }
  if (!(time > m_lastTime) || !std::isfinite(time)) {
    exchange.badStamps.fetch_add(1, std::memory_order_relaxed);
    return false;
  }
  if (std::isfinite(m_lastTime)) {
    exchange.timing.image.add(time - m_lastTime);
  }
  m_lastTime = time;
  return true;
}

bool vpServoVisionSide::isFrozen(const vpImage<unsigned char> &image, const vpRigidTransform *camera)
{
  const std::uint64_t hash = hashOf(image);
  if (hash != m_hash || !m_hasFirst) {
    m_hash = hash;
    m_hasFirst = camera != nullptr;
    m_firstOfSame = camera ? *camera : vpRigidTransform();
    return false;
  }
  if (!camera) {
    return false;
  }
  const vpTwist way = vpRigidMotion::log(m_firstOfSame.inverse() * *camera);
  return way.linearNorm() > movedLength || way.angularNorm() > movedAngle;
}

void vpServoVisionSide::publish(const vpServoSight &sight, const vpRigidTransform *camera, bool isFrozen,
                                vpServoExchange &exchange)
{
  const std::size_t most = std::max(sight.measurement.points.size(), sight.measurement.outline.size());
  if (sight.measurement.valid && most > m_maxPoints) {
    throw vpException(vpException::dimensionError,
                      "the measurement has %zu points, maxPoints of the visual servo is %u", most, m_maxPoints);
  }
  if (sight.hasGoal) {
    checkGoal(sight.goal);
  }
  if (!(sight.speedFactor > 0. && sight.speedFactor <= 1.)) {
    throw vpException(vpException::badValue, "speedFactor of the sight is %g, must be > 0, <= 1", sight.speedFactor);
  }
  const vpServoMeasurement &seen = sight.measurement;
  if (m_objectMoves && seen.valid && !isFrozen && camera) {
    m_object.add(*camera, vpRigidTransform::fromHomogeneous(seen.cMo), seen.covariance, seen.time);
  }
  vpServoParcel &parcel = exchange.sights.back();
  parcel.object = m_object.motion();
  parcel.sight = sight;
  parcel.isFrozen = isFrozen;
  exchange.sights.publish();
}

const vpServoSight &vpServoVisionSide::see(const vpImage<unsigned char> &image, double time, vpServoExchange &exchange)
{
  vpServoVision &eyes = vision();
  m_sight.measurement.valid = m_sight.hasGoal = false;
  m_sight.distance = m_sight.distanceSigma = 0.;
  m_sight.speedFactor = 1.;
  if (!isNewer(time, exchange)) {
    return m_sight;
  }
  vpRigidTransform camera;
  const vpRigidTransform *const known = exchange.history.at(time, camera) ? &camera : nullptr;
  const auto begin = std::chrono::steady_clock::now();
  eyes.see(image, time, known, m_sight);
  exchange.timing.vision.add(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  m_sight.measurement.time = time;
  const bool isSame = isFrozen(image, known);
  publish(m_sight, known, isSame && m_sight.measurement.valid, exchange);
  return m_sight;
}

void vpServoVisionSide::see(const vpServoSight &sight, vpServoExchange &exchange)
{
  if (isNewer(sight.measurement.time, exchange)) {
    vpRigidTransform camera;
    const bool isKnown = exchange.history.at(sight.measurement.time, camera);
    publish(sight, isKnown ? &camera : nullptr, false, exchange);
  }
}

END_VISP_NAMESPACE
