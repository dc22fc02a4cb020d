/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/avoidance/vpPathPlanner.h>

#include "vpPairText.h"
#include "vpPathPlanners.h"

#include <visp3/avoidance/vpCertifiedMotion.h>
#include <visp3/avoidance/vpDiscreteMotion.h>
#include <visp3/avoidance/vpExactChecker.h>
#include <visp3/avoidance/vpFclChecker.h>
#include <visp3/direct_core/vpLimit.h>

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

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <mutex>

namespace ob = ompl::base;
namespace og = ompl::geometric;

BEGIN_VISP_NAMESPACE

namespace
{
using Clock = std::chrono::steady_clock;
using Space = ob::RealVectorStateSpace;

double since(const Clock::time_point &start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

vpJointVector jointsOf(const ob::State *state, int n)
{
  return Eigen::Map<const Eigen::VectorXd>(state->as<Space::StateType>()->values, n);
}

// Common interface of the three motion checks.
class MotionCheck
{
public:
  virtual ~MotionCheck() = default;
  [[nodiscard]] virtual vpMotionResult motion(const vpJointVector &from, const vpJointVector &to) = 0;
  [[nodiscard]] virtual bool inCollision(const vpJointVector &q) = 0;
  // The least clearance below the cutoff.
  [[nodiscard]] virtual vpClearance clearance(const vpJointVector &q, double cutoff) = 0;
};

class Certified : public MotionCheck
{
public:
  Certified(const vpCollisionScene &scene, const vpPathPlannerSpec &spec)
    : m_checker(scene), m_margin(spec.margin), m_motion(scene, {spec.margin})
  {}
  vpMotionResult motion(const vpJointVector &from, const vpJointVector &to) VP_OVERRIDE
  {
    return m_motion.check(from, to, m_scratch);
  }
  bool inCollision(const vpJointVector &q) VP_OVERRIDE { return m_checker.inCollision(q, m_margin); }
  vpClearance clearance(const vpJointVector &q, double cutoff) VP_OVERRIDE { return m_checker.clearance(q, cutoff); }

private:
  vpExactChecker m_checker;
  double m_margin;
  vpCertifiedMotion m_motion;
  vpMotionScratch m_scratch;
};

class Discrete : public MotionCheck
{
public:
  Discrete(std::unique_ptr<vpCollisionChecker> checker, const vpPathPlannerSpec &spec)
    : m_checker(std::move(checker)), m_margin(spec.margin), m_motion(*m_checker, spec.step, spec.margin)
  {}
  vpMotionResult motion(const vpJointVector &from, const vpJointVector &to) VP_OVERRIDE
  {
    return m_motion.check(from, to);
  }
  bool inCollision(const vpJointVector &q) VP_OVERRIDE { return m_checker->inCollision(q, m_margin); }
  vpClearance clearance(const vpJointVector &q, double cutoff) VP_OVERRIDE { return m_checker->clearance(q, cutoff); }

private:
  std::unique_ptr<vpCollisionChecker> m_checker;
  double m_margin;
  vpDiscreteMotion m_motion;
};

std::unique_ptr<MotionCheck> makeCheck(const vpCollisionScene &scene, const vpPathPlannerSpec &spec)
{
  switch (spec.validation) {
  case vpMotionValidation::Discrete:
    return std::make_unique<Discrete>(std::make_unique<vpExactChecker>(scene), spec);
  case vpMotionValidation::DiscreteFcl:
    return std::make_unique<Discrete>(std::make_unique<vpFclChecker>(scene), spec);
  default:
    return std::make_unique<Certified>(scene, spec);
  }
}

// Adapter of the motion checks for OMPL.
class Validity : public ob::StateValidityChecker
{
public:
  Validity(const ob::SpaceInformationPtr &si, MotionCheck &check, int n)
    : ob::StateValidityChecker(si), m_check(&check), m_n(n)
  {}
  bool isValid(const ob::State *state) const VP_OVERRIDE
  {
    return si_->satisfiesBounds(state) && !m_check->inCollision(jointsOf(state, m_n));
  }

private:
  MotionCheck *m_check;
  int m_n;
};

class Motions : public ob::MotionValidator
{
public:
  Motions(const ob::SpaceInformationPtr &si, MotionCheck &check, int n)
    : ob::MotionValidator(si), m_check(&check), m_n(n)
  {}
  bool checkMotion(const ob::State *from, const ob::State *to) const VP_OVERRIDE { return check(from, to).isFree(); }
  bool checkMotion(const ob::State *from, const ob::State *to,
                   std::pair<ob::State *, double> &lastValid) const VP_OVERRIDE
  {
    const vpMotionResult result = check(from, to);
    if (!result.isFree()) {
      // Only the start is known to be free: the part before the collision found need not be.
      lastValid.second = 0.;
      if (lastValid.first != nullptr) {
        si_->copyState(lastValid.first, from);
      }
    }
    return result.isFree();
  }

private:
  [[nodiscard]] vpMotionResult check(const ob::State *from, const ob::State *to) const
  {
    const vpMotionResult result = m_check->motion(jointsOf(from, m_n), jointsOf(to, m_n));
    (result.isFree() ? valid_ : invalid_)++;
    return result;
  }

  MotionCheck *m_check;
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

vpJointVector withinLimits(const vpArmModel &arm, const vpJointVector &q)
{
  return q.cwiseMax(arm.lower()).cwiseMin(arm.upper());
}

// The goal with continuous joints by the shorter way from the start.
vpJointVector nearGoal(const vpArmModel &arm, const vpJointVector &start, const vpJointVector &goal)
{
  vpJointVector near = goal;
  for (int i = 0; i < arm.size(); ++i) {
    if (arm.isContinuous(i)) {
      near(i) = start(i) + std::remainder(goal(i) - start(i), 2. * M_PI);
    }
  }
  return near;
}

ob::StateSpacePtr makeSpace(const vpArmModel &arm, const vpJointVector &start, const vpJointVector &goal)
{
  auto space = std::make_shared<Space>(static_cast<unsigned int>(arm.size()));
  ob::RealVectorBounds bounds(static_cast<unsigned int>(arm.size()));
  for (int i = 0; i < arm.size(); ++i) {
    const auto k = static_cast<unsigned int>(i);
    // One full turn suffices for a joint without limits.
    bounds.setLow(k, arm.isContinuous(i) ? std::min(start(i), goal(i)) - M_PI : arm.lower()(i));
    bounds.setHigh(k, arm.isContinuous(i) ? std::max(start(i), goal(i)) + M_PI : arm.upper()(i));
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
} // namespace

std::shared_ptr<ob::Planner> vpOwnPathPlanner(const std::string &name, const std::shared_ptr<ob::SpaceInformation> &si,
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

class vpPathPlanner::Impl
{
public:
  Impl(const vpCollisionScene &s, const vpPathPlannerSpec &p) : scene(&s), spec(p)
  {
    spec.validate();
    check = makeCheck(s, p);
    ompl::msg::noOutputHandler(); // its messages are part of the result
  }

  //! Reason why a configuration cannot be an end of the path; Solved if it can.
  vpPathStatus judge(const vpJointVector &q, bool isStart, std::string &sentence)
  {
    const vpArmModel &arm = scene->arm();
    const std::string end = isStart ? "start" : "goal";
    if (q.size() != arm.size() || !(q.cwiseAbs().array() <= vpLargestCoordinate).all()) {
      sentence = "The " + end + " has " + std::to_string(q.size()) + " numbers, must have " +
                 std::to_string(arm.size()) + " finite ones.";
      return vpPathStatus::BadInput;
    }
    const vpJointVector inside = withinLimits(arm, q);
    for (int i = 0; i < arm.size(); ++i) {
      if (!vpLimit::isBetween(arm.lower()(i), q(i), arm.upper()(i))) {
        const double limit = q(i) < 0.5 * (arm.lower()(i) + arm.upper()(i)) ? arm.lower()(i) : arm.upper()(i);
        sentence = "Joint " + arm.spec().joints[static_cast<std::size_t>(i)].name + " of the " + end + " is at " +
                   vpDigits(q(i), 17) + ", beyond its limit " + vpDigits(limit, 17) + ".";
        return vpPathStatus::OutsideLimits;
      }
    }
    const vpClearance pair = check->clearance(inside, spec.margin + 1e-12);
    if (pair.kind != vpCollisionKind::None || check->inCollision(inside)) {
      sentence = "In the " + end + " the arm is nearer than the margin: " + vpPairText(*scene, pair, spec.margin) + ".";
      return isStart ? vpPathStatus::StartInCollision : vpPathStatus::GoalInCollision;
    }
    return vpPathStatus::Solved;
  }

  void search(const vpJointVector &start, const vpJointVector &goal, vpPathResult &result)
  {
    const int n = scene->arm().size();
    std::unique_lock<std::mutex> lock(seedLock());
    ompl::RNG::setSeed(spec.seed);
    const ob::StateSpacePtr space = makeSpace(scene->arm(), start, goal);
    space->setStateSamplerAllocator(
        [seed = spec.seed](const ob::StateSpace *s) mutable { return std::make_shared<Sampler>(s, seed++); });
    const auto si = std::make_shared<ob::SpaceInformation>(space);
    si->setStateValidityChecker(std::make_shared<Validity>(si, *check, n));
    const auto motions = std::make_shared<Motions>(si, *check, n);
    si->setMotionValidator(motions);
    si->setup();
    const auto problem = std::make_shared<ob::ProblemDefinition>(si);
    problem->setStartAndGoalStates(stateOf(space, start), stateOf(space, goal));
    const auto objective = std::make_shared<ob::PathLengthOptimizationObjective>(si);
    if (spec.stopAtFirst) {
      objective->setCostThreshold(ob::Cost(std::numeric_limits<double>::infinity()));
    }
    problem->setOptimizationObjective(objective);
    const ob::PlannerPtr planner = vpPathPlanners().find(spec.planner)(si, spec);
    if (!planner) {
      throw vpException(vpException::badValue, "the maker of path planner \"%s\" returned none", spec.planner.c_str());
    }
    planner->setProblemDefinition(problem);
    planner->setup();
    const auto begin = Clock::now();
    og::PathSimplifier simplifier(si);
    lock.unlock();
    const ob::PlannerStatus status = solve(*planner);
    result.planningTime = since(begin);
    const bool exact = status == ob::PlannerStatus::EXACT_SOLUTION;
    if (exact) {
      auto path = *problem->getSolutionPath()->as<og::PathGeometric>();
      const auto shortening = Clock::now();
      if (spec.shortenTime > 0.) {
        simplifier.simplify(path, spec.shortenTime);
      }
      result.shortenTime = since(shortening);
      result.path = pathOf(path, n);
    }
    result.motions = static_cast<long>(motions->getValidMotionCount() + motions->getInvalidMotionCount());
    result.status = !exact                             ? vpPathStatus::TimedOut
                    : isFree(result.path, start, goal) ? vpPathStatus::Solved
                                                       : vpPathStatus::NotFree;
    if (result.status == vpPathStatus::NotFree) {
      result.path.points.clear();
    }
  }

  //! The whole path once more: a planner that was added may have left out checks. Either direction may have been checked.
  bool isFree(const vpJointPath &path, const vpJointVector &start, const vpJointVector &goal)
  {
    bool free = path.points.size() > 1 && (path.points.front() - start).norm() < 1e-9 &&
                (path.points.back() - goal).norm() < 1e-9;
    for (std::size_t i = 1; i < path.points.size() && free; ++i) {
      const vpJointVector &a = path.points[i - 1], &b = path.points[i];
      free = check->motion(a, b).isFree() || check->motion(b, a).isFree();
    }
    return free;
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

  [[nodiscard]] ob::PlannerStatus solve(ob::Planner &planner) const
  {
    const auto time = ob::timedPlannerTerminationCondition(spec.timeLimit);
    if (spec.iterations == 0) {
      return planner.solve(time);
    }
    ob::IterationTerminationCondition rounds(spec.iterations);
    return planner.solve(ob::plannerOrTerminationCondition(time, rounds));
  }

  const vpCollisionScene *scene;
  vpPathPlannerSpec spec;
  std::unique_ptr<MotionCheck> check;
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
  vpPathResult result;
  result.status = m_impl->judge(start, true, result.message);
  if (result.status == vpPathStatus::Solved) {
    result.status = m_impl->judge(goal, false, result.message);
  }
  if (result.status != vpPathStatus::Solved) {
    return result;
  }
  const auto begin = Clock::now();
  const vpArmModel &arm = m_impl->scene->arm();
  const vpJointVector from = withinLimits(arm, start), to = nearGoal(arm, from, withinLimits(arm, goal));
  if (m_impl->check->motion(from, to).isFree()) {
    result.path.points = {from, to};
    result.motions = 1;
    result.planningTime = since(begin);
    result.message = "The straight motion is free.";
    return result;
  }
  m_impl->search(from, to, result);
  result.message = m_impl->messageOf(result.status);
  return result;
}

END_VISP_NAMESPACE
