/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpPlaneGeometry.h"

#include <visp3/core/vpException.h>
#include <visp3/direct_core/vpQuantile.h>

#include <Eigen/LU>

#include <opencv2/calib3d.hpp>

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

vpRigidPose vpRigidPose::fromMatrix(const vpHomogeneousMatrix &M)
{
  vpRigidPose pose;
  for (unsigned int i = 0; i < 3; ++i) {
    for (unsigned int j = 0; j < 3; ++j) {
      pose.R(i, j) = M[i][j];
    }
    pose.t(i) = M[i][3];
  }
  return pose;
}

void vpRigidPose::copyTo(vpHomogeneousMatrix &M) const
{
  for (unsigned int i = 0; i < 3; ++i) {
    for (unsigned int j = 0; j < 3; ++j) {
      M[i][j] = R(i, j);
    }
    M[i][3] = t(i);
  }
}

vpPinhole vpPinhole::fromCamera(const vpCameraParameters &camera)
{
  vpPinhole p;
  p.px = camera.get_px();
  p.py = camera.get_py();
  p.u0 = camera.get_u0();
  p.v0 = camera.get_v0();
  if (!(p.px > 0.) || !(p.py > 0.) || !std::isfinite(p.px) || !std::isfinite(p.py)) {
    throw vpException(vpException::badValue, "focal length of the camera is %g x %g px, must be > 0", p.px, p.py);
  }
  if (!std::isfinite(p.u0) || !std::isfinite(p.v0)) {
    throw vpException(vpException::badValue, "principal point of the camera is (%g, %g), must be finite", p.u0, p.v0);
  }
  switch (camera.get_projModel()) {
  case vpCameraParameters::perspectiveProjWithoutDistortion:
    break;
  case vpCameraParameters::perspectiveProjWithDistortion:
    p.kud = camera.get_kud();
    break;
  default:
    throw vpException(vpException::badValue,
                      "camera model %d is not supported, use perspectiveProjWithoutDistortion or "
                      "perspectiveProjWithDistortion",
                      static_cast<int>(camera.get_projModel()));
  }
  return p;
}

vpPinhole vpPinhole::atLevel(int level) const
{
  const double s = std::ldexp(1., -level);
  return {px * s, py * s, u0 * s, v0 * s, kud};
}

Eigen::Vector2d vpPinhole::project(const Eigen::Vector2d &x) const
{
  const double d = 1. + kud * x.squaredNorm();
  return {u0 + px * d * x.x(), v0 + py * d * x.y()};
}

Eigen::Vector2d vpTargetPlane::metric(double u, double v) const
{
  return {((u + 0.5) / cols - 0.5) * width, ((v + 0.5) / rows - 0.5) * height};
}

std::array<Eigen::Vector2d, 4> vpTargetPlane::corners() const
{
  const double x = 0.5 * width, y = 0.5 * height;
  return {Eigen::Vector2d(-x, -y), Eigen::Vector2d(x, -y), Eigen::Vector2d(x, y), Eigen::Vector2d(-x, y)};
}

Eigen::Matrix3d vpTargetPlane::homography(const vpRigidPose &pose, const vpPinhole &camera) const
{
  Eigen::Matrix3d K, pixelToPlane, planeToCamera;
  K << camera.px, 0., camera.u0, 0., camera.py, camera.v0, 0., 0., 1.;
  pixelToPlane << width / cols, 0., (0.5 / cols - 0.5) * width, 0., height / rows, (0.5 / rows - 0.5) * height, 0., 0.,
      1.;
  planeToCamera << pose.R.col(0), pose.R.col(1), pose.t;
  const Eigen::Matrix3d H = K * planeToCamera * pixelToPlane;
  return H(2, 2) != 0. ? Eigen::Matrix3d(H / H(2, 2)) : H;
}

double frontality(const vpRigidPose &pose)
{
  return pose.R.col(2).dot(pose.t) / pose.t.norm(); // z of the target points away from a camera in front of it
}

double nearestCornerDepth(const vpTargetPlane &plane, const vpRigidPose &pose)
{
  double depth = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector2d &c : plane.corners()) {
    depth = std::min(depth, pose.R(2, 0) * c.x() + pose.R(2, 1) * c.y() + pose.t.z());
  }
  return depth;
}

