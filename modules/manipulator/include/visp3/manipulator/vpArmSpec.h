/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpArmSpec.h
 * \brief Specification of an arm: joints, links, tool, camera. Filled by hand, from JSON or from URDF.
 */
#ifndef vpArmSpec_h
#define vpArmSpec_h

#include <visp3/manipulator/vpArmTypes.h>

#include <limits>
#include <string>
#include <utility>
#include <vector>

BEGIN_VISP_NAMESPACE

//! \ingroup group_manipulator
//! \brief Kind of a joint.
enum class vpJointType {
  Revolute,   //!< Rotates about its axis between two limits.
  Continuous, //!< Rotates about its axis without limits.
  Prismatic   //!< Moves along its axis between two limits.
};

/*!
 * \ingroup group_manipulator
 * \brief One joint, moving about or along z of its own frame. The frame of the moved link in the preceding link is
 * before * motion(q + offset) * after. Standard DH has before = I and after = Tz(d) Tx(a) Rx(alpha), modified DH
 * (Craig's) before = Rx(alpha) Tx(a) Tz(d) and after = I.
 */
struct VISP_EXPORT vpArmJointSpec {
  std::string name;                         //!< Name for messages; not empty.
  vpJointType type = vpJointType::Revolute; //!< Revolute, continuous or prismatic.
  vpRigidTransform before;                  //!< Joint frame in the frame of the preceding link.
  vpRigidTransform after;                   //!< Frame of the moved link in the joint frame.
  double offset = 0.;                       //!< Added to the joint's coordinate, rad or m (theta offset of DH).
  double lower = 0.;                        //!< Lower limit, rad or m; not used for a continuous joint.
  double upper = 0.;                        //!< Upper limit, rad or m, > lower; not used for a continuous joint.
  double velocity = std::numeric_limits<double>::infinity(); //!< Velocity limit, rad/s or m/s, > 0; infinity: unknown.
  //! Acceleration limit, rad/s^2 or m/s^2, > 0; infinity: unknown.
  double acceleration = std::numeric_limits<double>::infinity();
  double torque = std::numeric_limits<double>::infinity(); //!< Torque or force limit, Nm or N, > 0; infinity: unknown.
  double rotorInertia = 0.;                                //!< Inertia of the drive at the joint, kg m^2 or kg, >= 0.
  double viscous = 0.;                                     //!< Viscous friction, Nm s/rad or N s/m, >= 0.
  double coulomb = 0.;                                     //!< Coulomb friction, Nm or N, >= 0.
  double kp = 0.; //!< Position gain of the joint's drive, Nm/rad or N/m, >= 0; 0: unknown.
  double kd = 0.; //!< Velocity gain of the joint's drive, Nm s/rad or N s/m, >= 0; 0: unknown.

  //! Revolute joint from a row of a standard DH table: lengths in m, angles in rad.
  [[nodiscard]] static vpArmJointSpec standardDH(double a, double alpha, double d, double offset);
  //! Revolute joint from a row of a modified DH table: lengths in m, angles in rad; a and alpha of the link before it.
  [[nodiscard]] static vpArmJointSpec modifiedDH(double a, double alpha, double d, double offset);
};

/*!
 * \ingroup group_manipulator
 * \brief Joint of the chain whose coordinate is ratio * q + offset of another one (a mimic joint, a parallel linkage).
 *
 * It has no limits, friction or inertia of its own: those of the joint that it follows must allow for them.
 */
struct VISP_EXPORT vpArmFollower {
  std::string name;                         //!< Name for messages; not empty.
  vpJointType type = vpJointType::Revolute; //!< Revolute or continuous: rotates about z; prismatic: moves along z.
  vpRigidTransform before;                  //!< As vpArmJointSpec::before.
  vpRigidTransform after;                   //!< As vpArmJointSpec::after.
  int joint = 0;      //!< Joint that it follows, index into vpArmSpec::joints; at any place of the chain.
  double ratio = 1.;  //!< Its coordinate per coordinate of that joint, not 0, within +-100.
  double offset = 0.; //!< Its coordinate where that of the joint is 0, rad or m.
  int place = 0;      //!< Number of vpArmSpec::joints between the base and this one; followers with the same in order.
};

/*!
 * \ingroup group_manipulator
 * \brief Link moved by a joint, in the link frame (standard DH: frame i; URDF: frame of the child link).
 */
struct VISP_EXPORT vpArmLinkSpec {
  std::string name;                                  //!< Name for messages.
  bool hasMass = false;                              //!< False: mass unknown.
  double mass = 0.;                                  //!< Mass, kg, > 0 if hasMass.
  Eigen::Vector3d com = Eigen::Vector3d::Zero();     //!< Centre of mass, m.
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero(); //!< Inertia about the centre of mass, axes of the link, kg m^2.
};

