/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/avoidance/vpPathPlanner.h>

#include "vpPairText.h"
#include "vpPathPlanners.h"

#include <visp3/direct_core/vpLimit.h>

#include <algorithm>
#include <cmath>
#include <memory>

BEGIN_VISP_NAMESPACE

namespace
{
vpJointVector withinLimits(const vpArmModel &arm, const vpJointVector &q)
{
  return q.cwiseMax(arm.lower()).cwiseMin(arm.upper());
}

// Goal with continuous joints by the shorter way from the start; one full turn suffices for a joint without limits.
vpPathProblem problemOf(const vpArmModel &arm, const vpJointVector &start, const vpJointVector &goal)
{
  vpPathProblem problem{withinLimits(arm, start), withinLimits(arm, goal), arm.lower(), arm.upper()};
  for (int i = 0; i < arm.size(); ++i) {
    if (arm.isContinuous(i)) {
      const double from = problem.start(i);
      const double to = problem.goal(i) = from + std::remainder(problem.goal(i) - from, 2. * M_PI);
      problem.lower(i) = std::min(from, to) - M_PI;
      problem.upper(i) = std::max(from, to) + M_PI;
    }
  }
  return problem;
}
} // namespace

class vpPathPlanner::Impl
{
public:
  Impl(const vpCollisionScene &s, const vpPathPlannerSpec &p) : scene(&s), spec(p)
  {
    spec.validate();
    check = vpMakeMotionCheck(s, p);
    searching = vpPathPlanners().find(p.planner)(*check);
  }

  //! Reason why a configuration cannot be an end of any path; Solved if it can.
  vpPathStatus judge(const vpJointVector &q, const char *end, std::string &sentence) const
  {
    const vpArmModel &arm = scene->arm();
    if (q.size() != arm.size() || !(q.cwiseAbs().array() <= vpLargestCoordinate).all()) {
      sentence = std::string("The ") + end + " has " + std::to_string(q.size()) + " numbers, must have " +
                 std::to_string(arm.size()) + " finite ones.";
      return vpPathStatus::BadInput;
    }
    for (int i = 0; i < arm.size(); ++i) {
      if (!vpLimit::isBetween(arm.lower()(i), q(i), arm.upper()(i))) {
        const double limit = q(i) < 0.5 * (arm.lower()(i) + arm.upper()(i)) ? arm.lower()(i) : arm.upper()(i);
        sentence = "Joint " + arm.spec().joints[static_cast<std::size_t>(i)].name + " of the " + end + " is at " +
                   vpDigits(q(i), 17) + ", beyond its limit " + vpDigits(limit, 17) + ".";
        return vpPathStatus::OutsideLimits;
      }
    }
    return vpPathStatus::Solved;
  }

  //! True if the arm is nearer to something than the margin; the sentence names it.
  bool collides(const vpJointVector &q, const char *end, std::string &sentence)
  {
    if (!check->inCollision(q)) {
      return false;
    }
    const vpClearance pair = check->clearance(q, spec.margin + 1e-12);
    sentence = std::string("In the ") + end +
               " the arm is nearer than the margin: " + vpPairText(*scene, pair, spec.margin) + ".";
    return true;
  }

  vpPathResult plan(const vpJointVector &start, const vpJointVector &goal)
  {
    vpPathResult result;
    for (const bool isStart : {true, false}) {
      result.status = judge(isStart ? start : goal, isStart ? "start" : "goal", result.message);
      if (result.status != vpPathStatus::Solved) {
        return result;
      }
    }
    const auto begin = std::chrono::steady_clock::now();
    const vpPathProblem problem = problemOf(scene->arm(), start, goal);
    if (check->isFree(problem.start, problem.goal)) {
      result.path.points = {problem.start, problem.goal};
      result.motions = 1;
      result.planningTime = vpSecondsSince(begin);
      result.message = "The straight motion is free.";
    }
    else if (collides(problem.start, "start", result.message)) {
      result.status = vpPathStatus::StartInCollision;
    }
    else if (collides(problem.goal, "goal", result.message)) {
      result.status = vpPathStatus::GoalInCollision;
    }
    else {
      searching->search(problem, spec, result);
      result.message = messageOf(result.status);
    }
    return result;
  }

  [[nodiscard]] std::string messageOf(vpPathStatus status) const
  {
    return status == vpPathStatus::Solved ? "A path was found."
           : status == vpPathStatus::NotFree
               ? spec.planner + " returned a path that is not free; it is not used."
               : spec.planner + " found no path in " + limits() + "; that does not mean that there is none.";
  }

  //! Description of a search, for messages.
  [[nodiscard]] std::string limits() const
  {
    const std::string time = std::to_string(spec.timeLimit) + " s";
    return spec.iterations == 0 ? time : time + " or " + std::to_string(spec.iterations) + " iterations";
  }

  const vpCollisionScene *scene;
  vpPathPlannerSpec spec;
  std::unique_ptr<vpMotionCheck> check;
  std::unique_ptr<vpPathSearch> searching;
};

vpPathPlanner::vpPathPlanner(const vpCollisionScene &scene, const vpPathPlannerSpec &spec)
  : m_impl(std::make_unique<Impl>(scene, spec))
{}
vpPathPlanner::~vpPathPlanner() = default;
vpPathPlanner::vpPathPlanner(vpPathPlanner &&) noexcept = default;
vpPathPlanner &vpPathPlanner::operator=(vpPathPlanner &&) noexcept = default;

void vpPathPlanner::setTimeLimit(double seconds) noexcept
{
  m_impl->spec.timeLimit = seconds > 0. ? seconds : m_impl->spec.timeLimit;
}

void vpPathPlanner::setSeed(unsigned int seed) noexcept { m_impl->spec.seed = seed > 0 ? seed : m_impl->spec.seed; }

const vpPathPlannerSpec &vpPathPlanner::spec() const noexcept { return m_impl->spec; }

vpPathResult vpPathPlanner::plan(const vpJointVector &start, const vpJointVector &goal)
{
  return m_impl->plan(start, goal);
}

END_VISP_NAMESPACE
