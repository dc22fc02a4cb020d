/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// When the vias are passed, where the user does not say.
#include "vpTrajectoryPlannerImpl.h"

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double restCost = 0.3;    // a segment with rest at one end takes so much longer
constexpr double jerkCost = 1.6;    // weight of a jerk limit beside those of velocity and acceleration
constexpr double leastShare = 0.02; // of the longest segment: also coincident vias need some time
constexpr int rounds = 4;           // chains looked at
constexpr double leastNeed = 0.05;  // no share shrinks faster
constexpr double correction = 0.6;  // exponent of the correction of a share by what its segment needs
constexpr double worthwhile = 1e-4; // relative gain of a step of the search

// Time for the distance h at the limits; the ends are not looked at.
double passage(double h, const vpAxisLimits &limits)
{
  return std::max({h / limits.velocity, std::sqrt(h / limits.acceleration), jerkCost * std::cbrt(h / limits.jerk)});
}

// 0 at an end that is passed at the speed of the segment, 1 at rest, 2 in the opposite direction.
double slowness(double velocity, double speed) { return speed > 0. ? 1. - std::clamp(velocity / speed, -1., 1.) : 1.; }

// How far a peak takes its limit, as a factor of the duration.
double excessOf(const std::array<double, 3> &peaks, const vpAxisLimits &limits)
{
  return std::max(
      {peaks[0] / limits.velocity, std::sqrt(peaks[1] / limits.acceleration), std::cbrt(peaks[2] / limits.jerk)});
}

vpAxisLimits limitsOf(const vpAxisGroup &group)
{
  vpAxisLimits limits;
  limits.velocity = group.maxSpeed;
  limits.acceleration = group.maxAcceleration;
  return limits;
}
constexpr vpViaPace eased{0.9, 0.9}; // of a single via: close to the best for random ones
} // namespace

// Times as given, or by the rule alone.
void vpTrajectoryPlanner::Impl::takeTimes(const vpTrajectoryProblem &problem)
{
  pace = {};
  if (problem.hasAutomaticVias()) {
    setShares(problem);
    takeShares(problem.vias());
    return;
  }
  for (int k = 0; k < problem.vias(); ++k) {
    taus[static_cast<std::size_t>(k)] = problem.viaTime(k);
  }
}

// Estimated time of segment k.
double vpTrajectoryPlanner::Impl::timeOf(const vpTrajectoryProblem &problem, int k)
{
  const bool fromVia = k > 0, toVia = k < problem.vias();
  const bool givenBegin = !fromVia || problem.viaOrder(k - 1) >= 2, givenEnd = !toVia || problem.viaOrder(k) >= 2;
  double longest = 0.;
  const auto see = [&](double h, double vBegin, double vEnd, const vpAxisLimits &limits) {
    const double time = passage(h, limits), speed = h / time;
    const double slow = (givenBegin ? slowness(vBegin, speed) : 0.) + (givenEnd ? slowness(vEnd, speed) : 0.);
    const double turns = (givenBegin ? std::max(-vBegin, 0.) : 0.) + (givenEnd ? std::max(-vEnd, 0.) : 0.);
    longest = std::max(longest, (time > 0. ? time * (1. + restCost * slow) : 0.) + 2. * turns / limits.acceleration);
  };
  std::array<double, vpTrajectorySpec::maxGroups> lengths{};
  for (int i = 0; i < n; ++i) {
    const vpAxisState begin = fromVia ? problem.viaState(k - 1, i) : problem.start(i);
    const vpAxisState end = toVia ? problem.viaState(k, i) : problem.goal(i);
    const double h = end[0] - begin[0], side = h < 0. ? -1. : 1.;
    see(std::abs(h), side * begin[1], side * end[1], problem.limits(i));
    for (std::size_t g = 0; g < lengths.size(); ++g) {
      lengths[g] = problem.spec.groups[g].contains(i) ? std::hypot(lengths[g], h) : lengths[g];
    }
  }
  for (std::size_t g = 0; g < lengths.size(); ++g) {
    see(lengths[g], 0., 0., limitsOf(problem.spec.groups[g]));
  }
  return longest;
}

