/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Figures 8.8 and 8.10: experiments, here run by the arm with its drives; 8.11 and 8.12 are snapshots of them, which the report takes.
#include "replicas.h"
#include "seenBox.h"

#include "numberText.h"
#include "robot.h"
#include "runData.h"

#include "lab/avoidance/vpAvoidanceScenes.h"
#include <visp3/avoidance/vpAvoidanceMethod.h>
#include <visp3/manipulator/vpRedundancySolver.h>
#include <visp3/trajectory/vpDirectTrajectory.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <vector>

namespace avoidObstacle
{
namespace
{
//! \brief A change of the tool's goal.
struct ToolEvent {
  double time = 0.;                               //!< s.
  Eigen::Vector3d goal = Eigen::Vector3d::Zero(); //!< m.
  std::optional<Eigen::Vector3d> via;             //!< m.
  bool whenSeen = false; //!< Comes when the obstacle is in the scene, and shifts the times of the following events.
};

/*!
 * \brief Repeats the events of the thesis at their times, without looking at obstacles. The position
 * of the tool is controlled, its orientation is free (thesis 8.1.1).
 */
class PrescribedMotion : public vpAvoidanceMethod
{
public:
  //! \param events : In time order; the first one starts the motion. \param scene : Must outlive this.
  PrescribedMotion(const vpCollisionScene &scene, const vpAvoidanceMethodSpec &spec, std::vector<ToolEvent> events,
                   double viaShare);

  vpAvoidanceStatus start(const vpJointVector &q, const vpAvoidanceGoal &goal) override;
  void setGoal(const vpAvoidanceGoal &) noexcept override {} // goals come from the events
  void look() override {}
  void step(const vpJointVector &q, vpAvoidanceOutput &output) noexcept override;

private:
  void take(const ToolEvent &event) noexcept;
  [[nodiscard]] bool isDue(const ToolEvent &event, double now) const noexcept;

