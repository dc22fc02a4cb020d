/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpCoupledAxes.h"

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double worthwhile = 0.8; // the cruise form replaces the minimum-jerk polynomial where it saves a fifth
} // namespace

void vpCoupledAxes::reserve(int axes)
{
  m_members.resize(static_cast<std::size_t>(axes));
  m_steps.resize(static_cast<std::size_t>(axes));
  m_families.resize(static_cast<std::size_t>(axes));
}

void vpCoupledAxes::clear() noexcept
{
  m_count = 0;
  m_hasNorm = false;
}

void vpCoupledAxes::prepare(bool allowCruise) noexcept
{
  m_allowCruise = allowCruise && order() == 3;
  m_droppedGoal = m_rampedReady = m_softReady = m_lastBuilt = m_lastReady = m_cruiseReady = false;
  m_iterations = 0;
  m_braking = 0.;
  bool outside = m_hasNorm && breaksNorm();
  for (int i = 0; i < m_count; ++i) {
    at(i)[vpMotionAxis::Direct].open(at(i).task);
    outside = outside || needsBraking(at(i).task);
  }
  m_tailRamp = commonRamp(false);
  if (m_tailRamp < 0.) {
    dropGoalAcceleration();
  }
  m_headRamp = outside ? 0. : commonRamp(true);
  if (outside || m_headRamp < 0.) {
    brake();
    m_headRamp = 0.; // braking ends with zero acceleration
  }
  boundPositions();
  close(vpMotionAxis::Direct);
  m_estimate = 0.;
  for (int i = 0; i < m_count; ++i) {
    m_estimate = std::max(m_estimate, at(i)[vpMotionAxis::Direct].least());
  }
  m_own = infinity;
  const bool isOut = isOutside();
  if (isOut || m_braking > 0.) {
    takeLast();
  }
  if (isOut) {
    const double own = search(vpMotionAxis::Direct, 0.);
    m_own = own < infinity ? own * (1. + 1e-9) : 0.;
  }
}

void vpCoupledAxes::close(Form form) noexcept
{
  for (int i = 0; i < m_count; ++i) {
    at(i)[form].close(at(i).task);
    m_none[static_cast<std::size_t>(form)] = infinity;
  }
}

// Until the fallback is needed: no form leaves the range from start to goal by more than the braking distance, nor
// exceeds the position limits.
void vpCoupledAxes::boundPositions() noexcept
{
  bool monotone = m_braking == 0. && !isOutside();
  for (int i = 0; i < m_count; ++i) {
    monotone = monotone && !at(i).task.isMoving();
  }
  m_bounded = !monotone;
  for (int i = 0; i < m_count; ++i) {
    vpAxisTask &task = at(i).task;
    const double low = std::min(0., task.to[0]), high = std::max(0., task.to[0]);
    const bool hasDistance = m_bounded && task.hasBrakingDistance();
    const auto [stop, launch] = hasDistance ? task.brakingWays() : std::pair<double, double>(0., 0.);
    const double distance = hasDistance ? std::max(std::abs(stop), std::abs(launch)) : infinity;
    at(i).low = low - distance;
    at(i).high = high + distance;
    const auto fills = [this, i](double place) { return place <= at(i).low || place >= at(i).high; };
    at(i).overshoots = (stop != 0. && fills(stop)) || (launch != 0. && fills(task.to[0] - launch));
    task.limits.minPosition = m_bounded ? std::min(low, task.minPosition) : -infinity;
    task.limits.maxPosition = m_bounded ? std::max(high, task.maxPosition) : infinity;
  }
}

