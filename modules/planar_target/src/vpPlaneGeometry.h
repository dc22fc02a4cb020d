/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPlaneGeometry.h
 * \brief Internal: camera, rigid motion and plane on fixed-size types, and the pose of a plane from matched points.
 *
 * Pixels: (0,0) is the centre of the top-left pixel. The reference image of W x H pixels covers width x height metres
 * from outer edge to outer edge, so the centre of reference pixel (u,v) is at X = ((u + 0.5) / W - 0.5) width, Y alike.
 */
#ifndef vpPlaneGeometry_h
#define vpPlaneGeometry_h

#include <visp3/core/vpCameraParameters.h>
#include <visp3/core/vpHomogeneousMatrix.h>
#include <visp3/direct_core/vpDirectCompat.h>

#include <Eigen/Core>

#include <array>
#include <optional>
#include <utility>
#include <vector>

BEGIN_VISP_NAMESPACE

//! Pose of the target in the camera: a point of the target at P is at R P + t.
struct vpRigidPose {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  Eigen::Vector3d t = Eigen::Vector3d::Zero();

  static vpRigidPose fromMatrix(const vpHomogeneousMatrix &M);
  void copyTo(vpHomogeneousMatrix &M) const;
  [[nodiscard]] bool isFinite() const { return R.allFinite() && t.allFinite(); }
};

//! ViSP's camera, perspective with or without the distortion kud, as plain numbers.
struct vpPinhole {
  double px = 0., py = 0., u0 = 0., v0 = 0.;
  double kud = 0.; //!< undistorted to distorted: (x, y) (1 + kud r^2)

  //! \throw vpException (badValue) naming the focal length or the camera model that cannot be used.
  static vpPinhole fromCamera(const vpCameraParameters &camera);
  //! The camera of pyramid level \e level (see vpTargetFrame).
  [[nodiscard]] vpPinhole atLevel(int level) const;
  //! Normalised coordinates to pixels.
  [[nodiscard]] Eigen::Vector2d project(const Eigen::Vector2d &x) const;
};

//! The target's rectangle in its own plane z = 0.
struct vpTargetPlane {
  double width = 0., height = 0.; //!< m
  int cols = 0, rows = 0;         //!< of the reference image

  //! Reference pixel to plane, m.
  [[nodiscard]] Eigen::Vector2d metric(double u, double v) const;
  //! Outer corners, m: top left, top right, bottom right, bottom left.
  [[nodiscard]] std::array<Eigen::Vector2d, 4> corners() const;
  //! Reference pixels to pixels of a camera without distortion, H(2,2) = 1 (0 for a reference at infinity).
  [[nodiscard]] Eigen::Matrix3d homography(const vpRigidPose &pose, const vpPinhole &camera) const;
};

//! Cosine of the angle between the line of sight to the target's centre and its normal: 1 frontal, < 0 from behind.
[[nodiscard]] double frontality(const vpRigidPose &pose);
//! Smallest depth of the four corners, m.
[[nodiscard]] double nearestCornerDepth(const vpTargetPlane &plane, const vpRigidPose &pose);
//! Area of the target in the image over its area in the plane, at the target's centre, px^2 / m^2.
[[nodiscard]] double imageScale(const vpRigidPose &pose, const vpPinhole &camera);

//! Centre of the part of the target that is in an image of cols x rows pixels, m in the plane; 0 if that is all or none.
[[nodiscard]] Eigen::Vector2d seenCentre(const vpTargetPlane &plane, const vpRigidPose &pose, const vpPinhole &camera,
                                         int cols, int rows);

//! Points of the plane (m) and their image positions (normalised coordinates).
struct vpPlaneMatches {
  std::vector<Eigen::Vector2d> plane;
  std::vector<Eigen::Vector2d> image;
};

//! Both poses that a plane may have for the same points, better first; the second only if it is plausible.
struct vpPlanePoses {
  std::vector<std::size_t> inliers; //!< indices of the matches that agree
  vpRigidPose best;                 //!< valid if there are enough inliers
  std::optional<vpRigidPose> rival;
};

/*!
 * Homography by USAC_MAGSAC, then the poses of its inliers (IPPE, then Levenberg-Marquardt on the reprojection error).
 * \param planePixels, imagePixels : Pixels per metre of the plane and per normalised unit of the image.
 * \param threshold : Largest reprojection error of an inlier, px.
 * \param minInliers : Minimum number of inliers for a pose.
 */
vpPlanePoses planePoses(const vpPlaneMatches &matches, double planePixels, double imagePixels, double threshold,
                        unsigned int minInliers);

//! Median reprojection error of some matches at a pose, normalised units.
double medianError(const vpPlaneMatches &matches, const std::vector<std::size_t> &which, const vpRigidPose &pose);

END_VISP_NAMESPACE
#endif
