/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpBiRrt.h"

#include "vpPathShortcuts.h"

#include <utility>

BEGIN_VISP_NAMESPACE

namespace
{
vpJointVector draw(const vpPathProblem &problem, vpHashRandom &random)
{
  vpJointVector q(problem.lower.size());
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    q(i) = random.uniform(problem.lower(i), problem.upper(i));
  }
  return q;
}

// The way from the root of one tree to that of the other, through the last nodes, which are the same configuration.
vpJointPath pathThrough(const vpConfigurationTree &from, const vpConfigurationTree &to)
{
  const std::vector<vpJointVector> back = from.wayToRoot(from.last()), on = to.wayToRoot(to.last());
  vpJointPath path;
  path.points.assign(back.rbegin(), back.rend());
  path.points.insert(path.points.end(), on.begin() + 1, on.end());
  return path;
}
} // namespace

bool vpBiRrt::isFree(const vpJointVector &from, const vpJointVector &to)
{
  ++m_motions;
  return m_check->isFree(from, to);
}

vpBiRrt::Step vpBiRrt::extend(vpConfigurationTree &tree, const vpJointVector &towards)
{
  const int node = tree.nearest(towards);
  const vpJointVector from = tree.at(node), way = towards - from;
  const double length = way.norm();
  const bool reaches = !(length > m_range);
  const vpJointVector to = reaches ? towards : vpJointVector(from + m_range / length * way);
  if (!isFree(from, to)) {
    return Step::Trapped;
  }
  tree.add(to, node);
  return reaches ? Step::Reached : Step::Advanced;
}

// True if the trees met, in their last nodes.
bool vpBiRrt::connect(const vpPathProblem &problem, const vpPathPlannerSpec &spec)
{
  m_fromStart.start(problem.start);
  m_fromGoal.start(problem.goal);
  vpConfigurationTree *tree = &m_fromStart, *other = &m_fromGoal;
  for (unsigned int round = 0; (spec.iterations == 0 || round < spec.iterations) && isTimeLeft(); ++round) {
    if (extend(*tree, round == 0 ? problem.goal : draw(problem, m_random)) != Step::Trapped) {
      const vpJointVector meeting = tree->at(tree->last());
      Step step = Step::Advanced;
      while (step == Step::Advanced && isTimeLeft()) {
        step = extend(*other, meeting);
      }
      if (step == Step::Reached) {
        return true;
      }
    }
    std::swap(tree, other);
  }
  return false;
}

void vpBiRrt::search(const vpPathProblem &problem, const vpPathPlannerSpec &spec, vpPathResult &result)
{
  m_begin = std::chrono::steady_clock::now();
  m_timeLimit = spec.timeLimit;
  m_random = vpHashRandom(spec.seed, vpHashRandom::Purpose::Planner, 0, 0);
  m_range = spec.range > 0. ? spec.range : 0.2 * (problem.upper - problem.lower).norm();
  m_motions = 0;
  const bool found = connect(problem, spec);
  result.planningTime = vpSecondsSince(m_begin);
  if (found) {
    result.path = pathThrough(m_fromStart, m_fromGoal);
    shorten(result.path, spec.shortenTime);
    result.shortenTime = vpSecondsSince(m_begin) - result.planningTime;
  }
  result.status = found ? vpPathStatus::Solved : vpPathStatus::TimedOut;
  result.motions = m_motions;
}

void vpBiRrt::shorten(vpJointPath &path, double time)
{
  if (time > 0.) {
    vpPathShortcuts shortcuts(*m_check, m_random);
    vpJointPath shorter = path;
    shortcuts.apply(shorter, time);
    m_motions += shortcuts.motions();
    // Pieces of motions have their own samples with discrete checks, and their own rounding.
    if (m_check->isFree(shorter)) {
      path = std::move(shorter);
    }
  }
}

END_VISP_NAMESPACE