  const vpCollisionScene *m_scene;
  const vpArmModel *m_arm;
  vpAvoidanceMethodSpec m_spec;
  std::vector<ToolEvent> m_events;
  double m_viaShare;
  vpRedundancySolver m_solver;
  vpDirectTrajectory<3> m_trajectory;
  vpTrajectoryInput<3> m_input;
  vpTrajectoryOutput<3> m_output;
  vpRedundancyInput m_wish;
  vpRedundancyOutput m_solved;
  vpArmData m_data;
  std::size_t m_next = 0;
  long m_cycle = 0;
  double m_shift = 0.; // of the events, s
};

constexpr double FOLLOWING_GAIN = 10.; // 1/s: gain that recovers lag caused by joint limits

vpRedundancySpec solverSpec(double period)
{
  vpRedundancySpec spec;
  spec.period = period;
  return spec;
}

PrescribedMotion::PrescribedMotion(const vpCollisionScene &scene, const vpAvoidanceMethodSpec &spec,
                                   std::vector<ToolEvent> events, double viaShare)
  : m_scene(&scene), m_arm(&scene.arm()), m_spec(spec), m_events(std::move(events)), m_viaShare(viaShare),
    m_solver(scene.arm(), solverSpec(spec.period)), m_trajectory(3, 1)
{
  m_input.vias.reserve(1);
  m_input.maxVelocity.setConstant(spec.maxVelocity);
  m_input.maxAcceleration.setConstant(spec.maxAcceleration);
  m_input.spec.groups[0] = vpAxisGroup({0, 1, 2}, spec.maxVelocity, spec.maxAcceleration);
  m_wish.frame = vpArmFrame::Base;
  m_wish.free = {false, false, false, true, true, true};
}

vpAvoidanceStatus PrescribedMotion::start(const vpJointVector &q, const vpAvoidanceGoal &)
{
  vpArmKinematics::forward(*m_arm, q, m_data);
  m_trajectory.reset();
  m_input.start.q = m_input.goal.q = m_data.tool.p;
  m_input.vias.clear();
  m_wish.previous = vpJointVector::Zero(q.size());
  m_next = 0;
  m_cycle = 0;
  m_shift = 0.;
  return vpAvoidanceStatus::Moving;
}

bool PrescribedMotion::isDue(const ToolEvent &event, double now) const noexcept
{
  return event.whenSeen ? m_scene->objectCount() > 0 : event.time + m_shift <= now + 0.5 * m_spec.period;
}

void PrescribedMotion::take(const ToolEvent &event) noexcept
{
  m_input.goal.q = event.goal;
  m_input.vias.clear();
  if (event.via) {
    m_input.vias.emplace_back(); // within its capacity
    m_input.vias.back().q = *event.via;
    m_input.vias.back().tau = m_viaShare;
  }
}

void PrescribedMotion::step(const vpJointVector &q, vpAvoidanceOutput &output) noexcept
{
  const double now = static_cast<double>(m_cycle++) * m_spec.period;
  for (; m_next < m_events.size() && isDue(m_events[m_next], now); ++m_next) {
    take(m_events[m_next]);
    m_shift = m_events[m_next].whenSeen ? now - m_events[m_next].time : m_shift;
  }
  const Eigen::Vector3d before = m_cycle == 1 ? m_input.start.q : m_output.state.q; // desired tool position now
  const vpTrajectoryResult result = m_trajectory.step(m_input, m_output, m_spec.period);
  vpArmKinematics::forward(*m_arm, q, m_data);
  vpArmKinematics::jacobian(*m_arm, m_data);
  Eigen::Vector3d v = (m_output.state.q - before) / m_spec.period + FOLLOWING_GAIN * (before - m_data.tool.p);
  v *= std::min(1., m_spec.maxVelocity / std::max(1e-9, v.norm()));
  m_wish.twist = vpTwist(v.x(), v.y(), v.z(), 0., 0., 0.);
  m_solver.step(m_data, m_wish, m_solved);
  m_wish.previous = m_solved.velocity;
  output = vpAvoidanceOutput();
  output.velocity = m_solved.velocity;
  output.wanted = m_output.state.q;
  const bool rests =
      (result == vpTrajectoryResult::Finished || result == vpTrajectoryResult::Holding) && m_next == m_events.size();
  output.status = rests        ? vpAvoidanceStatus::Arrived
                  : m_next > 1 ? vpAvoidanceStatus::Detouring
                               : vpAvoidanceStatus::Moving;
}

using Eigen::Vector3d;
using vpApp::fixed;
using vpApp::number;

constexpr double MOTION_BEGINS = 0.4;                 // s
constexpr double MOST_ACCELERATION = 2.;              // m/s^2
constexpr double SETTLED = 0.008;                     // m: table 8.1 has 3.0, 5.6 and 5.2 mm rms, 8.2 mm in total
constexpr double HEIGHT = 0.35;                       // m
constexpr double ROUNDING = 1e-6;                     // relative tolerance of a bound
constexpr double APPEARS_FROM = 0.6, APPEARS_TO = 1.; // s
constexpr double IMAGE_BEFORE = 0.8, IMAGE = 0.1;     // s: the figures' change comes with the image after that one

Vector3d place(double x, double y) { return {x, y, HEIGHT}; }
std::string text(const Vector3d &p) { return "[" + number(p.x(), 3) + ", " + number(p.y(), 3) + "] m"; }

//! \brief Commands with their times.
struct Script {
  std::vector<ToolEvent> events;
  double viaShare = 0.5;
};

Script scriptOf(bool multiPoint)
{
  const Vector3d straight = place(0.05, 0.93);
  if (!multiPoint) {
    return {{{MOTION_BEGINS, straight, std::nullopt}, {0.95, place(0.225, 0.93), std::nullopt}}};
  }
  return {{{MOTION_BEGINS, straight, std::nullopt},
           {0.95, straight, place(0.18, 0.8)},
           {1.15, place(0.125, 0.93), place(0.18, 0.8)}}};
}

vpAvoidanceRunSpec specOf(const Options &options, const Script &script)
{
  const auto arm = vpApp::loadUsableRobot(options.robot).arm;
  vpAvoidanceRunSpec spec = vpAvoidanceScenes::figure88(arm, 1).run; // start and ground of figure 8.8
  vpArmData data;
  vpArmKinematics::forward(*arm, spec.start, data);
  if (!((data.tool.p - place(0.05, 0.63)).norm() < SETTLED)) {
    throw std::runtime_error(arm->label() + ": does not start where the figure does, which is made for AMOR");
  }
  spec.obstacles.clear();
  spec.goalMoves.clear();
  spec.goal = vpAvoidanceGoal();
  spec.goal.position = script.events.front().goal;
  for (const ToolEvent &event : script.events) {
    vpGoalMove move;
    move.begin = move.end = event.time;
    move.to.position = event.goal;
    spec.goalMoves.push_back(move);
  }
  spec.sight = vpObstacleSight::Exact;
  spec.methodSpec.maxVelocity = 0.5;
  spec.methodSpec.maxAcceleration = MOST_ACCELERATION;
  spec.makeMethod = [script](const vpCollisionScene &scene, const vpAvoidanceMethodSpec &common) {
    return std::make_unique<PrescribedMotion>(scene, common, script.events, script.viaShare);
  };
  spec.drives.ideal = options.friction <= 0.;
  spec.drives.frictionScale = options.friction;
  spec.goalTolerance = spec.drives.ideal ? spec.goalTolerance : SETTLED;
  spec.seed = options.seed;
  return spec;
}

//! Largest speed of the true tool, from differences between the samples, m/s; NaN if one of them is.
double movedSpeed(const vpAvoidanceRun &run)
{
  double largest = 0.;
  for (std::size_t i = 1; i < run.samples.size(); ++i) {
    const vpAvoidanceSample &before = run.samples[i - 1], &now = run.samples[i];
    const double speed = (now.tool - before.tool).norm() / (now.time - before.time);
    largest = std::isnan(speed) || speed > largest ? speed : largest;
  }
  return largest;
}

double passes(const vpAvoidanceRun &run, const Vector3d &via)
{
  double least = HUGE_VAL;
  for (const vpAvoidanceSample &s : run.samples) {
    least = std::min(least, (s.tool - via).norm());
  }
  return least;
}

//! When the box appears: any time about the figures' change but that with which the change would come by their clock.
double appearanceOf(unsigned int seed)
{
  std::mt19937_64 rng(seed + 8800);
  const double t = std::uniform_real_distribution<double>(APPEARS_FROM, APPEARS_TO)(rng);
  return t < IMAGE_BEFORE ? t : t + IMAGE;
}

nlohmann::ordered_json eventsOf(const Script &script)
{
  nlohmann::ordered_json events = nlohmann::ordered_json::array();
  for (const ToolEvent &event : script.events) {
    events.push_back({{"time_s", event.time}, {"goal_m", {event.goal.x(), event.goal.y()}}, {"via_m", nullptr}});
    if (event.via) {
      events.back()["via_m"] = {event.via->x(), event.via->y()};
    }
  }
  return events;
}

void compare(const vpAvoidanceRun &run, const Script &script, Replica &replica)
{
  const vpAvoidanceMetrics &m = run.metrics;
  const Vector3d end = run.samples.back().tool, goal = script.events.back().goal;
  const double moved = movedSpeed(run);
  const bool kept = moved <= run.spec.methodSpec.maxVelocity * (1. + ROUNDING);
  replica.numbers["moved_peak_v"] = moved;
  replica.comparisons = {
      {"start", "[0.05, 0.63] m", text(run.samples.front().tool)},
      {"changed at", script.events.size() > 2 ? "0.95 and 1.15 s" : "0.95 s",
       script.events.size() > 2 ? "0.95 s (via) and 1.15 s (goal)" : "0.95 s"},
      {"ends at", text(goal), text(end) + ", off by " + number(1000. * m.goal_error_m, 2) + " mm", m.success},
      {"speed", "at most 0.5 m/s, not violated",
       "at most " + number(moved, 4) + " m/s, commanded " + number(m.peak_v, 6), kept},
      {"acceleration", "no limit given", "up to " + number(m.peak_a, 3) + " m/s^2 (commanded)"},
      {"duration", "not given",
       fixed(m.duration_s, 2) + " s, of them " + number(MOTION_BEGINS, 2) + " s before it moves"},
      {"clearance", "not given", fixed(1000. * m.min_clearance_m, 0) + " mm of the arm from itself and the ground"}};
  if (script.events.back().via) {
    const double missed = passes(run, *script.events.back().via);
    replica.comparisons.push_back({"goes through", text(*script.events.back().via),
                                   "the true tool passes it at " + number(1000. * missed, 2) + " mm", missed < 0.01});
    replica.numbers["via_distance_m"] = missed;
  }
  replica.findings = {
      "The tool was commanded to go at no more than " + number(m.peak_v, 6) +
          " m/s, where 0.5 m/s are allowed, went at up to " + number(moved, 4) + " m/s and ended " +
          number(1000. * m.goal_error_m, 2) + " mm from the goal after " + fixed(m.duration_s, 2) + " s.",
      "There is no obstacle in this scene: the thesis gives when goal and via changed and to what, which is "
      "repeated, but not where the obstacle was."};
}
} // namespace

nlohmann::ordered_json playSeenArmReplica(const Options &options)
{
  Script script = scriptOf(options.replica == "fig8.10");
  script.events[1].whenSeen = true;
  vpAvoidanceRunSpec spec = specOf(options, script);
  const double appears = appearanceOf(options.seed);
  addSeenBox(options, place(0.05, 1.05), appears, spec);
  const vpAvoidanceRun run = runAvoidanceExperiment(spec);
  const auto changed = std::find_if(run.samples.begin(), run.samples.end(), [](const vpAvoidanceSample &s) {
    return s.status == vpAvoidanceStatus::Detouring;
  });
  nlohmann::ordered_json numbers = {{"metrics", vpApp::metricsJson(run.metrics)},
                                    {"moved_peak_v", movedSpeed(run)},
                                    {"seen", changed != run.samples.end()},
                                    {"appears_s", appears},
                                    {"seen_after_s", changed == run.samples.end() ? NAN : changed->time - appears}};
  if (script.events.back().via) {
    numbers["via_distance_m"] = passes(run, *script.events.back().via);
  }
  return numbers;
}

Replica playArmReplica(const Options &options)
{
  const bool multiPoint = options.replica == "fig8.10" || options.replica == "fig8.12";
  const Script script = scriptOf(multiPoint);
  const vpAvoidanceRun run = runAvoidanceExperiment(specOf(options, script));
  Replica replica;
  replica.name = options.replica;
  replica.title = replicaTitle(options.replica);
  compare(run, script, replica);
  replica.numbers["metrics"] = vpApp::metricsJson(run.metrics);
  replica.numbers["motion_begins_s"] = MOTION_BEGINS;
  replica.numbers["max_speed_mps"] = run.spec.methodSpec.maxVelocity;
  replica.numbers["events"] = eventsOf(script);
  replica.choices = {
      "The clock of the experiments runs before the arm moves: 0.95 s of figure 8.10 and 0.55 s of figure 8.9 fit "
      "together when that is 0.4 s, which is our choice. Without it the motion were almost over at 0.95 s.",
      "The motion is in a plane 0.35 m above the ground, which is not given, and the orientation of the tool is free.",
      "A limit on the acceleration is not given; here it is 2 m/s^2, which the joints can follow.",
      "Drives by torques with the friction of the arm's file: see option --friction of visp-avoid-obstacle."};
  if (multiPoint) {
    replica.choices.emplace_back("Two arrows, two changes: the via comes at 0.95 s, the final goal at 1.15 s. When to "
                                 "be at the via is not given; "
                                 "it is half way in time from its event on.");
  }
  replica.tables.emplace_back("samples.csv", vpApp::samplesCsv(run));
  replica.run = run;
  return replica;
}
} // namespace avoidObstacle