// Where the fallback has to go, the other forms may go too. True when their bounds have changed.
bool vpCoupledAxes::takeLast() noexcept
{
  buildLast();
  m_roomier = false;
  if (!m_bounded) {
    return false;
  }
  bool wider = false;
  for (int i = 0; i < m_count; ++i) {
    const vpAxisTask &task = at(i).task;
    vpAxisLimits &limits = at(i).task.limits;
    double low = 0., high = 0.;
    at(i)[m_last].hull(low, high);
    const double distance = task.hasBrakingDistance() ? at(i)[m_last].brakingDistance(task.to[0]) : infinity;
    const double same = 1e-9 * (at(i).high - at(i).low), oldLow = at(i).low, oldHigh = at(i).high;
    at(i).low = std::min(low, std::min(0., task.to[0]) - distance);
    at(i).high = std::max(high, std::max(0., task.to[0]) + distance);
    m_roomier = m_roomier || at(i).low < oldLow - same || at(i).high > oldHigh + same;
    wider = wider || low < limits.minPosition || high > limits.maxPosition;
    limits.minPosition = std::min(low, limits.minPosition);
    limits.maxPosition = std::max(high, limits.maxPosition);
  }
  m_roomier = m_roomier || wider;
  if (wider) {
    m_cruiseReady = false;
    close(vpMotionAxis::Direct);
  }
  if (wider && m_rampedReady) {
    close(vpMotionAxis::Ramped);
  }
  if (m_softReady && (wider || m_last == vpMotionAxis::Soft)) { // which may include the return inside
    close(vpMotionAxis::Soft);
  }
  return wider;
}

bool vpCoupledAxes::isOutside() const noexcept
{
  for (int i = 0; i < m_count; ++i) {
    if (at(i).task.minPosition > 0. || at(i).task.maxPosition < 0.) {
      return true;
    }
  }
  return false;
}

// The extent of start and goal.
bool vpCoupledAxes::keepsPositions(Form form) const noexcept
{
  for (int i = 0; i < m_count; ++i) {
    const vpAxisTask &task = at(i).task;
    if (!std::isfinite(task.minPosition) && !std::isfinite(task.maxPosition)) {
      continue;
    }
    double low = 0., high = 0.;
    at(i)[form].hull(low, high);
    if (low < task.lowest() || high > task.highest()) {
      return false;
    }
  }
  return true;
}

// A single axis that overshoots leaves its range by more with a gentler stop.
bool vpCoupledAxes::mayBeSoft() const noexcept { return !(isSingle() && order() == 3 && at(0).overshoots); }

bool vpCoupledAxes::breaksNorm() const noexcept
{
  const double slack = 1. + 1e-12;
  double v2 = 0., a2 = 0.;
  for (int i = 0; i < m_count; ++i) {
    const vpAxisState &x = m_members[static_cast<std::size_t>(i)]->task.from;
    v2 += x[1] * x[1];
    a2 += x[2] * x[2];
  }
  return std::sqrt(v2) > m_norm.velocity * slack || std::sqrt(a2) > m_norm.acceleration * slack;
}

double vpCoupledAxes::search(Form form, double T) noexcept
{
  double &none = m_none[static_cast<std::size_t>(form)];
  if (T >= none) {
    return infinity;
  }
  none = infinity;
  int looks = 0;
  const double from = T;
  for (; looks < vpMinimumDuration::maxIterations; ++looks) {
    double candidate = T;
    for (int i = 0; i < m_count && candidate < infinity; ++i) {
      candidate = std::max(candidate, at(i)[form].next(T));
    }
    if (m_hasNorm && candidate == T) {
      const double fixed = at(0)[form].fixedDuration();
      for (int i = 0; i < m_count; ++i) {
        m_families[static_cast<std::size_t>(i)] = &at(i)[form].middle();
      }
      const double next = vpMinimumDuration::nextCandidate(m_families.data(), m_count, m_norm, T - fixed);
      candidate = next == T - fixed ? T : std::max(fixed + next, T * (1. + 4e-16));
    }
    if (candidate == T || candidate == infinity) {
      m_iterations = std::max(m_iterations, looks + 1);
      none = candidate == infinity ? from : none;
      return candidate;
    }
    T = candidate;
  }
  m_iterations = std::max(m_iterations, looks);
  none = from;
  return infinity; // undecided: use another form
}

bool vpCoupledAxes::isAtGoal(bool atRest) const noexcept
{
  for (int i = 0; i < m_count; ++i) {
    const vpAxisTask &task = m_members[static_cast<std::size_t>(i)]->task;
    for (std::size_t k = 0; k < static_cast<std::size_t>(task.order); ++k) {
      if (task.from[k] != task.to[k] || (atRest && k > 0 && task.to[k] != 0.)) {
        return false;
      }
    }
  }
  return true;
}

