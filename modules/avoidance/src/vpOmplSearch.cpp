/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpOmplSearch.h"

#include <visp3/core/vpException.h>

#include <ompl/base/MotionValidator.h>
#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/base/terminationconditions/IterationTerminationCondition.h>
#include <ompl/geometric/PathSimplifier.h>
#include <ompl/geometric/planners/informedtrees/BITstar.h>
#include <ompl/geometric/planners/kpiece/KPIECE1.h>
#include <ompl/geometric/planners/prm/PRM.h>
#include <ompl/geometric/planners/rrt/RRT.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/geometric/planners/rrt/RRTstar.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <limits>
#include <memory>
#include <mutex>
#include <utility>

namespace ob = ompl::base;
namespace og = ompl::geometric;

BEGIN_VISP_NAMESPACE

namespace
{
using Clock = std::chrono::steady_clock;
using Space = ob::RealVectorStateSpace;

vpJointVector jointsOf(const ob::State *state, int n)
{
  return Eigen::Map<const Eigen::VectorXd>(state->as<Space::StateType>()->values, n);
}

// Adapter of the motion checks for OMPL.
class Validity : public ob::StateValidityChecker
{
public:
  Validity(const ob::SpaceInformationPtr &si, vpMotionCheck &check, int n)
    : ob::StateValidityChecker(si), m_check(&check), m_n(n)
  {}
  bool isValid(const ob::State *state) const VP_OVERRIDE
  {
    return si_->satisfiesBounds(state) && !m_check->inCollision(jointsOf(state, m_n));
  }

private:
  vpMotionCheck *m_check;
  int m_n;
};

class Motions : public ob::MotionValidator
{
public:
  Motions(const ob::SpaceInformationPtr &si, vpMotionCheck &check, int n)
    : ob::MotionValidator(si), m_check(&check), m_n(n)
  {}
  bool checkMotion(const ob::State *from, const ob::State *to) const VP_OVERRIDE { return isFree(from, to); }
  bool checkMotion(const ob::State *from, const ob::State *to,
                   std::pair<ob::State *, double> &lastValid) const VP_OVERRIDE
  {
    const bool free = isFree(from, to);
    if (!free) {
      // Only the start is known to be free: the part before the collision found need not be.
      lastValid.second = 0.;
      if (lastValid.first != nullptr) {
        si_->copyState(lastValid.first, from);
      }
    }
    return free;
  }

private:
  [[nodiscard]] bool isFree(const ob::State *from, const ob::State *to) const
  {
    const bool free = m_check->isFree(jointsOf(from, m_n), jointsOf(to, m_n));
    (free ? valid_ : invalid_)++;
    return free;
  }

  vpMotionCheck *m_check;
  int m_n;
};

// With its own seed: planners create samplers while searching, possibly in several threads.
class Sampler : public ob::RealVectorStateSampler
{
public:
  Sampler(const ob::StateSpace *space, unsigned int seed) : ob::RealVectorStateSampler(space)
  {
    rng_.setLocalSeed(seed);
  }
};

template <class Planner> ob::PlannerPtr withRange(const ob::SpaceInformationPtr &si, double range)
{
  auto planner = std::make_shared<Planner>(si);
  if (range > 0.) {
    planner->setRange(range);
  }
  return planner;
}

// OMPL's seeds come from one process-wide generator.
std::mutex &seedLock()
{
  static std::mutex lock;
  return lock;
}

ob::StateSpacePtr makeSpace(const vpPathProblem &problem)
{
  const auto n = static_cast<unsigned int>(problem.start.size());
  auto space = std::make_shared<Space>(n);
  ob::RealVectorBounds bounds(n);
  for (unsigned int i = 0; i < n; ++i) {
    bounds.setLow(i, problem.lower(i));
    bounds.setHigh(i, problem.upper(i));
  }
  space->setBounds(bounds);
  return space;
}

ob::ScopedState<Space> stateOf(const ob::StateSpacePtr &space, const vpJointVector &q)
{
  ob::ScopedState<Space> state(space);
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    state->values[i] = q(i);
  }
  return state;
}

vpJointPath pathOf(const og::PathGeometric &path, int n)
{
  vpJointPath result;
  for (std::size_t i = 0; i < path.getStateCount(); ++i) {
    result.points.push_back(jointsOf(path.getState(static_cast<unsigned int>(i)), n));
  }
  return result;
}
class OmplSearch : public vpPathSearch
{
public:
  OmplSearch(vpMotionCheck &check, vpPathPlanner::Maker maker) : m_check(&check), m_maker(std::move(maker))
  {
    ompl::msg::noOutputHandler(); // its messages are part of the result
  }

