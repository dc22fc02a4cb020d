/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/avoidance/vpObstacleDetector.h>

#include "vpFieldCheck.h"
#include "vpPlausible.h"

#include <visp3/core/vpException.h>
#include <visp3/direct_core/vpSO3.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <cstdio>

BEGIN_VISP_NAMESPACE

namespace
{
using Matrix6 = Eigen::Matrix<double, 6, 6>;

constexpr vpFieldCheck fields("the obstacle detector");
constexpr double longestMotion = 0.2; // s; velocities over longer times are not meaningful

double square(double x) { return x * x; }

double worst(const Eigen::Matrix3d &covariance)
{
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance, Eigen::EigenvaluesOnly);
  return solver.eigenvalues()(2);
}

// Information of four corners on position of the body's centre and rotation, in the camera axes, per px^2.
Matrix6 information(const vpRigidTransform &cMo, double width, double height, double depth,
                    const vpCameraParameters &camera)
{
  Matrix6 sum = Matrix6::Zero();
  const Eigen::Vector3d middle = cMo.p + 0.5 * depth * cMo.R.col(2);
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector3d corner =
        cMo.p + (i % 2 == 0 ? -0.5 : 0.5) * width * cMo.R.col(0) + (i / 2 == 0 ? -0.5 : 0.5) * height * cMo.R.col(1);
    Eigen::Matrix<double, 2, 3> projection;
    projection << camera.get_px(), 0., -camera.get_px() * corner.x() / corner.z(), 0., camera.get_py(),
        -camera.get_py() * corner.y() / corner.z();
    projection /= corner.z();
    Eigen::Matrix<double, 2, 6> J;
    J.leftCols<3>() = projection;
    J.rightCols<3>() = -projection * vpSO3::skew(corner - middle);
    sum += J.transpose() * J;
  }
  return sum;
}

// A correlation of c corresponds to an image with a noise of sqrt(1 / c^2 - 1) times its contrast. A part of the target
// gives less information than the whole: less area, and a shorter lever.
double pixelVariance(const vpPlanarTargetResult &result, const vpObstacleDetectorSpec &spec)
{
  const double c = std::clamp(result.correlation, 0.1, 1.), visible = std::clamp(result.visible, 0.05, 1.);
  return (square(spec.pixelSigma) + square(spec.greySigma) * (1. / (c * c) - 1.)) / (visible * visible);
}

vpCollisionShape body(const vpPlanarTargetSighting &target, const vpObstacleDetectorSpec &spec)
{
  return vpCollisionShape::box({target.width, target.height, target.depth > 0. ? target.depth : spec.thickness});
}
} // namespace

void vpObstacleDetectorSpec::validate() const
{
  fields.positive("thickness", thickness, "m");
  fields.positive("pixelSigma", pixelSigma, "px");
  fields.notNegative("greySigma", greySigma, "px");
  fields.notNegative("cameraPositionSigma", cameraPositionSigma, "m");
  fields.notNegative("cameraAngleSigma", cameraAngleSigma, "rad");
  fields.notNegative("scaleSigma", scaleSigma);
  fields.positive("maxPositionSigma", maxPositionSigma, "m");
}

vpPlanarTargetSpec vpObstacleDetector::fastTargets()
{
  vpPlanarTargetSpec spec;
  spec.fallback = false;
  spec.refinementSize = 120;
  spec.exact = false; // this class has its own, larger error estimates
  return spec;
}

vpObstacleDetector::vpObstacleDetector(vpPlanarTargetDatabase targets, const vpCameraParameters &camera,
                                       const vpObstacleDetectorSpec &spec)
  : m_targets(std::move(targets)), m_camera(camera), m_spec(spec)
{
  m_spec.validate();
  if (m_targets.size() == 0) {
    throw vpException(vpException::badValue, "the database of the obstacle detector has no target");
  }
  for (const vpPlanarTargetSighting &target : m_targets.sightings()) {
    vpObstacleDetection detection;
    detection.sighting.name = target.name;
    detection.sighting.shape = body(target, m_spec);
    detection.message = "No picture was taken yet.";
    m_detections.push_back(detection);
  }
  m_memory.resize(m_detections.size());
}

