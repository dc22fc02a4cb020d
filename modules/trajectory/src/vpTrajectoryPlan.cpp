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
// At most: a stop (8), a way back inside, one polynomial, a launch (8).
constexpr int segmentsPerLeg = 18;
// After the arrival: a ramp, constant velocity, braking (4), or a stop (8).
constexpr int segmentsAfter = 8;

// Rounding difference of times that are sums of different durations but equal in theory.
double rounding(double t) { return 1e-14 * t; }

// Coefficients in time of a polynomial in 0 ... 1.
std::vector<double> inTime(const vpPolynomial &p, double duration)
{
  std::vector<double> c(p.data(), p.data() + p.degree() + 1);
  double power = 1.;
  for (double &x : c) {
    x /= power;
    power *= duration;
  }
  return c;
}

vpAxisState jetInTime(const vpPolynomial &p, double s, double duration)
{
  const auto x = p.jet(s);
  const double r = 1. / duration;
  return {x[0], x[1] * r, x[2] * r * r, x[3] * r * r * r};
}
} // namespace

const char *vpToString(vpTrajectoryForm form)
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
  case vpTrajectoryForm::Own:
    return "Own";
  }
  return "";
}

vpTrajectoryPlan::vpTrajectoryPlan(int axes, int maxVias)
  : m_axes(axes), m_capacity(segmentsPerLeg * (maxVias + 1) + segmentsAfter)
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
  const int used = track.count + track.coasting;
  if (!(duration > 0.) || used >= m_capacity) {
    return;
  }
  vpTrajectorySegment &segment = m_segments[index(axis, used)];
  ++(track.finished ? track.coasting : track.count);
  segment.begin = track.end;
  segment.duration = duration;
  segment.p = relative;
  segment.p[0] += track.place;
  double way = 0., slope = 0.;
  for (int k = relative.degree(); k > 0; --k) {
    way += relative[k];
    slope += k * relative[k];
  }
  track.place += way;
  track.end += duration;
  track.coast = slope / duration;
}

void vpTrajectoryPlan::appendRamp(int axis, const vpVelocityRamp &ramp, const vpAxisState &x) noexcept
{
  double v = x[1], a = x[2];
  for (int i = 0; i < ramp.count(); ++i) {
    const double d = ramp.piece(i).duration, j = ramp.piece(i).jerk;
    append(axis, {0., v * d, a * d * d / 2., j * d * d * d / 6.}, d);
    v += d * (a + d * j / 2.);
    a += d * j;
  }
}

void vpTrajectoryPlan::endLeg(int axis, double t) noexcept { m_tracks[static_cast<std::size_t>(axis)].end = t; }

void vpTrajectoryPlan::finish(int axis, const vpAxisState &goal) noexcept
{
  Track &track = m_tracks[static_cast<std::size_t>(axis)];
  track.finished = true;
  track.goal = goal;
  track.place = goal[0];
  track.coast = goal[1];
  track.duration = track.end;
  m_duration = std::max(m_duration, track.duration);
}

