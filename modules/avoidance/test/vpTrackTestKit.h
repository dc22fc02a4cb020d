/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// A body with a known motion and its sightings by a sensor.
#ifndef vpTrackTestKit_h
#define vpTrackTestKit_h

#include "vpAvoidanceTestKit.h"

#include <visp3/avoidance/vpObjectTracks.h>

namespace vpTrackTestKit
{
using namespace vpAvoidanceTestKit;

inline double normal(std::mt19937_64 &rng, double sigma)
{
  return sigma * std::normal_distribution<double>()(rng); // sigma may be 0
}

inline Vector3d normal3(std::mt19937_64 &rng, double sigma)
{
  return {normal(rng, sigma), normal(rng, sigma), normal(rng, sigma)};
}

inline Vector3d linear(const vpObjectTrack &track) { return {track.velocity[0], track.velocity[1], track.velocity[2]}; }

inline Vector3d angular(const vpObjectTrack &track)
{
  return {track.velocity[3], track.velocity[4], track.velocity[5]};
}

//! A body with random accelerations according to the specification.
struct Body {
  Vector3d p = Vector3d::Zero(), v = Vector3d::Zero(), w = Vector3d::Zero();
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();

  void move(double dt, double pushes, double twists, std::mt19937_64 &rng)
  {
    const int steps = std::max(1, static_cast<int>(dt / 0.001));
    const double h = dt / steps;
    for (int k = 0; k < steps; ++k) {
      const Vector3d dv = normal3(rng, std::sqrt(pushes * h)), dw = normal3(rng, std::sqrt(twists * h));
      p += h * (v + 0.5 * dv);
      v += dv;
      R = vpSO3::exp(h * (w + 0.5 * dw)) * R;
      w += dw;
    }
  }
  [[nodiscard]] vpObjectSighting seen(double time, std::mt19937_64 &rng, double sigma = 0.002,
                                      double angle = 0.01) const
  {
    vpObjectSighting sighting;
    sighting.name = "body";
    sighting.shape = vpCollisionShape::box({0.2, 0.1, 0.02});
    sighting.pose = {vpSO3::exp(normal3(rng, angle)) * R, p + normal3(rng, sigma)};
    sighting.time = time;
    sighting.positionSigma = sigma;
    sighting.angleSigma = angle;
    return sighting;
  }
};

inline vpObjectTrackSpec withoutRest()
{
  vpObjectTrackSpec spec;
  spec.restSigmas = 0.;
  return spec;
}

inline double density(double acceleration, const vpObjectTrackSpec &spec)
{
  return acceleration * acceleration * spec.persistence;
}

//! Sightings at a rate of a body that moves steadily, from \e from to \e to; each comes at once.
inline void watch(vpObjectTracks &tracks, Body &body, double from, double to, std::mt19937_64 &rng, double rate = 30.)
{
  const int frames = static_cast<int>(std::lround((to - from) * rate));
  for (int k = 0; k < frames; ++k) {
    const double t = from + k / rate;
    static_cast<void>(tracks.add(body.seen(t, rng)));
    tracks.advance(t);
    body.move(1. / rate, 0., 0., rng);
  }
}
} // namespace vpTrackTestKit
#endif
