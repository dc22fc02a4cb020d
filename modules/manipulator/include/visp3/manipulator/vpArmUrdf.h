/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpArmUrdf.h
 * \brief Loads an arm from a URDF file. Requires a build with urdfdom.
 */
#ifndef vpArmUrdf_h
#define vpArmUrdf_h

#include <visp3/manipulator/vpArmModel.h>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_manipulator
 * \brief Data that a URDF file does not contain.
 */
struct VISP_EXPORT vpArmUrdfSpec {
  std::string base;   //!< First link of the chain; empty: the root.
  std::string tip;    //!< Last link, whose frame is the end effector; empty: the only leaf.
  std::string camera; //!< Camera link, fixed to the end effector's link; empty: the end effector itself.
  //! Acceleration limit of all joints, rad/s^2 or m/s^2, > 0; URDF has none.
  double acceleration = std::numeric_limits<double>::infinity();
};

/*!
 * \ingroup group_manipulator
 * \brief Reads the chain from base to tip. Fixed joints are merged into their neighbours with the masses they carry;
 * cylinders, spheres and boxes of the collision geometry become enclosing capsules; damping and friction become viscous
 * and Coulomb friction. Bodies on side branches that are fixed to a link of the chain belong to it, with mass and
 * shape. A body that has a mesh as collision geometry, or none at all but something to be seen, and a body with a shape
 * that a joint outside the chain moves, is named in vpArmSpec::uncovered; the mass of the latter is ignored.
 * \throw vpException (ioError) if the file cannot be read, (badValue) if it is malformed, a link is missing, the
 * tip is not unique or not below the base, a joint type is unsupported (floating, planar, mimic), or
 * vpArmModel rejects a value; one sentence with the file and the element.
 */
[[nodiscard]] VISP_EXPORT vpArmModel vpLoadArmUrdf(const std::string &file, const vpArmUrdfSpec &spec = {});

END_VISP_NAMESPACE
#endif
