/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/trajectory/vpTrajectoryPlan.h>

#include <visp3/core/vpException.h>

#include <algorithm>
#include <cmath>
#include <limits>

BEGIN_VISP_NAMESPACE

namespace
{
// At most: braking (4) and its padding, a stop, one polynomial, a launch (4).
constexpr int segmentsPerLeg = 12;

vpAxisState jetInTime(const vpPolynomial &p, double s, double duration)
{
  const auto x = p.jet(s);
  const double r = 1. / duration;
  return {x[0], x[1] * r, x[2] * r * r, x[3] * r * r * r};
}
} // namespace

const char *toString(vpTrajectoryForm form)
{
  switch (form) {
  case vpTrajectoryForm::Hold:
    return "Hold";
  case vpTrajectoryForm::Direct:
    return "Direct";
  case vpTrajectoryForm::Cruise:
    return "Cruise";
  case vpTrajectoryForm::Ramped:
    return "Ramped";
  case vpTrajectoryForm::StopAndGo:
    return "StopAndGo";
  case vpTrajectoryForm::Vias:
    return "Vias";
  }
  return "";
}

vpTrajectoryPlan::vpTrajectoryPlan(int axes, int maxVias) : m_axes(axes), m_capacity(segmentsPerLeg * (maxVias + 1))
{
  if (axes < 1) {
    throw vpException(vpException::badValue, "a plan has %d axes, must be >= 1", axes);
  }
  if (maxVias < 0) {
    throw vpException(vpException::badValue, "a plan has room for %d vias, must be >= 0", maxVias);
  }
  m_tracks.resize(static_cast<std::size_t>(axes));
  m_segments.resize(index(axes, 0));
  m_viaTimes.resize(static_cast<std::size_t>(maxVias));
}

void vpTrajectoryPlan::clear() noexcept
{
  std::fill(m_tracks.begin(), m_tracks.end(), Track());
  m_duration = m_brakingEnd = 0.;
  m_iterations = m_vias = 0;
}

void vpTrajectoryPlan::begin(int axis, double q, vpTrajectoryForm form) noexcept
{
  Track &track = m_tracks[static_cast<std::size_t>(axis)];
  track = Track();
  track.place = q;
  track.form = form;
}

void vpTrajectoryPlan::append(int axis, const vpPolynomial &relative, double duration) noexcept
{
  Track &track = m_tracks[static_cast<std::size_t>(axis)];
  if (!(duration > 0.) || track.count >= m_capacity) {
    return;
  }
  vpTrajectorySegment &segment = m_segments[index(axis, track.count)];
  ++track.count;
  segment.begin = track.duration;
  segment.duration = duration;
  segment.p = relative;
  segment.p[0] += track.place;
  track.place += relative.value(1.) - relative[0];
  track.duration += duration;
}

void vpTrajectoryPlan::finish(int axis, const vpAxisState &goal, double rampTime) noexcept
{
  Track &track = m_tracks[static_cast<std::size_t>(axis)];
  track.goal = goal;
  track.rampTime = rampTime;
  m_duration = std::max(m_duration, track.duration);
}

void vpTrajectoryPlan::addVia(double t) noexcept
{
  if (m_vias < static_cast<int>(m_viaTimes.size())) {
    m_viaTimes[static_cast<std::size_t>(m_vias++)] = t;
  }
}

vpTrajectoryForm vpTrajectoryPlan::form() const
{
  vpTrajectoryForm worst = vpTrajectoryForm::Hold;
  for (const Track &track : m_tracks) {
    worst = std::max(worst, track.form);
  }
  return worst;
}

vpAxisState vpTrajectoryPlan::at(int axis, double t) const noexcept
{
  const Track &track = m_tracks[static_cast<std::size_t>(axis)];
  if (t >= track.duration) {
    // After the arrival: the acceleration goes down linearly, then the velocity stays.
    const double after = t - track.duration, r = track.rampTime;
    const double ramp = std::min(after, r);
    const double slope = r > 0. ? -track.goal[2] / r : 0.;
    const double a = r > 0. ? track.goal[2] : 0.;
    vpAxisState x = track.goal;
    x[0] += ramp * (track.goal[1] + ramp * (a / 2. + ramp * slope / 6.));
    x[1] += ramp * (a + ramp * slope / 2.);
    x[2] = after == 0. ? track.goal[2] : a + ramp * slope;
    x[3] = after == 0. ? track.goal[3] : (after < r ? slope : 0.);
    x[0] += (after - ramp) * x[1];
    return x;
  }
  int i = 0;
  while (i + 1 < track.count && t >= segment(axis, i + 1).begin) {
    ++i;
  }
  const vpTrajectorySegment &s = segment(axis, i);
  return jetInTime(s.p, std::clamp((t - s.begin) / s.duration, 0., 1.), s.duration);
}

