/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpServoExperiment.h
 * \brief The closed loop: sensor -> law -> filter -> recovery -> twist shaper -> plant, and the log of it.
 */
#ifndef vpServoExperiment_h
#define vpServoExperiment_h

#include <visp3/feedforward/vpServoLaw.h>
#include <visp3/simulation/vpPlaneRenderer.h>
#include <visp3/simulation/vpServoPlant.h>
#include <visp3/simulation/vpServoArm.h>
#include <visp3/simulation/vpServoTask.h>
#include <visp3/trajectory/vpTwistShaper.h>

#include <atomic>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_simulation
 * \brief One row of the log, taken each cycle of the inner loop: what is true at #time, and the motion from then until
 * the next row. Angles in rad, all else in SI units and px.
 *
 * World frame: the camera at the start of the experiment.
 */
struct VISP_EXPORT vpServoSample {
  double time = 0.;        //!< s since the start.
  int segment = 0;         //!< Index of the segment in force.
  vpHomogeneousMatrix wMc; //!< True pose of the camera in the world.
  vpHomogeneousMatrix cMo; //!< True pose of the object in the camera.
  vpTwist commanded;       //!< Twist asked of the plant, after the shaper if there is one; camera frame.
  vpTwist actual;          //!< Twist that the plant executed, camera frame.
  double yaw = 0.;         //!< Rotation of the camera about the vertical (y axis of the world), rad.
  double goalYaw = 0.;     //!< The same of the goal.
  //! Where the law wants to turn to: yaw of R exp(w / gain) with vpServoLaw::rotationGain(); figures 5.6 and 5.8.
  double referenceYaw = 0.;
  double rotationError = 0.;    //!< Angle of the true cdMc, rad.
  double translationError = 0.; //!< Length of the true cdMc, m.
  /*!
   * Standard deviations of the rotation (rad) and translation (m) of cdMc that the covariance of the measurement in use gives
   * it; infinite when that is not known or nothing was measured.
   */
  double rotationDeviation = std::numeric_limits<double>::infinity();
  double translationDeviation = std::numeric_limits<double>::infinity(); //!< See #rotationDeviation.
  double seenRotationError =
      std::numeric_limits<double>::infinity(); //!< #rotationError by the measurement in use, rad.
  double seenTranslationError =
      std::numeric_limits<double>::infinity();  //!< #translationError by the measurement in use, m.
  double u = 0.;                                //!< True, noise-free image of the object's centre, px to the right.
  double v = 0.;                                //!< The same, px down.
  double imageErrorU = 0.;                      //!< u minus the goal's u, px.
  double imageErrorV = 0.;                      //!< v minus the goal's v, px.
  bool inView = true;                           //!< All of the object's corners lie in the image (true pose).
  bool measured = false;                        //!< The measurement in use was valid.
  bool newFrame = false;                        //!< A vision result arrived in this cycle.
  vpServoStatus status = vpServoStatus::NoGoal; //!< Of the controller.
};

//! \ingroup group_simulation
//! \brief What to run. All fields together with the seed determine the result.
struct VISP_EXPORT vpServoRunSpec {
  std::string law = "ff-lookat-pi";         //!< Id of the law, optionally followed by `+cbf`.
  std::string measure = "points";           //!< "points" (vpServoSensor::points) or "image" (vpServoSensor::image).
  vpServoGains gains;                       //!< The same for every law.
  vpServoPlant plant;                       //!< What moves the camera.
  vpServoTask task = vpServoTask::thesis(); //!< Where to.
  unsigned int seed = 1;                    //!< Of all noise.
  std::string target;                       //!< Image file of the object for measure "image".
  vpCameraFaults faults; //!< Of the pictures for measure "image", in the place of vpServoPlant::pixelNoise.
  /*!
   * Limits of a vpTwistShaper between controller and plant; without them the plant gets the controller's twist as it
   * is. The shaper starts at rest and is never reset: a new goal, a lost target and the retreat after it are ramps too.
   */
  std::optional<vpTwistShaperLimits> shape;
  //! Carries the camera; null: the camera flies freely, with the lag and friction of the plant.
  std::shared_ptr<const vpServoArm> arm;
};

