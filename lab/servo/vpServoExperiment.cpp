/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "lab/servo/vpServoExperiment.h"

#include "lab/servo/vpServoSensor.h"

#include <visp3/core/vpException.h>
#include <visp3/core/vpHomogeneousMatrix.h>
#include <visp3/core/vpMath.h>
#include <visp3/core/vpMeterPixelConversion.h>
#include <visp3/direct_core/vpSO3.h>
#include <visp3/feedforward/vpObjectAverage.h>
#include <visp3/feedforward/vpOdometryBridge.h>
#include <visp3/feedforward/vpServoController.h>
#include <visp3/manipulator/vpTwistAxes.h>
#include <visp3/servoing/vpArmMotionCheck.h>
#include <visp3/simulation/vpVisionChannel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <tuple>
#include <utility>

BEGIN_VISP_NAMESPACE

namespace
{
//! Rotation part of \e M.
Eigen::Matrix3d rotationOf(const vpHomogeneousMatrix &M)
{
  Eigen::Matrix3d R;
  for (unsigned int r = 0; r < 3; ++r) {
    for (unsigned int c = 0; c < 3; ++c) {
      R(r, c) = M[r][c];
    }
  }
  return R;
}

//! Direction of the optical axis in the world's x-z plane, rad: 0 along z, positive towards x.
double yawOf(const Eigen::Matrix3d &wRc) { return std::atan2(wRc(0, 2), wRc(2, 2)); }

//! Length of the translation of \e M, m.
double lengthOf(const vpHomogeneousMatrix &M)
{
  return std::sqrt(M[0][3] * M[0][3] + M[1][3] * M[1][3] + M[2][3] * M[2][3]);
}

constexpr double mostCycles = 1e7;  // the log must fit into memory
constexpr double framesMissed = 5.; // maximum number of frames bridged by odometry alone

std::unique_ptr<vpServoSensor> makeSensor(const vpServoRunSpec &spec)
{
  if (spec.measure == "points") {
    return vpServoSensor::points(spec.task, spec.plant.pixelNoise, spec.seed);
  }
  if (spec.measure == "image") {
    if (spec.target.empty()) {
      throw vpException(vpException::badValue, "measure 'image' needs an image file of the object, target is empty");
    }
    return vpServoSensor::image(spec.task, spec.target, spec.faults, spec.seed);
  }
  throw vpException(vpException::badValue, "unknown measure '%s', known are points and image", spec.measure.c_str());
}

// Filter and plant share the speed limits and the view, so that the filter never requests what the robot cannot do.
vpServoController makeController(const vpServoRunSpec &spec)
{
  vpServoControllerSpec controller;
  controller.gains = spec.gains;
  controller.motion = spec.bounds.value_or(vpServoMotionLimits());
  controller.view = vpViewConstraintSpec::fromCamera(spec.task.camera, spec.task.width, spec.task.height);
  controller.view.period = 1. / spec.plant.loopRate;
  controller.view.imageUncertainty = 3. * spec.plant.pixelNoise / spec.task.camera.get_px();
  controller.view.maxLinear = spec.plant.maxLinear;
  controller.view.maxAngular = spec.plant.maxAngular;
  return vpServoController::create(spec.law, controller);
}

double speedLimit(const vpServoRunSpec &spec, double vpServoMotionLimits::*field, double plant)
{
  return spec.bounds ? std::min(plant, (*spec.bounds).*field) : plant;
}

std::optional<vpTwistShaperLimits> shapeOf(const vpServoRunSpec &spec)
{
  return spec.bounds ? std::optional(spec.bounds->shaperLimits()) : spec.shape;
}

// Number of the first cycle after each segment.
std::vector<long> segmentEnds(const vpServoRunSpec &spec)
{
  std::vector<long> ends;
  double time = 0.;
  long before = 0;
  for (const vpServoSegment &segment : spec.task.segments) {
    time += segment.duration;
    if (time * spec.plant.loopRate > mostCycles) {
      throw vpException(vpException::badValue, "the run would take more than %g cycles (%g s at %g Hz)", mostCycles,
                        time, spec.plant.loopRate);
    }
    ends.push_back(std::lround(time * spec.plant.loopRate));
    if (ends.back() == before) {
      throw vpException(vpException::badValue, "segment '%s' lasts %g s, less than one cycle at loopRate %g Hz",
                        segment.name.c_str(), segment.duration, spec.plant.loopRate);
    }
    before = ends.back();
  }
  return ends;
}

// Pixel of a point of the object, seen from the true pose.
void project(const vpServoTask &task, const vpHomogeneousMatrix &cMo, double x, double y, double &u, double &v,
             bool &inImage)
{
  constexpr double nearest = 1e-3; // keeps the log finite if the object passes beside or behind the camera
  const double depth = cMo[2][0] * x + cMo[2][1] * y + cMo[2][3];
  const double Z = std::max(depth, nearest);
  vpMeterPixelConversion::convertPoint(task.camera, (cMo[0][0] * x + cMo[0][1] * y + cMo[0][3]) / Z,
                                       (cMo[1][0] * x + cMo[1][1] * y + cMo[1][3]) / Z, u, v);
  inImage = depth >= nearest && u >= 0. && v >= 0. && u <= task.width - 1. && v <= task.height - 1.;
}

bool allCornersInImage(const vpServoTask &task, const vpHomogeneousMatrix &cMo)
{
  for (int corner = 0; corner < 4; ++corner) {
    double u = 0., v = 0.;
    bool inImage = false;
    project(task, cMo, (corner % 2 == 0 ? -0.5 : 0.5) * task.objectWidth,
            (corner / 2 == 0 ? -0.5 : 0.5) * task.objectHeight, u, v, inImage);
    if (!inImage) {
      return false;
    }
  }
  return true;
}

using FreeAxes = std::array<bool, 6>;

FreeAxes freeAxesOf(const vpServoRunSpec &spec) { return spec.arm ? spec.arm->spec.free : FreeAxes{}; }

// Rotation vector (first) and translation of cdMc, without the free axes of the camera.
std::pair<double, double> errorsOf(const vpHomogeneousMatrix &cdMc, const FreeAxes &free)
{
  if (free == FreeAxes{}) {
    return {vpSO3::log(rotationOf(cdMc)).norm(), lengthOf(cdMc)};
  }
  const Eigen::Matrix3d R = rotationOf(cdMc);
  Eigen::Vector3d w = vpSO3::log(R), t = R.transpose() * Eigen::Vector3d(cdMc[0][3], cdMc[1][3], cdMc[2][3]);
  for (int k = 0; k < 3; ++k) {
    const std::size_t axis = static_cast<std::size_t>(k);
    t(k) = free[axis] ? 0. : t(k);
    w(k) = free[axis + 3] ? 0. : w(k);
  }
  return {w.norm(), t.norm()};
}

// The true state at this instant, independent of the sensor.
void fillTruth(const vpServoTask &task, const vpServoSegment &segment, const FreeAxes &free, vpServoSample &s)
{
  const vpHomogeneousMatrix cdMc = segment.cdMo * s.cMo.inverse();
  s.yaw = yawOf(rotationOf(s.wMc));
  s.goalYaw = yawOf(rotationOf(task.initial * segment.cdMo.inverse()));
  std::tie(s.rotationError, s.translationError) = errorsOf(cdMc, free);
  bool centreInImage = false;
  double goalU = 0., goalV = 0.;
  project(task, segment.cdMo, 0., 0., goalU, goalV, centreInImage);
  project(task, s.cMo, 0., 0., s.u, s.v, centreInImage);
  s.imageErrorU = s.u - goalU;
  s.imageErrorV = s.v - goalV;
  s.inView = allCornersInImage(task, s.cMo);
}

// What the measurement and its own covariance say about cdMc. With errors (v, w) of cMo = (R, t) the rotation of cdMc errs by w, and
// the camera's place, -R^T t in the object's frame, by v + t x w.
void fillSeen(const vpServoSegment &segment, const vpServoMeasurement &measurement, const FreeAxes &free,
              vpServoSample &s)
{
  if (!measurement.valid) {
    return;
  }
  const vpHomogeneousMatrix cdMc = segment.cdMo * measurement.cMo.inverse();
  std::tie(s.seenRotationError, s.seenTranslationError) = errorsOf(cdMc, free);
  if (!measurement.covariance.known) {
    return;
  }
  using Matrix6 = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;
  const Matrix6 C = Eigen::Map<const Matrix6>(measurement.covariance.C.data());
  const vpHomogeneousMatrix &cMo = measurement.cMo;
  Eigen::Matrix<double, 3, 6> G;
  G << Eigen::Matrix3d::Identity(), vpSO3::skew({cMo[0][3], cMo[1][3], cMo[2][3]});
  const double variance = (G * C * G.transpose()).trace();
  s.rotationDeviation = measurement.covariance.rotationDeviation();
  s.translationDeviation = variance >= 0. ? std::sqrt(variance) : s.translationDeviation;
}

vpServoGoal goalOf(const vpServoRunSpec &spec, const vpServoSegment &segment, vpServoSensor &sensor)
{
  if (!spec.noisyReference) {
    return sensor.goal(segment.cdMo);
  }
  vpServoMeasurement reference;
  sensor.measure(segment.cdMo, 0., reference);
  if (!reference.valid) {
    throw vpException(vpException::badValue, "the view of the goal of segment '%s' cannot be measured",
                      segment.name.c_str());
  }
  return sensor.goal(reference.cMo);
}

// Final rotation if this angular velocity decayed like the law's own rotation error.
double referenceYaw(const vpHomogeneousMatrix &wMc, const vpTwist &command, double rotationGain)
{
  const Eigen::Vector3d w(command[3], command[4], command[5]);
  return yawOf(rotationOf(wMc) * vpSO3::exp(w / rotationGain));
}
} // namespace

