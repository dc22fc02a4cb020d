/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "runPicture.h"

#include <algorithm>

namespace vpApp
{
namespace
{
constexpr int GHOSTS = 5;
constexpr std::size_t TRACE_POINTS = 300;
constexpr double FRAME = 0.05;  // s, frame period of an animation
constexpr double LONGEST = 20.; // s

std::vector<ArmMark> marksOf(const vpAvoidanceRun &run)
{
  return {{run.samples.front().tool, "start"}, {run.samples.back().goal, "goal"}};
}

std::vector<ArmGhost> ghostsOf(const vpAvoidanceRun &run)
{
  std::vector<ArmGhost> ghosts;
  for (int i = 0; i < GHOSTS; ++i) {
    const bool first = i == 0, last = i == GHOSTS - 1;
    const vpAvoidanceSample &s = first ? run.samples.front() : sampleAt(run, i / (GHOSTS - 1.));
    ghosts.push_back({s.q, first ? "#8d99ae" : last ? "#1d3557" : "#5c7c9c", first || last ? 0.55 : 0.16});
  }
  return ghosts;
}
} // namespace

const vpAvoidanceSample &sampleAt(const vpAvoidanceRun &run, double share)
{
  const auto step = [&](std::size_t i) { return (run.samples[i].tool - run.samples[i - 1].tool).norm(); };
  double length = 0., gone = 0.;
  for (std::size_t i = 1; i < run.samples.size(); ++i) {
    length += step(i);
  }
  for (std::size_t i = 1; i < run.samples.size(); ++i) {
    gone += step(i);
    if (gone >= share * length) {
      return run.samples[i];
    }
  }
  return run.samples.back();
}

vpCollisionObject objectAt(const vpMovingObstacle &obstacle, double time)
{
  vpCollisionObject object = obstacle.object;
  obstacle.stateAt(time, object.pose, object.velocity);
  return object;
}

ArmTrace toolTrace(const vpAvoidanceRun &run, const std::string &label, const std::string &colour)
{
  ArmTrace trace;
  trace.label = label;
  trace.colour = colour;
  const std::size_t stride = std::max<std::size_t>(1, run.samples.size() / TRACE_POINTS);
  for (std::size_t i = 0; i < run.samples.size(); i += stride) {
    trace.points.push_back(run.samples[i].tool);
  }
  trace.points.push_back(run.samples.back().tool);
  return trace;
}

ArmPicture runPicture(const vpAvoidanceRun &run, const std::string &title)
{
  ArmPicture picture;
  picture.title = title;
  picture.ground = run.spec.scene.ground.has_value();
  picture.objects = run.spec.scene.objects;
  const double middle = sampleAt(run, 0.5).time;
  for (const vpMovingObstacle &obstacle : run.spec.obstacles) {
    picture.objects.push_back(objectAt(obstacle, std::max(middle, obstacle.appears)));
  }
  picture.ghosts = ghostsOf(run);
  picture.marks = marksOf(run);
  return picture;
}

ArmAnimation runAnimation(const vpAvoidanceRun &run, const std::string &title)
{
  ArmAnimation animation;
  animation.title = title;
  animation.ground = run.spec.scene.ground.has_value();
  animation.still = run.spec.scene.objects;
  for (const vpMovingObstacle &obstacle : run.spec.obstacles) {
    animation.objects.push_back(obstacle.object);
  }
  animation.marks = marksOf(run);
  double next = 0.;
  for (const vpAvoidanceSample &s : run.samples) {
    if (s.time < next - 1e-9 || s.time > LONGEST) {
      continue;
    }
    next = s.time + FRAME;
    ArmFrame frame;
    frame.time = s.time;
    frame.q = s.q;
    for (const vpMovingObstacle &obstacle : run.spec.obstacles) {
      frame.objects.push_back(objectAt(obstacle, s.time).pose);
      frame.visible.push_back(obstacle.isThere(s.time));
    }
    frame.caption = std::string(s.stopping ? "protective stop, " : "") + vpToString(s.status);
    animation.frames.push_back(frame);
  }
  return animation;
}
} // namespace vpApp
