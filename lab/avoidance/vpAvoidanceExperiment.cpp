/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "lab/avoidance/vpAvoidanceExperiment.h"

#include "lab/avoidance/vpAvoidanceEvaluation.h"
#include "lab/avoidance/vpTrueScene.h"

#include <visp3/core/vpException.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <deque>

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

//! \brief Sensor, latency and tracks: converts the true scene to the one read by the method.
class PerceivedScene
{
public:
  explicit PerceivedScene(const vpAvoidanceRunSpec &spec);

  /*!
   * One period: exposes when due, processes arrived results, and updates the scene to the time \e t, s.
   * \param q : True current configuration. \return True if a result arrived, even one without objects.
   */
  bool update(double t, const vpTrueScene &truth, const vpJointVector &q);
  //! Perceived scene for the method.
  [[nodiscard]] const vpCollisionScene &scene() const noexcept { return m_scene; }

private:
  struct Result {
    double arrival = 0.;
    std::vector<vpObjectSighting> sightings;
  };
  [[nodiscard]] bool isExposed(double t);
  [[nodiscard]] bool isCovered(double t) const;
  void copyExactly(const vpTrueScene &truth);

  const vpAvoidanceRunSpec *m_spec;
  vpCollisionScene m_scene;
  std::unique_ptr<vpObstacleSensor> m_sensor;
  vpObjectTracks m_tracks;
  vpCollisionData m_data;
  std::deque<Result> m_pending;
  double m_nextFrame = 0.; // number of the next exposure
  double m_now = 0.;
};

PerceivedScene::PerceivedScene(const vpAvoidanceRunSpec &spec)
  : m_spec(&spec), m_scene(*spec.arm, spec.scene), m_sensor(makeSensor(spec)), m_tracks(spec.tracks)
{}

bool PerceivedScene::isExposed(double t)
{
  if (t < m_nextFrame / m_spec->visionRate - rounding) {
    return false;
  }
  m_nextFrame += 1.;
  return !isCovered(t);
}

bool PerceivedScene::isCovered(double t) const
{
  return std::any_of(m_spec->covered.begin(), m_spec->covered.end(),
                     [t](const std::pair<double, double> &c) { return t >= c.first && t < c.second; });
}

void PerceivedScene::copyExactly(const vpTrueScene &truth)
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

bool PerceivedScene::update(double t, const vpTrueScene &truth, const vpJointVector &q)
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

constexpr double holdTime = 0.2;     // s that the arm must rest at the goal
constexpr double patience = 1.;      // s that a method may report Arrived away from the goal
constexpr double stuckTime = 3.;     // s without any motion
constexpr double longestStep = 1e-3; // s between knots of non-ideal drives

std::string seconds(double s)
{
  char text[32];
  std::snprintf(text, sizeof(text), "%g s", s);
  return text;
}

double secondsSince(std::chrono::steady_clock::time_point start)
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::unique_ptr<vpAvoidanceMethod> makeMethod(const vpAvoidanceRunSpec &spec, const vpCollisionScene &scene)
{
  auto method = spec.makeMethod ? spec.makeMethod(scene, spec.methodSpec)
                                : vpMakeAvoidanceMethod(spec.method, scene, spec.methodSpec);
  if (!method) {
    throw vpException(vpException::badValue, "makeMethod of the avoidance experiment made no method");
  }
  return method;
}

//! \brief The loop, advanced by periods.
class Loop
{
public:
  explicit Loop(vpAvoidanceRun &run)
    : m_run(&run), m_spec(&run.spec), m_truth(run.spec), m_perceived(run.spec), m_goal(run.spec),
      m_drives(*run.spec.arm, run.spec.drives), m_method(makeMethod(run.spec, m_perceived.scene()))
  {
    m_drives.reset(m_spec->start);
    m_knots.push_back({0., m_spec->start});
    m_truth.enter(0.);
    static_cast<void>(m_perceived.update(0., m_truth, m_spec->start));
    const auto begin = std::chrono::steady_clock::now();
    run.start = m_method->start(m_spec->start, m_goal.told(0.));
    run.startTime = secondsSince(begin);
    static_cast<void>(m_goal.isDue(0.)); // reported by start()
  }

  //! Log, look, step. \return False at the end of the run.
  bool cycle(double t)
  {
    m_truth.enter(t);
    vpAvoidanceSample s = observe(t);
    s.newImage = t > 0. && m_perceived.update(t, m_truth, s.q);
    if (m_goal.isDue(t)) {
      m_method->setGoal(m_goal.told(t));
      s.newImage = true;
    }
    if (s.newImage) {
      const auto begin = std::chrono::steady_clock::now();
      m_method->look();
      s.lookTime = secondsSince(begin);
      m_run->lookTimes.push_back(s.lookTime);
    }
    m_method->step(s.commanded, m_output);
    s.command = m_output.velocity;
    s.wanted = m_output.wanted;
    s.status = m_output.status;
    s.stopping = m_output.stopping;
    m_run->samples.push_back(s);
    return t < m_goal.end() || !isOver(s);
  }

