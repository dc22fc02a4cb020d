/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/avoidance/vpReachBounds.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

BEGIN_VISP_NAMESPACE

namespace
{
using Eigen::Vector3d;
constexpr int elevations = 90; // Steps of the support function from -pi/2 to pi/2.
constexpr int arcs = 8;        // First steps of the search about z,
constexpr int halvings = 6;    // and how often those are halved that may hold the largest value.
constexpr double pi = 3.14159265358979323846;
constexpr double beyond = 0.05; // of a prismatic joint's range: tolerated distance outside its limits

/*
 * Support function of a body of revolution about z: h(phi) = max over the body of x cos(phi) + z sin(phi), at samples.
 * A direction in between is a combination of its two neighbours with weights >= 0, and h is sublinear, so the same
 * combination of samples bounds it from above.
 */
class Profile
{
public:
  // Directions of the samples.
  static double sine(int k) { return table().sine[at(k)]; }
  static double cosine(int k) { return table().cosine[at(k)]; }

  // Value at the direction with the sine s.
  [[nodiscard]] double operator()(double s) const
  {
    const Table &t = table();
    const double c = std::sqrt(std::max(0., 1. - s * s));
    int k = t.below[at(static_cast<int>(0.5 * (s + 1.) * elevations))];
    while (k < elevations - 1 && t.sine[at(k + 1)] < s) {
      ++k;
    }
    const double right = s * t.cosine[at(k)] - c * t.sine[at(k)],
                 left = t.sine[at(k + 1)] * c - t.cosine[at(k + 1)] * s;
    return (left * m_values[at(k)] + right * m_values[at(k + 1)]) / t.step;
  }
  [[nodiscard]] double value(int k) const { return m_values[at(k)]; }
  void set(int k, double value) { m_values[at(k)] = value; }

private:
  struct Table {
    std::array<double, elevations + 1> sine, cosine;
    std::array<int, elevations + 1> below; // Sample at or below each of evenly spaced sines.
    double step;                           // Sine of the angle between two samples.
  };
  static std::size_t at(int k) { return static_cast<std::size_t>(k); }
  static const Table &table()
  {
    static const Table made = [] {
      Table t;
      t.step = std::sin(pi / elevations);
      for (int k = 0; k <= elevations; ++k) {
        t.sine[at(k)] = std::sin(-0.5 * pi + pi * k / elevations);
        t.cosine[at(k)] = std::max(0., std::cos(-0.5 * pi + pi * k / elevations));
      }
      for (int i = 0, k = 0; i <= elevations; ++i) {
        while (k < elevations - 1 && t.sine[at(k + 1)] <= 2. * i / elevations - 1.) {
          ++k;
        }
        t.below[at(i)] = k;
      }
      return t;
    }();
    return made;
  }