/*!
 * \ingroup group_manipulator
 * \brief Rigid body of a description (a link of a URDF). Several bodies may be fixed to one link of the arm.
 */
struct VISP_EXPORT vpArmBody {
  std::string name; //!< Name in the description.
  int link = 0;     //!< Link that carries it, 1..l; 0: the base.
};

//! \ingroup group_manipulator
//! \brief Kind of a vpArmShape, with the meaning of its size.
enum class vpArmShapeKind {
  Sphere,   //!< size(0): radius, m.
  Cylinder, //!< size(0): radius, size(1): length along z, m; centred.
  Box,      //!< size: edges along x, y, z, m; centred.
  Mesh      //!< size: metres per unit of the file along x, y, z; any sign but not 0.
};

/*!
 * \ingroup group_manipulator
 * \brief Exact collision geometry of a body; capsules cover it.
 */
struct VISP_EXPORT vpArmShape {
  int body = 0;                                   //!< Index into vpArmSpec::bodies.
  vpArmShapeKind kind = vpArmShapeKind::Mesh;     //!< Kind.
  Eigen::Vector3d size = Eigen::Vector3d::Ones(); //!< See vpArmShapeKind.
  std::string file;                               //!< Path of the mesh on this machine; empty for other kinds.
  vpRigidTransform pose;                          //!< Frame of the shape in the link frame.
};

/*!
 * \ingroup group_manipulator
 * \brief Part of the arm's surface for collision checks: all points within radius of a segment; a sphere if both ends
 * coincide.
 */
struct VISP_EXPORT vpArmCapsule {
  int link = 0;                                   //!< Link that carries the capsule, 1..l; 0: the base.
  Eigen::Vector3d from = Eigen::Vector3d::Zero(); //!< One end of the axis, in the link frame, m.
  Eigen::Vector3d to = Eigen::Vector3d::Zero();   //!< The other end, in the link frame, m.
  double radius = 0.;                             //!< Radius, m, > 0.
  int body = -1;                                  //!< Index into vpArmSpec::bodies; -1: not of a named body.
};

/*!
 * \ingroup group_manipulator
 * \brief Specification of an arm; validated by vpArmModel.
 *
 * Links are numbered from the base (0) to the last one (l), one for each joint and follower in the order of the chain.
 *
 * \code
 * vpArmSpec spec; // two links in a plane
 * spec.name = "planar";
 * for (const char *name : {"shoulder", "elbow"}) {
 *   vpArmJointSpec joint = vpArmJointSpec::standardDH(0.3, 0., 0., 0.); // a, alpha, d, offset: m, rad
 *   joint.name = name;
 *   joint.lower = -2.5;       // rad
 *   joint.upper = 2.5;
 *   joint.velocity = 2.;      // rad/s
 *   joint.acceleration = 10.; // rad/s^2
 *   spec.joints.push_back(joint);
 * }
 * const vpArmModel planar(spec); // throws, naming what is wrong
 * \endcode
 */
struct VISP_EXPORT vpArmSpec {
  std::string name;                   //!< Name for messages.
  std::string source;                 //!< Source file, for messages; may be empty.
  std::vector<vpArmJointSpec> joints; //!< Joints from the base on, at least one: the coordinates of the arm.
  //! Joints that follow one of these; with them at most vpArmMaxJoints.
  std::vector<vpArmFollower> followers;
  std::vector<vpArmLinkSpec> links;   //!< Links 1..l, or none.
  std::vector<vpArmCapsule> capsules; //!< Capsules for collision checks; may be empty.
  std::vector<vpArmBody> bodies;      //!< Bodies of the description; may be empty.
  std::vector<vpArmShape> shapes;     //!< Exact collision geometry: all of a body or nothing; may be empty.
  //! Pairs of bodies that need no check against each other (disable_collisions of an SRDF), by name.
  std::vector<std::pair<std::string, std::string>> allowedBodies;
  /*!
   * Names of bodies whose shape is unknown or only partly covered by #capsules: a collision check would not see them.
   * vpCollisionScene refuses the arm unless each is in vpCollisionSceneSpec::ignoredBodies.
   */
  std::vector<std::string> uncovered;
  int toolLink = -1;                 //!< Link that carries the end effector, 1..l; -1: the last one.
  vpRigidTransform tool;             //!< End effector in the frame of its link.
  int cameraLink = -1;               //!< Link that carries the camera, 1..l; -1: it is fixed to the end effector.
  vpRigidTransform camera;           //!< Camera in the frame of its link; without one eMc, in the end effector's.
  vpJointVector home;                //!< Home configuration, rad or m, within the limits; empty: unknown.
  std::vector<std::string> warnings; //!< What the reader took as unknown, or assumed: one sentence each.
};

END_VISP_NAMESPACE
#endif
