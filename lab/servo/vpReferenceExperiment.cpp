/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "lab/servo/vpReferenceExperiment.h"

#include <visp3/direct_core/vpSO3.h>
#include <visp3/feedforward/vpOdometryBridge.h>
#include <visp3/feedforward/vpServoController.h>
#include <visp3/simulation/vpFrictionCamera.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <deque>

BEGIN_VISP_NAMESPACE

namespace
{
using Rng = std::mt19937_64;
constexpr double largestTurn = M_PI / 3.;

double uniform(Rng &rng, double low, double high) { return std::uniform_real_distribution<double>(low, high)(rng); }
double normal(Rng &rng, double sigma) { return std::normal_distribution<double>(0., sigma)(rng); }

// Normalised image; false if the point is less than margin px within the image, or behind the camera.
bool project(const vpRigidTransform &rMc, const Eigen::Vector3d &P, Eigen::Vector2d &x, double margin = 0.)
{
  const Eigen::Vector3d C = rMc.R.transpose() * (P - rMc.p);
  x = C.hnormalized();
  return C.z() > 1e-3 && std::abs(x.x()) * vpReferenceStart::focal < 0.5 * vpReferenceStart::width - margin &&
         std::abs(x.y()) * vpReferenceStart::focal < 0.5 * vpReferenceStart::height - margin;
}

void drawObject(Rng &rng, vpReferenceStart &s)
{
  const double Z = uniform(rng, 0.25, 1.), tilt = uniform(rng, 0., 0.6), azimuth = uniform(rng, 0., 2. * M_PI);
  s.size = 0.16 * Z;
  s.normal << std::sin(tilt) * std::cos(azimuth), std::sin(tilt) * std::sin(azimuth), std::cos(tilt);
  s.rMo.R = vpSO3::minimalRotation(Eigen::Vector3d::UnitZ(), s.normal) *
            vpSO3::exp(Eigen::Vector3d(0., 0., uniform(rng, 0., 2. * M_PI)));
  s.rMo.p << uniform(rng, -0.08, 0.08) * Z, uniform(rng, -0.06, 0.06) * Z, Z;
  s.distance = s.normal.dot(s.rMo.p);
  s.points.clear();
  const auto onObject = [&s](double x, double y) {
    return Eigen::Vector3d(s.rMo.p + s.size * s.rMo.R.leftCols<2>() * Eigen::Vector2d(x, y));
  };
  for (int i = 0; i < 30; ++i) {
    const double x = uniform(rng, -0.5, 0.5);
    s.points.push_back(onObject(x, uniform(rng, -0.5, 0.5)));
  }
  s.corners = {onObject(-0.5, -0.5), onObject(0.5, -0.5), onObject(0.5, 0.5), onObject(-0.5, 0.5)};
}

void drawCamera(Rng &rng, bool turned, vpReferenceStart &s)
{
  if (turned) {
    const double x = uniform(rng, -0.15, 0.15), y = uniform(rng, -0.1, 0.1);
    s.rMc = {vpSO3::exp(Eigen::Vector3d(x, y, uniform(rng, -1., 1.))), Eigen::Vector3d::Zero()};
    return;
  }
  Eigen::Vector3d axis;
  for (int i = 0; i < 3; ++i) {
    axis(i) = normal(rng, 1.);
  }
  s.rMc.R = vpSO3::exp(axis.normalized() * uniform(rng, 0., largestTurn));
  const double x = uniform(rng, -0.35, 0.35), y = uniform(rng, -0.26, 0.26);
  const double distance = uniform(rng, 0.3, 2.) * s.rMo.p.norm();
  s.rMc.p = s.rMo.p - s.rMc.R * Eigen::Vector3d(x, y, 1.).normalized() * distance;
}

bool isVisible(const vpReferenceStart &s)
{
  const Eigen::Vector3d way = s.rMo.p - s.rMc.p;
  bool seen = way.dot(s.normal) > 0.3 * way.norm(); // from the front, not grazing
  Eigen::Vector2d x;
  for (const Eigen::Vector3d &corner : s.corners) {
    seen = seen && project(s.rMc, corner, x, 5.) && project({}, corner, x, 5.);
  }
  return seen;
}

// Images of the points with noise.
void takePoints(const vpReferenceStart &s, const vpRigidTransform &rMc, double sigma, Rng &rng,
                std::vector<vpServoPoint> &points)
{
  points.resize(s.points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    Eigen::Vector2d x;
    points[i].visible = project(rMc, s.points[i], x);
    points[i].x = x.x() + normal(rng, sigma);
    points[i].y = x.y() + normal(rng, sigma);
  }
}
} // namespace

