/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpSelfMotionExperiment.h
 * \brief S5: what the spare joints do while the tool does its work, figures 8.14 to 8.17.
 */
#ifndef vpSelfMotionExperiment_h
#define vpSelfMotionExperiment_h

#include <visp3/manipulator/vpClosedLoopKinematics.h>

#include <memory>
#include <vector>

BEGIN_VISP_NAMESPACE

/*!
 * \brief A tool that goes through places, its orientation kept, and one index for the self-motion.
 */
struct vpSelfMotionRunSpec {
  std::shared_ptr<const vpArmModel> arm; //!< Must be there.
  vpJointVector start;                   //!< rad or m.
  std::vector<Eigen::Vector3d> places;   //!< Of the tool, m, one after another by least jerk; empty: it stays.
  double legTime = 2.;                   //!< From place to place, s, > 0.
  double restTime = 1.;                  //!< At the last place, s, >= 0.
  vpSelfMotionIndex index;               //!< What the spare joints climb.
  double share = 0.5;                    //!< |eta|, 0..1: see vpRedundancySpec::selfMotion; 0: no self-motion.

  /*!
   * The motion of section 8.3.3 from the arm's home: two vias and a final place, 2 s each. The thesis tells no places;
   * these lie 0.05 to 0.17 m before and beside the start, at its height.
   */
  [[nodiscard]] static vpSelfMotionRunSpec thesis(const std::shared_ptr<const vpArmModel> &arm);
  /*!
   * The boundary of figure 8.17: the plane through the base, [0, 0, 1] and [1, 1, 0.5] m for joint 4. The allowed side is
   * the one on which the joint is at the arm's home.
   */
  [[nodiscard]] static vpSelfMotionIndex thesisPlane(const vpArmModel &arm, vpIndexSense sense);
  //! \throw vpException (badValue) naming the field that is out of range, and its value.
  void validate() const;
};

/*!
 * \brief At the end of a period.
 */
struct vpSelfMotionSample {
  double time = 0.;     //!< s.
  vpJointVector q;      //!< rad or m.
  double drift = 0.;    //!< Of the tool from where it shall be, m.
  double turn = 0.;     //!< Of its orientation, rad.
  double distance = 0.; //!< Of the joint that the index looks at, m; see vpIndexValue::distance.
};

/*!
 * \brief The log and its figures; the same names as in summary.json.
 */
struct vpSelfMotionRun {
  std::vector<vpSelfMotionSample> samples; //!< One a period.
  double tcp_drift_m = 0.;                 //!< Largest drift.
  double tcp_drift_rad = 0.;               //!< Largest turn.
  double start_distance_m = 0.;            //!< Distance at the start.
  double mean_distance_m = 0.;             //!< Mean over time.
  double end_distance_m = 0.;              //!< Distance in the end.
  double joint_travel_rad = 0.;            //!< Sum of the ways of all joints, d_total of figure 8.16.
};

//! \ingroup group_simulation
//! \brief Runs one experiment with ideal drives at 200 Hz. \throw vpException (badValue) naming what is wrong with the spec.
[[nodiscard]] vpSelfMotionRun runSelfMotionExperiment(const vpSelfMotionRunSpec &spec);

END_VISP_NAMESPACE
#endif
