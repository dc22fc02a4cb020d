/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpSelfMotionIndex.h
 * \brief What the spare joints shall do: indices of a configuration with exact gradients.
 */
#ifndef vpSelfMotionIndex_h
#define vpSelfMotionIndex_h

#include <visp3/manipulator/vpArmKinematics.h>

BEGIN_VISP_NAMESPACE

//! \ingroup group_manipulator
//! \brief Towards a thing or away from it.
enum class vpIndexSense {
  Attract, //!< The distance shall become smaller.
  Repel    //!< The distance shall become larger.
};

//! \ingroup group_manipulator
//! \brief What an index looks at.
enum class vpIndexKind {
  Manipulability, //!< (3.25), (3.27): distance from singularities \cite Yoshikawa85.
  PointDistance,  //!< (3.29): of a joint from a point.
  LineDistance,   //!< (3.35): of a joint from the segment between base and tool.
  PlaneDistance,  //!< (3.41): of a joint from a plane, with sign.
  JointLimits,    //!< Distance of all joints from their limits.
  Posture         //!< Distance from a preferred configuration.
};

/*!
 * \ingroup group_manipulator
 * \brief One wish for the self-motion; make it with the functions below. The solver climbs gain times the index.
 *
 * Thesis 3.3.2, corrected. The text sums J^# x over 6 x n partial Jacobians, which are singular for every usable joint;
 * the true gradient of a distance is J_p^T times a unit vector. The index is a function of the distance d whose slope
 * is at most 1: to attract -s (sqrt(1 + (d/s)^2) - 1); to repel -s exp(-d/s) from points and lines and -s log(1 +
 * exp(-d/s)) from planes, so that repulsion decays with distance (the raw vector repels more when farther away), and a
 * joint on the wrong side of a plane is led back. Sense and gain >= 0 replace the sign of k0, of which the text says
 * one thing and figures 8.14 and 8.17 another.
 */
struct VISP_EXPORT vpSelfMotionIndex {
  vpIndexKind kind = vpIndexKind::Manipulability;    //!< What it looks at.
  double gain = 1.;                                  //!< Weight among the indices, >= 0.
  vpIndexSense sense = vpIndexSense::Repel;          //!< Of the three distances.
  int joint = 0;                                     //!< Whose origin is looked at, 0..n-1; q4 of the thesis is 3.
  Eigen::Vector3d point = Eigen::Vector3d::Zero();   //!< In the base, m: the point; a point of the plane.
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ(); //!< Of the plane, of length 1, towards the allowed side.
  double range = 0.2;                                //!< s, m, > 0: width over which the wish acts.
  vpJointVector reference;                           //!< Posture wished for, n numbers.
  vpJointVector weights;                             //!< W of (3.27), diagonal, n numbers > 0; empty: the identity.
  double taskLength = 1.;                            //!< m/rad, > 0: angular rows of (3.27) count this much.

  //! (3.25): all units as they are.
  [[nodiscard]] static vpSelfMotionIndex manipulability(double gain = 1.);
  //! (3.27): with weights of the joints and one length for radians, which makes it a number with a unit.
  [[nodiscard]] static vpSelfMotionIndex weightedManipulability(const vpJointVector &weights, double taskLength,
                                                                double gain = 1.);
  //! Of joint \e joint from a point in the base.
  [[nodiscard]] static vpSelfMotionIndex pointDistance(int joint, const Eigen::Vector3d &point, vpIndexSense sense,
                                                       double gain = 1., double range = 0.2);
  //! Of joint \e joint from the segment between the origins of base and end effector, (3.33) with the projection
  //! clamped to it.
  [[nodiscard]] static vpSelfMotionIndex lineDistance(int joint, vpIndexSense sense, double gain = 1.,
                                                      double range = 0.2);
  //! Of joint \e joint from any plane normal . (x - point) = 0; the normal is made of length 1.
  [[nodiscard]] static vpSelfMotionIndex planeDistance(int joint, const Eigen::Vector3d &point,
                                                       const Eigen::Vector3d &normal, vpIndexSense sense,
                                                       double gain = 1., double range = 0.2);
  //! -1/2 mean over the limited joints of ((q - middle) / half range)^2.
  [[nodiscard]] static vpSelfMotionIndex jointLimits(double gain = 1.);
  //! -1/2 |q - reference|^2; continuous joints by the short way round.
  [[nodiscard]] static vpSelfMotionIndex posture(const vpJointVector &reference, double gain = 1.);

  /*!
   * For set-up; the solver takes an index that does not fit for one without a wish.
   * \throw vpException (badValue) naming the field that is out of range for this arm, and its value.
   */
  void validate(const vpArmModel &model) const;
};

/*!
 * \ingroup group_manipulator
 * \brief An index in one configuration.
 */
struct VISP_EXPORT vpIndexValue {
  double value = 0.;      //!< What is climbed; without the gain.
  double distance = 0.;   //!< Of the joint from the thing, m (with sign for a plane); 0 for the other kinds.
  vpJointVector gradient; //!< d value / dq, n numbers.
};

/*!
 * \ingroup group_manipulator
 * \brief Index and exact gradient, (3.26) per component: dM/dq_k = M tr(dJ/dq_k J^+). No allocation, no exception.
 * \param model : The arm.
 * \param data : After vpArmKinematics::jacobian().
 * \param index : What is climbed.
 * \param result : Receives value, distance and gradient.
 * \return False where there is no gradient (singular pose, joint in the point or on the line, index that does not fit
 * the arm, numbers that are not finite); the gradient is zero then.
 */
VISP_EXPORT bool vpEvaluateIndex(const vpArmModel &model, const vpArmData &data, const vpSelfMotionIndex &index,
                                 vpIndexValue &result) noexcept;

END_VISP_NAMESPACE
#endif
