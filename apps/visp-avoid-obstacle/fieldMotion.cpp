/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "fieldMotion.h"

#include <algorithm>
#include <cmath>

namespace avoidObstacle
{
vpFieldWeightSpec strictField() { return {0.12, 0.06, 0.5}; }
vpFieldWeightSpec mildField() { return {0.06, 0.03, 0.5}; }

FieldMotion followField(const FieldTask &task, const vpFieldWeightSpec &weight, bool withObstacle)
{
  weight.validate(vpFieldForm::Thesis);
  constexpr double noWeight = 1e3; // m: far enough to have no effect
  FieldMotion motion;
  motion.weight = weight;
  Eigen::Vector2d x = Eigen::Vector2d::Zero();
  double now = 0.;
  for (std::size_t i = 0; i < task.places.size(); ++i) {
    const double slot = i + 1 == task.places.size() ? 2. * task.slot : task.slot;
    const long cycles = std::lround(slot / task.period);
    for (long k = 0; k < cycles; ++k) {
      const Eigen::Vector2d offset = task.obstacle - x;
      const bool seen = withObstacle && std::fabs(offset.y()) <= task.sight;
      const double u = seen ? offset.x() : noWeight;
      const Eigen::Vector2d wish = task.gain * (task.places[i] - x);
      const Eigen::Vector3d avoid(offset.x() < 0. ? task.avoidSpeed : -task.avoidSpeed, 0., 0.);
      const Eigen::Vector3d v = blendAsPrinted(weight, {u, noWeight}, avoid, {wish.x(), wish.y(), 0.});
      motion.times.push_back(now);
      motion.way.push_back(x);
      motion.weights.push_back(seen ? vpFieldWeight(weight, vpFieldForm::Thesis, u) : 0.);
      motion.peakSpeed = std::max(motion.peakSpeed, v.norm());
      x += task.period * v.head<2>();
      now += task.period;
    }
    motion.missed.push_back((task.places[i] - x).norm());
  }
  motion.times.push_back(now);
  motion.way.push_back(x);
  motion.weights.push_back(motion.weights.back());
  return motion;
}
} // namespace avoidObstacle
