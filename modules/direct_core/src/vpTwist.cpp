/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/direct_core/vpTwist.h>

#include <visp3/core/vpException.h>

#include <algorithm>
#include <cmath>
#include <utility>

BEGIN_VISP_NAMESPACE

namespace
{
// Squares overflow from 1e154 on. (std::hypot of three numbers loses a NaN among zeros.)
double norm(double x, double y, double z) { return std::hypot(std::hypot(x, y), z); }
} // namespace

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

double vpTwist::linearNorm() const { return norm(m_data[0], m_data[1], m_data[2]); }

double vpTwist::angularNorm() const { return norm(m_data[3], m_data[4], m_data[5]); }

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

vpTwist vpLimitTwist(const vpTwist &twist, double maxLinear, double maxAngular)
{
  if (!twist.isFinite() || !(maxLinear > 0.) || !(maxAngular > 0.)) {
    return {};
  }
  double excess = 1.;
  for (const auto &[length, limit] : {std::pair(twist.linearNorm(), maxLinear), {twist.angularNorm(), maxAngular}}) {
    if (length > limit) { // both may be infinite, and their quotient NaN
      excess = std::max(excess, length / limit);
    }
  }
  return excess > 1. ? twist.scaled(1. / excess) : twist;
}

END_VISP_NAMESPACE
