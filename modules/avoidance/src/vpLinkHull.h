/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The capsules of each link within one sphere and one capsule, and the pairs of links that must not touch.
#ifndef vpLinkHull_h
#define vpLinkHull_h

#include <visp3/avoidance/vpCollisionScene.h>

BEGIN_VISP_NAMESPACE

//! Capsules of one link; poses in the moving frame of its joint, link 0: in the base.
struct vpLinkHull {
  int link = 0;
  std::vector<int> capsules;                        // In the order of the arm.
  vpArmCapsule bound;                               // Encloses them; its axis is in the convex hull of their axes.
  Eigen::Vector3d centre = Eigen::Vector3d::Zero(); // Of a sphere that encloses them.
  double radius = 0.;                               // Of this sphere.
};

//! Two links with pairs of capsules that must not touch: begin..end - 1 of the scene's self pairs.
struct vpLinkPair {
  int first = 0; // Hull of the link nearer to the base.
  int second = 0;
  int begin = 0;
  int end = 0;
};

//! Hulls of all links that have capsules, in the order of the links; capsules in the moving frames of the joints.
std::vector<vpLinkHull> vpFindHulls(const std::vector<vpArmCapsule> &capsules);

//! Pairs of capsules that must not touch, see vpCollisionScene; appends them to pairs.
std::vector<vpLinkPair> vpFindPairs(const vpArmModel &arm, const vpCollisionSceneSpec &spec,
                                    const std::vector<vpLinkHull> &hulls, std::vector<vpSelfPair> &pairs);

END_VISP_NAMESPACE
#endif