  //! Moves the drives for one period.
  void move(double t)
  {
    const double period = m_spec->methodSpec.period;
    const int steps = m_spec->drives.ideal ? 1 : static_cast<int>(std::ceil(period / longestStep - 1e-9));
    const vpJointVector command = m_output.velocity;
    for (int i = 1; i <= steps; ++i) {
      m_drives.move(command, period / steps);
      m_knots.push_back({t + i * period / steps, m_drives.q()});
    }
  }

  //! The last row: the final state.
  void finish(double t)
  {
    m_run->message = vpMessage(m_output, m_perceived.scene(), m_spec->methodSpec.margin);
    if (!m_run->samples.empty() && m_run->samples.back().time == t) {
      m_run->samples.back().command.setZero();
      return;
    }
    m_truth.enter(t);
    vpAvoidanceSample s = observe(t);
    s.command = vpJointVector::Zero(s.q.size());
    s.wanted = s.tool;
    s.status = m_run->samples.back().status;
    m_run->samples.push_back(s);
  }

  [[nodiscard]] const std::vector<vpMotionKnot> &knots() const noexcept { return m_knots; }

private:
  bool isOver(const vpAvoidanceSample &s)
  {
    const bool there = vpAvoidanceEvaluation::isThere(*m_spec, s), arrived = s.status == vpAvoidanceStatus::Arrived;
    m_thereSince = there ? std::min(m_thereSince, s.time) : HUGE_VAL;
    m_arrivedSince = arrived ? std::min(m_arrivedSince, s.time) : HUGE_VAL;
    const bool still = vpAvoidanceEvaluation::isAtRest(s.command) && m_truth.isStill(s.time);
    m_stillSince = still ? std::min(m_stillSince, s.time) : HUGE_VAL;
    m_run->ended = s.time - m_thereSince >= holdTime     ? "the arm rested at the goal for " + seconds(holdTime)
                   : s.time - m_arrivedSince >= patience ? "the method reported Arrived for " + seconds(patience)
                   : s.time - m_stillSince >= stuckTime  ? "the arm stood still for " + seconds(stuckTime)
                                                         : "";
    return !m_run->ended.empty();
  }
  vpAvoidanceSample observe(double t)
  {
    vpAvoidanceSample s;
    s.time = t;
    s.q = m_drives.q();
    s.commanded = m_drives.wanted();
    m_truth.scene().place(s.q, m_data);
    s.tool = m_data.arm.tool.p;
    s.goal = m_goal.at(t).position;
    s.goalDistance = (s.tool - s.goal).norm();
    s.clearance = m_truth.scene().clearance(m_data, vpClearanceSearch::horizon);
    if (s.clearance.kind == vpCollisionKind::Object) {
      s.nearest = m_truth.scene().object(s.clearance.other).name;
    }
    return s;
  }

  vpAvoidanceRun *m_run;
  const vpAvoidanceRunSpec *m_spec;
  vpTrueScene m_truth;
  PerceivedScene m_perceived;
  vpMovingGoal m_goal;
  vpArmDrives m_drives;
  std::unique_ptr<vpAvoidanceMethod> m_method;
  vpCollisionData m_data;
  vpAvoidanceOutput m_output;
  std::vector<vpMotionKnot> m_knots;
  double m_thereSince = HUGE_VAL, m_arrivedSince = HUGE_VAL, m_stillSince = HUGE_VAL; // s
};
} // namespace

vpAvoidanceRun runAvoidanceExperiment(const vpAvoidanceRunSpec &spec, const std::function<bool(double)> &progress)
{
  spec.validate();
  vpAvoidanceRun run;
  run.spec = spec;
  Loop loop(run);
  const double period = spec.methodSpec.period;
  const long cycles = std::lround(std::ceil(spec.maxDuration / period - 1e-9)),
             reportEvery = std::max(1L, cycles / 100);
  long cycle = 0;
  for (; cycle < cycles; ++cycle) {
    const double t = static_cast<double>(cycle) * period;
    if (!loop.cycle(t)) {
      break;
    }
    loop.move(t);
    if (progress && cycle % reportEvery == 0 && !progress(static_cast<double>(cycle) / static_cast<double>(cycles))) {
      ++cycle;
      run.ended = "it was stopped";
      break;
    }
  }
  if (run.ended.empty()) {
    run.ended = "its longest duration of " + seconds(spec.maxDuration) + " was over";
  }
  loop.finish(static_cast<double>(cycle) * period);
  run.metrics = vpAvoidanceEvaluation::evaluate(run, loop.knots());
  return run;
}

END_VISP_NAMESPACE