vpReferenceStart vpReferenceStart::draw(std::mt19937_64 &rng, bool turned)
{
  vpReferenceStart s;
  do {
    drawObject(rng, s);
    drawCamera(rng, turned, s);
  } while (!isVisible(s));
  return s;
}

vpReferenceEye seePoints(const vpReferenceStart &start, double pixelNoise, unsigned int taught,
                         const vpReferencePoseSpec &spec, unsigned int seed,
                         std::shared_ptr<const vpReferencePose> &pose)
{
  const double sigma = pixelNoise / vpReferenceStart::focal, taughtSigma = sigma / std::sqrt(taught);
  auto rng = std::make_shared<Rng>(seed);
  std::vector<vpServoPoint> points;
  takePoints(start, {}, taughtSigma, *rng, points);
  std::vector<Eigen::Vector2d> reference;
  for (const vpServoPoint &p : points) {
    reference.emplace_back(p.x, p.y);
  }
  const auto estimator = std::make_shared<vpReferencePose>(reference, taughtSigma, spec);
  pose = estimator;
  return [&start, sigma, rng, estimator, points](const vpRigidTransform &rMc, const vpRigidTransform &fMc, double time,
                                                 vpServoSight &sight) mutable {
    takePoints(start, rMc, sigma, *rng, points);
    estimator->add(points, sigma, &fMc);
    estimator->sight(time, sight);
  };
}

vpReferenceEye seeKnownPoints(const vpReferenceStart &start, double pixelNoise, unsigned int taught, unsigned int seed)
{
  constexpr double exact = 1e-6; // normalised, rad
  const double sigma = pixelNoise / vpReferenceStart::focal, taughtSigma = sigma / std::sqrt(taught);
  auto rng = std::make_shared<Rng>(seed);
  std::vector<vpServoPoint> points;
  takePoints(start, {}, 0., *rng, points);
  std::vector<Eigen::Vector2d> model;
  for (const vpServoPoint &p : points) {
    model.emplace_back(p.x, p.y);
  }
  vpReferencePoseSpec spec;
  spec.nearest = spec.farthest = start.distance;
  const auto estimator = std::make_shared<vpReferencePose>(model, exact, spec);
  estimator->setNormalPrior(start.normal, exact);
  *rng = Rng(seed); // the noise of the taught image is that of seePoints()
  takePoints(start, {}, taughtSigma, *rng, points);
  vpServoSight goal;
  estimator->add(points, taughtSigma, nullptr);
  estimator->sight(0., goal);
  estimator->reset();
  return [&start, sigma, rng, estimator, points, goal](const vpRigidTransform &rMc, const vpRigidTransform &fMc,
                                                       double time, vpServoSight &sight) mutable {
    takePoints(start, rMc, sigma, *rng, points);
    estimator->add(points, sigma, &fMc);
    estimator->sight(time, sight);
    sight.goal.cdMo = goal.measurement.cMo;
    sight.goal.points = goal.measurement.points;
  };
}

