/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpOpeningOutline.h"

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr double keptShare = 0.2; // of the half length, beyond the centre, on the damaged side

// Fraction of an interval of length h that is inside, centred `distance` outside (> 0) or inside (< 0) an edge.
double inside(double distance, double h) { return std::clamp(0.5 - distance / h, 0., 1.); }
} // namespace

vpOpeningOutline::vpOpeningOutline(const vpProductPatternSpec &spec, vpOpeningDamage damage)
  : m_shape(spec.shape), m_a(spec.openingX / 2.), m_b(spec.openingY / 2.),
    m_radius(spec.shape == vpProductShape::Rounded ? spec.cornerRadius : 0.), m_cos(std::cos(spec.rotation)),
    m_sin(std::sin(spec.rotation)), m_left(damage == vpOpeningDamage::Left ? -keptShare * m_a : -m_a),
    m_right(damage == vpOpeningDamage::Right ? keptShare * m_a : m_a),
    m_upper(damage == vpOpeningDamage::Upper ? -keptShare * m_b : -m_b),
    m_lower(damage == vpOpeningDamage::Lower ? keptShare * m_b : m_b)
{
  const double c = std::fabs(m_cos);
  const double s = std::fabs(m_sin);
  if (m_shape == vpProductShape::Dot) {
    m_halfX = std::hypot(m_a * c, m_b * s);
    m_halfY = std::hypot(m_a * s, m_b * c);
  }
  else {
    m_halfX = (m_a - m_radius) * c + (m_b - m_radius) * s + m_radius;
    m_halfY = (m_a - m_radius) * s + (m_b - m_radius) * c + m_radius;
  }
}

double vpOpeningOutline::coverage(double x, double y, double h) const
{
  const double p = m_cos * x + m_sin * y; // along the row of cells
  const double q = m_cos * y - m_sin * x;
  // A rectangle is the product of its two intervals; this also closes the damaged side.
  const double rectangle =
      inside(m_left - p, h) * inside(p - m_right, h) * inside(m_upper - q, h) * inside(q - m_lower, h);
  if (rectangle <= 0.) {
    return 0.;
  }
  if (m_shape == vpProductShape::Dot) {
    const double f = p * p / (m_a * m_a) + q * q / (m_b * m_b) - 1.;
    const double slope = 2. * std::hypot(p / (m_a * m_a), q / (m_b * m_b));
    return std::min(rectangle, inside(slope > 0. ? f / slope : -m_b, h)); // distance to first order, exact at the edge
  }
  const double cornerX = std::fabs(p) - (m_a - m_radius);
  const double cornerY = std::fabs(q) - (m_b - m_radius);
  if (m_radius > 0. && cornerX > 0. && cornerY > 0.) {
    return std::min(rectangle, inside(std::hypot(cornerX, cornerY) - m_radius, h));
  }
  return rectangle;
}

END_VISP_NAMESPACE
