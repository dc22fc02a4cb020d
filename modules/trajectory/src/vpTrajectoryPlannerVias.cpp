/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpTrajectoryPlannerImpl.h"

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
using Columns = std::array<double, 3>;

// x -= m y for a 2x2 block m on the pair y.
void subtract(const double (&m)[2][2], const Columns (&y)[2], Columns (&x)[2])
{
  for (int i = 0; i < 2; ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      x[i][c] -= m[i][0] * y[0][c] + m[i][1] * y[1][c];
    }
  }
}

void invert(const double (&m)[2][2], double (&out)[2][2])
{
  const double determinant = m[0][0] * m[1][1] - m[0][1] * m[1][0];
  out[0][0] = m[1][1] / determinant;
  out[0][1] = -m[0][1] / determinant;
  out[1][0] = -m[1][0] / determinant;
  out[1][1] = m[0][0] / determinant;
}
} // namespace

vpViaSpline::vpViaSpline(int maxVias)
  : m_nodes(static_cast<std::size_t>(maxVias) + 2), m_rows(static_cast<std::size_t>(maxVias) + 1)
{}

// Continuity of the third (row 0) and fourth (row 1) derivative at a via between segments of length l and r; rows of
// given values become identities. Unknowns are ordered so that row 0 belongs to d2 and row 1 to d1: a given value
// replaces its dual condition (d1 given: the fourth derivative may jump; d2 given: the third may).
void vpViaSpline::assemble(Row &row, const Node &before, const Node &here, const Node &after, int order) const
{
  const double l = here.time - before.time, r = after.time - here.time;
  const double l2 = l * l, r2 = r * r, l3 = l2 * l, r3 = r2 * r;
  Row full{};
  full.below[0][0] = -24. / l2;
  full.below[0][1] = -3. / l;
  full.diagonal[0][0] = 36. * (1. / r2 - 1. / l2);
  full.diagonal[0][1] = 9. * (1. / l + 1. / r);
  full.above[0][0] = 24. / r2;
  full.above[0][1] = -3. / r;
  full.below[1][0] = -168. / l3;
  full.below[1][1] = -24. / l2;
  full.diagonal[1][0] = -192. * (1. / l3 + 1. / r3);
  full.diagonal[1][1] = 36. * (1. / l2 - 1. / r2);
  full.above[1][0] = -168. / r3;
  full.above[1][1] = 24. / r2;
  for (std::size_t c = 0; c < 3; ++c) {
    const double left = here.p[c] - before.p[c], right = after.p[c] - here.p[c];
    full.right[0][c] = -60. * (left / l3 - right / r3);
    full.right[1][c] = -360. * (left / (l3 * l) + right / (r3 * r));
  }
  row = full;
  const auto give = [&row](int equation, int unknown, const Columns &value) {
    for (int k = 0; k < 2; ++k) {
      row.below[equation][k] = row.above[equation][k] = 0.;
      row.diagonal[equation][k] = k == unknown ? 1. : 0.;
    }
    row.right[equation] = value;
  };
  if (order >= 2) {
    give(1, 0, here.d1);
  }
  if (order >= 3) {
    give(0, 1, here.d2);
  }
}

void vpViaSpline::solve(const vpTrajectoryProblem &problem, const std::vector<double> &taus, int axis,
                        const vpAxisState &from, const vpAxisState &to) noexcept
{
  const int n = problem.vias();
  const auto node = [this](int i) -> Node & { return m_nodes[static_cast<std::size_t>(i)]; };
  for (int i = 0; i <= n + 1; ++i) {
    vpAxisState x = i == 0 ? from : (i > n ? to : problem.viaState(i - 1, axis));
    if (i > 0 && i <= n) {
      x[0] -= problem.start(axis)[0];
    }
    node(i).time = i == 0 ? 0. : (i > n ? 1. : taus[static_cast<std::size_t>(i - 1)]);
    node(i).p = {x[0] - from[0], 0., 0.};
    node(i).d1 = {0., x[1], 0.};
    node(i).d2 = {0., 0., x[2]};
  }
  // Block elimination downwards; `above` becomes diagonal^-1 above.
  for (int i = 1; i <= n; ++i) {
    Row &row = m_rows[static_cast<std::size_t>(i)];
    assemble(row, node(i - 1), node(i), node(i + 1), problem.viaOrder(i - 1));
    if (i == 1) {
      const Columns known[2] = {node(0).d1, node(0).d2};
      subtract(row.below, known, row.right);
    }
    else {
      const Row &previous = m_rows[static_cast<std::size_t>(i - 1)];
      subtract(row.below, previous.right, row.right);
      for (int r = 0; r < 2; ++r) {
        for (int c = 0; c < 2; ++c) {
          row.diagonal[r][c] -= row.below[r][0] * previous.above[0][c] + row.below[r][1] * previous.above[1][c];
        }
      }
    }
    if (i == n) {
      const Columns known[2] = {node(n + 1).d1, node(n + 1).d2};
      subtract(row.above, known, row.right);
    }
    double inverse[2][2];
    invert(row.diagonal, inverse);
    const Row kept = row;
    for (int r = 0; r < 2; ++r) {
      for (int c = 0; c < 2; ++c) {
        row.above[r][c] = inverse[r][0] * kept.above[0][c] + inverse[r][1] * kept.above[1][c];
      }
      for (std::size_t c = 0; c < 3; ++c) {
        row.right[r][c] = inverse[r][0] * kept.right[0][c] + inverse[r][1] * kept.right[1][c];
      }
    }
  }
  for (int i = n; i >= 1; --i) {
    Row &row = m_rows[static_cast<std::size_t>(i)];
    if (i < n) {
      subtract(row.above, m_rows[static_cast<std::size_t>(i + 1)].right, row.right);
    }
    node(i).d1 = row.right[0];
    node(i).d2 = row.right[1];
  }
}

vpMotionFamily vpViaSpline::segment(int k) const noexcept
{
  const Node &a = m_nodes[static_cast<std::size_t>(k)], &b = m_nodes[static_cast<std::size_t>(k) + 1];
  const double share = b.time - a.time;
  const auto end = [&a, share](const Node &x) {
    std::array<std::array<double, 3>, 3> e{};
    for (std::size_t c = 0; c < 3; ++c) {
      e[0][c] = x.p[c] - a.p[c];
      e[1][c] = x.d1[c] * share;
      e[2][c] = x.d2[c] * share * share;
    }
    return e;
  };
  return vpMotionFamily::chained(end(a), end(b), share);
}

namespace
{
constexpr double infinity = std::numeric_limits<double>::infinity();
}

// Motions through vias: one duration over all of them, otherwise leg by leg.

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
      if (problem.viaOrder(0) != 1) {
        segment(0, i) = vpMotionFamily::throughState(task.from, task.to, via, taus[0]);
      }
      else if (pace.isSmooth()) {
        segment(0, i) = vpMotionFamily::throughPosition(task.from, task.to, via[0], taus[0]);
      }
      else {
        segment(0, i) =
            vpMotionFamily::throughPosition(task.from, task.to, via[0], taus[0], pace.velocity, pace.acceleration);
      }
    }
    else {
      spline.solve(problem, taus, i, task.from, task.to);
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
    plan.addVia(taus[static_cast<std::size_t>(k)] * T);
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
    const double T = chooseTimes(problem, floor);
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