double imageScale(const vpRigidPose &pose, const vpPinhole &camera)
{
  // det of the Jacobian of the plane's projection at its origin: n.t / Z^3
  const double Z = pose.t.z();
  return camera.px * camera.py * std::abs(pose.R.col(2).dot(pose.t)) / std::abs(Z * Z * Z);
}

Eigen::Vector2d seenCentre(const vpTargetPlane &plane, const vpRigidPose &pose, const vpPinhole &camera, int cols,
                           int rows)
{
  constexpr int steps = 12; // each way
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  int inside = 0;
  for (int i = 0; i < steps * steps; ++i) {
    const Eigen::Vector2d X(((i % steps + 0.5) / steps - 0.5) * plane.width,
                            ((i / steps + 0.5) / steps - 0.5) * plane.height);
    const Eigen::Vector3d P = pose.R.leftCols<2>() * X + pose.t;
    const Eigen::Vector2d p = camera.project(P.head<2>() / P.z());
    if (P.z() > 0. && p.x() >= 0. && p.x() <= cols - 1 && p.y() >= 0. && p.y() <= rows - 1) {
      sum += X;
      ++inside;
    }
  }
  return inside == 0 || inside == steps * steps ? Eigen::Vector2d::Zero() : Eigen::Vector2d(sum / inside);
}

vpPlanePoses planePoses(const vpPlaneMatches &matches, double planePixels, double imagePixels, double threshold,
                        unsigned int minInliers)
{
  vpPlanePoses poses;
  const std::size_t n = matches.plane.size();
  if (n < std::max(4u, minInliers)) {
    return poses;
  }
  std::vector<cv::Point2d> from(n), to(n);
  for (std::size_t i = 0; i < n; ++i) {
    from[i] = {planePixels * matches.plane[i].x(), planePixels * matches.plane[i].y()};
    to[i] = {imagePixels * matches.image[i].x(), imagePixels * matches.image[i].y()};
  }
  // In pixels: MAGSAC's tables and degeneracy tests assume pixels and fail in metres.
  std::vector<unsigned char> mask;
  const cv::Mat H = cv::findHomography(from, to, cv::USAC_MAGSAC, threshold, mask, 2000, 0.999);
  if (H.empty()) {
    return poses;
  }
  std::vector<cv::Point3d> object;
  std::vector<cv::Point2d> image;
  for (std::size_t i = 0; i < n; ++i) {
    if (mask[i]) {
      object.emplace_back(matches.plane[i].x(), matches.plane[i].y(), 0.);
      image.emplace_back(matches.image[i].x(), matches.image[i].y());
      poses.inliers.push_back(i);
    }
  }
  if (poses.inliers.size() < minInliers) {
    return poses;
  }
  const cv::Matx33d identity = cv::Matx33d::eye();
  std::vector<cv::Mat> rotations, translations;
  std::vector<double> errors;
  cv::solvePnPGeneric(object, image, identity, cv::noArray(), rotations, translations, false, cv::SOLVEPNP_IPPE,
                      cv::noArray(), cv::noArray(), errors);
  for (std::size_t i = 0; i < std::min<std::size_t>(2, rotations.size()); ++i) {
    // A rival with twice the error of the best is excluded by the points alone.
    if (i == 1 && errors[1] > 2. * errors[0]) {
      break;
    }
    cv::solvePnPRefineLM(object, image, identity, cv::noArray(), rotations[i], translations[i]);
    cv::Matx33d R;
    cv::Rodrigues(rotations[i], R);
    vpRigidPose pose;
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) {
        pose.R(r, c) = R(r, c);
      }
      pose.t(r) = translations[i].at<double>(r);
    }
    if (i == 0) {
      poses.best = pose;
    }
    else {
      poses.rival = pose;
    }
  }
  return poses;
}

double medianError(const vpPlaneMatches &matches, const std::vector<std::size_t> &which, const vpRigidPose &pose)
{
  std::vector<double> errors;
  for (std::size_t i : which) {
    const Eigen::Vector3d P = pose.R.leftCols<2>() * matches.plane[i] + pose.t;
    errors.push_back((P.head<2>() / P.z() - matches.image[i]).norm());
  }
  return errors.empty() ? 0. : vpMedian(std::move(errors));
}

END_VISP_NAMESPACE
