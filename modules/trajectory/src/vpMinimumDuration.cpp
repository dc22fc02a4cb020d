/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/trajectory/vpMinimumDuration.h>
#include <visp3/trajectory/vpThesisDuration.h>

#include "vpRootKernel.h"

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace vpMinimumDuration
{
namespace
{
constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int size = vpMotionFamily::maxDegree + 1;
constexpr double farAway = 1.05; // a jump by this factor makes the search for a longer one unnecessary

double power(double x, int n)
{
  double p = 1.;
  for (int i = 0; i < n; ++i) {
    p *= x;
  }
  return p;
}

// In place: the polynomial in x = T' - T instead of T'. Its constant term becomes the excess, exactly as evaluated.
void shift(double *g, int degree, double T, double excess)
{
  for (int i = 0; i < degree; ++i) {
    for (int k = degree - 1; k >= i; --k) {
      g[k] += T * g[k + 1];
    }
  }
  g[0] = excess;
}

vpPolynomial derivativeOf(const vpMotionFamily &motion, int d, double T)
{
  const vpPolynomial first = motion.at(T).derivative();
  return d == 1 ? first : first.derivative();
}

// From one duration to the next that may be feasible, given the distance of the root of g.
double advance(double T, double root) { return std::max(T + root, T * (1. + 2. * epsilon)); }

// A derivative of the motion at the current T, with its roots.
template <int Degree> struct Level {
  double c[Degree + 1];
  double roots[Degree + 1];
  int rootCount = 0;

  template <int Upper> void differentiateFrom(const Level<Upper> &upper)
  {
    c[0] = 0.;
    vpRootKernel::differentiate(upper.c, Upper, c);
  }
  // From the roots of the derivative.
  template <int Below> void findRoots(const Level<Below> &below)
  {
    if constexpr (Degree <= 2) {
      rootCount = vpRootKernel::closedFormRoots(c, Degree, roots);
    }
    else {
      rootCount =
          vpRootKernel::rootsBetween(c, Degree, below.roots, below.rootCount, vpRootKernel::Wanted::Extrema, roots);
    }
  }
  void findRoots()
  {
    rootCount =
        Degree <= 2 ? vpRootKernel::closedFormRoots(c, Degree, roots) : vpRootKernel::allRoots(c, Degree, roots);
  }
  [[nodiscard]] double noise() const
  {
    double sum = 0.;
    for (const double x : c) {
      sum += std::abs(x);
    }
    return 2. * epsilon * sum;
  }
};

/*
 * Search over the extrema of each derivative at one T. Sizes are known at compile time, which unrolls all loops: N is
 * the degree in s, P in T.
 */
template <int N, int P> class Look
{
public:
  Look(const vpMotionFamily &motion, double T) : m_motion(motion), m_T(T) {}

  [[nodiscard]] double next(const vpAxisLimits &limits)
  {
    Level<N> place;
    Level<N - 1> velocity;
    Level<N - 2> acceleration;
    Level<N - 3> jerk;
    evaluate(m_T, place.c);
    velocity.differentiateFrom(place);
    acceleration.differentiateFrom(velocity);
    jerk.differentiateFrom(acceleration);
    const bool boundsPlace = std::isfinite(limits.minPosition) || std::isfinite(limits.maxPosition);
    const bool boundsJerk = std::isfinite(limits.jerk), boundsAcceleration = std::isfinite(limits.acceleration);
    // Without a closed form for the roots, first a bound: often no roots are needed.
    const bool boundsVelocity =
        std::isfinite(limits.velocity) &&
        !(N > 4 && vpRootKernel::isSurelyWithin(velocity.c, N - 1, limits.velocity * m_motion.share() * m_T));
    // From the highest derivative down: the roots of each split the next one into monotone pieces.
    const bool deep = boundsPlace || boundsVelocity || boundsAcceleration;
    Level<std::max(N - 4, 0)> snap;
    if (boundsJerk || (N > 5 && deep)) {
      snap.differentiateFrom(jerk);
      snap.findRoots();
    }
    if (boundsJerk) {
      boundAbsolute(jerk, snap, 3, limits.jerk);
    }
    if (deep) {
      jerk.findRoots(snap);
    }
    if (boundsAcceleration) {
      boundAbsolute(acceleration, jerk, 2, limits.acceleration);
    }
    if (m_next > farAway * m_T) {
      return nextFollowing(); // the peak velocity at T no longer matters
    }
    if (boundsPlace || boundsVelocity) {
      acceleration.findRoots(jerk);
    }
    if (boundsVelocity) {
      boundAbsolute(velocity, acceleration, 1, limits.velocity);
    }
    if (boundsPlace && m_next == m_T) { // the most expensive last, and only when all others are satisfied
      velocity.findRoots(acceleration);
      boundPosition(place, velocity, limits.minPosition, limits.maxPosition);
    }
    return nextFollowing();
  }

  // Three limits at fixed places.
  [[nodiscard]] double raise(const vpAxisLimits &limits)
  {
    if (std::isfinite(limits.velocity)) {
      boundAt(0.5, 1, limits.velocity);
    }
    if (std::isfinite(limits.acceleration)) {
      constexpr double early = 0.21132486540518712; // (3 - sqrt(3))/6
      boundAt(early, 2, limits.acceleration);
      boundAt(1. - early, 2, limits.acceleration);
    }
    return m_next;
  }

private:
  void evaluate(double T, double *c) const
  {
    for (int k = 0; k <= N; ++k) {
      c[k] = m_motion.coefficient(k, P);
      for (int m = P - 1; m >= 0; --m) {
        c[k] = c[k] * T + m_motion.coefficient(k, m);
      }
    }
  }

  // Coefficients in T of the derivative at s; see vpMotionFamily::inDuration().
  [[nodiscard]] std::array<double, 4> inDuration(double s, int d) const
  {
    std::array<double, 4> out{};
    for (int k = N; k >= d; --k) {
      const double factor = fallingFactorials[d][k];
      for (int m = 0; m <= P; ++m) {
        double &x = out[static_cast<std::size_t>(m)];
        x = x * s + factor * m_motion.coefficient(k, m);
      }
    }
    return out;
  }

  // Follows the extremum with the longest jump as it moves with T, to the roots at its next locations. Each step starts
  // where the limit is violated, so nothing is skipped; following one extremum is cheaper than searching all.
  [[nodiscard]] double nextFollowing()
  {
    constexpr int steps = 4;
    for (int k = 0; k < steps && m_last.d > 0 && m_next < infinity; ++k) {
      double y = 0.;
      m_last.s = follow(m_last.s, m_last.d, m_next, y);
      const double bound = m_last.limit * power(m_motion.share() * m_next, m_last.d);
      const double excess = m_last.sign * y - bound;
      if (!(excess > 1e-9 * bound)) {
        break;
      }
      m_next = step(inDuration(m_last.s, m_last.d), m_last, m_next, excess);
    }
    return m_next;
  }

  // |d^d p/ds^d| <= limit (share T)^d, at the extrema and, unless they are given, at the ends.
  template <int Degree, int Below>
  void boundAbsolute(const Level<Degree> &level, const Level<Below> &derivative, int d, double limit)
  {
    const double bound = limit * power(m_motion.share() * m_T, d);
    const double allowed = bound * (1. + tolerance) + level.noise();
    forEachCandidate(derivative, d, [&](double s) {
      const double y = vpRootKernel::horner(level.c, Degree, s);
      if (std::abs(y) > allowed) {
        jump({s, d, std::copysign(1., y), limit}, std::abs(y) - bound);
      }
    });
  }

  // lower <= p <= upper, all relative to the start.
  void boundPosition(const Level<N> &level, const Level<N - 1> &derivative, double lower, double upper)
  {
    // Relative to the position range where there is one, never below the rounding of p.
    const double room =
        std::max(std::isfinite(lower) ? std::abs(lower) : 0., std::isfinite(upper) ? std::abs(upper) : 0.);
    const double slack = tolerance * room + 0.5 * level.noise();
    forEachCandidate(derivative, 0, [&](double s) {
      const double y = vpRootKernel::horner(level.c, N, s);
      if (y > upper + slack) {
        jump({s, 0, 1., upper}, y - upper);
      }
      if (y < lower - slack) {
        jump({s, 0, -1., -lower}, lower - y);
      }
    });
  }

  // |d^d p/ds^d| <= limit (share T)^d at a given s.
  void boundAt(double s, int d, double limit)
  {
    const auto g = inDuration(s, d);
    const double y = ((g[3] * m_T + g[2]) * m_T + g[1]) * m_T + g[0];
    const double bound = limit * power(m_motion.share() * m_T, d);
    if (std::abs(y) > bound * (1. + 1e-9)) {
      jump({s, d, std::copysign(1., y), limit}, std::abs(y) - bound);
    }
  }

  template <int Degree, typename Check> void forEachCandidate(const Level<Degree> &derivative, int d, Check check) const
  {
    for (int i = 0; i < derivative.rootCount; ++i) {
      check(derivative.roots[i]);
    }
    if (!m_motion.isGivenAtEnds(d)) {
      check(0.);
      check(1.);
    }
  }

  struct Extremum {
    double s = 0.;
    int d = 0;
    double sign = 1.;
    double limit = 0.;
  };

  // To the next root of the extremum's own g.
  void jump(const Extremum &extremum, double excess)
  {
    const double next = step(inDuration(extremum.s, extremum.d), extremum, m_T, excess);
    if (next > m_next) {
      m_next = next;
      m_last = extremum;
    }
  }

  [[nodiscard]] double step(std::array<double, 4> g, const Extremum &extremum, double T, double excess) const
  {
    for (double &c : g) {
      c *= extremum.sign;
    }
    g[static_cast<std::size_t>(extremum.d)] -= extremum.limit * power(m_motion.share(), extremum.d);
    shift(g.data(), 3, T, excess);
    return advance(T, vpRootKernel::firstPositiveRoot(g.data(), 3));
  }

  // One Newton step from s towards the extremum of the derivative d at T, and the value there.
  [[nodiscard]] double follow(double s, int d, double T, double &value) const
  {
    double c[size];
    evaluate(T, c);
    int degree = N;
    for (int k = 0; k < d; ++k) {
      vpRootKernel::differentiate(c, degree--, c);
    }
    double y = 0., slope = 0., curvature = 0.;
    for (int k = degree; k >= 0; --k) {
      curvature = curvature * s + slope;
      slope = slope * s + y;
      y = y * s + c[k];
    }
    const double next = s - slope / (2. * curvature);
    const double place = next >= 0. && next <= 1. ? next : s;
    value = vpRootKernel::horner(c, degree, place);
    return place;
  }

  // Derivative of order d of s^k: factors [d][k].
  static constexpr double fallingFactorials[4][size] = {{1., 1., 1., 1., 1., 1., 1., 1., 1.},
                                                        {0., 1., 2., 3., 4., 5., 6., 7., 8.},
                                                        {0., 0., 2., 6., 12., 20., 30., 42., 56.},
                                                        {0., 0., 0., 6., 24., 60., 120., 210., 336.}};

  const vpMotionFamily &m_motion;
  double m_T;
  double m_next = m_T;
  Extremum m_last; // extremum that determined m_next
};

// Calls \e visit with a look of the motion's size.
template <typename Visit> double withLook(const vpMotionFamily &motion, double T, Visit visit)
{
  switch (motion.degree()) {
  case 4:
    return visit(Look<4, 2>(motion, T));
  case 5:
    return motion.power() == 2 ? visit(Look<5, 2>(motion, T)) : visit(Look<5, 3>(motion, T));
  case 6:
    return visit(Look<6, 3>(motion, T));
  case 7:
    return visit(Look<7, 3>(motion, T));
  case 8:
    return visit(Look<8, 3>(motion, T));
  default:
    return visit(Look<3, 3>(motion, T)); // coefficients beyond the degree are zero
  }
}
} // namespace

double nextCandidate(const vpMotionFamily &motion, const vpAxisLimits &limits, double T) noexcept
{
  return withLook(motion, T, [&](auto look) { return look.next(limits); });
}

double nextCandidate(const vpMotionFamily *const motions[], int count, const vpNormLimits &limits, double T) noexcept
{
  double next = T;
  for (int d = 1; d <= 2; ++d) {
    const double limit = d == 1 ? limits.velocity : limits.acceleration;
    if (!std::isfinite(limit) || count == 0) {
      continue;
    }
    vpPolynomial squared;
    for (int i = 0; i < count; ++i) {
      const vpPolynomial y = derivativeOf(*motions[i], d, T), y2 = y.times(y);
      squared.setDegree(std::max(squared.degree(), y2.degree()));
      for (int k = 0; k <= y2.degree(); ++k) {
        squared[k] += y2[k];
      }
    }
    const double share = motions[0]->share();
    const double bound = limit * limit * power(share * T, 2 * d);
    const auto check = [&](double s) {
      // The square locates the extrema; its value is computed from the components, which keeps the digits.
      double y = 0., noise = 0.;
      for (int i = 0; i < count; ++i) {
        const vpPolynomial part = derivativeOf(*motions[i], d, T);
        const double value = part.value(s);
        double magnitude = 0.;
        for (int k = 0; k <= part.degree(); ++k) {
          magnitude += std::abs(part[k]);
        }
        y += value * value;
        noise += 2. * std::abs(value) * epsilon * magnitude;
      }
      if (!(y > bound * (1. + 2. * tolerance) + noise)) {
        return;
      }
      // Sum of the squares of polynomials in T, minus limit^2 (share T)^(2 d).
      double g[2 * vpMotionFamily::maxPower + 1] = {};
      for (int i = 0; i < count; ++i) {
        const auto part = motions[i]->inDuration(s, d);
        for (std::size_t a = 0; a < part.size(); ++a) {
          for (std::size_t b = 0; b < part.size(); ++b) {
            g[a + b] += part[a] * part[b];
          }
        }
      }
      g[2 * d] -= limit * limit * power(share, 2 * d);
      const int degree = 2 * vpMotionFamily::maxPower;
      shift(g, degree, T, y - bound);
      next = std::max(next, advance(T, vpRootKernel::firstPositiveRoot(g, degree)));
    };
    for (double s : squared.derivative().roots()) {
      check(s);
    }
    if (!motions[0]->isGivenAtEnds(d)) {
      check(0.);
      check(1.);
    }
  }
  return next;
}

vpDurationAnswer solve(const vpMotionFamily &motion, const vpAxisLimits &limits, double floor) noexcept
{
  vpDurationAnswer answer;
  answer.T = floor;
  while (answer.iterations < maxIterations) {
    ++answer.iterations;
    const double next = nextCandidate(motion, limits, answer.T);
    if (next == answer.T) {
      answer.kind = vpDurationAnswer::Kind::Found;
      return answer;
    }
    if (!(next < infinity)) {
      answer.kind = vpDurationAnswer::Kind::Infeasible;
      return answer;
    }
    answer.T = next;
  }
  return answer;
}

double raiseLowerBound(const vpMotionFamily &motion, const vpAxisLimits &limits, double T) noexcept
{
  return withLook(motion, T, [&](auto look) { return look.raise(limits); });
}

double lowerBound(const vpAxisState &from, const vpAxisState &to, const vpAxisLimits &limits) noexcept
{
  const double scale = limits.velocity / limits.acceleration;
  const double smallest = 1e-6 * (std::isfinite(scale) && scale > 0. ? scale : 1.);
  return std::max({smallest, std::abs(to[0] - from[0]) / limits.velocity,
                   std::abs(to[1] - from[1]) / limits.acceleration, std::abs(to[2] - from[2]) / limits.jerk});
}
} // namespace vpMinimumDuration

