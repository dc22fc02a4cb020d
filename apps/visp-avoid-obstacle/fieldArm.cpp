/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Figure 8.6 by the arm with its drives, the obstacle seen by its camera.
#include "planeMotion.h"
#include "replicas.h"
#include "results.h"
#include "seenBox.h"

#include "dataFile.h"
#include "robot.h"

#include <visp3/avoidance/vpCollisionSceneJson.h>
#include <visp3/manipulator/vpRedundancySolver.h>

#include <algorithm>
#include <cmath>

namespace avoidObstacle
{
namespace
{
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double REACHED = 0.005; // m, as in figure 8.6
constexpr double BEHIND = 0.1;    // m: the obstacle is so much farther along y, or the arm would touch the box

//! \brief Visits the places of a FieldTask with the tool; the obstacle is where the scene has it.
class FieldFollower : public vpAvoidanceMethod
{
public:
  //! \param scene : Must outlive this. \param weight : Of the field as printed, (8.2).
  FieldFollower(const vpCollisionScene &scene, const vpAvoidanceMethodSpec &spec, const vpFieldWeightSpec &weight)
    : m_scene(&scene), m_period(spec.period), m_weight(weight), m_solver(scene.arm(), solverSpec(spec.period))
  {
    m_wish.frame = vpArmFrame::Base;
    m_wish.free = {false, false, false, true, true, true};
  }

  vpAvoidanceStatus start(const vpJointVector &q, const vpAvoidanceGoal &) override
  {
    vpArmKinematics::forward(m_scene->arm(), q, m_data);
    m_origin = m_data.tool.p;
    m_wish.previous = vpJointVector::Zero(q.size());
    m_cycle = 0;
    return vpAvoidanceStatus::Moving;
  }
  void setGoal(const vpAvoidanceGoal &) noexcept override {}
  void look() override {}

  void step(const vpJointVector &q, vpAvoidanceOutput &output) noexcept override
  {
    const double now = static_cast<double>(m_cycle++) * m_period;
    const std::size_t last = m_task.places.size() - 1;
    const Vector2d place = m_task.places[std::min(last, static_cast<std::size_t>(now / m_task.slot))];
    vpArmKinematics::forward(m_scene->arm(), q, m_data);
    vpArmKinematics::jacobian(m_scene->arm(), m_data);
    const Vector3d at = m_data.tool.p - m_origin;
    const Vector2d wish = m_task.gain * (place - at.head<2>());
    const Vector3d v = blend(at, {wish.x(), wish.y(), -m_task.gain * at.z()});
    m_wish.twist = vpTwist(v.x(), v.y(), v.z(), 0., 0., 0.);
    m_solver.step(m_data, m_wish, m_solved);
    m_wish.previous = m_solved.velocity;
    output = vpAvoidanceOutput();
    output.velocity = m_solved.velocity;
    output.wanted = m_origin + Vector3d(place.x(), place.y(), 0.);
    output.status =
        now > static_cast<double>(last + 2) * m_task.slot ? vpAvoidanceStatus::Arrived : vpAvoidanceStatus::Moving;
  }

private:
  static vpRedundancySpec solverSpec(double period)
  {
    vpRedundancySpec spec;
    spec.period = period;
    return spec;
  }
  //! As followField(): only x is affected.
  [[nodiscard]] Vector3d blend(const Vector3d &at, const Vector3d &wish) const
  {
    constexpr double noWeight = 1e3; // m
    if (m_scene->objectCount() == 0) {
      return wish;
    }
    const Vector3d offset = m_scene->object(0).pose.p - m_origin - at;
    const bool near = std::fabs(offset.y()) <= m_task.sight + BEHIND;
    const Vector3d avoid(offset.x() < 0. ? m_task.avoidSpeed : -m_task.avoidSpeed, 0., 0.);
    return vpBlendAsPrinted(m_weight, {near ? offset.x() : noWeight, noWeight}, avoid, wish);
  }

  const vpCollisionScene *m_scene;
  double m_period;
  vpFieldWeightSpec m_weight;
  FieldTask m_task;
  vpRedundancySolver m_solver;
  vpRedundancyInput m_wish;
  vpRedundancyOutput m_solved;
  vpArmData m_data;
  Vector3d m_origin = Vector3d::Zero();
  long m_cycle = 0;
};

vpAvoidanceRun run(const Options &options, const vpFieldWeightSpec &weight)
{
  const FieldTask task;
  vpAvoidanceRunSpec spec;
  spec.arm = vpApp::loadUsableRobot(options.robot).arm;
  spec.start = vpLoadCollisionScene(vpApp::dataFile("scene/photo-box.json")).tasks.front().start;
  vpArmData data;
  vpArmKinematics::forward(*spec.arm, spec.start, data);
  const auto fromStart = [&](const Vector2d &p) { return Vector3d(data.tool.p + Vector3d(p.x(), p.y(), 0.)); };
  addSeenBox(options, fromStart(task.obstacle + Vector2d(0., BEHIND)), 0., spec);
  spec.goal = vpAvoidanceGoal();
  spec.goal.position = fromStart(task.places.back());
  spec.makeMethod = [weight](const vpCollisionScene &scene, const vpAvoidanceMethodSpec &common) {
    return std::make_unique<FieldFollower>(scene, common, weight);
  };
  spec.drives.ideal = options.friction <= 0.;
  spec.drives.frictionScale = options.friction;
  spec.maxDuration = task.slot * (static_cast<double>(task.places.size()) + 1.) + 2.;
  spec.seed = options.seed;
  return runAvoidanceExperiment(spec);
}

nlohmann::ordered_json numbersOf(const vpAvoidanceRun &run)
{
  const FieldTask task;
  const Vector3d origin = run.samples.front().tool;
  std::vector<double> missed;
  for (std::size_t i = 0; i < task.places.size(); ++i) {
    const double until = i + 1 == task.places.size() ? HUGE_VAL : static_cast<double>(i + 1) * task.slot;
    const auto next = std::find_if(run.samples.begin(), run.samples.end(),
                                   [until](const vpAvoidanceSample &s) { return s.time >= until; });
    const Vector2d at = ((next - 1)->tool - origin).head<2>();
    missed.push_back((at - task.places[i]).norm());
  }
  return {{"missed_m", missed},
          {"end_reached", missed.back() < REACHED},
          {"peak_v", run.metrics.peak_v},
          {"collisions_moving", run.metrics.collisions_moving}};
}
} // namespace

nlohmann::ordered_json playSeenFieldReplica(const Options &options)
{
  return {{"strict", numbersOf(run(options, strictField()))}, {"mild", numbersOf(run(options, mildField()))}};
}
} // namespace avoidObstacle
