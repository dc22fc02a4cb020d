/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPoseChoice.h
 * \brief Internal: decides between the two poses of a plane from the pixels, over time.
 */
#ifndef vpPoseChoice_h
#define vpPoseChoice_h

#include "vpPixelRefiner.h"

#include <array>
#include <optional>

BEGIN_VISP_NAMESPACE

//! The more likely pose, and the other one where it exists.
struct vpPoseDecision {
  vpPixelFit best; //!< more likely over the frames so far; valid if it converged
  std::optional<vpPixelFit> rival;
  double evidence = 0.;  //!< logarithm of the ratio of likelihoods, best over rival, over the frames so far
  double spreads = 0.;   //!< evidence over its standard deviation
  bool certain = true;   //!< the data decide
  bool doubtful = false; //!< not certain, though the other pose has no fit: the best one may be neither of the two
};

/*!
 * At weak perspective a plane has two poses with nearly the same image: the normal turned by 180 degrees about the line
 * of sight to the part that is seen. Both are refined on the pixels. Their squared residuals decide, L = sum (e_rival^2 - e^2) / (2 s^2),
 * ideally normal with mean d^2 / 2 and variance d^2, d the distance of the two images in deviations. The reliability of
 * L comes from the sums over blocks of the image: z is L over their spread. Certain: L > 9.2 (odds of 10,000) and z >
 * 3.
 *
 * A bad fit without a fit near its mirrored pose is certain in the first frame only if the mirrored pose itself fits
 * worse by the same test: it may be a false optimum, from which the right pose is out of reach.
 *
 * Over time the evidence accumulates and decays, L_k = 0.9 L_(k-1) + L, so that the choice can change.
 */
class vpPoseChoice
{
public:
  //! \e texture must outlive this object.
  vpPoseChoice(const vpTargetTexture &texture, const vpTargetPlane &plane, const vpPinhole &camera)
    : m_plane(plane),
      m_camera(camera), m_refiners{vpPixelRefiner(texture, plane, camera), vpPixelRefiner(texture, plane, camera)}
  {}

  //! \param image : CV_8UC1 frame. \param pose : Best pose of the previous frame, or a new one, within a pixel.
  const vpPoseDecision &decide(const cv::Mat &image, const vpRigidPose &pose, const vpCameraState &camera);
  //! True if \e pose continues the previous frame: nearer to its best pose than to the mirrored one.
  [[nodiscard]] bool follows(const vpRigidPose &pose) const;
  //! The next frame is independent of the previous ones.
  void forget() { m_memory.reset(); }

private:
  struct Evidence {
    double L = 0., variance = 0.;
  };
  struct Memory {
    vpRigidPose best;
    Eigen::Matrix3d mirrored; // rotation of its mirrored pose
    Evidence evidence;        // for best
  };

  vpRigidPose mirrored(const cv::Mat &image, const vpRigidPose &pose) const;
  bool isPlain(const cv::Mat &image, const vpRigidPose &rival);
  bool refineRival(const cv::Mat &image);
  bool isDoubtful(const cv::Mat &image, const vpRigidPose &rival);
  [[nodiscard]] Evidence compare() const;
  void conclude(Evidence now);

  vpTargetPlane m_plane;
  vpPinhole m_camera;
  std::array<vpPixelRefiner, 2> m_refiners; // of the given pose, and of its rival
  std::optional<Memory> m_memory;
  vpPoseDecision m_decision;
};

//! The other pose with the same image to first order about a point of the plane, \e pivot, which keeps its place: normal
//! rotated by 180 degrees about the line of sight to it.
[[nodiscard]] vpRigidPose rivalPose(const vpRigidPose &pose, const Eigen::Vector2d &pivot);

END_VISP_NAMESPACE
#endif