namespace vpThesisDuration
{
double extraTime(const vpMotionFamily &motion, const vpAxisLimits &limits, const Gains &gains, double T) noexcept
{
  const vpPolynomial v = motion.at(T).derivative();
  double extra = -T;
  if (std::isfinite(limits.velocity)) {
    extra = std::max(extra, gains.velocity * (v.range().peak() / T - limits.velocity));
  }
  if (std::isfinite(limits.acceleration)) {
    extra = std::max(extra, gains.acceleration * (v.derivative().range().peak() / (T * T) - limits.acceleration));
  }
  return extra;
}

vpDurationAnswer solve(const vpMotionFamily &motion, const vpAxisLimits &limits, const Gains &gains, double T,
                       int steps) noexcept
{
  vpDurationAnswer answer;
  answer.T = T;
  while (answer.iterations < steps) {
    ++answer.iterations;
    const double extra = extraTime(motion, limits, gains, answer.T);
    // Reducing T by more than half at once would leave the range in which (6.6) is meaningful.
    answer.T = std::max(answer.T + extra, 0.5 * answer.T);
    if (std::abs(extra) < 1e-10 * answer.T) {
      answer.kind = vpDurationAnswer::Kind::Found;
      break;
    }
  }
  return answer;
}
} // namespace vpThesisDuration

END_VISP_NAMESPACE
