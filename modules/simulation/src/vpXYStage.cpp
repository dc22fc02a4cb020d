/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/simulation/vpXYStage.h>

#include <visp3/core/vpException.h>

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr int partsPerStep = 32;
constexpr double stepsPerDelay = 1000.;
constexpr double longestStep = 1e6;
constexpr double largest = 1e12; // force or position

void require(bool good, const char *axis, const char *field, double value, const char *range)
{
  if (!good) {
    throw vpException(vpException::badValue, "%s of stage axis %s is %g, must be %s", field, axis, value, range);
  }
}

// Small enough that no step overflows.
bool positive(double value) { return value >= 1e-30 && value <= 1e15; }
bool notNegative(double value) { return value == 0. || positive(value); }
} // namespace

double vpXYStageAxis::friction(double velocity, double position) const
{
  const double ratio = velocity / stribeckVelocity;
  const double rise = position > viscousRiseFrom ? 1. + viscousRise : 1.;
  return coulomb + (stiction - coulomb) * std::exp(-ratio * ratio) + viscous * rise * velocity;
}

void vpXYStageAxis::validate(const char *name) const
{
  require(positive(mass), name, "mass", mass, "> 0");
  require(notNegative(viscous), name, "viscous", viscous, ">= 0");
  require(notNegative(coulomb), name, "coulomb", coulomb, ">= 0");
  require(std::isfinite(stiction) && stiction >= coulomb, name, "stiction", stiction, ">= coulomb");
  require(positive(stribeckVelocity), name, "stribeckVelocity", stribeckVelocity, "> 0");
  require(std::isfinite(viscousRise) && viscousRise >= -1., name, "viscousRise", viscousRise, ">= -1");
  require(std::isfinite(viscousRiseFrom), name, "viscousRiseFrom", viscousRiseFrom, "finite");
  require(notNegative(lag), name, "lag", lag, ">= 0");
  require(notNegative(delay), name, "delay", delay, ">= 0");
  require(maxVelocity > 0., name, "maxVelocity", maxVelocity, "> 0");
}

vpXYStageSpec vpXYStageSpec::thesis()
{
  vpXYStageSpec spec;
  spec.x.viscous = 0.02;
  spec.x.coulomb = 0.08;
  spec.x.stiction = 0.12;
  spec.x.stribeckVelocity = 0.3;
  spec.x.viscousRise = 0.3;
  spec.x.viscousRiseFrom = 5. * 220. / 4.5; // cells of 220 um, 4.5 um/px
  spec.x.lag = 0.3;
  spec.y = spec.x;
  spec.y.viscousRiseFrom = 5. * 80. / 4.5;
  return spec;
}

void vpXYStageSpec::validate() const
{
  x.validate("x");
  y.validate("y");
}

vpXYStage::vpXYStage(const vpXYStageSpec &spec) : m_spec(spec), m_axes{{spec.x, spec.y}}
{
  spec.validate();
  m_given.reserve(static_cast<std::size_t>(stepsPerDelay) + 4);
  reset();
}

void vpXYStage::reset(const Pair &position)
{
  for (const double place : position) {
    if (!(std::fabs(place) <= largest)) {
      throw vpException(vpException::badValue, "position of the stage is %g, must be finite, at most %g in magnitude",
                        place, largest);
    }
  }
  m_state = State();
  m_state.position = position;
  m_given.clear();
}

const vpXYStage::State &vpXYStage::step(double dt, const Pair &command)
{
  const double longest = std::max(m_spec.x.delay, m_spec.y.delay);
  if (!positive(dt) || dt > longestStep || dt * stepsPerDelay < longest) {
    throw vpException(vpException::badValue,
                      "time step of the stage is %g, must be > 0, at least 1/%g of its delay and at most %g", dt,
                      stepsPerDelay, longestStep);
  }
  for (const double force : command) {
    if (!(std::fabs(force) <= largest)) {
      throw vpException(vpException::badValue, "command of the stage is %g, must be finite, at most %g in magnitude",
                        force, largest);
    }
  }
  // Drop commands whose successor already acts on both axes.
  const auto stale = [&](const Given &next) { return next.time + longest <= m_state.time; };
  while (m_given.size() > 1 && stale(m_given[1])) {
    m_given.erase(m_given.begin());
  }
  m_given.push_back({m_state.time, command});
  for (std::size_t axis = 0; axis < 2; ++axis) {
    stepAxis(axis, dt);
  }
  m_state.time += dt;
  return m_state;
}

// Splits the step where a command begins to act.
void vpXYStage::stepAxis(std::size_t axis, double dt)
{
  const double delay = m_axes[axis].delay;
  const double end = m_state.time + dt;
  double now = m_state.time;
  double command = 0.; // before the first
  const auto integrateTo = [&](double until) {
    if (until > now) {
      integrate(axis, command, until - now, static_cast<int>(std::ceil(partsPerStep * (until - now) / dt)));
      now = until;
    }
  };
  for (const Given &given : m_given) {
    integrateTo(std::min(given.time + delay, end));
    if (given.time + delay > now) {
      return; // not before the end of this step
    }
    command = given.command[axis];
  }
  integrateTo(end);
}

void vpXYStage::integrate(std::size_t axis, double command, double duration, int parts)
{
  for (int k = 0; k < parts; ++k) {
    part(axis, command, duration / parts);
  }
}

void vpXYStage::part(std::size_t axis, double command, double h)
{
  const vpXYStageAxis &a = m_axes[axis];
  double &f = m_state.force[axis];
  double &v = m_state.velocity[axis];
  double &p = m_state.position[axis];

  // Mean of f' = (command - f) / lag over this part, exactly.
  const double decay = a.lag > 0. ? std::exp(-h / a.lag) : 0.;
  const double mean = command + (f - command) * (a.lag > 0. ? (1. - decay) * a.lag / h : 0.);
  f = command + (f - command) * decay;

  if (m_state.resting[axis]) {
    if (std::fabs(mean) <= a.stiction) {
      return;
    }
    m_state.resting[axis] = false;
  }
  const double direction = v != 0. ? std::copysign(1., v) : std::copysign(1., mean);
  const auto acceleration = [&](double velocity) {
    return (mean - direction * a.friction(std::fabs(velocity), p)) / a.mass;
  };
  const double middle = v + 0.5 * h * acceleration(v);
  const double next = v + h * acceleration(direction * middle > 0. ? middle : 0.);
  if (direction * next <= 0.) { // comes to rest within the part
    const double share = v == next ? 0. : v / (v - next);
    p += 0.5 * v * share * h;
    v = 0.;
    m_state.resting[axis] = a.stiction > 0.;
    if (!m_state.resting[axis]) { // nothing holds it
      v = (1. - share) * h * mean / a.mass;
      p += 0.5 * v * (1. - share) * h;
    }
    return;
  }
  const double limited = std::clamp(next, -a.maxVelocity, a.maxVelocity);
  p += 0.5 * h * (v + limited);
  v = limited;
}

END_VISP_NAMESPACE