// The rule: shares in proportion to the estimated times.
void vpTrajectoryPlanner::Impl::setShares(const vpTrajectoryProblem &problem)
{
  double longest = 0.;
  for (int k = 0; k <= problem.vias(); ++k) {
    double &share = shares[static_cast<std::size_t>(k)];
    share = timeOf(problem, k);
    longest = std::max(longest, share);
  }
  for (int k = 0; k <= problem.vias(); ++k) {
    double &share = shares[static_cast<std::size_t>(k)];
    share = longest > 0. ? std::max(share / longest, leastShare) : 1.;
  }
}

void vpTrajectoryPlanner::Impl::takeShares(int vias)
{
  double sum = 0., passed = 0.;
  for (int k = 0; k <= vias; ++k) {
    sum += shares[static_cast<std::size_t>(k)];
  }
  for (int k = 0; k < vias; ++k) {
    passed += shares[static_cast<std::size_t>(k)];
    taus[static_cast<std::size_t>(k)] = passed / sum;
  }
}

// Least duration with the shares in use.
double vpTrajectoryPlanner::Impl::tryShares(const vpTrajectoryProblem &problem, double floor)
{
  takeShares(problem.vias());
  makeChain(problem);
  return searchChain(problem, floor);
}

// The factor by which segment k alone would have to take longer, or could take less, at the duration T of the chain.
double vpTrajectoryPlanner::Impl::needOf(const vpTrajectoryProblem &problem, int k, double T)
{
  double need = 0.;
  std::array<std::array<double, 3>, vpTrajectorySpec::maxGroups> norms{};
  for (int i = 0; i < n; ++i) {
    vpPolynomial p = segment(k, i).at(T);
    const double duration = segment(k, i).share() * T;
    std::array<double, 3> peaks{};
    double unit = 1.;
    for (std::size_t d = 0; d < 3; ++d) {
      p = p.derivative();
      unit /= duration;
      peaks[d] = p.range().peak() * unit;
    }
    need = std::max(need, excessOf(peaks, axis(i).task.limits));
    for (std::size_t g = 0; g < norms.size(); ++g) {
      for (std::size_t d = 0; d < 2 && problem.spec.groups[g].contains(i); ++d) {
        norms[g][d] = std::hypot(norms[g][d], peaks[d]);
      }
    }
  }
  for (std::size_t g = 0; g < norms.size(); ++g) {
    need = std::max(need, excessOf(norms[g], limitsOf(problem.spec.groups[g])));
  }
  return need;
}

// Time from segments that do not reach their limits to those that do.
void vpTrajectoryPlanner::Impl::balanceShares(const vpTrajectoryProblem &problem, double T)
{
  for (int k = 0; k <= problem.vias(); ++k) {
    const double need = needOf(problem, k, T);
    shares[static_cast<std::size_t>(k)] *= std::pow(std::max(need, leastNeed), correction);
  }
}

// Families of the chain and its duration: with the given times, or with those of a few chains that need the least.
double vpTrajectoryPlanner::Impl::chooseTimes(const vpTrajectoryProblem &problem, double floor)
{
  takeTimes(problem);
  makeChain(problem);
  double T = searchChain(problem, floor), best = T;
  if (!problem.hasAutomaticVias() || T <= floor) {
    return T;
  }
  const bool single = segments(problem) == 1;
  const int looks = !single ? rounds : (problem.viaOrder(0) == 1 ? 2 : 1);
  bestShares = shares;
  vpViaPace bestPace = pace;
  for (int look = 1; look < looks && T < infinity && best > floor; ++look) {
    if (single) {
      pace = eased;
    }
    else {
      balanceShares(problem, T);
    }
    T = tryShares(problem, floor);
    if (T < best) {
      best = T;
      bestShares = shares;
      bestPace = pace;
    }
  }
  shares = bestShares;
  pace = bestPace;
  takeShares(problem.vias());
  makeChain(problem);
  return best;
}

