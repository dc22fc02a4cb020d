/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpDetourSearch.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
using Eigen::Vector3d;
constexpr std::array<double, 3> speeds{1., 0.5, 0.25};
constexpr double neighbourhood = 0.2; // m: an octree may be the whole room; only the part near the position is used
constexpr double atGoal = 0.01;       // m: conflicts with the tool this near to its goal count as conflicts at the goal

//! Insertion index of a via: the segment whose line is nearest to a position.
int stretchOf(const vpToolTask &task, const Vector3d &from, const Vector3d &place)
{
  int best = 0;
  double least = 1e9;
  Vector3d begin = from;
  for (int k = 0; k <= task.viaCount; ++k) {
    const Vector3d end = k < task.viaCount ? task.vias[static_cast<std::size_t>(k)] : task.goal;
    const Vector3d way = end - begin;
    const double share = way.squaredNorm() > 0. ? std::clamp((place - begin).dot(way) / way.squaredNorm(), 0., 1.) : 0.;
    const double distance = (begin + share * way - place).norm();
    if (distance < least) {
      least = distance;
      best = k;
    }
    begin = end;
  }
  return best;
}

//! Extent of the surface along a unit vector; vector and position in the shape's frame.
double extent(const vpCollisionShape &shape, const Vector3d &u, const Vector3d &place)
{
  const double across = std::hypot(u.x(), u.y()), along = std::fabs(u.z());
  switch (shape.type()) {
  case vpShapeType::Sphere:
    return shape.radius();
  case vpShapeType::Capsule:
    return shape.radius() + 0.5 * shape.length() * along;
  case vpShapeType::Box:
    return 0.5 * shape.size().dot(u.cwiseAbs());
  case vpShapeType::Cylinder:
    return shape.radius() * across + 0.5 * shape.length() * along;
  case vpShapeType::Mesh: {
    double most = -1e9;
    for (const Vector3d &p : shape.mesh().vertices()) {
      most = std::max(most, u.dot(p));
    }
    return most;
  }
  case vpShapeType::Octree:
    break;
  }
  double most = -1e9;
  for (const vpOctreeCell &cell : shape.octree().cells()) {
    if ((cell.centre - place).norm() < neighbourhood) {
      most = std::max(most, u.dot(cell.centre) + 0.5 * cell.size * u.cwiseAbs().sum());
    }
  }
  return most;
}

//! Two unit vectors perpendicular to a direction; the first one is horizontal.
void across(const Vector3d &d, Vector3d &level, Vector3d &up)
{
  level = Vector3d::UnitZ().cross(d);
  level = level.norm() > 1e-3 ? level.normalized() : Vector3d::UnitX();
  up = d.cross(level).normalized();
}

//! Largest extent of the object's surface, inflation included, from its origin along a unit direction, m; for an
//! octree only near a position.
double extentAlong(const vpCollisionObject &object, const Vector3d &direction, const Vector3d &place)
{
  const Eigen::Matrix3d R = object.pose.R.transpose();
  return extent(object.shape, R * direction, R * (place - object.pose.p)) + object.inflation;
}

/*!
 * Positions beside the obstacle in the way of a tool moving from \e from to \e to: on every side of the obstacle, at
 * its extent there plus a clearance; if another part than the tool would touch, also farther out. If nothing is in the
 * way but the arm cannot follow, positions around the one where it lags behind.
 * \param conflict : Predicted conflict. \param clearance : Clearance of the tool's origin from the extent, m.
 * \param sides : Number of sides, >= 2.
 */
std::vector<Vector3d> placesBeside(const vpCollisionScene &scene, const vpForecast &conflict, const Vector3d &from,
                                   const Vector3d &to, double clearance, int sides)
{
  std::vector<Vector3d> places;
  const vpClearance &pair = conflict.pair;
  const Vector3d way = to - from;
  Vector3d level, up;
  across(way.norm() > 1e-6 ? Vector3d(way.normalized()) : Vector3d::UnitX(), level, up);
  if (pair.kind == vpCollisionKind::None) { // the arm itself cannot follow there
    for (int k = 0; k < sides; ++k) {
      const double angle = 2. * M_PI * k / sides;
      places.push_back(conflict.tool + 0.15 * (std::cos(angle) * level + std::sin(angle) * up));
    }
    return places;
  }
  // Away from the obstacle, wherever on the arm the contact is.
  for (const double shift : {0.1, 0.2}) {
    places.push_back(conflict.tool + shift * pair.normal);
  }
  if (pair.kind != vpCollisionKind::Object) {
    return places;
  }
  vpCollisionObject object = scene.object(pair.other);
  object.pose = object.poseAt(conflict.time);
  const double share =
      way.squaredNorm() > 0. ? std::clamp((object.pose.p - from).dot(way) / way.squaredNorm(), 0.05, 0.95) : 0.5;
  const Vector3d foot = from + share * way;
  for (int k = 0; k < sides; ++k) {
    const double angle = 2. * M_PI * k / sides;
    const Vector3d u = std::cos(angle) * level + std::sin(angle) * up;
    const double out = (object.pose.p - foot).dot(u) + extentAlong(object, u, pair.onOther) + clearance;
    for (const double more : {0., 0.08}) {
      places.push_back(foot + std::max(0.03, out + more) * u);
    }
  }
  return places;
}
} // namespace