bool vpTrajectoryPlan::isFinite() const noexcept
{
  for (int axis = 0; axis < m_axes; ++axis) {
    const Track &track = m_tracks[static_cast<std::size_t>(axis)];
    double sum = track.end + track.place + track.coast;
    for (int i = 0; i < track.count + track.coasting; ++i) {
      const vpTrajectorySegment &s = segment(axis, i);
      const double r = 1. / s.duration;
      sum += r * r * r; // factor of the jets
      for (int k = 0; k <= s.p.degree(); ++k) {
        sum += std::abs(s.p[k]) * r * r * r;
      }
    }
    if (!std::isfinite(sum)) {
      return false;
    }
  }
  return true;
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
  const int last = track.count + track.coasting - 1;
  if (t == track.duration || last < 0) {
    vpAxisState x = track.goal;
    x[0] += std::max(t - track.duration, 0.) * track.coast;
    return x;
  }
  if (t >= track.end) {
    return {track.place + (t - track.end) * track.coast, track.coast, 0., 0.};
  }
  int i = t > track.duration ? track.count : 0;
  while (i < last && t >= segment(axis, i + 1).begin) {
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

double vpTrajectoryPlan::endOf(int axis, int i) const noexcept
{
  const Track &track = m_tracks[static_cast<std::size_t>(axis)];
  if (i + 1 == track.count) {
    return track.duration;
  }
  return i + 1 < track.count + track.coasting ? segment(axis, i + 1).begin : track.end;
}

double vpTrajectoryPlan::nextBreak(double t, double until) const noexcept
{
  // Each axis sums its own segments; breaks that differ by rounding only are merged.
  const double later = t + rounding(until);
  double next = until;
  for (int axis = 0; axis < m_axes; ++axis) {
    const int count = segments(axis) + coasting(axis);
    for (int i = 0; i < count; ++i) {
      const double end = endOf(axis, i);
      if (end > later) {
        next = std::min(next, end);
        break;
      }
    }
  }
  return until - next > rounding(until) ? next : until;
}

vpPolynomial vpTrajectoryPlan::between(int axis, double from, double to, double &duration) const noexcept
{
  const double middle = 0.5 * (from + to), same = rounding(to);
  const int count = segments(axis) + coasting(axis);
  duration = to - from;
  for (int i = 0; i < count; ++i) {
    const vpTrajectorySegment &s = segment(axis, i);
    const double end = endOf(axis, i);
    if (middle < end) {
      // From end to end where the times agree to rounding, so that the ends are met exactly.
      const double first = std::abs(from - s.begin) <= same ? 0. : (from - s.begin) / s.duration;
      const double last = std::abs(to - end) <= same ? 1. : (to - s.begin) / s.duration;
      duration = (last - first) * s.duration;
      return s.p.composed(first, last - first);
    }
  }
  // Arrived before the others (independent axes); a goal velocity is kept.
  return vpPolynomial{at(axis, from)[0], at(axis, middle)[1] * (to - from)};
}

double vpTrajectoryPlan::peakNorm(unsigned long long axes, int order, double begin) const noexcept
{
  // Derivative with respect to time, in the interval's own time.
  const auto part = [order, this](int axis, double from, double to) {
    double duration = 0.;
    vpPolynomial x = between(axis, from, to, duration);
    for (int k = 0; k < order; ++k) {
      x = x.derivative();
      for (int i = 0; i <= x.degree(); ++i) {
        x[i] /= duration;
      }
    }
    return x;
  };
  const auto isMember = [axes](int axis) { return axis < 64 && (axes >> axis & 1) != 0; };
  double peak = 0., until = m_duration;
  for (const Track &track : m_tracks) {
    until = std::max(until, track.end);
  }
  for (double t = begin; t < until;) {
    const double end = nextBreak(t, until);
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
    // The square locates the peak; its value is computed from the components, which keeps the digits.
    const double s = squared.range().atMax;
    double norm = 0.;
    for (int axis = 0; axis < m_axes; ++axis) {
      norm = isMember(axis) ? std::hypot(norm, part(axis, t, end).value(s)) : norm;
    }
    peak = std::max(peak, norm);
    t = end;
  }
  return peak;
}

std::vector<vpTrajectoryPiece> vpTrajectoryPlan::pieces(double until) const
{
  std::vector<vpTrajectoryPiece> pieces;
  std::vector<int> next(m_tracks.size(), 0); // segment of each axis
  const double same = rounding(until);
  const auto countOf = [&](int axis) { // what follows the arrival only when it is asked for
    return segments(axis) + (until > duration(axis) + same ? coasting(axis) : 0);
  };
  const auto hasEnded = [&](int axis, double t) {
    const int i = next[static_cast<std::size_t>(axis)];
    return i < countOf(axis) && endOf(axis, i) <= t + same;
  };
  bool pending = until > 0. && std::isfinite(until);
  for (double t = 0.; pending;) {
    vpTrajectoryPiece piece;
    piece.begin = t;
    piece.end = until;
    for (int axis = 0; axis < m_axes; ++axis) {
      const int i = next[static_cast<std::size_t>(axis)];
      piece.end = i < countOf(axis) ? std::min(piece.end, endOf(axis, i)) : piece.end;
    }
    piece.end = std::max(piece.end, t);
    // A segment keeps the digits of its duration, which two times lose where it is little longer than their rounding.
    piece.duration = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < m_axes; ++axis) {
      if (hasEnded(axis, piece.end)) {
        const vpTrajectorySegment &s = segment(axis, next[static_cast<std::size_t>(axis)]);
        piece.duration = std::abs(t - s.begin) <= same ? std::min(piece.duration, s.duration) : piece.duration;
      }
    }
    piece.duration = std::isfinite(piece.duration) ? piece.duration : piece.end - t;
    pending = piece.end < until;
    for (int axis = 0; axis < m_axes; ++axis) {
      int &i = next[static_cast<std::size_t>(axis)];
      const int count = countOf(axis);
      const bool ends = hasEnded(axis, piece.end);
      const bool justEnded = i == count && count > 0 && std::abs(piece.end - endOf(axis, count - 1)) <= same;
      vpPolynomial p{at(axis, t)[0], at(axis, 0.5 * (t + piece.end))[1] * piece.duration}; // arrived long ago
      if (i < count || justEnded) {
        const vpTrajectorySegment &s = segment(axis, justEnded ? i - 1 : i);
        const double ratio = piece.duration / s.duration;
        const double first = std::abs(t - s.begin) <= same ? 0. : (t - s.begin) / s.duration;
        // Exact at the start of the motion, and later where a segment ends.
        p = s.p.composed((ends && !pieces.empty()) || justEnded ? 1. - ratio : first, ratio);
      }
      piece.coefficients.push_back(inTime(p, piece.duration));
      i += ends ? 1 : 0;
      pending = pending || hasEnded(axis, until);
    }
    t = piece.end;
    pieces.push_back(std::move(piece));
  }
  return pieces;
}

END_VISP_NAMESPACE
