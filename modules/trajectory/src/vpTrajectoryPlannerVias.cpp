/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Motions through vias: one duration over all of them, otherwise leg by leg.
#include "vpTrajectoryPlannerImpl.h"

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr double infinity = std::numeric_limits<double>::infinity();
}

// One polynomial for no via, for one position (degree 6) and for one position with velocity and acceleration (degree
// 8).
int vpTrajectoryPlanner::Impl::segments(const vpTrajectoryProblem &problem) const
{
  const int vias = problem.vias();
  return vias == 1 && problem.viaOrder(0) != 2 ? 1 : vias + 1;
}

// Families from the problem's start to its goal, for every axis.
void vpTrajectoryPlanner::Impl::makeChain(const vpTrajectoryProblem &problem)
{
  const int count = segments(problem);
  for (int i = 0; i < n; ++i) {
    from[static_cast<std::size_t>(i)] = problem.start(i);
    to[static_cast<std::size_t>(i)] = problem.goal(i);
  }
  setTasks(problem);
  for (int i = 0; i < n; ++i) {
    const vpAxisTask &task = axis(i).task;
    if (problem.vias() == 0) {
      segment(0, i) = vpMotionFamily::pointToPoint(task.from, task.to, task.order);
    }
    else if (count == 1) {
      vpAxisState via = problem.viaState(0, i);
      via[0] -= problem.start(i)[0];
      segment(0, i) = problem.viaOrder(0) == 1
                          ? vpMotionFamily::throughPosition(task.from, task.to, via[0], problem.viaTime(0))
                          : vpMotionFamily::throughState(task.from, task.to, via, problem.viaTime(0));
    }
    else {
      spline.solve(problem, i, task.from, task.to);
      for (int k = 0; k < count; ++k) {
        segment(k, i) = spline.segment(k);
      }
    }
  }
}

double vpTrajectoryPlanner::Impl::searchChain(const vpTrajectoryProblem &problem, double floor)
{
  const int count = segments(problem);
  double T = floor;
  for (int i = 0; i < n; ++i) {
    if (needsBraking(axis(i).task)) {
      return infinity; // leg by leg, braking first
    }
    T = std::max(T, vpMinimumDuration::lowerBound(axis(i).task.from, axis(i).task.to, axis(i).task.limits));
  }
  for (int look = 1; look <= vpMinimumDuration::maxIterations; ++look) {
    double candidate = T;
    for (int k = 0; k < count; ++k) {
      for (int i = 0; i < n; ++i) {
        vpAxisLimits limits = axis(i).task.limits;
        // Segments have positions relative to their own start.
        const double place = k == 0 ? 0. : problem.viaState(k - 1, i)[0] - problem.start(i)[0];
        limits.minPosition -= place;
        limits.maxPosition -= place;
        candidate = std::max(candidate, vpMinimumDuration::nextCandidate(segment(k, i), limits, T));
      }
      for (const vpAxisGroup &group : problem.spec.groups) {
        int members = 0;
        for (int i = 0; i < n; ++i) {
          if (group.contains(i)) {
            column[static_cast<std::size_t>(members++)] = &segment(k, i);
          }
        }
        const vpNormLimits norm{group.maxSpeed, group.maxAcceleration};
        candidate = std::max(candidate, vpMinimumDuration::nextCandidate(column.data(), members, norm, T));
      }
    }
    if (candidate == T || candidate == infinity) {
      iterations = std::max(iterations, look);
      return candidate;
    }
    T = candidate;
  }
  iterations = vpMinimumDuration::maxIterations;
  return infinity;
}

void vpTrajectoryPlanner::Impl::emitChain(const vpTrajectoryProblem &problem, double T, vpTrajectoryPlan &plan)
{
  const int count = segments(problem);
  for (int i = 0; i < n; ++i) {
    plan.begin(i, problem.start(i)[0], vpTrajectoryForm::Direct);
    for (int k = 0; k < count; ++k) {
      plan.append(i, segment(k, i).at(T), segment(k, i).share() * T);
    }
    plan.endLeg(i, T);
  }
  for (int k = 0; k < problem.vias(); ++k) {
    plan.addVia(problem.viaTime(k) * T);
  }
}

// Via by via with the given velocity of a via, or rest: this always has a solution.
double vpTrajectoryPlanner::Impl::planLegs(const vpTrajectoryProblem &problem, bool withFloors, vpTrajectoryPlan &plan)
{
  double total = 0.;
  plan.clear();
  for (int i = 0; i < n; ++i) {
    plan.begin(i, problem.start(i)[0], vpTrajectoryForm::Vias);
    from[static_cast<std::size_t>(i)] = problem.start(i);
  }
  for (int k = 0; k <= problem.vias(); ++k) {
    for (int i = 0; i < n; ++i) {
      to[static_cast<std::size_t>(i)] = k < problem.vias() ? problem.viaState(k, i) : problem.goal(i);
    }
    setTasks(problem);
    double &leg = legs[static_cast<std::size_t>(k)];
    leg = searchLeg(problem.spec, withFloors ? leg : 0., false);
    emitLeg(plan, total, true);
    braking = k == 0 ? groupBraking() : braking;
    total += leg;
    if (k < problem.vias()) {
      plan.addVia(total);
    }
    from = to;
  }
  return total;
}

double vpTrajectoryPlanner::Impl::planVias(const vpTrajectoryProblem &problem, double floor, vpTrajectoryPlan &plan)
{
  if (problem.spec.synchronisation != vpSynchronisation::Straight) {
    makeChain(problem);
    const double T = searchChain(problem, floor);
    if (T < infinity) {
      emitChain(problem, T, plan);
      return T;
    }
  }
  double total = planLegs(problem, false, plan);
  if (total < floor) {
    for (double &leg : legs) {
      leg *= floor / total;
    }
    total = planLegs(problem, true, plan);
  }
  return total;
}

END_VISP_NAMESPACE