vpDetourSearch::vpDetourSearch(const vpCollisionScene &scene, const vpDirectTrajectoryAvoidanceSpec &spec,
                               const vpToolMotionSpec &motion)
  : m_scene(&scene), m_spec(spec), m_forecast(scene, motion),
    m_path(spec.common.maxVelocity, spec.common.maxAcceleration), m_plan(vpToolPath::room())
{}

vpForecast vpDetourSearch::foresee(const vpDetourStart &start, const vpTrajectoryPlan &plan, double clock,
                                   double margin)
{
  return m_forecast.run(start.q, start.velocity, plan, clock, start.posture, start.orientation, margin);
}

vpForecast vpDetourSearch::foresee(const vpDetourStart &start, vpToolTask &task, double margin)
{
  vpForecast result;
  for (const double speed : speeds) {
    task.speed = speed;
    if (!m_path.plan(start.tool, task, m_plan)) {
      continue;
    }
    --m_left;
    result = foresee(start, m_plan, 0., margin);
    if (result.status != vpForecastStatus::TooFast) {
      break;
    }
  }
  return result;
}

std::optional<vpJointVector> vpDetourSearch::endOf(const vpDetourStart &start, const Vector3d &goal)
{
  constexpr double nothing = -1e3; // m: a margin that is never violated
  vpToolTask task;
  task.goal = goal;
  const vpForecast forecast = foresee(start, task, nothing);
  return forecast.status == vpForecastStatus::Free ? std::optional<vpJointVector>(forecast.end) : std::nullopt;
}

void vpDetourSearch::expand(const vpDetourStart &start, const Node &node, const vpForecast &conflict)
{
  if (node.task.viaCount == vpToolTask::maxVias) {
    return;
  }
  const int stretch = stretchOf(node.task, start.tool.x, conflict.tool);
  const Vector3d from = stretch == 0 ? start.tool.x : node.task.vias[static_cast<std::size_t>(stretch - 1)];
  const Vector3d to =
      stretch == node.task.viaCount ? node.task.goal : node.task.vias[static_cast<std::size_t>(stretch)];
  for (const Vector3d &place : placesBeside(*m_scene, conflict, from, to, m_spec.toolClearance, m_spec.sides)) {
    Node child = node;
    for (int k = child.task.viaCount; k > stretch; --k) {
      child.task.vias[static_cast<std::size_t>(k)] = child.task.vias[static_cast<std::size_t>(k - 1)];
    }
    child.task.vias[static_cast<std::size_t>(stretch)] = place;
    ++child.task.viaCount;
    child.length = child.task.length(start.tool.x);
    m_open.push_back(child);
    std::push_heap(m_open.begin(), m_open.end(), [](const Node &a, const Node &b) { return a.length > b.length; });
  }
}

// Motion after a stop at a final position beside the obstacle.
bool vpDetourSearch::leadsToGoal(const vpDetourStart &start, const vpForecast &there, const Vector3d &goal)
{
  vpToolState rest;
  rest.x = there.tool;
  vpToolTask task;
  task.goal = goal;
  if (!m_path.plan(rest, task, m_plan)) {
    return false;
  }
  --m_left;
  const vpForecast onward = m_forecast.run(there.end, vpJointVector::Zero(there.end.size()), m_plan, 0., start.posture,
                                           start.orientation, m_spec.common.margin + m_spec.clearance, there.time);
  return onward.status == vpForecastStatus::Free || onward.status == vpForecastStatus::TooFast;
}

vpDetourResult vpDetourSearch::search(const vpDetourStart &start, const Vector3d &goal, const Vector3d &goalVelocity)
{
  const double margin = m_spec.common.margin + m_spec.clearance;
  const auto longer = [](const Node &a, const Node &b) { return a.length > b.length; };
  vpDetourResult result;
  Node first;
  first.task.goal = goal;
  first.task.goalVelocity = goalVelocity;
  first.length = (goal - start.tool.x).norm();
  m_open.assign(1, first);
  m_left = m_spec.forecasts;
  bool isFirst = true;
  while (!m_open.empty() && m_left > 0) {
    std::pop_heap(m_open.begin(), m_open.end(), longer);
    Node node = m_open.back();
    m_open.pop_back();
    const bool final = m_spec.detour == vpDetourKind::PointToPoint && node.task.viaCount > 0;
    if (final) { // the newest position is the first stop
      node.task.goal = node.task.vias[0];
      node.task.goalVelocity.setZero();
      node.task.viaCount = 0;
    }
    const vpForecast forecast = foresee(start, node.task, margin);
    if (isFirst) {
      result.direct = forecast;
      isFirst = false;
    }
    if (forecast.status == vpForecastStatus::Free && (!final || leadsToGoal(start, forecast, goal))) {
      result.task = node.task;
      return result;
    }
    const bool blocked =
        forecast.status == vpForecastStatus::Conflict && (forecast.tool - node.task.goal).norm() < atGoal;
    if (forecast.status == vpForecastStatus::Conflict && !blocked && !final) {
      expand(start, node, forecast);
    }
  }
  return result;
}

END_VISP_NAMESPACE
