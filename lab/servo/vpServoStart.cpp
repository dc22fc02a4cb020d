/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "lab/servo/vpServoStart.h"

#include <visp3/core/vpException.h>
#include <visp3/manipulator/vpClosedLoopKinematics.h>

#include <algorithm>
#include <cmath>
#include <random>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr int candidates = 200;
constexpr double goodSingular = 0.2; // m/rad: away from singularities
constexpr double coarse = 1e-3;      // m and rad: tolerance for a pose to count as reachable
constexpr double longest = 20.;      // s to a pose

double marginOf(const vpArmModel &model, const vpJointVector &q)
{
  double margin = 1.;
  for (int i = 0; i < model.size(); ++i) {
    if (!model.isContinuous(i)) {
      const double half = 0.5 * (model.upper()(i) - model.lower()(i));
      margin = std::min(margin, std::min(q(i) - model.lower()(i), model.upper()(i) - q(i)) / half);
    }
  }
  return margin;
}

// Ends early with its current value if that is not above a bound: such a start is not used.
double rate(const vpArmModel &model, const vpServoTask &task, const vpJointVector &start, double bound)
{
  vpRedundancySpec redundancy;
  vpClosedLoopSpec spec;
  spec.linearTolerance = spec.angularTolerance = coarse;
  vpClosedLoopKinematics loop(model, redundancy, spec);
  vpClosedLoopInput input;
  vpClosedLoopState state;
  vpClosedLoopOutput output;
  state.q = start;
  vpArmData data;
  vpArmKinematics::forward(model, start, data);
  const vpRigidTransform fMo = vpArmKinematics::camera(model, data) * vpRigidTransform::fromHomogeneous(task.initial);
  double rating = marginOf(model, start);
  for (const vpServoSegment &segment : task.segments) {
    input.goal = fMo * vpRigidTransform::fromHomogeneous(segment.cdMo).inverse() * model.spec().camera.inverse();
    double time = 0.;
    do {
      loop.step(input, state, output);
      rating = std::min({rating, marginOf(model, state.q), output.solver.smallestSingular / goodSingular});
      time += redundancy.period;
    } while (state.status == vpClosedLoopStatus::Moving && time < longest && rating > bound);
    if (rating <= bound) {
      return rating;
    }
    if (state.status != vpClosedLoopStatus::Reached) {
      return -1.;
    }
  }
  return rating;
}
} // namespace

double rateServoStart(const vpArmModel &model, const vpServoTask &task, const vpJointVector &start)
{
  return rate(model, task, start, -1.);
}

vpJointVector findServoStart(const vpArmModel &model, const vpServoTask &task)
{
  if (model.spec().home.size() > 0) {
    return model.home();
  }
  std::mt19937_64 rng(1);
  vpJointVector best;
  double bestRating = -1.;
  for (int candidate = 0; candidate < candidates; ++candidate) {
    vpJointVector q(model.size());
    for (int i = 0; i < model.size(); ++i) {
      const double lower = model.isContinuous(i) ? -M_PI : model.lower()(i);
      const double upper = model.isContinuous(i) ? M_PI : model.upper()(i);
      q(i) = std::uniform_real_distribution<double>(lower, upper)(rng);
    }
    const double rating = rate(model, task, q, bestRating);
    if (rating > bestRating) {
      bestRating = rating;
      best = q;
    }
  }
  if (bestRating < 0.) {
    throw vpException(vpException::badValue,
                      "%s: from none of %d start configurations the camera reaches all poses of task %s",
                      model.label().c_str(), candidates, task.name.c_str());
  }
  return best;
}

END_VISP_NAMESPACE
