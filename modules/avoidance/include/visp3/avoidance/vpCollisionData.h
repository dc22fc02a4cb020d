/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpCollisionData.h
 * \brief Scratch and results of collision queries.
 */
#ifndef vpCollisionData_h
#define vpCollisionData_h

#include <visp3/manipulator/vpArmKinematics.h>

#include <array>
#include <limits>

BEGIN_VISP_NAMESPACE

//! \ingroup group_avoidance
//! \brief Most capsules that an arm in a vpCollisionScene may have.
constexpr int vpArmMaxCapsules = 32;

/*!
 * \ingroup group_avoidance
 * \brief A capsule of the arm in one configuration, in the base frame, m.
 */
struct VISP_EXPORT vpPlacedCapsule {
  Eigen::Vector3d from = Eigen::Vector3d::Zero();   //!< One end of the axis.
  Eigen::Vector3d to = Eigen::Vector3d::Zero();     //!< The other end.
  Eigen::Vector3d centre = Eigen::Vector3d::Zero(); //!< Half way.
  double radius = 0.;                               //!< Of the capsule.
  double halfLength = 0.;                           //!< Half the axis.
};

/*!
 * \ingroup group_avoidance
 * \brief Scratch of the queries in one configuration: filled by vpCollisionScene::place(). One for each thread.
 */
struct VISP_EXPORT vpCollisionData {
  vpArmData arm;                                          //!< Kinematics of the configuration.
  std::array<vpPlacedCapsule, vpArmMaxCapsules> capsules; //!< As many as the arm has, in its order.
  //! The last place() had a configuration of the arm's size with coordinates within vpLargestCoordinate. Otherwise, as
  //! before the first one, nothing is known, and every query says so: in collision.
  bool placed = false;
};

//! \ingroup group_avoidance
//! \brief What came near the arm's capsule.
enum class vpCollisionKind {
  None,   //!< Nothing within the cutoff.
  Object, //!< An object of the scene.
  Self,   //!< Another capsule of the arm.
  Ground, //!< The ground plane.
  Unknown //!< Configuration or time is not finite or out of all range: nothing is known, the distance is -infinity.
};

/*!
 * \ingroup group_avoidance
 * \brief Signed distance of one pair, with nearest points; all in the base frame.
 *
 * distance = (distance of the capsule's axis from the other's core) - radius - the other's radius and inflation. The
 * core of a sphere is its centre, of a capsule its axis, of a box, cylinder or octree the solid itself, of the ground
 * the half space, of a mesh its surface. Positive: the exact gap. Negative: with spheres, capsules and the ground the
 * exact depth along \e normal; with boxes, cylinders and octrees exact until the axis itself is inside, from where on
 * it stays at -(radius + inflation); inside a watertight mesh it goes on to fall. It changes by no more than its parts
 * move.
 */
struct VISP_EXPORT vpClearance {
  //! m; infinity: no pair within the cutoff; -infinity: not known (numbers out of all range).
  double distance = std::numeric_limits<double>::infinity();
  vpCollisionKind kind = vpCollisionKind::None; //!< What the other is.
  int capsule = -1;                             //!< Capsule of the arm, 0..m-1 in the order of vpArmSpec::capsules.
  int other = -1; //!< Object's index, or the other capsule (> capsule); -1 for the ground.
  Eigen::Vector3d onArm = Eigen::Vector3d::Zero();   //!< Nearest point of the capsule's surface.
  Eigen::Vector3d onOther = Eigen::Vector3d::Zero(); //!< Nearest point of the other, inflation included.
  //! Unit vector from the other to the capsule, the way out: onArm = onOther + distance * normal. Arbitrary when the
  //! axis is inside the core.
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
};

/*!
 * \ingroup group_avoidance
 * \brief Pairs near the arm, for a control cycle; fixed capacity.
 */
struct VISP_EXPORT vpNearPairs {
  static constexpr int capacity = 128;     //!< The nearest 128 are kept.
  std::array<vpClearance, capacity> pairs; //!< In no order; only the first \e count are set.
  int count = 0;                           //!< Pairs set.
  bool dropped = false;                    //!< True when there were more.
};

END_VISP_NAMESPACE
#endif
