/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpCollisionData.h
 * \brief Scratch memory and results of collision queries.
 */
#ifndef vpCollisionData_h
#define vpCollisionData_h

#include <visp3/manipulator/vpArmKinematics.h>

#include <array>
#include <limits>

BEGIN_VISP_NAMESPACE

//! \ingroup group_avoidance
//! \brief Maximum number of capsules of an arm in a vpCollisionScene.
constexpr int vpArmMaxCapsules = 128;

/*!
 * \ingroup group_avoidance
 * \brief A capsule of the arm in one configuration, in the base frame, m.
 */
struct VISP_EXPORT vpPlacedCapsule {
  Eigen::Vector3d from = Eigen::Vector3d::Zero();   //!< One end of the axis.
  Eigen::Vector3d to = Eigen::Vector3d::Zero();     //!< The other end.
  Eigen::Vector3d centre = Eigen::Vector3d::Zero(); //!< Midpoint of the axis.
  double radius = 0.;                               //!< Radius of the capsule.
  double halfLength = 0.;                           //!< Half the length of the axis.
};

/*!
 * \ingroup group_avoidance
 * \brief Data of the queries in one configuration: filled by vpCollisionScene::place(). One per thread.
 */
struct VISP_EXPORT vpCollisionData {
  vpArmData arm;                                          //!< Kinematics of the configuration.
  std::array<vpPlacedCapsule, vpArmMaxCapsules> capsules; //!< Capsules of the arm, in its order.
  //! Centres of the links' bounding spheres, in the base; for this module's own use.
  std::array<Eigen::Vector3d, vpArmMaxJoints + 1> centres;
  //! True if the last place() had a configuration of the arm's size with coordinates within vpLargestCoordinate.
  //! Otherwise, and before the first place(), every query reports a collision.
  bool placed = false;
};

//! \ingroup group_avoidance
//! \brief What is near a capsule of the arm.
enum class vpCollisionKind {
  None,   //!< Nothing within the cutoff.
  Object, //!< An object of the scene.
  Self,   //!< Another capsule of the arm.
  Ground, //!< The ground plane.
  Unknown //!< Configuration or time is not finite or out of range: the distance is -infinity.
};

/*!
 * \ingroup group_avoidance
 * \brief Signed distance of one pair, with nearest points; all in the base frame.
 *
 * distance = (distance of the capsule's axis from the other's core) - radius - the other's radius and inflation. The
 * core of a sphere is its centre, of a capsule its axis, of a box, cylinder or octree the solid itself, of the ground
 * the half space, of a mesh its surface. Positive: the exact gap. Negative: for spheres, capsules and the ground the
 * exact depth along \e normal; for boxes, cylinders and octrees exact until the axis itself is inside, then constant
 * at -(radius + inflation); inside a watertight mesh it keeps decreasing. It changes by at most the motion of its
 * parts.
 */
struct VISP_EXPORT vpClearance {
  //! Signed distance, m; infinity: no pair within the cutoff; -infinity: unknown (numbers out of range).
  double distance = std::numeric_limits<double>::infinity();
  vpCollisionKind kind = vpCollisionKind::None; //!< Kind of the other part.
  int capsule = -1;                             //!< Capsule of the arm, 0..m-1 in the order of vpArmSpec::capsules.
  int other = -1; //!< Index of the object, or of the other capsule (> capsule); -1 for the ground.
  Eigen::Vector3d onArm = Eigen::Vector3d::Zero();   //!< Nearest point on the capsule's surface.
  Eigen::Vector3d onOther = Eigen::Vector3d::Zero(); //!< Nearest point on the other part, inflation included.
  //! Unit vector from the other part to the capsule (separating direction): onArm = onOther + distance * normal.
  //! Arbitrary if the axis is inside the core.
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
};

/*!
 * \ingroup group_avoidance
 * \brief Pairs near the arm, for a control cycle: of each link and object, of each two links, and of each link and the
 * ground the pair with the least clearance. Fixed capacity: an arm of seven links among 32 objects cannot exceed it.
 */
struct VISP_EXPORT vpNearPairs {
  static constexpr int capacity = 256;     //!< Maximum number of pairs; the nearest are kept.
  std::array<vpClearance, capacity> pairs; //!< Pairs, unordered; only the first \e count are set.
  int count = 0;                           //!< Number of pairs set.
  bool dropped = false;                    //!< True if there were more.
};

END_VISP_NAMESPACE
#endif
