/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpSelfMotionIndex.h
 * \brief Self-motion criteria: indices of a configuration with exact gradients.
 */
#ifndef vpSelfMotionIndex_h
#define vpSelfMotionIndex_h

#include <visp3/manipulator/vpArmKinematics.h>

BEGIN_VISP_NAMESPACE

//! \ingroup group_manipulator
//! \brief Sense of a distance index.
enum class vpIndexSense {
  Attract, //!< Decrease the distance.
  Repel    //!< Increase the distance.
};

//! \ingroup group_manipulator
//! \brief Quantity that an index measures.
enum class vpIndexKind {
  Manipulability, //!< (3.25), (3.27): distance from singularities \cite Yoshikawa85.
  PointDistance,  //!< (3.29): distance of a joint from a point.
  LineDistance,   //!< (3.35): distance of a joint from the segment between base and tool.
  PlaneDistance,  //!< (3.41): signed distance of a joint from a plane.
  JointLimits,    //!< Distance of all joints from their limits.
  Posture         //!< Distance from a preferred configuration.
};

/*!
 * \ingroup group_manipulator
 * \brief Criterion for the self-motion; create it with the functions below. The solver maximizes gain times index.
 *
 * Thesis 3.3.2, corrected. The text sums J^# x over 6 x n partial Jacobians, which are singular for every usable joint;
 * the true gradient of a distance is J_p^T times a unit vector. The index is a function of the distance d with slope
 * at most 1: to attract, -s (sqrt(1 + (d/s)^2) - 1); to repel, -s exp(-d/s) from points and lines and -s log(1 +
 * exp(-d/s)) from planes, so that repulsion decays with distance (the raw vector repels more when farther away), and a
 * joint on the wrong side of a plane is led back. Sense and gain >= 0 replace the sign of k0, on which the text and
 * figures 8.14 and 8.17 disagree.
 *
 * \code
 * const vpSelfMotionIndex elbow = // the origin of joint 4 stays above the table, z = 0
 *     vpSelfMotionIndex::planeDistance(3, {0., 0., 0.}, {0., 0., 1.}, vpIndexSense::Repel);
 * elbow.validate(arm); // throws, naming what does not fit
 * vpArmData data;
 * vpIndexValue value;
 * if (vpArmKinematics::update(arm, q, data) && vpEvaluateIndex(arm, data, elbow, value)) {
 *   std::cout << value.distance << " m above it" << std::endl;
 * }
 * \endcode
 */
struct VISP_EXPORT vpSelfMotionIndex {
  vpIndexKind kind = vpIndexKind::Manipulability; //!< Quantity measured.
  double gain = 1.;                               //!< Weight among the indices, >= 0.
  vpIndexSense sense = vpIndexSense::Repel;       //!< Sense, for the three distance kinds.
  int joint = 0; //!< Joint or follower of the chain whose origin is used, from 0; q4 of the thesis is 3.
  Eigen::Vector3d point = Eigen::Vector3d::Zero();   //!< The point, or a point of the plane, in the base, m.
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ(); //!< Unit normal of the plane, towards the allowed side.
  double range = 0.2;                                //!< Length scale s of the distance function, m, > 0.
  vpJointVector reference;                           //!< Preferred posture, n numbers, rad or m.
  vpJointVector weights;                             //!< Diagonal of W in (3.27), n numbers > 0; empty: the identity.
  double taskLength = 1.;                            //!< Weight of the angular rows of (3.27), m/rad, > 0.

  //! Manipulability (3.25), units not scaled.
  [[nodiscard]] static vpSelfMotionIndex manipulability(double gain = 1.);
  //! Weighted manipulability (3.27), with joint weights and a length for radians, which makes the units consistent.
  [[nodiscard]] static vpSelfMotionIndex weightedManipulability(const vpJointVector &weights, double taskLength,
                                                                double gain = 1.);
  //! Distance of joint \e joint from a point in the base.
  [[nodiscard]] static vpSelfMotionIndex pointDistance(int joint, const Eigen::Vector3d &point, vpIndexSense sense,
                                                       double gain = 1., double range = 0.2);
  //! Distance of joint \e joint from the segment between the origins of base and end effector, (3.33) with the
  //! projection clamped to it.
  [[nodiscard]] static vpSelfMotionIndex lineDistance(int joint, vpIndexSense sense, double gain = 1.,
                                                      double range = 0.2);
  //! Distance of joint \e joint from any plane normal . (x - point) = 0; the normal is normalized.
  [[nodiscard]] static vpSelfMotionIndex planeDistance(int joint, const Eigen::Vector3d &point,
                                                       const Eigen::Vector3d &normal, vpIndexSense sense,
                                                       double gain = 1., double range = 0.2);
  //! Joint limits: -1/2 mean over the limited joints of ((q - middle) / half range)^2.
  [[nodiscard]] static vpSelfMotionIndex jointLimits(double gain = 1.);
  //! Posture: -1/2 |q - reference|^2; continuous joints by the shorter way.
  [[nodiscard]] static vpSelfMotionIndex posture(const vpJointVector &reference, double gain = 1.);

  /*!
   * Checks the index at set-up; the solver ignores an index that does not fit the arm.
   * \throw vpException (badValue) naming the field that is out of range for this arm, and its value.
   */
  void validate(const vpArmModel &model) const;
};

/*!
 * \ingroup group_manipulator
 * \brief Value of an index in one configuration.
 */
struct VISP_EXPORT vpIndexValue {
  double value = 0.;      //!< Value of the index, without the gain.
  double distance = 0.;   //!< Distance of the joint, m (signed for a plane); 0 for the other kinds.
  vpJointVector gradient; //!< Gradient d value / dq, n numbers.
};

/*!
 * \ingroup group_manipulator
 * \brief Index and exact gradient, (3.26) per component: dM/dq_k = M tr(dJ/dq_k J^+). No allocation, no exception.
 * \param model : The arm.
 * \param data : Current configuration, after vpArmKinematics::jacobian().
 * \param index : The index.
 * \param result : Receives value, distance and gradient.
 * \return False if there is no gradient (singular pose, joint at the point or on the line, index that does not fit
 * the arm, numbers that are not finite); the gradient is then zero.
 */
VISP_EXPORT bool vpEvaluateIndex(const vpArmModel &model, const vpArmData &data, const vpSelfMotionIndex &index,
                                 vpIndexValue &result) noexcept;

END_VISP_NAMESPACE
#endif