namespace
{
// The least of f(x) by steps of each factor in turn, ever smaller; x and \a best are those of the start.
template <class Function> double searchFactors(std::vector<double> &x, double best, Function f)
{
  for (double step = 1.2; step > 1.01;) {
    bool better = false;
    for (double &value : x) {
      const double before = value;
      bool here = false;
      for (const double factor : {step, 1. / step}) {
        value = here ? value : before * factor;
        const double found = here ? best : f(x);
        here = here || found < best * (1. - worthwhile);
        best = here ? std::min(found, best) : best;
      }
      value = here ? value : before;
      better = better || here;
    }
    step = better ? step : std::sqrt(step);
  }
  return best;
}
} // namespace

// At the free vias of \a problem the velocities and accelerations of the chain in use.
void vpTrajectoryPlanner::Impl::giveStates(vpTrajectoryProblem &problem, double T)
{
  const bool single = segments(problem) == 1;
  for (int k = 0; k < problem.vias(); ++k) {
    if (problem.viaOrder(k) > 1) {
      continue;
    }
    for (int i = 0; i < n; ++i) {
      const vpMotionFamily &family = segment(single ? 0 : k + 1, i);
      const auto x = family.at(T).jet(single ? taus[0] : 0.);
      const double duration = family.share() * T;
      problem.setViaState(k, i, {problem.viaState(k, i)[0], x[1] / duration, x[2] / (duration * duration), 0.});
    }
    problem.setViaTime(k, taus[static_cast<std::size_t>(k)], 3);
  }
}

// Shares first, then with them the velocities at the free vias, of all axes by one factor, then also the accelerations.
bool vpTrajectoryPlanner::Impl::optimiseVias(vpTrajectoryProblem &problem)
{
  vpTrajectoryProblem trial = problem;
  for (int k = 0; k < trial.vias(); ++k) {
    trial.setViaTime(k, vpAutomaticTau, trial.viaOrder(k));
  }
  double best = chooseTimes(trial, 0.);
  if (!(best > 0. && best < infinity)) {
    return false;
  }
  const vpTrajectoryProblem free = trial;
  const auto count = static_cast<std::size_t>(trial.vias()) + 1;
  std::vector<double> x(shares.begin(), shares.begin() + static_cast<std::ptrdiff_t>(count));
  for (const std::size_t factors : {std::size_t(0), std::size_t(1), std::size_t(2)}) { // factors a via
    const vpTrajectoryProblem base = trial;
    const auto take = [&](const std::vector<double> &candidate) {
      std::copy_n(candidate.begin(), count, shares.begin());
      for (std::size_t k = 0; k + 1 < count && factors > 0; ++k) {
        for (std::size_t i = 0; i < static_cast<std::size_t>(n) && free.viaOrder(static_cast<int>(k)) == 1; ++i) {
          vpAxisState state = base.viaState(static_cast<int>(k), static_cast<int>(i));
          for (std::size_t d = 0; d < factors; ++d) {
            state[d + 1] *= candidate[count + k * factors + d];
          }
          trial.setViaState(static_cast<int>(k), static_cast<int>(i), state);
        }
      }
      return tryShares(trial, 0.);
    };
    x.resize(count);
    x.resize(count + (count - 1) * factors, 1.);
    best = searchFactors(x, take(x), take);
    static_cast<void>(take(x));
    if (factors == 0) {
      giveStates(trial, best);
    }
  }
  for (int k = 0; k < trial.vias(); ++k) {
    trial.setViaTime(k, taus[static_cast<std::size_t>(k)], trial.viaOrder(k));
  }
  problem = trial;
  return true;
}

bool vpTrajectoryPlanner::optimiseVias(vpTrajectoryProblem &problem)
{
  if (problem.vias() == 0 || problem.spec.synchronisation == vpSynchronisation::Straight) {
    return false;
  }
  m_impl->begin();
  return m_impl->optimiseVias(problem);
}

END_VISP_NAMESPACE
