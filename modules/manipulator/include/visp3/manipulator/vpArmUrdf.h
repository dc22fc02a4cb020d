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

#include <map>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_manipulator
 * \brief Which part of a URDF file is the arm, and data that the file does not contain.
 */
struct VISP_EXPORT vpArmUrdfSpec {
  std::string base; //!< First link of the chain; empty: that of the group, else the root (above the tip).
  std::string tip;  //!< Last link; empty: that of the group, else the only leaf.
  std::string tool; //!< Link whose frame is the end effector, fixed to any link of the chain; empty: the last one.
  //! Camera link, fixed to any link of the chain; empty: the end effector itself.
  std::string camera;
  std::string srdf; //!< SRDF file with pairs that are not checked, groups and home configurations; empty: none.
  /*!
   * Group of the SRDF that gives base and tip if both are empty. Empty: the group that is one chain with more moving
   * joints than any other such group; groups made of groups are not used.
   */
  std::string group;
  //! Folders in which `package://` names are searched: packages, or what contains them; see vpLoadArmUrdf().
  std::vector<std::string> packagePaths;
  //! Joints that the caller promises to keep at a coordinate, rad or m: what they move is rigid.
  std::map<std::string, double> held;
  /*!
   * True: the caller promises to keep all joints beside the chain, too: at their coordinate in the home state, else
   * at 0 or the limit next to it. Those that mimic a joint of the chain still move.
   */
  bool holdOthers = false;
  //! File of limits in the format of MoveIt's joint_limits.yaml; velocity, acceleration and effort replace those of
  //! the URDF, positions narrow them. Empty: none.
  std::string limits;
  //! Velocity limits of the arm's joints, > 0, rad/s or m/s; empty: those of the files and of followers.
  vpJointVector velocity;
  //! Acceleration limit of the joints for which #limits has none, rad/s^2 or m/s^2, > 0.
  double acceleration = std::numeric_limits<double>::infinity();
  bool softLimits = true; //!< Narrow the position limits to the soft ones (`safety_controller`), as ros_control does.
  vpJointVector home;     //!< Home configuration, rad or m; empty: that of #homeState.
  std::string homeState;  //!< Group state of the SRDF. Empty: "home", "ready", "default" or the first, if complete.
};

/*!
 * \ingroup group_manipulator
 * \brief Reads the chain from base to tip.
 *
 * **Bodies.** All links of the chain and all that joints connect with it, also above the base, are vpArmSpec::bodies.
 * What is fixed to a link, by fixed joints and by held ones, belongs to it, with mass and shape. Collision geometry
 * becomes vpArmSpec::shapes; spheres, cylinders and boxes also become enclosing capsules. In vpArmSpec::uncovered are:
 * - bodies with a mesh, until it is covered;
 * - bodies that can be seen but have no collision geometry, and those of which a mesh file is not found; these have no
 *   shapes, except the capsules of what is known;
 * - bodies with a shape that a joint beside the chain moves, also one that mimics a joint of the chain. They have no
 *   shapes and no capsules. Except: spheres, cylinders and boxes that one prismatic joint moves by at most 0.1 m (a
 *   gripper's fingers) have capsules that enclose them wherever it is within its limits;
 * - links of the arm without any shape that have a mass, and all if no link has a shape, each by its first body.
 *
 * The mass of what moves beside the chain counts where it is with the joint at 0 or the limit next to it.
 *
 * **Meshes.** `package://NAME/...` is searched in vpArmUrdfSpec::packagePaths, then in the folders above the URDF
 * file: a folder is the package if it is called NAME or has a package.xml with this name. Other names are relative to
 * the file, or absolute, also after `file://`. The letter case of the suffix does not matter.
 *
 * **Joints.** Damping and friction become viscous and Coulomb friction. Joints that mimic one of the chain from beside
 * it are carried along, see above; a joint of the chain that mimics a held joint, or any with the ratio 0, is held.
 * One that mimics another joint of the chain is a follower (vpArmSpec::followers); so are all but the first of those
 * that mimic the same joint beside the chain, of which the first counts as independent within the limits of both. The
 * joint that is followed gets the followers' limits of position and velocity, also those of #vpArmUrdfSpec::limits, and
 * their friction, by their ratios; efforts of followers are not used.
 *
 * **Unknown values.** Effort or velocity limits that are missing, not > 0 or beyond vpArmLargest are infinite; a
 * negative mass, a mass of 0 of a link with a shape and an inertia that no body has make the mass of the whole link
 * unknown; a mass of 0 of a body that is fixed to a link is taken as included in the link's; empty shapes, and calls
 * of xacro macros that were never expanded, are left out. vpArmSpec::warnings says so, and what else was assumed:
 * names, roots, the group, soft limits, the home state, joints beside the chain that are not held, names of the other
 * files that this one does not have.
 *
 * \code
 * vpArmUrdfSpec spec;
 * spec.tip = "tool"; // links of the file
 * spec.camera = "camera";
 * spec.acceleration = 10.; // rad/s^2, which a URDF lacks
 * const vpArmModel robot = vpLoadArmUrdf("data/robot/generic-6r.urdf", spec);
 * for (const std::string &warning : robot.spec().warnings) {
 *   std::cerr << warning << std::endl; // what was assumed
 * }
 * \endcode
 * \throw vpException (ioError) if a file cannot be read, (badValue) if it is malformed or written in xacro, a link,
 * joint, group or state is missing, the tip is not unique or not below the base, the camera or the tool is not fixed to
 * a link of the chain, a joint of the chain is floating or planar, or vpArmModel rejects a value; one sentence with the
 * file and the element, or the field of \e spec.
 */
[[nodiscard]] VISP_EXPORT vpArmModel vpLoadArmUrdf(const std::string &file, const vpArmUrdfSpec &spec = {});

END_VISP_NAMESPACE
#endif
