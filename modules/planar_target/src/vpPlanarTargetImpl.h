/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPlanarTargetImpl.h
 * \brief Internal: vpPlanarTarget on a frame that several targets may share.
 */
#ifndef vpPlanarTargetImpl_h
#define vpPlanarTargetImpl_h

#include "vpPhotometricRefiner.h"
#include "vpPoseChoice.h"
#include "vpTargetSearch.h"

BEGIN_VISP_NAMESPACE

class vpPlanarTarget::Impl
{
public:
  Impl(const vpImage<unsigned char> &reference, double width, double height, const vpCameraParameters &camera,
       const vpPlanarTargetSpec &spec);

  //! One detector with its keypoints on the reference.
  struct Reference {
    vpKeypointType type;
    vpKeypointSet keypoints;
    vpKeypointSet telling; //!< The most distinctive ones, see tellingKeypoints().
    std::vector<Eigen::Vector2d> plane;
  };

  void process(vpTargetFrame &frame);
  void acquire(vpTargetFrame &frame);
  //! Acquire by keypoints \e current of the frame, or of a part of it.
  void acquireWith(const Reference &reference, const vpKeypointSet &current, const vpTargetFrame &frame);
  //! Number of matches of a part of a reference's keypoints.
  [[nodiscard]] static std::size_t matchesOf(const vpKeypointSet &part, const vpKeypointSet &current);
  void track(vpTargetFrame &frame, const vpRigidPose &guess);
  //! Track from the last pose; without one, the status of the last frame stays.
  void trackLast(vpTargetFrame &frame);
  //! Forget the pose of the target.
  void reset();
  //! Result for a frame that is too small to be processed.
  bool refuse(const vpImage<unsigned char> &image);

  vpPlanarTargetSpec m_spec;
  vpCameraParameters m_viewer; //!< as given, for undistortion
  vpPinhole m_camera;
  vpTargetPlane m_plane;
  vpTargetFrame m_ownFrame;
  vpPlanarTargetResult m_result;
  bool m_fresh = true;    //!< no search since the last reset
  bool m_known = false;   //!< m_result holds the pose of the previous frame
  bool m_decided = false; //!< between the two poses of the plane, since the target was acquired

  std::vector<Reference> m_references; //!< The detector of the settings, and the fallback if wanted.
  void fail(vpPlanarTargetStatus status, const std::string &message);

private:
  bool trackFrom(const vpTargetFrame &frame, const vpRigidPose &guess, double reach);
  //! A start of an acquisition after the refinement; agrees: with the keypoints.
  struct Candidate {
    vpRigidPose pose;
    double correlation = 0.;
    bool converged = false, agrees = false;
  };
  Candidate refineStart(const vpTargetFrame &frame, const vpRigidPose &start, const vpPlaneMatches &matches,
                        const std::vector<std::size_t> &inliers);
  void preferRival(const vpTargetFrame &frame, vpRigidPose &pose, double reach);
  bool checkView(const vpRigidPose &pose);
  //! In every frame, or only until it is decided which of the plane's two poses is the right one.
  [[nodiscard]] bool usesLastStage() const { return m_choice && (m_spec.exact || !m_decided); }
  void acquireFrom(const vpTargetFrame &frame, const std::vector<Candidate> &candidates);
  vpPoseDecision decide(const vpTargetFrame &frame, const vpRigidPose &coarse);
  bool conclude(const vpTargetFrame &frame, const vpRigidPose &coarse, vpPlanarTargetStatus success);
  bool finish(const vpTargetFrame &frame, const vpRigidPose &coarse, const vpPoseDecision &decision,
              vpPlanarTargetStatus success);
  bool confirm(const vpTargetFrame &frame, const vpRigidPose &pose);
  void report(const vpRigidPose &pose, const vpPoseDecision &decision, vpPlanarTargetStatus success);

  vpTargetSearch m_search;
  std::unique_ptr<vpPhotometricModel> m_model;
  std::unique_ptr<vpPhotometricRefiner> m_refiner;
  std::unique_ptr<vpTargetTexture> m_texture;
  std::unique_ptr<vpPoseChoice> m_choice; //!< none without refinement
  double m_blur = 0.7;                    //!< of the previous frame, px
};

END_VISP_NAMESPACE
#endif