vpServoRun runServoExperiment(const vpServoRunSpec &spec, const std::function<bool(double)> &progress)
{
  spec.faults.validate();
  spec.plant.validate();
  spec.task.validate();
  const std::vector<long> ends = segmentEnds(spec);
  const long cycles = ends.back(), reportEvery = std::max(1L, cycles / 100);
  const double dt = 1. / spec.plant.loopRate;

  vpServoController servo = makeController(spec);
  const auto sensor = makeSensor(spec);
  const auto robot = vpServoRobot::create(spec);
  const FreeAxes free = freeAxesOf(spec);
  const bool plans = servo.law().plansMotion();
  std::optional<vpTwistShaper> shaper;
  if (const auto shape = shapeOf(spec); shape && !plans) {
    shaper.emplace(*shape);
  }
  const double maxLinear = speedLimit(spec, &vpServoMotionLimits::linearVelocity, spec.plant.maxLinear);
  const double maxAngular = speedLimit(spec, &vpServoMotionLimits::angularVelocity, spec.plant.maxAngular);
  vpObjectAverage object;
  std::optional<vpArmMotionCheck> check;
  if (spec.arm && plans) {
    const vpSimulatedArmSpec arm = spec.arm->forPlant(spec.plant);
    check.emplace(spec.arm->model, arm.redundancy, arm.indices, arm.free, spec.arm->jerk);
    servo.setMotionCheck(&*check);
  }
  vpVisionChannel vision(spec.plant.visionRate, spec.plant.latency);
  vpOdometryBridge odometry(spec.plant.latency + framesMissed / spec.plant.visionRate, spec.plant.loopRate);
  vpServoMeasurement frame, result, measurement;

  vpServoRun run;
  run.spec = spec;
  run.samples.reserve(cycles);
  int segment = -1;
  for (long cycle = 0; cycle < cycles; ++cycle) {
    if (segment < 0 || cycle == ends[segment]) {
      ++segment;
      servo.setGoal(goalOf(spec, spec.task.segments[segment], *sensor));
    }
    vpServoSample s;
    s.time = cycle * dt;
    s.segment = segment;
    s.wMc = robot->wMc();
    s.cMo = s.wMc.inverse() * spec.task.initial;
    fillTruth(spec.task, spec.task.segments[segment], free, s);

    if (vision.due(s.time)) {
      sensor->measure(s.cMo, s.time, frame);
      vision.push(frame);
    }
    while (vision.pop(s.time, result)) {
      s.newFrame = odometry.correct(result);
    }
    odometry.predict(measurement);
    if (spec.average && !plans) {
      static_cast<void>(object.see(measurement));
      object.predict(measurement);
    }
    vpArmSample joints;
    if (check && robot->sample(joints)) {
      check->setState(joints.wanted, joints.command);
    }
    const vpServoCommand command = servo.step(measurement, dt);
    vpTwist asked = vpWithoutFreeAxes(command.v, free);
    if (shaper) {
      // The plant's speed limits come first: after the shaper they would cause a kink in its smooth twist.
      asked = shaper->step(vpLimitTwist(asked, maxLinear, maxAngular), dt);
    }
    robot->move(asked);
    odometry.move(robot->actual(), (cycle + 1) * dt);
    object.move(robot->actual(), dt);
    servo.notifyExecuted(vpLimitTwist(asked, spec.plant.maxLinear, spec.plant.maxAngular), robot->actual());

    s.commanded = asked;
    s.actual = robot->actual();
    s.referenceYaw = referenceYaw(s.wMc, command.v, servo.law().rotationGain());
    s.measured = measurement.valid;
    fillSeen(spec.task.segments[segment], measurement, free, s);
    s.status = command.status;
    run.samples.push_back(s);
    if (robot->sample(joints)) {
      run.arm.push_back(joints);
    }
    if (progress && (cycle + 1) % reportEvery == 0 && !progress(double(cycle + 1) / cycles)) {
      break;
    }
  }
  run.metrics = evaluateServoRun(spec, run.samples);
  if (spec.arm) {
    run.armMetrics = evaluateArmRun(spec.arm->model, run.arm, dt);
  }
  return run;
}