namespace
{
constexpr double settledRotation = 2. * M_PI / 180., settledTranslation = 0.02;

struct Arrival {
  double time;
  vpServoSight sight;
};

// Figures of the true pose at one time.
void follow(const vpReferenceStart &start, const vpRigidTransform &rMc, double time, double left, double dt,
            vpReferenceRun &run)
{
  Eigen::Vector2d x;
  const auto lost = [&](const Eigen::Vector3d &corner) { return !project(rMc, corner, x); };
  run.outOfView += std::any_of(start.corners.begin(), start.corners.end(), lost) ? dt : 0.;
  const double rotation = vpSO3::log(rMc.R).norm(), translation = rMc.p.norm() / start.distance;
  if (!(rotation < settledRotation && translation < settledTranslation)) {
    run.settled = vpReferenceRun::never;
  }
  else if (run.settled == vpReferenceRun::never) {
    run.settled = time;
  }
  const double way = start.rMc.p.squaredNorm();
  run.overshoot = std::max(run.overshoot, way > 0. ? -rMc.p.dot(start.rMc.p) / way : translation);
  if (left < 1. + 0.5 * dt) { // the last second
    run.endRotation = (run.endRotation == vpReferenceRun::never ? 0. : run.endRotation) + rotation * dt;
    run.endTranslation = (run.endTranslation == vpReferenceRun::never ? 0. : run.endTranslation) + translation * dt;
  }
}
} // namespace

vpReferenceRun runReferenceExperiment(const vpReferenceStart &start, const vpReferenceEye &eye,
                                      const vpReferenceRunSpec &spec)
{
  spec.plant.validate();
  const double dt = 1. / spec.plant.loopRate;
  const long cycles = std::lround(spec.duration * spec.plant.loopRate);
  const long frame = std::max(1L, std::lround(spec.plant.loopRate / spec.plant.visionRate));
  vpFrictionCamera robot(spec.plant);
  robot.setRobotState(vpRobot::STATE_VELOCITY_CONTROL);
  vpServoController servo = vpServoController::create(spec.law);
  vpOdometryBridge bridge(spec.plant.latency + 5. / spec.plant.visionRate, spec.plant.loopRate);
  std::deque<Arrival> arrivals;
  vpServoMeasurement now;
  vpColVector velocity(6);
  vpReferenceRun run;
  double factor = 1.;
  bool hasGoal = false;
  for (long k = 0; k < cycles; ++k) {
    const double time = k * dt;
    const vpRigidTransform wMc = vpRigidTransform::fromHomogeneous(robot.getPosition()), rMc = start.rMc * wMc;
    follow(start, rMc, time, spec.duration - time, dt, run);
    if (k % frame == 0) {
      arrivals.push_back({time + spec.plant.latency, {}});
      eye(rMc, {wMc.R, spec.odometryScale * wMc.p}, time, arrivals.back().sight);
    }
    while (!arrivals.empty() && arrivals.front().time < time + 0.5 * dt) {
      const vpServoSight &sight = arrivals.front().sight;
      if (sight.hasGoal) {
        servo.setGoal(sight.goal);
        hasGoal = true;
        run.endDistance = sight.distance;
        run.endSigma = sight.distanceSigma;
        if (run.halfDistance == 0. && rMc.p.norm() < 0.5 * start.rMc.p.norm()) {
          run.halfDistance = sight.distance;
          run.halfSigma = sight.distanceSigma;
        }
      }
      if (sight.measurement.valid && bridge.correct(sight.measurement)) {
        factor = sight.speedFactor;
      }
      arrivals.pop_front();
    }
    bridge.predict(now);
    const vpServoCommand command = hasGoal ? servo.step(now, dt) : vpServoCommand();
    vpLimitTwist(command.v, factor * spec.plant.maxLinear, factor * spec.plant.maxAngular).copyTo(velocity);
    robot.setVelocity(vpRobot::CAMERA_FRAME, velocity);
    vpTwist moved = robot.actualTwist();
    for (std::size_t i = 0; i < 3; ++i) {
      moved[i] *= spec.odometryScale;
    }
    bridge.move(moved, (k + 1) * dt);
  }
  return run;
}

END_VISP_NAMESPACE