vpTrajectoryPeaks vpTrajectoryPlan::peaks(int axis) const noexcept
{
  vpTrajectoryPeaks peaks;
  const vpAxisState start = at(axis, 0.);
  peaks.minPosition = peaks.maxPosition = start[0];
  for (int i = 0; i < segments(axis); ++i) {
    const vpTrajectorySegment &s = segment(axis, i);
    const double r = 1. / s.duration;
    const vpPolynomial v = s.p.derivative(), a = v.derivative(), j = a.derivative(), j2 = j.times(j);
    const auto place = s.p.range();
    peaks.minPosition = std::min(peaks.minPosition, place.min);
    peaks.maxPosition = std::max(peaks.maxPosition, place.max);
    peaks.velocity = std::max(peaks.velocity, v.range().peak() * r);
    peaks.acceleration = std::max(peaks.acceleration, a.range().peak() * r * r);
    peaks.jerk = std::max(peaks.jerk, j.range().peak() * r * r * r);
    double integral = 0.;
    for (int k = j2.degree(); k >= 0; --k) {
      integral += j2[k] / (k + 1);
    }
    peaks.squaredJerk += integral * std::pow(r, 5);
  }
  return peaks;
}

double vpTrajectoryPlan::nextBreak(double t) const noexcept
{
  // Axes add up their segments on their own; what differs by rounding only is one break.
  const double later = t + 1e-12 * m_duration;
  double next = m_duration;
  for (int axis = 0; axis < m_axes; ++axis) {
    for (int i = 0; i < segments(axis); ++i) {
      const double end = segment(axis, i).begin + segment(axis, i).duration;
      if (end > later) {
        next = std::min(next, end);
        break;
      }
    }
  }
  return next;
}

vpPolynomial vpTrajectoryPlan::between(int axis, double from, double to) const noexcept
{
  const double middle = 0.5 * (from + to);
  for (int i = 0; i < segments(axis); ++i) {
    const vpTrajectorySegment &s = segment(axis, i);
    if (middle < s.begin + s.duration) {
      return s.p.composed((from - s.begin) / s.duration, (to - from) / s.duration);
    }
  }
  // Arrived before the others (independent axes); a goal velocity is kept.
  return vpPolynomial{at(axis, from)[0], at(axis, middle)[1] * (to - from)};
}

double vpTrajectoryPlan::peakNorm(unsigned long long axes, int order) const noexcept
{
  const auto part = [order, this](int axis, double from, double to) {
    vpPolynomial x = between(axis, from, to);
    for (int k = 0; k < order; ++k) {
      x = x.derivative();
    }
    return x;
  };
  const auto isMember = [axes](int axis) { return axis < 64 && (axes >> axis & 1) != 0; };
  double peak = 0.;
  for (double t = 0.; t < m_duration;) {
    const double end = nextBreak(t);
    vpPolynomial squared;
    for (int axis = 0; axis < m_axes; ++axis) {
      if (isMember(axis)) {
        const vpPolynomial x = part(axis, t, end), x2 = x.times(x);
        squared.setDegree(std::max(squared.degree(), x2.degree()));
        for (int k = 0; k <= x2.degree(); ++k) {
          squared[k] += x2[k];
        }
      }
    }
    // The square locates the peak; its value is taken from the parts, which keeps the digits.
    const double s = squared.range().atMax;
    double norm = 0.;
    for (int axis = 0; axis < m_axes; ++axis) {
      norm = isMember(axis) ? std::hypot(norm, part(axis, t, end).value(s)) : norm;
    }
    peak = std::max(peak, norm / std::pow(end - t, order));
    t = end;
  }
  return peak;
}

std::vector<vpTrajectoryPiece> vpTrajectoryPlan::pieces() const
{
  std::vector<vpTrajectoryPiece> pieces;
  for (double t = 0.; t < m_duration;) {
    vpTrajectoryPiece piece;
    piece.begin = t;
    piece.end = nextBreak(t);
    for (int axis = 0; axis < m_axes; ++axis) {
      const vpPolynomial p = between(axis, t, piece.end);
      std::vector<double> c(p.data(), p.data() + p.degree() + 1);
      double power = 1.;
      for (double &x : c) {
        x /= power;
        power *= piece.end - t;
      }
      piece.coefficients.push_back(std::move(c));
    }
    t = piece.end;
    pieces.push_back(std::move(piece));
  }
  return pieces;
}

END_VISP_NAMESPACE
