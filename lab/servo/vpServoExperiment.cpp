/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "lab/servo/vpServoExperiment.h"

#include <visp3/core/vpException.h>
#include <visp3/core/vpMeterPixelConversion.h>
#include <visp3/feedforward/vpServoController.h>
#include <visp3/feedforward/vpOdometryBridge.h>
#include "lab/servo/vpServoSensor.h"
#include <visp3/simulation/vpVisionChannel.h>

#include "lab/servo/vpServoGeometry.h"
#include "lab/servo/vpServoRobot.h"

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
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
  controller.view = vpViewConstraintSpec::fromCamera(spec.task.camera, spec.task.width, spec.task.height);
  controller.view.period = 1. / spec.plant.loopRate;
  controller.view.imageUncertainty = 3. * spec.plant.pixelNoise / spec.task.camera.get_px();
  controller.view.maxLinear = spec.plant.maxLinear;
  controller.view.maxAngular = spec.plant.maxAngular;
  return vpServoController::create(spec.law, controller);
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

// The true state at this instant, independent of the sensor.
void fillTruth(const vpServoTask &task, const vpServoSegment &segment, vpServoSample &s)
{
  const vpHomogeneousMatrix cdMc = segment.cdMo * s.cMo.inverse();
  s.yaw = vpServoGeometry::yaw(vpServoGeometry::rotation(s.wMc));
  s.goalYaw = vpServoGeometry::yaw(vpServoGeometry::rotation(task.initial * segment.cdMo.inverse()));
  s.rotationError = vpSO3::log(vpServoGeometry::rotation(cdMc)).norm();
  s.translationError = vpServoGeometry::distance(cdMc);
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
void fillSeen(const vpServoSegment &segment, const vpServoMeasurement &measurement, vpServoSample &s)
{
  if (!measurement.valid) {
    return;
  }
  const vpHomogeneousMatrix cdMc = segment.cdMo * measurement.cMo.inverse();
  s.seenRotationError = vpSO3::log(vpServoGeometry::rotation(cdMc)).norm();
  s.seenTranslationError = vpServoGeometry::distance(cdMc);
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

// Final rotation if this angular velocity decayed like the law's own rotation error.
double referenceYaw(const vpHomogeneousMatrix &wMc, const vpTwist &command, double rotationGain)
{
  const Eigen::Vector3d w(command[3], command[4], command[5]);
  return vpServoGeometry::yaw(vpServoGeometry::rotation(wMc) * vpSO3::exp(w / rotationGain));
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
  std::optional<vpTwistShaper> shaper;
  if (spec.shape) {
    shaper.emplace(*spec.shape);
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
      servo.setGoal(sensor->goal(spec.task.segments[segment].cdMo));
    }
    vpServoSample s;
    s.time = cycle * dt;
    s.segment = segment;
    s.wMc = robot->wMc();
    s.cMo = s.wMc.inverse() * spec.task.initial;
    fillTruth(spec.task, spec.task.segments[segment], s);

    if (vision.due(s.time)) {
      sensor->measure(s.cMo, s.time, frame);
      vision.push(frame);
    }
    while (vision.pop(s.time, result)) {
      s.newFrame = odometry.correct(result);
    }
    odometry.predict(measurement);
    const vpServoCommand command = servo.step(measurement, dt);
    vpTwist asked = command.v;
    if (shaper) {
      // The plant's speed limits come first: after the shaper they would cause a kink in its smooth twist.
      asked = shaper->step(vpLimitTwist(asked, spec.plant.maxLinear, spec.plant.maxAngular), dt);
    }
    robot->move(asked);
    odometry.move(robot->actual(), (cycle + 1) * dt);

    s.commanded = asked;
    s.actual = robot->actual();
    s.referenceYaw = referenceYaw(s.wMc, command.v, servo.law().rotationGain());
    s.measured = measurement.valid;
    fillSeen(spec.task.segments[segment], measurement, s);
    s.status = command.status;
    run.samples.push_back(s);
    vpArmSample joints;
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

END_VISP_NAMESPACE
