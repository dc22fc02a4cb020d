/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "motion.h"

#include <visp3/trajectory/vpDirectTrajectory.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace planTrajectory
{
namespace
{
using Trajectory = vpDirectTrajectory<Eigen::Dynamic>;

std::runtime_error invalid(const Problem &problem, const std::string &sentence)
{
  return std::runtime_error(problem.place + ": " + sentence);
}

std::string nameOf(const Problem &problem, std::size_t event)
{
  std::ostringstream name;
  name << "event " << event << " (t = " << problem.events[event].t << " s): ";
  return name.str();
}

void appendPieces(const PlanInForce &plan, std::vector<vpTrajectoryPiece> &pieces)
{
  for (vpTrajectoryPiece &piece : plan.plan.pieces(plan.end - plan.begin)) {
    piece.begin += plan.begin;
    piece.end += plan.begin;
    pieces.push_back(std::move(piece));
  }
}

//! The piece in its own time 0 ... 1.
vpPolynomial normalised(const std::vector<double> &coefficients, double duration)
{
  vpPolynomial p;
  p.setDegree(static_cast<int>(coefficients.size()) - 1);
  double power = 1.;
  for (std::size_t k = 0; k < coefficients.size(); ++k) {
    p[static_cast<int>(k)] = coefficients[k] * power;
    power *= duration;
  }
  return p;
}

vpTrajectoryPeaks peaksOf(const std::vector<vpTrajectoryPiece> &pieces, std::size_t axis, const vpAxisState &start)
{
  vpTrajectoryPeaks peaks;
  peaks.minPosition = peaks.maxPosition = start[0];
  for (const vpTrajectoryPiece &piece : pieces) {
    const double rate = 1. / piece.duration;
    const vpPolynomial q = normalised(piece.coefficients[axis], piece.duration);
    const vpPolynomial v = q.derivative();
    const vpPolynomial a = v.derivative();
    const vpPolynomial j = a.derivative();
    const vpPolynomial::Range places = q.range();
    peaks.minPosition = std::min(peaks.minPosition, places.min);
    peaks.maxPosition = std::max(peaks.maxPosition, places.max);
    peaks.velocity = std::max(peaks.velocity, v.range().peak() * rate);
    peaks.acceleration = std::max(peaks.acceleration, a.range().peak() * rate * rate);
    peaks.jerk = std::max(peaks.jerk, j.range().peak() * rate * rate * rate);
  }
  return peaks;
}

std::vector<PlanInForce> planAtOnce(const Problem &problem)
{
  PlanInForce only;
  only.status = Trajectory::calculate(problem.input, only.plan);
  if (only.status.result == vpTrajectoryResult::InvalidInput) {
    throw invalid(problem, only.status.message());
  }
  only.end = only.plan.duration();
  return {only};
}

std::vector<PlanInForce> planCycleByCycle(const Problem &problem)
{
  std::size_t vias = problem.input.vias.size();
  for (const Event &event : problem.events) {
    vias = std::max(vias, event.input.vias.size());
  }
  Trajectory trajectory(problem.axes(), static_cast<int>(vias));
  vpTrajectoryOutput<Eigen::Dynamic> output(problem.axes());
  std::vector<PlanInForce> plans;
  const Input *input = &problem.input;
  std::size_t next = 0; // event
  double now = 0.;
  for (double cycle = 1.;;) {
    if (next < problem.events.size() && now >= problem.events[next].t) {
      input = &problem.events[next++].input;
    }
    double then = cycle * problem.dt;
    if (next < problem.events.size() && problem.events[next].t <= then) {
      then = problem.events[next].t;
    }
    cycle += then == cycle * problem.dt ? 1. : 0.;
    trajectory.step(*input, output, then - now);
    if (output.status.result == vpTrajectoryResult::InvalidInput) {
      throw invalid(problem, (next > 0 ? nameOf(problem, next - 1) : "") + output.status.message());
    }
    if (output.newPlan) {
      if (!plans.empty()) {
        plans.back().end = now;
      }
      plans.push_back({now, 0., trajectory.plan(), output.status});
    }
    now = then;
    const bool arrived =
        output.status.result == vpTrajectoryResult::Finished || output.status.result == vpTrajectoryResult::Holding;
    if (arrived && next == problem.events.size()) {
      break;
    }
    const double last = next < problem.events.size() ? problem.events.back().t : now + output.remaining;
    if (last > maxCycles * problem.dt) {
      std::ostringstream sentence;
      sentence << "the motion of " << last << " s takes more than " << maxCycles << " cycles of dt = " << problem.dt
               << " s";
      throw invalid(problem, sentence.str());
    }
  }
  plans.back().end = plans.back().begin + plans.back().plan.duration();
  return plans;
}

int badness(vpTrajectoryResult result)
{
  switch (result) {
  case vpTrajectoryResult::Braking:
    return 1;
  case vpTrajectoryResult::ArrivalInfeasible:
    return 2;
  case vpTrajectoryResult::NoFeasibleDuration:
    return 3;
  case vpTrajectoryResult::InvalidInput:
    return 4;
  default:
    return 0;
  }
}
std::string sentenceOf(const PlanInForce &plan)
{
  std::ostringstream sentence;
  if (plan.begin > 0.) {
    sentence << "at t = " << plan.begin << " s: ";
  }
  sentence << plan.status.message();
  return sentence.str();
}

std::string reached(const Problem &problem)
{
  return problem.input.spec.method == vpDurationMethod::Exact
             ? "the goal is reached within the limits"
             : "the goal is reached within the limits, which the thesis's iteration does not guarantee";
}
} // namespace

vpAxisState Motion::at(int axis, double t) const
{
  std::size_t i = 0;
  while (i + 1 < plans.size() && t >= plans[i + 1].begin) {
    ++i;
  }
  return plans[i].plan.at(axis, t - plans[i].begin);
}

Motion execute(const Problem &problem)
{
  const bool plain = problem.events.empty() && problem.input.spec.replanPeriod == 0. &&
                     problem.input.spec.method == vpDurationMethod::Exact;
  Motion motion;
  motion.plans = plain ? planAtOnce(problem) : planCycleByCycle(problem);
  const PlanInForce *worst = nullptr;
  for (const PlanInForce &plan : motion.plans) {
    appendPieces(plan, motion.pieces);
    motion.form = std::max(motion.form, plan.plan.form());
    if (badness(plan.status.result) > (worst != nullptr ? badness(worst->status.result) : 0)) {
      worst = &plan;
    }
  }
  motion.result = worst != nullptr ? worst->status.result : vpTrajectoryResult::Finished;
  motion.excess = worst != nullptr ? worst->status.excess : vpLimitExcess();
  motion.message = worst != nullptr ? sentenceOf(*worst) : reached(problem);
  for (const PlanInForce &plan : motion.plans) {
    if (&plan != worst && plan.status.fault == vpTrajectoryFault::NotStraight) {
      motion.message += "; " + sentenceOf(plan);
    }
  }
  for (int i = 0; i < problem.axes(); ++i) {
    motion.peaks.push_back(peaksOf(motion.pieces, static_cast<std::size_t>(i), motion.at(i, 0.)));
  }
  return motion;
}
} // namespace planTrajectory