namespace
{
constexpr double settledRotation = 2. * M_PI / 180.;
constexpr double settledTranslation = 0.005;

double idealYawRange(const vpServoTask &task)
{
  double lowest = 0., highest = 0.; // world frame: the camera at the start
  for (const vpServoSegment &segment : task.segments) {
    const double yaw = yawOf(rotationOf(task.initial * segment.cdMo.inverse()));
    lowest = std::min(lowest, yaw);
    highest = std::max(highest, yaw);
  }
  return vpMath::deg(highest - lowest);
}

// Final status of the run: the first rule that applies.
std::string describeEnd(const vpServoRunSpec &spec, const std::vector<vpServoSample> &samples)
{
  char text[256];
  double duration = 0.;
  for (const vpServoSegment &segment : spec.task.segments) {
    duration += segment.duration;
  }
  const double cycle = 1. / spec.plant.loopRate, end = samples.back().time + cycle;
  if (end < duration - 1.5 * cycle) {
    std::snprintf(text, sizeof(text), "stopped after %.2f s of %.2f s", end, duration);
    return text;
  }
  const vpServoStatus last = samples.back().status;
  if (last == vpServoStatus::Servoing || last == vpServoStatus::ViewLimited) {
    return "ok";
  }
  auto since = samples.end() - 1;
  while (since != samples.begin() && (since - 1)->status == last) {
    --since;
  }
  std::snprintf(text, sizeof(text), "ended in %s since %.2f s: %s", vpToString(last), since->time, vpMessage(last));
  return text;
}

vpTwist minus(const vpTwist &a, const vpTwist &b)
{
  return vpTwist(a[0] - b[0], a[1] - b[1], a[2] - b[2], a[3] - b[3], a[4] - b[4], a[5] - b[5]);
}

// Above the limits by more than rounding.
bool exceeds(const vpServoMotionLimits &limits, const vpTwist &v, const vpTwist &a, const vpTwist &j)
{
  constexpr double rounding = 1e-6;
  return std::max({v.linearNorm() / limits.linearVelocity, v.angularNorm() / limits.angularVelocity,
                   a.linearNorm() / limits.linearAcceleration, a.angularNorm() / limits.angularAcceleration,
                   j.linearNorm() / limits.linearJerk, j.angularNorm() / limits.angularJerk}) > 1. + rounding;
}

// Time from a segment's first sample until its errors stay small.
double settlingTime(const vpServoSample *first, const vpServoSample *last, double cycle)
{
  const vpServoSample *s = last;
  while (s != first && (s - 1)->rotationError < settledRotation && (s - 1)->translationError < settledTranslation) {
    --s;
  }
  return (s - first) * cycle;
}
} // namespace