  std::array<double, elevations + 1> m_values{};
};

// Directions about z.
struct Circle {
  static constexpr int samples = arcs << halvings;
  std::array<double, samples> x, y;
  static const Circle &table()
  {
    static const Circle made = [] {
      Circle circle;
      for (std::size_t i = 0; i < circle.x.size(); ++i) {
        circle.x[i] = std::cos(2. * pi * static_cast<double>(i) / samples);
        circle.y[i] = std::sin(2. * pi * static_cast<double>(i) / samples);
      }
      return circle;
    }();
    return made;
  }
};

// Reach of a link's axes relative to a joint: a body of revolution about an axis, at any of several positions (a
// prismatic joint gives two, its ends); before the first revolute joint just the points themselves.
struct Reach {
  bool revolved = false;
  Profile body;
  Vector3d axis = Vector3d::UnitZ();
  std::vector<Vector3d> places;
};

// Transforms into the preceding frame, in which T is the pose of this one.
void step(const vpRigidTransform &T, Reach &reach)
{
  reach.axis = T.R * reach.axis;
  for (Vector3d &place : reach.places) {
    place = T.R * place + T.p;
  }
}

void slide(double low, double high, Reach &reach)
{
  std::vector<Vector3d> places;
  for (const Vector3d &place : reach.places) {
    places.push_back(place + low * Vector3d::UnitZ());
    places.push_back(place + high * Vector3d::UnitZ());
  }
  reach.places = places;
}

double support(const Reach &reach, const Vector3d &u)
{
  double most = -std::numeric_limits<double>::infinity();
  for (const Vector3d &place : reach.places) {
    most = std::max(most, u.dot(place));
  }
  return reach.revolved ? most + reach.body(std::clamp(u.dot(reach.axis), -1., 1.)) : most;
}

// Largest absolute value of the support function, or more.
double farthest(const Reach &reach)
{
  double body = 0., away = 0.;
  for (int k = 0; reach.revolved && k <= elevations; ++k) {
    body = std::max(body, std::fabs(reach.body.value(k)));
  }
  for (const Vector3d &place : reach.places) {
    away = std::max(away, place.norm());
  }
  return 1.001 * body + away;
}

/*
 * Largest value of the support function in the directions of one elevation (cosine c, sine s), or slightly more.
 *
 * A direction u between two neighbours u1 and u2 of the circle is w1 u1 + w2 u2 and some of z, with w1 + w2 <= 1 + e,
 * e = 1 / cos(half a step) - 1: h(u) <= max(h(u1), h(u2)) + 2 e times the largest |h|. Only arcs whose bound exceeds
 * what is returned in the end are halved.
 */
double largestOnCircle(const Reach &reach, double c, double s, double most)
{
  struct Arc {
    int begin, end; // samples of the circle
    double atBegin, atEnd;
  };
  const Circle &circle = Circle::table();
  const auto excess = [most](double half) { return 2. * (1. / std::cos(half) - 1.) * most; };
  const auto value = [&](int i) {
    const std::size_t k = static_cast<std::size_t>(i % Circle::samples);
    return support(reach, Vector3d(c * circle.x[k], c * circle.y[k], s));
  };
  constexpr int step = Circle::samples / arcs;
  std::array<Arc, 32 * arcs> open, next;
  const double first = value(0);
  double best = first, last = first;
  for (int i = 0; i < arcs; ++i) {
    const double now = i + 1 < arcs ? value(step * (i + 1)) : first;
    open[static_cast<std::size_t>(i)] = {step * i, step * (i + 1), last, now};
    best = std::max(best, now);
    last = now;
  }
  const double between = excess(pi / Circle::samples); // of the shortest arcs
  std::size_t count = arcs;
  double half = pi / arcs, missed = 0.;
  for (int level = 0; level < halvings; ++level, half *= 0.5) {
    const double more = excess(half);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const Arc &arc = open[i];
      if (std::max(arc.atBegin, arc.atEnd) + more <= best + between) {
        continue;
      }
      if (kept + 2 > next.size()) { // a body that is nearly round: its bound is as good as its value
        missed = std::max(missed, more);
        continue;
      }
      const int middle = (arc.begin + arc.end) / 2;
      const double there = value(middle);
      best = std::max(best, there);
      next[kept++] = {arc.begin, middle, arc.atBegin, there};
      next[kept++] = {middle, arc.end, there, arc.atEnd};
    }
    std::copy_n(next.begin(), kept, open.begin());
    count = kept;
  }
  return best + std::max(between, missed);
}

// All rotations about z.
void turn(Reach &reach)
{
  const double most = farthest(reach);
  Profile profile;
  for (int k = 0; k <= elevations; ++k) {
    const double c = Profile::cosine(k), s = Profile::sine(k);
    double value = -std::numeric_limits<double>::infinity();
    if (reach.revolved) {
      value = largestOnCircle(reach, c, s, most);
    }
    for (const Vector3d &place : reach.places) { // a point goes round a circle
      value = reach.revolved ? value : std::max(value, c * std::hypot(place.x(), place.y()) + s * place.z());
    }
    profile.set(k, value);
  }
  reach.revolved = true;
  reach.body = profile;
  reach.axis = Vector3d::UnitZ();
  reach.places = {Vector3d::Zero()};
}

