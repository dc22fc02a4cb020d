/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/printing/vpAlphaBetaFilter.h>

#include "vpPrintingCheck.h"

BEGIN_VISP_NAMESPACE

using namespace vpPrintingCheck;

namespace
{
const char *const owner = "alpha-beta filter";
}

vpAlphaBetaGains vpAlphaBetaGains::criticallyDamped(double alpha)
{
  require(alpha > 0. && alpha < 1., "alpha", owner, alpha, "in (0, 1) for critical damping");
  vpAlphaBetaGains gains;
  gains.alpha = alpha;
  gains.beta = 2. - alpha - 2. * std::sqrt(1. - alpha);
  return gains;
}

vpAlphaBetaGains vpAlphaBetaGains::steadyKalman(double alpha)
{
  require(alpha > 0. && alpha < 1., "alpha", owner, alpha, "in (0, 1) for a steady Kalman filter");
  vpAlphaBetaGains gains;
  gains.alpha = alpha;
  gains.beta = 2. * (2. - alpha) - 4. * std::sqrt(1. - alpha);
  return gains;
}

double vpAlphaBetaGains::valueVariance() const
{
  return (2. * alpha * alpha + 2. * beta - 3. * alpha * beta) / (alpha * (4. - 2. * alpha - beta));
}

double vpAlphaBetaGains::rateVariance() const { return 2. * beta * beta / (alpha * (4. - 2. * alpha - beta)); }

void vpAlphaBetaGains::validate() const
{
  require(alpha > 0. && alpha < 2., "alpha", owner, alpha, "in (0, 2)");
  require(beta > 0. && beta < 4. - 2. * alpha, "beta", owner, beta, "in (0, 4 - 2 alpha)");
}

vpAlphaBetaFilter::vpAlphaBetaFilter(const vpAlphaBetaGains &gains, double period) : m_gains(gains), m_period(period)
{
  gains.validate();
  positive("period", owner, period);
}

const vpAlphaBetaFilter::State &vpAlphaBetaFilter::step(double z, double u) noexcept
{
  if (!vpIsPlausible(z)) {
    return skip(u);
  }
  if (!m_state.started) {
    reset(z, 0.);
    m_state.measured = true;
    return m_state;
  }
  skip(u);
  m_state.measured = true;
  m_state.residual = z - m_state.value;
  m_state.value += m_gains.alpha * m_state.residual;
  m_state.rate += m_gains.beta * m_state.residual / m_period;
  return m_state;
}

const vpAlphaBetaFilter::State &vpAlphaBetaFilter::skip(double u) noexcept
{
  if (m_state.started) {
    const double known = vpIsPlausible(u) ? u : 0.;
    m_state.value += m_period * (m_state.rate + 0.5 * m_period * known);
    m_state.rate += m_period * known;
  }
  m_state.residual = 0.;
  m_state.measured = false;
  return m_state;
}

double vpAlphaBetaFilter::predict(double dt) const noexcept
{
  return vpIsPlausible(dt) ? m_state.value + dt * m_state.rate : m_state.value;
}

void vpAlphaBetaFilter::reset(double value, double rate) noexcept
{
  if (!vpIsPlausible(value) || !vpIsPlausible(rate)) {
    return;
  }
  m_state = State();
  m_state.value = value;
  m_state.rate = rate;
  m_state.started = true;
}

END_VISP_NAMESPACE
