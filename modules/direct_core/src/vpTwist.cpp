/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/direct_core/vpTwist.h>

#include <visp3/core/vpException.h>

#include <cmath>

BEGIN_VISP_NAMESPACE

vpTwist vpTwist::fromColVector(const vpColVector &v)
{
  if (v.getRows() != 6) {
    throw vpException(vpException::dimensionError, "a twist has 6 components, got a vector of %u", v.getRows());
  }
  return {v[0], v[1], v[2], v[3], v[4], v[5]};
}

vpColVector vpTwist::toColVector() const
{
  vpColVector v;
  copyTo(v);
  return v;
}

void vpTwist::copyTo(vpColVector &v) const
{
  v.resize(6, false);
  for (unsigned int i = 0; i < 6; ++i) {
    v[i] = m_data[i];
  }
}

double vpTwist::linearNorm() const
{
  return std::sqrt(m_data[0] * m_data[0] + m_data[1] * m_data[1] + m_data[2] * m_data[2]);
}

double vpTwist::angularNorm() const
{
  return std::sqrt(m_data[3] * m_data[3] + m_data[4] * m_data[4] + m_data[5] * m_data[5]);
}

bool vpTwist::isFinite() const
{
  for (double x : m_data) {
    if (!std::isfinite(x)) {
      return false;
    }
  }
  return true;
}

vpTwist vpTwist::scaled(double factor) const
{
  vpTwist out = *this;
  for (double &x : out.m_data) {
    x *= factor;
  }
  return out;
}

vpTwist limitTwist(const vpTwist &twist, double maxLinear, double maxAngular)
{
  const double excess = std::max(twist.linearNorm() / maxLinear, twist.angularNorm() / maxAngular);
  return excess > 1. ? twist.scaled(1. / excess) : twist;
}

END_VISP_NAMESPACE