vpServoMetrics evaluateServoRun(const vpServoRunSpec &spec, const std::vector<vpServoSample> &samples)
{
  vpServoMetrics m;
  m.ideal_yaw_range_deg = idealYawRange(spec.task);
  if (samples.empty()) {
    m.status = "no cycle was run";
    return m;
  }
  const double cycle = 1. / spec.plant.loopRate;
  double squares = 0., lowestYaw = samples.front().yaw, highestYaw = lowestYaw, settleSum = 0.;
  int segments = 0;
  vpTwist before, changeBefore; // the camera starts at rest
  double jerks = 0., angularJerks = 0.;
  bool wasInView = true;
  const vpServoSample *const end = samples.data() + samples.size();
  const vpServoSample *segmentBegin = samples.data();
  for (const vpServoSample *s = samples.data(); s != end; ++s) {
    const double error = std::hypot(s->imageErrorU, s->imageErrorV);
    m.max_image_error_px = std::max(m.max_image_error_px, error);
    squares += error * error;
    lowestYaw = std::min(lowestYaw, s->yaw);
    highestYaw = std::max(highestYaw, s->yaw);
    m.out_of_view_s += s->inView ? 0. : cycle;
    m.path_length_m += s->actual.linearNorm() * cycle;
    m.peak_linear_mps = std::max(m.peak_linear_mps, s->actual.linearNorm());
    m.peak_angular_radps = std::max(m.peak_angular_radps, s->actual.angularNorm());
    const vpTwist asked = vpLimitTwist(s->commanded, spec.plant.maxLinear, spec.plant.maxAngular);
    const vpTwist change = minus(asked, before);
    m.peak_linear_acceleration_mps2 = std::max(m.peak_linear_acceleration_mps2, change.linearNorm() / cycle);
    m.peak_angular_acceleration_radps2 = std::max(m.peak_angular_acceleration_radps2, change.angularNorm() / cycle);
    const vpTwist jerk = minus(change, changeBefore).scaled(1. / (cycle * cycle));
    m.peak_linear_jerk_mps3 = std::max(m.peak_linear_jerk_mps3, jerk.linearNorm());
    m.peak_angular_jerk_radps3 = std::max(m.peak_angular_jerk_radps3, jerk.angularNorm());
    jerks += jerk.linearNorm() * jerk.linearNorm();
    angularJerks += jerk.angularNorm() * jerk.angularNorm();
    m.bounds_exceeded_cycles += spec.bounds && exceeds(*spec.bounds, asked, change.scaled(1. / cycle), jerk) ? 1. : 0.;
    m.view_losses += wasInView && !s->inView ? 1. : 0.;
    wasInView = s->inView;
    before = asked;
    changeBefore = change;
    m.deadlock_cycles += s->status == vpServoStatus::Deadlock ? 1 : 0;
    if (s + 1 == end || (s + 1)->segment != s->segment) {
      m.end_rotation_deg = std::max(m.end_rotation_deg, vpMath::deg(s->rotationError));
      m.end_translation_mm = std::max(m.end_translation_mm, 1000. * s->translationError);
      m.left_end_rotation_deg = std::max(m.left_end_rotation_deg, vpMath::deg(s->seenRotationError));
      m.left_end_translation_mm = std::max(m.left_end_translation_mm, 1000. * s->seenTranslationError);
      m.expected_end_rotation_deg =
          std::max(m.expected_end_rotation_deg, vpMath::deg(std::hypot(s->seenRotationError, s->rotationDeviation)));
      m.expected_end_translation_mm =
          std::max(m.expected_end_translation_mm, 1000. * std::hypot(s->seenTranslationError, s->translationDeviation));
      settleSum += settlingTime(segmentBegin, s + 1, cycle);
      segmentBegin = s + 1;
      ++segments;
    }
  }
  m.rms_image_error_px = std::sqrt(squares / samples.size());
  m.rms_linear_jerk_mps3 = std::sqrt(jerks / samples.size());
  m.rms_angular_jerk_radps3 = std::sqrt(angularJerks / samples.size());
  m.yaw_range_deg = vpMath::deg(highestYaw - lowestYaw);
  m.settle_s = settleSum / segments;
  m.status = describeEnd(spec, samples);
  return m;
}

END_VISP_NAMESPACE
