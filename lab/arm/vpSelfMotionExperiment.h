/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpSelfMotionExperiment.h
 * \brief S5: self-motion during a tool motion, figures 8.14 to 8.17.
 */
#ifndef vpSelfMotionExperiment_h
#define vpSelfMotionExperiment_h

#include <visp3/manipulator/vpClosedLoopKinematics.h>

#include <memory>
#include <vector>

BEGIN_VISP_NAMESPACE

/*!
 * \brief Tool motion through given positions at constant orientation, with one self-motion index.
 */
struct vpSelfMotionRunSpec {
  std::shared_ptr<const vpArmModel> arm; //!< The arm; not null.
  vpJointVector start;                   //!< Start configuration, rad or m.
  std::vector<Eigen::Vector3d> places;   //!< Successive tool positions by minimum jerk, m; empty: at rest.
  double legTime = 2.;                   //!< Time between positions, s, > 0.
  double restTime = 1.;                  //!< Time at the last position, s, >= 0.
  vpSelfMotionIndex index;               //!< Index that self-motion maximizes.
  double share = 0.5;                    //!< |eta|, 0..1: see vpRedundancySpec::selfMotion; 0: no self-motion.

  /*!
   * Motion of section 8.3.3 from the arm's home: two vias and a final position, 2 s each. The thesis does not give the
   * positions; these are 0.05 to 0.17 m in front of and beside the start, at its height.
   */
  [[nodiscard]] static vpSelfMotionRunSpec thesis(const std::shared_ptr<const vpArmModel> &arm);
  /*!
   * Boundary of figure 8.17: the plane through the base, [0, 0, 1] and [1, 1, 0.5] m for joint 4. The allowed side is
   * that of the joint at the arm's home.
   */
  [[nodiscard]] static vpSelfMotionIndex thesisPlane(const vpArmModel &arm, vpIndexSense sense);
  //! \throw vpException (badValue) naming the field that is out of range, and its value.
  void validate() const;
};

/*!
 * \brief Sample at the end of a period.
 */
struct vpSelfMotionSample {
  double time = 0.;     //!< Time, s.
  vpJointVector q;      //!< Configuration, rad or m.
  double drift = 0.;    //!< Position error of the tool, m.
  double turn = 0.;     //!< Orientation error of the tool, rad.
  double distance = 0.; //!< Distance measured by the index, m; see vpIndexValue::distance.
};

/*!
 * \brief Log and metrics, named as in summary.json.
 */
struct vpSelfMotionRun {
  std::vector<vpSelfMotionSample> samples; //!< One per period.
  double tcp_drift_m = 0.;                 //!< Largest position error.
  double tcp_drift_rad = 0.;               //!< Largest orientation error.
  double start_distance_m = 0.;            //!< Distance at the start.
  double mean_distance_m = 0.;             //!< Mean distance over time.
  double end_distance_m = 0.;              //!< Distance at the end.
  double joint_travel_rad = 0.;            //!< Sum of the travel of all joints, d_total of figure 8.16.
};

//! \brief Runs one experiment with ideal drives at 200 Hz. \throw vpException (badValue) naming the error in the spec.
[[nodiscard]] vpSelfMotionRun runSelfMotionExperiment(const vpSelfMotionRunSpec &spec);

END_VISP_NAMESPACE
#endif