void vpObstacleDetector::reset()
{
  m_targets.reset();
  m_memory.assign(m_detections.size(), Memory());
  for (vpObstacleDetection &detection : m_detections) {
    detection.seen = false;
    detection.status = vpPlanarTargetStatus::NoFrame;
    detection.message = "No picture was taken yet.";
  }
}

const std::vector<vpObstacleDetection> &vpObstacleDetector::process(const vpImage<unsigned char> &image,
                                                                    const vpRigidTransform &fMc, double time)
{
  const bool known = vpIsPlace(fMc) && vpIsTime(time);
  if (known) {
    predict(fMc, time);
  }
  const std::vector<vpPlanarTargetSighting> &targets = m_targets.process(image);
  for (std::size_t i = 0; i < targets.size(); ++i) {
    vpObstacleDetection &detection = m_detections[i];
    detection.seen = false;
    detection.status = targets[i].result.status;
    detection.message = targets[i].result.message;
    if (!targets[i].result.found() || !known) {
      m_memory[i].isKnown = false;
    }
    if (!targets[i].result.found()) {
      continue;
    }
    if (!known) {
      detection.message = "Where the camera was, or when, is not finite or out of range.";
      continue;
    }
    remember(fMc * vpRigidTransform::fromHomogeneous(targets[i].result.cMo), time, m_memory[i]);
    conclude(targets[i], fMc, time, detection);
  }
  return m_detections;
}

// Predicts by the camera's motion and, if seen twice recently, by the target's own.
void vpObstacleDetector::predict(const vpRigidTransform &fMc, double time)
{
  for (std::size_t i = 0; i < m_memory.size(); ++i) {
    const Memory &memory = m_memory[i];
    const double dt = time - memory.time;
    if (!memory.isKnown) {
      continue;
    }
    vpRigidTransform fMo = memory.fMo;
    if (dt > 0. && dt < longestMotion) {
      fMo.p += dt * memory.linear;
      fMo.R = vpSO3::exp(dt * memory.angular) * fMo.R;
    }
    m_targets.predict(i, (fMc.inverse() * fMo).toHomogeneous());
  }
}

void vpObstacleDetector::remember(const vpRigidTransform &fMo, double time, Memory &memory)
{
  const double dt = time - memory.time;
  const bool isMotion = memory.isKnown && dt > 0. && dt < longestMotion;
  const vpRigidTransform before = memory.fMo;
  memory = Memory();
  memory.fMo = fMo;
  memory.time = time;
  memory.isKnown = true;
  if (isMotion) {
    memory.linear = (fMo.p - before.p) / dt;
    memory.angular = vpSO3::log(fMo.R * before.R.transpose()) / dt;
  }
}

void vpObstacleDetector::conclude(const vpPlanarTargetSighting &target, const vpRigidTransform &fMc, double time,
                                  vpObstacleDetection &detection) const
{
  const vpRigidTransform cMo = vpRigidTransform::fromHomogeneous(target.result.cMo);
  const double depth = detection.sighting.shape.size().z();
  const Matrix6 covariance =
      pixelVariance(target.result, m_spec) *
      information(cMo, target.width, target.height, depth, m_camera).ldlt().solve(Matrix6::Identity());
  const vpRigidTransform middle{Eigen::Matrix3d::Identity(), Eigen::Vector3d(0., 0., 0.5 * depth)};
  vpObjectSighting &sighting = detection.sighting;
  sighting.pose = fMc * cMo * middle;
  sighting.time = time;
  const double distance = (sighting.pose.p - fMc.p).norm();
  sighting.positionSigma = std::sqrt(worst(covariance.topLeftCorner<3, 3>()) + square(m_spec.cameraPositionSigma) +
                                     square(distance) * (square(m_spec.cameraAngleSigma) + square(m_spec.scaleSigma)));
  sighting.angleSigma = std::sqrt(worst(covariance.bottomRightCorner<3, 3>()) + square(m_spec.cameraAngleSigma));
  detection.seen = sighting.positionSigma <= m_spec.maxPositionSigma; // false for NaN
  if (!detection.seen) {
    char text[128];
    std::snprintf(text, sizeof(text), "Its place is uncertain by %.0f mm, at most %.0f mm are used.",
                  1e3 * sighting.positionSigma, 1e3 * m_spec.maxPositionSigma);
    detection.message = text;
  }
}

END_VISP_NAMESPACE