  void search(const vpPathProblem &given, const vpPathPlannerSpec &spec, vpPathResult &result) VP_OVERRIDE
  {
    const int n = static_cast<int>(given.start.size());
    std::unique_lock<std::mutex> lock(seedLock());
    ompl::RNG::setSeed(spec.seed);
    const ob::StateSpacePtr space = makeSpace(given);
    space->setStateSamplerAllocator(
        [seed = spec.seed](const ob::StateSpace *s) mutable { return std::make_shared<Sampler>(s, seed++); });
    const auto si = std::make_shared<ob::SpaceInformation>(space);
    si->setStateValidityChecker(std::make_shared<Validity>(si, *m_check, n));
    const auto motions = std::make_shared<Motions>(si, *m_check, n);
    si->setMotionValidator(motions);
    si->setup();
    const auto problem = std::make_shared<ob::ProblemDefinition>(si);
    problem->setStartAndGoalStates(stateOf(space, given.start), stateOf(space, given.goal));
    const auto objective = std::make_shared<ob::PathLengthOptimizationObjective>(si);
    if (spec.stopAtFirst) {
      objective->setCostThreshold(ob::Cost(std::numeric_limits<double>::infinity()));
    }
    problem->setOptimizationObjective(objective);
    const ob::PlannerPtr planner = m_maker(si, spec);
    if (!planner) {
      throw vpException(vpException::badValue, "the maker of path planner \"%s\" returned none", spec.planner.c_str());
    }
    planner->setProblemDefinition(problem);
    planner->setup();
    const auto begin = Clock::now();
    og::PathSimplifier simplifier(si);
    lock.unlock();
    const bool exact = solve(*planner, spec) == ob::PlannerStatus::EXACT_SOLUTION;
    result.planningTime = vpSecondsSince(begin);
    if (exact) {
      auto path = *problem->getSolutionPath()->as<og::PathGeometric>();
      const auto shortening = Clock::now();
      if (spec.shortenTime > 0.) {
        simplifier.simplify(path, spec.shortenTime);
      }
      result.shortenTime = vpSecondsSince(shortening);
      result.path = pathOf(path, n);
    }
    result.status = !exact                       ? vpPathStatus::TimedOut
                    : isFree(result.path, given) ? vpPathStatus::Solved
                                                 : vpPathStatus::NotFree;
    if (result.status == vpPathStatus::NotFree) {
      result.path.points.clear();
    }
    result.motions = static_cast<long>(motions->getValidMotionCount() + motions->getInvalidMotionCount());
  }

private:
  [[nodiscard]] static ob::PlannerStatus solve(ob::Planner &planner, const vpPathPlannerSpec &spec)
  {
    const auto time = ob::timedPlannerTerminationCondition(spec.timeLimit);
    if (spec.iterations == 0) {
      return planner.solve(time);
    }
    ob::IterationTerminationCondition rounds(spec.iterations);
    return planner.solve(ob::plannerOrTerminationCondition(time, rounds));
  }

  //! The whole path once more: a planner that was added may have left out checks.
  bool isFree(const vpJointPath &path, const vpPathProblem &problem)
  {
    return path.points.size() > 1 && (path.points.front() - problem.start).norm() < 1e-9 &&
           (path.points.back() - problem.goal).norm() < 1e-9 && m_check->isFree(path);
  }

  vpMotionCheck *m_check;
  vpPathPlanner::Maker m_maker;
};
} // namespace

std::shared_ptr<ob::Planner> vpMakeOmplPlanner(const std::string &name, const std::shared_ptr<ob::SpaceInformation> &si,
                                               const vpPathPlannerSpec &spec)
{
  if (name == "RRT") {
    return withRange<og::RRT>(si, spec.range);
  }
  if (name == "RRTstar") {
    return withRange<og::RRTstar>(si, spec.range);
  }
  if (name == "KPIECE") {
    return withRange<og::KPIECE1>(si, spec.range);
  }
  if (name == "PRM") {
    return std::make_shared<og::PRM>(si);
  }
  if (name == "BITstar") {
    return std::make_shared<og::BITstar>(si);
  }
  return withRange<og::RRTConnect>(si, spec.range);
}

std::unique_ptr<vpPathSearch> vpMakeOmplSearch(vpMotionCheck &check, const std::string &,
                                               const vpPathPlanner::Maker &maker)
{
  return std::make_unique<OmplSearch>(check, maker);
}

END_VISP_NAMESPACE