double vpCoupledAxes::next(double T) noexcept
{
  m_form = vpTrajectoryForm::Direct;
  m_used = vpMotionAxis::Direct;
  if (isAtGoal(T > 0.)) {
    m_form = vpTrajectoryForm::Hold;
    return T;
  }
  if (T > m_own) { // returns inside before anything else
    return searchStops(T, infinity);
  }
  double best = searchFree(T);
  bool detour = best < infinity && makesDetour(best);
  if (best < infinity && !detour) {
    return best;
  }
  if (!m_lastBuilt) { // it costs more than all others
    const double soft = searchSoft(T, best);
    if (soft < infinity) {
      return soft;
    }
    best = takeLast() ? searchFree(T) : best;
    detour = best < infinity && ((detour && !m_roomier) || makesDetour(best));
  }
  // A detour only where it is faster than stopping first.
  const bool stops = !(best < infinity) || (detour && !(best < searchLast(T)));
  return stops ? searchStops(T, best) : best;
}

// The forms without a stop.
double vpCoupledAxes::searchFree(double T) noexcept
{
  m_form = vpTrajectoryForm::Direct;
  m_used = vpMotionAxis::Direct;
  const double best = search(vpMotionAxis::Direct, T);
  const auto isBetter = [=](double cruise) { // much sooner, or in time
    return cruise < worthwhile * best || (cruise == T && T < best);
  };
  if (m_allowCruise && isBetter(std::max(T, leastCruise()))) {
    const double cruise = searchCruise(T);
    if (isBetter(cruise)) {
      m_form = vpTrajectoryForm::Cruise;
      return cruise;
    }
  }
  return best < infinity ? best : searchRamped(T);
}

bool vpCoupledAxes::makesDetour(double T) const noexcept
{
  for (int i = 0; i < m_count; ++i) {
    const vpMotionAxis &axis = at(i);
    const bool bounded = axis.low > -infinity || axis.high < infinity;
    if (bounded && !(m_form == vpTrajectoryForm::Cruise ? axis.cruise.staysWithin(axis.low, axis.high, T)
                                                        : axis[m_used].staysWithin(axis.low, axis.high, T))) {
      return true;
    }
  }
  return false;
}

double vpCoupledAxes::searchRamped(double T) noexcept
{
  m_form = vpTrajectoryForm::Ramped;
  m_used = vpMotionAxis::Ramped;
  if (!m_rampedReady) {
    buildRamped();
  }
  return at(0)[m_used].hasFixedPieces() ? search(m_used, T) : infinity;
}

// The gentle stop, unless it needs more time than another form would, or more space; infinity then.
double vpCoupledAxes::searchSoft(double T, double instead) noexcept
{
  if (!mayBeSoft()) {
    return infinity;
  }
  const vpTrajectoryForm form = m_form;
  const Form used = m_used;
  m_form = vpTrajectoryForm::StopAndGo;
  m_used = vpMotionAxis::Soft;
  if (!m_softReady) {
    buildSoft();
  }
  const double soft = search(m_used, T);
  if (soft < infinity && soft <= std::max(T, instead) && !makesDetour(soft)) {
    return soft;
  }
  m_form = form;
  m_used = used;
  return infinity;
}

double vpCoupledAxes::searchStops(double T, double instead) noexcept
{
  const double soft = T <= m_own ? searchSoft(T, instead) : infinity;
  if (soft < infinity) {
    return soft;
  }
  m_form = vpTrajectoryForm::StopAndGo;
  m_used = m_last;
  return searchLast(T);
}

double vpCoupledAxes::searchLast(double T) noexcept
{
  if (!m_lastReady) {
    close(m_last);
    m_lastReady = true;
  }
  return search(m_last, T);
}

void vpCoupledAxes::emit(vpTrajectoryPlan &plan, int member, int axis, double factor, double T) const noexcept
{
  const vpMotionAxis &m = at(member);
  if (m_form == vpTrajectoryForm::Cruise) {
    m[vpMotionAxis::Direct].emitHead(plan, axis, factor);
    m.cruise.emit(plan, axis, factor, T);
  }
  else {
    m[m_used].emit(plan, axis, factor, T);
  }
}

END_VISP_NAMESPACE
