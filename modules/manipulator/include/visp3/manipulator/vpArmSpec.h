/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpArmSpec.h
 * \brief What makes an arm: joints, links, tool, camera. Filled by hand, from JSON or from URDF.
 */
#ifndef vpArmSpec_h
#define vpArmSpec_h

#include <visp3/manipulator/vpArmTypes.h>

#include <limits>
#include <string>
#include <vector>

BEGIN_VISP_NAMESPACE

//! \ingroup group_manipulator
//! \brief Kind of a joint.
enum class vpJointType {
  Revolute,   //!< Turns about its axis between two limits.
  Continuous, //!< Turns about its axis without end.
  Prismatic   //!< Moves along its axis between two limits.
};

/*!
 * \ingroup group_manipulator
 * \brief One joint. It moves about or along z of its own frame; the frame of the link that it moves is
 * before * motion(q + offset) * after in the frame of the link before. Standard DH has before = I and after = Tz(d)
 * Tx(a) Rx(alpha).
 */
struct VISP_EXPORT vpArmJointSpec {
  std::string name;                         //!< For messages; not empty.
  vpJointType type = vpJointType::Revolute; //!< Revolute, continuous or prismatic.
  vpRigidTransform before;                  //!< Joint's frame in the frame of the link before it.
  vpRigidTransform after;                   //!< Frame of the moved link in the joint's frame.
  double offset = 0.;                       //!< Added to the joint's coordinate, rad or m (theta offset of DH).
  double lower = 0.;                        //!< Lower limit, rad or m; not used for a continuous joint.
  double upper = 0.;                        //!< Upper limit, rad or m, > lower; not used for a continuous joint.
  double velocity = std::numeric_limits<double>::infinity(); //!< Limit, rad/s or m/s, > 0; infinity: none known.
  //! Limit, rad/s^2 or m/s^2, > 0; infinity: none known.
  double acceleration = std::numeric_limits<double>::infinity();
  double torque = std::numeric_limits<double>::infinity(); //!< Limit, Nm or N, > 0; infinity: none known.
  double rotorInertia = 0.;                                //!< Of the drive, seen at the joint, kg m^2 or kg, >= 0.
  double viscous = 0.;                                     //!< Viscous friction, Nm s/rad or N s/m, >= 0.
  double coulomb = 0.;                                     //!< Coulomb friction, Nm or N, >= 0.
  double kp = 0.; //!< Position gain of the joint's drive, Nm/rad or N/m, >= 0; 0: not known.
  double kd = 0.; //!< Velocity gain of the joint's drive, Nm s/rad or N s/m, >= 0; 0: not known.

  //! A revolute joint by its row of a standard DH table: lengths in m, angles in rad.
  [[nodiscard]] static vpArmJointSpec standardDH(double a, double alpha, double d, double offset);
};

/*!
 * \ingroup group_manipulator
 * \brief The link that a joint moves, in the link's frame (standard DH: frame i; URDF: the child link's frame).
 */
struct VISP_EXPORT vpArmLinkSpec {
  std::string name;                                  //!< For messages.
  bool hasMass = false;                              //!< False: nothing is known of its mass.
  double mass = 0.;                                  //!< kg, > 0 when hasMass.
  Eigen::Vector3d com = Eigen::Vector3d::Zero();     //!< Centre of mass, m.
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero(); //!< About the centre of mass, axes of the link, kg m^2.
};

/*!
 * \ingroup group_manipulator
 * \brief Part of the arm's surface for collision checks: all points within radius of a segment; a sphere when the ends
 * agree.
 */
struct VISP_EXPORT vpArmCapsule {
  int link = 0;                                   //!< 1..n: the link that carries it; 0: the base.
  Eigen::Vector3d from = Eigen::Vector3d::Zero(); //!< One end, in the link's frame, m.
  Eigen::Vector3d to = Eigen::Vector3d::Zero();   //!< The other end, m.
  double radius = 0.;                             //!< m, > 0.
};

/*!
 * \ingroup group_manipulator
 * \brief A whole arm. vpArmModel checks it.
 */
struct VISP_EXPORT vpArmSpec {
  std::string name;                   //!< For messages.
  std::string source;                 //!< File it came from, for messages; may be empty.
  std::vector<vpArmJointSpec> joints; //!< 1..8, from the base on.
  std::vector<vpArmLinkSpec> links;   //!< As many as joints, or none.
  std::vector<vpArmCapsule> capsules; //!< May be empty.
  vpRigidTransform tool;              //!< End effector in the frame of the last link.
  vpRigidTransform camera;            //!< eMc: camera in the end effector's frame.
  vpJointVector home;                 //!< Where work starts, rad or m, within the limits; empty: not known.
};

END_VISP_NAMESPACE
#endif