//! \ingroup group_simulation
//! \brief The figures of a run; the same names as in summary.json.
struct VISP_EXPORT vpServoMetrics {
  double max_image_error_px = 0.; //!< Largest distance of the object's centre from where it shall be seen.
  double rms_image_error_px = 0.; //!< Root mean square of that distance.
  double end_rotation_deg = 0.;   //!< Largest rotation error at the end of a segment.
  double end_translation_mm = 0.; //!< Largest translation error at the end of a segment.
  /*!
   * What a machine that does not know the truth may expect of its rotation error at the end of a segment: the root mean square
   * given the last measurement, sqrt(|e|^2 + tr C), the largest of the segments. e is the error that the measurement still
   * shows, which is what the law has left (friction, a way not finished); C is the covariance of its rotation. An end beyond
   * three of it says that the covariance is wrong. Infinite when that is not known.
   */
  double expected_end_rotation_deg = 0.;
  double expected_end_translation_mm = 0.; //!< The same of the translation error.
  double left_end_rotation_deg =
      0.; //!< The part |e| of #expected_end_rotation_deg, what the law has left; the largest.
  double left_end_translation_mm = 0.; //!< The same of the translation error.
  double yaw_range_deg = 0.;           //!< Largest minus smallest yaw.
  double ideal_yaw_range_deg = 0.;     //!< The same of the goals (and the start).
  double out_of_view_s = 0.;           //!< Time during which a corner of the object is out of the image.
  //! Time until the error stays below 2 deg and 5 mm, the segment's duration if it never does; mean over the segments.
  double settle_s = 0.;
  double path_length_m = 0.;      //!< Of the camera's way.
  double peak_linear_mps = 0.;    //!< Of the executed motion.
  double peak_angular_radps = 0.; //!< The same of the angular part.
  /*!
   * Largest linear part of the change of vpServoSample::commanded, within the plant's speed limits, from one cycle to
   * the next, divided by the cycle. The first change is that from rest, so a step at t = 0 shows here: as a number that
   * grows with the loop rate.
   */
  double peak_linear_acceleration_mps2 = 0.;
  double peak_angular_acceleration_radps2 = 0.; //!< The same of the angular part.
  int deadlock_cycles = 0;                      //!< Cycles with vpServoStatus::Deadlock.
  std::string status; //!< "ok", or a sentence on how the run ended otherwise (target lost, deadlock).
};

//! \ingroup group_simulation
//! \brief A finished run.
struct VISP_EXPORT vpServoRun {
  vpServoRunSpec spec;                    //!< What was run.
  std::vector<vpServoSample> samples;     //!< One a cycle of the loop.
  vpServoMetrics metrics;                 //!< The figures.
  std::vector<vpArmSample> arm;           //!< As many as samples, at the end of each cycle; none without an arm.
  std::optional<vpArmMetrics> armMetrics; //!< Given when there is an arm.
};

/*!
 * \ingroup group_simulation
 * Run one experiment.
 * \param spec : What to run; validated first.
 * \param progress : If given, called now and then with the share done, 0..1; return false to stop early.
 * \throw vpException naming what is wrong with the spec (unknown law, measure, plant field, target image,
 * limit of the shaper).
 */
[[nodiscard]] VISP_EXPORT vpServoRun runServoExperiment(const vpServoRunSpec &spec,
                                                        const std::function<bool(double)> &progress = {});

/*!
 * \ingroup group_simulation
 * The figures of a log.
 */
[[nodiscard]] VISP_EXPORT vpServoMetrics evaluateServoRun(const vpServoRunSpec &spec,
                                                          const std::vector<vpServoSample> &samples);

END_VISP_NAMESPACE
#endif