// The largest distance from z, or slightly more.
double distanceFromAxis(const Reach &reach)
{
  if (reach.revolved) {
    return largestOnCircle(reach, 1., 0., farthest(reach));
  }
  double most = 0.;
  for (const Vector3d &place : reach.places) {
    most = std::max(most, std::hypot(place.x(), place.y()));
  }
  return most;
}

// Ends of the axes of a link's capsules, in the moving frame of its joint.
std::vector<Vector3d> endsOn(const vpArmModel &arm, int link)
{
  const vpRigidTransform &after = arm.chain(link - 1).after;
  std::vector<Vector3d> ends;
  for (const vpArmCapsule &capsule : arm.spec().capsules) {
    if (capsule.link == link) {
      ends.push_back(after.R * capsule.from + after.p);
      ends.push_back(after.R * capsule.to + after.p);
    }
  }
  return ends;
}
} // namespace

vpReachBounds::vpReachBounds(const vpArmModel &arm)
  : m_joints(arm.size()), m_bounds(static_cast<std::size_t>((arm.links() + 1) * arm.size()), 0.),
    m_alone(static_cast<std::size_t>((arm.links() + 1) * arm.links()), 0.)
{
  m_low.setConstant(arm.links(), -vpLargestCoordinate);
  m_high.setConstant(arm.links(), vpLargestCoordinate);
  for (int k = 0; k < arm.links(); ++k) {
    const vpArmChainJoint &own = arm.chain(k);
    m_chain.push_back(own);
    if (own.isPrismatic) {
      const double a = own.ratio * arm.lower()(own.joint) + own.offset,
                   b = own.ratio * arm.upper()(own.joint) + own.offset, more = beyond * std::fabs(b - a);
      m_low(k) = std::min(a, b) - more;
      m_high(k) = std::max(a, b) + more;
    }
  }
  for (const vpArmCapsule &capsule : arm.spec().capsules) {
    m_links.push_back(capsule.link);
  }
  for (int link = 1; link <= arm.links(); ++link) {
    follow(arm, link);
  }
}

// From the link inwards.
void vpReachBounds::follow(const vpArmModel &arm, int link)
{
  Reach reach;
  reach.places = endsOn(arm, link);
  for (int k = link - 1; k >= 0 && !reach.places.empty(); --k) {
    const vpArmChainJoint &own = arm.chain(k);
    if (k < link - 1) {
      step(arm.chain(k + 1).step, reach);
    }
    double &bound = m_alone[static_cast<std::size_t>(link * arm.links() + k)];
    if (own.isPrismatic) {
      bound = 1.;
      slide(m_low(k), m_high(k), reach);
    }
    else {
      bound = distanceFromAxis(reach) * (1. + 1e-12);
      if (k > 0) {
        turn(reach);
      }
    }
    m_bounds[static_cast<std::size_t>(link * m_joints + own.joint)] += std::fabs(own.ratio) * bound;
  }
}

bool vpReachBounds::holds(const vpJointVector &q, const vpJointVector &way) const noexcept
{
  if (q.size() != m_joints || way.size() != m_joints) {
    return false;
  }
  for (std::size_t k = 0; k < m_chain.size(); ++k) {
    const vpArmChainJoint &own = m_chain[k];
    const double at = own.ratio * q(own.joint) + own.offset, reach = std::fabs(own.ratio) * way(own.joint);
    if (!(at - reach >= m_low(static_cast<int>(k)) && at + reach <= m_high(static_cast<int>(k)))) {
      return false;
    }
  }
  return true;
}

END_VISP_NAMESPACE
