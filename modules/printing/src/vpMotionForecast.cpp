/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/printing/vpMotionForecast.h>

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

vpAxisState vpEvaluatePieces(const vpTrajectorySegment *pieces, int count, double t) noexcept
{
  if (count <= 0) {
    return {};
  }
  int i = 0;
  while (i + 1 < count && t >= pieces[i + 1].begin) {
    ++i;
  }
  const vpTrajectorySegment &piece = pieces[i];
  const double T = piece.duration;
  const double inside = std::clamp(t - piece.begin, 0., T);
  const std::array<double, 4> jet = piece.p.jet(inside / T);
  vpAxisState x{{jet[0], jet[1] / T, jet[2] / (T * T), jet[3] / (T * T * T)}};
  const double outside = t - piece.begin - inside;
  if (outside != 0.) {
    x = {{x[0] + outside * x[1], x[1], 0., 0.}};
  }
  return x;
}

bool vpMotionForecast::isPlausible() const noexcept
{
  if (!vpIsPlausible(time) || !vpIsPlausible(position) || !vpIsPlausible(velocity) || !vpIsPlausible(acceleration) ||
      !(accelerationTime >= 0.) || !vpIsPlausible(accelerationTime) || !vpIsPlausibleDeviation(errorTime) ||
      pieces < 0 || pieces > maxPieces) {
    return false;
  }
  return std::all_of(plan.begin(), plan.begin() + pieces, [](const vpTrajectorySegment &piece) {
    const double *c = piece.p.data();
    return vpIsPlausible(piece.begin) && vpIsPlausibleDeviation(piece.duration) &&
           std::all_of(c, c + piece.p.degree() + 1, vpIsPlausible);
  });
}

vpAxisState vpMotionForecast::at(double asked) const noexcept
{
  const double dt = std::isnan(asked) ? 0. : std::clamp(asked - time, -longest, longest);
  const double t = time + dt;
  if (pieces <= 0 || pieces > maxPieces) {
    const double accelerated = std::clamp(dt, 0., accelerationTime);
    const double gained = acceleration * accelerated;
    const bool still = dt >= 0. && dt < accelerationTime;
    return {{position + velocity * dt + gained * (dt - 0.5 * accelerated), velocity + gained, still ? acceleration : 0.,
             0.}};
  }
  const vpAxisState from = vpEvaluatePieces(plan.data(), pieces, time);
  vpAxisState x = vpEvaluatePieces(plan.data(), pieces, t);
  const double error = velocity - from[1];
  if (dt >= 0.) {
    const double decay = std::exp(-dt / errorTime);
    x[0] += position - from[0] + error * errorTime * (1. - decay);
    x[1] += error * decay;
    x[2] -= error * decay / errorTime;
  }
  else { // the past, extrapolated back
    x[0] += position - from[0] + error * dt;
    x[1] += error;
  }
  return x;
}

END_VISP_NAMESPACE
