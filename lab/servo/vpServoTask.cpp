/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "lab/servo/vpServoTask.h"

#include "lab/servo/vpServoStart.h"

#include <visp3/core/vpException.h>
#include <visp3/core/vpThetaUVector.h>
#include <visp3/manipulator/vpClosedLoopKinematics.h>
#include <visp3/manipulator/vpTwistAxes.h>

#include <algorithm>
#include <cmath>
#include <random>

BEGIN_VISP_NAMESPACE

namespace
{
void requirePositive(const std::string &field, double value, const char *unit)
{
  if (!(value > 0.) || !std::isfinite(value)) {
    throw vpException(vpException::badValue, "%s of the task is %g %s, must be > 0 and finite", field.c_str(), value,
                      unit);
  }
}

// The object must be visible to this camera: rigid pose, completely in front, front side towards the camera.
void requireVisiblePose(const std::string &field, const vpHomogeneousMatrix &cMo, double width, double height)
{
  for (unsigned int i = 0; i < 12; ++i) {
    if (!std::isfinite(cMo.data[i])) {
      throw vpException(vpException::badValue, "%s of the task has the entry %g in row %u, column %u, must be finite",
                        field.c_str(), cMo.data[i], i / 4, i % 4);
    }
  }
  if (!cMo.isAnHomogeneousMatrix()) {
    throw vpException(vpException::badValue, "%s of the task is not a rigid motion: its 3x3 part is not a rotation",
                      field.c_str());
  }
  for (int corner = 0; corner < 4; ++corner) {
    const double x = (corner % 2 == 0 ? -0.5 : 0.5) * width, y = (corner / 2 == 0 ? -0.5 : 0.5) * height;
    const double depth = cMo[2][0] * x + cMo[2][1] * y + cMo[2][3];
    if (!(depth > 0.)) {
      throw vpException(vpException::badValue,
                        "%s of the task has a corner of the object at depth %g m, must be in front of the camera",
                        field.c_str(), depth);
    }
  }
  const double cameraZ = -(cMo[0][2] * cMo[0][3] + cMo[1][2] * cMo[1][3] + cMo[2][2] * cMo[2][3]);
  if (!(cameraZ < 0.)) {
    throw vpException(vpException::badValue,
                      "%s of the task has the camera at z = %g m of the object, must be < 0 to see its front",
                      field.c_str(), cameraZ);
  }
}

// Pose of an object at depth Z0 on the first camera's axis, for a camera that moved by (x, 0, z) and faces it.
vpHomogeneousMatrix facingPose(double x, double z, double Z0)
{
  const double yaw = std::atan2(-x, Z0 - z);
  const vpHomogeneousMatrix wMc(vpTranslationVector(x, 0., z), vpRotationMatrix(vpThetaUVector(0., yaw, 0.)));
  return wMc.inverse() * vpHomogeneousMatrix(0., 0., Z0, 0., 0., 0.);
}
} // namespace

vpServoTask vpServoTask::thesis()
{
  const double Z0 = 0.47, sideways = 0.2, forward = 0.1;
  vpServoTask task;
  task.camera.initPersProjWithoutDistortion(800., 800., 320., 240.);
  task.initial = facingPose(0., 0., Z0);
  task.segments = {{"2", facingPose(-sideways, forward, Z0), 8.},
                   {"1", facingPose(0., 0., Z0), 8.},
                   {"3", facingPose(sideways, forward, Z0), 8.}};
  return task;
}

