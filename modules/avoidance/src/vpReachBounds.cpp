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
constexpr int elevations = 180; // Steps of the support function from -pi/2 to pi/2.
constexpr int turns = 180;      // Steps of half a turn about z.
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

// Reach of a capsule relative to a joint: a body of revolution about an axis, at any of several positions (a prismatic
// joint gives two, its ends); before the first revolute joint just the points themselves.
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

// All rotations about z.
void turn(Reach &reach)
{
  // A direction u between two neighbours u1 and u2 of a circle of one elevation is w1 u1 + w2 u2 and some of z, with w1
  // + w2 <= 1 + e, e = 1 / cos(half a step) - 1: h(u) <= max(h(u1), h(u2)) + 2 e times the body's farthest point.
  double farthest = 0., away = 0.;
  for (int k = 0; reach.revolved && k <= elevations; ++k) {
    farthest = std::max(farthest, std::fabs(reach.body.value(k)));
  }
  for (const Vector3d &place : reach.places) {
    away = std::max(away, place.norm());
  }
  const double between = 2. * (1. / std::cos(0.5 * pi / turns) - 1.) * (1.001 * farthest + away);
  std::array<double, 2 * turns> x, y;
  for (std::size_t i = 0; i < x.size(); ++i) {
    x[i] = std::cos(pi * static_cast<double>(i) / turns);
    y[i] = std::sin(pi * static_cast<double>(i) / turns);
  }
  Profile profile;
  for (int k = 0; k <= elevations; ++k) {
    const double c = Profile::cosine(k), s = Profile::sine(k);
    double most = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < x.size(); ++i) {
      most = std::max(most, support(reach, Vector3d(c * x[i], c * y[i], s)));
    }
    profile.set(k, most + between);
  }
  reach.revolved = true;
  reach.body = profile;
  reach.axis = Vector3d::UnitZ();
  reach.places = {Vector3d::Zero()};
}
} // namespace

vpReachBounds::vpReachBounds(const vpArmModel &arm)
  : m_joints(arm.size()), m_bounds(arm.spec().capsules.size() * static_cast<std::size_t>(arm.size()), 0.)
{
  m_low.setConstant(m_joints, -vpLargestCoordinate);
  m_high.setConstant(m_joints, vpLargestCoordinate);
  for (int j = 0; j < m_joints; ++j) {
    if (arm.isPrismatic(j)) {
      const double more = beyond * (arm.upper()(j) - arm.lower()(j));
      m_low(j) = arm.lower()(j) - more;
      m_high(j) = arm.upper()(j) + more;
    }
  }
  for (std::size_t i = 0; i < arm.spec().capsules.size(); ++i) {
    const vpArmCapsule &capsule = arm.spec().capsules[i];
    if (capsule.link == 0) {
      continue;
    }
    const int last = capsule.link - 1;
    Reach reach;
    const vpRigidTransform &after = arm.spec().joints[static_cast<std::size_t>(last)].after;
    reach.places = {after.R * capsule.from + after.p, after.R * capsule.to + after.p};
    for (int j = last; j >= 0; --j) {
      if (j < last) {
        step(arm.step(j + 1), reach);
      }
      double &bound = m_bounds[i * static_cast<std::size_t>(m_joints) + static_cast<std::size_t>(j)];
      if (arm.isPrismatic(j)) {
        bound = 1.;
        slide(m_low(j) + arm.offset(j), m_high(j) + arm.offset(j), reach);
      }
      else {
        turn(reach);
        // The body is now about z: its extent at elevation 0 is its distance from the axis.
        bound = reach.body.value(elevations / 2) * (1. + 1e-12);
      }
    }
  }
}

bool vpReachBounds::holds(const vpJointVector &q, const vpJointVector &way) const noexcept
{
  return q.size() == m_joints && way.size() == m_joints && ((q - way).array() >= m_low.array()).all() &&
         ((q + way).array() <= m_high.array()).all();
}

END_VISP_NAMESPACE