void vpServoTask::validate() const
{
  if (camera.get_projModel() != vpCameraParameters::perspectiveProjWithoutDistortion) {
    throw vpException(vpException::badValue, "camera of the task has a distortion model, must have none");
  }
  requirePositive("camera px", camera.get_px(), "px");
  requirePositive("camera py", camera.get_py(), "px");
  if (!std::isfinite(camera.get_u0()) || !std::isfinite(camera.get_v0())) {
    throw vpException(vpException::badValue, "camera of the task has the principal point (%g, %g) px, must be finite",
                      camera.get_u0(), camera.get_v0());
  }
  if (width < 32 || height < 32 || width > 10000 || height > 10000) {
    throw vpException(vpException::badValue, "image size of the task is %ux%u px, must be 32 to 10000 each way", width,
                      height);
  }
  requirePositive("objectWidth", objectWidth, "m");
  requirePositive("objectHeight", objectHeight, "m");
  if (pointCount < 4 || pointCount > 10000) {
    throw vpException(vpException::badValue, "pointCount of the task is %u, must be 4 to 10000", pointCount);
  }
  requireVisiblePose("initial", initial, objectWidth, objectHeight);
  if (segments.empty()) {
    throw vpException(vpException::badValue, "the task has no segments, must have at least one");
  }
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const std::string segment = "segment " + std::to_string(i) + " ('" + segments[i].name + "')";
    requirePositive("duration of " + segment, segments[i].duration, "s");
    requireVisiblePose("cdMo of " + segment, segments[i].cdMo, objectWidth, objectHeight);
  }
}

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

using FreeAxes = std::array<bool, 6>;

// The arm with its camera as end effector, whose axes may be free.
vpArmModel withCameraAsTool(const vpArmModel &model)
{
  vpArmSpec spec = model.spec();
  spec.tool = spec.cameraLink < 0 ? spec.tool * spec.camera : spec.camera;
  spec.toolLink = spec.cameraLink < 0 ? spec.toolLink : spec.cameraLink;
  spec.cameraLink = -1;
  spec.camera = vpRigidTransform();
  return vpArmModel(spec);
}

// The tool may stand for a camera that is fixed to it, unless axes of the camera are free.
vpArmModel toBeRated(const vpArmModel &model, const FreeAxes &free)
{
  return free == FreeAxes{} && model.spec().cameraLink < 0 ? model : withCameraAsTool(model);
}

// Names axes that the arm cannot command for lack of joints, at mid-range; empty if there are none.
std::string lackOf(const vpArmModel &model, const FreeAxes &free)
{
  vpArmData data;
  vpArmKinematics::update(model, model.home(), data);
  vpRedundancyInput input;
  input.free = free;
  input.previous = vpJointVector::Zero(model.size());
  vpRedundancyOutput output;
  vpRedundancySolver(model).step(data, input, output);
  const std::string axes = vpAxesInWords(output.unreachableAxes);
  return axes.empty() ? "" : "; the arm has too few joints for six axes, free one like " + axes;
}

// Ends early with its current value if that is not above a bound: such a start is not used.
double rate(const vpArmModel &model, const vpServoTask &task, const vpJointVector &start, const FreeAxes &free,
            double bound)
{
  vpRedundancySpec redundancy;
  vpClosedLoopSpec spec;
  spec.linearTolerance = spec.angularTolerance = coarse;
  vpClosedLoopKinematics loop(model, redundancy, spec);
  vpClosedLoopInput input;
  input.free = free;
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

double rateServoStart(const vpArmModel &model, const vpServoTask &task, const vpJointVector &start,
                      const FreeAxes &free)
{
  return rate(toBeRated(model, free), task, start, free, -1.);
}

vpJointVector findServoStart(const vpArmModel &model, const vpServoTask &task, const FreeAxes &free)
{
  if (model.spec().home.size() > 0) {
    return model.home();
  }
  const vpArmModel arm = toBeRated(model, free);
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
    const double rating = rate(arm, task, q, free, bestRating);
    if (rating > bestRating) {
      bestRating = rating;
      best = q;
    }
  }
  if (bestRating < 0.) {
    const std::string reason = lackOf(arm, free);
    throw vpException(vpException::badValue,
                      "%s: from none of %d start configurations the camera reaches all poses of task %s%s",
                      model.label().c_str(), candidates, task.name.c_str(), reason.c_str());
  }
  return best;
}

END_VISP_NAMESPACE
