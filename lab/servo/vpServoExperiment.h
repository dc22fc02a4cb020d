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
#include <visp3/feedforward/vpServoMotionLimits.h>
#include <visp3/rendering/vpPlaneRenderer.h>
#include <visp3/simulation/vpServoPlant.h>
#include "lab/servo/vpServoArm.h"
#include "lab/servo/vpServoTask.h"
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
 * \brief One row of the log per cycle of the inner loop: the true state at #time, and the motion from then until
 * the next row. Angles in rad, all else in SI units and px.
 *
 * World frame: the camera at the start of the experiment.
 */
struct vpServoSample {
  double time = 0.;        //!< Time since the start, s.
  int segment = 0;         //!< Index of the current segment.
  vpHomogeneousMatrix wMc; //!< True pose of the camera in the world.
  vpHomogeneousMatrix cMo; //!< True pose of the object in the camera.
  vpTwist commanded;       //!< Twist commanded to the plant, after the shaper if there is one; camera frame.
  vpTwist actual;          //!< Twist executed by the plant, camera frame.
  double yaw = 0.;         //!< Rotation of the camera about the vertical (y axis of the world), rad.
  double goalYaw = 0.;     //!< Yaw of the goal, rad.
  //! Reference yaw of the law: yaw of R exp(w / gain) with vpServoLaw::rotationGain(), rad; figures 5.6 and 5.8.
  double referenceYaw = 0.;
  double rotationError = 0.;    //!< Angle of the true cdMc, rad; without free axes of the arm: of its rotation vector.
  double translationError = 0.; //!< Length of the true cdMc, m; without free axes of the arm, in the camera's axes.
  /*!
   * Standard deviation of the rotation of cdMc, rad, from the covariance of the measurement in use; infinite if unknown
   * or nothing was measured.
   */
  double rotationDeviation = std::numeric_limits<double>::infinity();
  double translationDeviation = std::numeric_limits<double>::infinity(); //!< Likewise of the translation, m.
  double seenRotationError =
      std::numeric_limits<double>::infinity(); //!< #rotationError by the measurement in use, rad.
  double seenTranslationError =
      std::numeric_limits<double>::infinity();  //!< #translationError by the measurement in use, m.
  double u = 0.;                                //!< True, noise-free image of the object's centre, px to the right.
  double v = 0.;                                //!< True, noise-free image of the object's centre, px down.
  double imageErrorU = 0.;                      //!< u minus the goal's u, px.
  double imageErrorV = 0.;                      //!< v minus the goal's v, px.
  bool inView = true;                           //!< True if all corners of the object lie in the image (true pose).
  bool measured = false;                        //!< True if the measurement in use was valid.
  bool newFrame = false;                        //!< True if a vision result arrived in this cycle.
  vpServoStatus status = vpServoStatus::NoGoal; //!< Status of the controller.
};

//! \brief Specification of a run; it determines the result.
struct vpServoRunSpec {
  std::string law = "ff-lookat-pi";         //!< Id of the law, optionally followed by `+cbf`.
  std::string measure = "points";           //!< "points" (vpServoSensor::points) or "image" (vpServoSensor::image).
  vpServoGains gains;                       //!< Gains, the same for every law.
  vpServoPlant plant;                       //!< Plant that moves the camera.
  vpServoTask task = vpServoTask::thesis(); //!< Task with the goals.
  unsigned int seed = 1;                    //!< Seed of all noise.
  std::string target;                       //!< Image file of the object for measure "image".
  vpCameraFaults faults;                    //!< Image faults for measure "image", instead of vpServoPlant::pixelNoise.
  /*!
   * Limits of a vpTwistShaper between controller and plant; without them the plant gets the controller's twist
   * unchanged. The shaper starts at rest and is never reset: a new goal, a lost target and the retreat also give ramps.
   */
  std::optional<vpTwistShaperLimits> shape;
  /*!
   * Limits of the camera's motion, the same for every law, instead of #shape: a law that plans gets them as its own; the twist of any
   * other is limited and passes a vpTwistShaper. Without them a law that plans has its default limits.
   */
  std::optional<vpServoMotionLimits> bounds;
  bool average =
      false; //!< The law gets the pose of the object averaged over images (vpObjectAverage); planning laws always do.
  //! The goal of each segment is measured once in a view at its pose, with the sensor's noise; false: it is known exactly.
  bool noisyReference = false;
  //! Arm that carries the camera; null: free-flying camera with the lag and friction of the plant.
  std::shared_ptr<const vpServoArm> arm;
};

//! \brief Metrics of a run, named as in summary.json.
struct vpServoMetrics {
  double max_image_error_px = 0.; //!< Largest distance of the object's centre from its desired image position.
  double rms_image_error_px = 0.; //!< Root mean square of that distance.
  double end_rotation_deg = 0.;   //!< Largest rotation error at the end of a segment.
  double end_translation_mm = 0.; //!< Largest translation error at the end of a segment.
  /*!
   * Rotation error that a machine which does not know the truth may expect at the end of a segment: the root mean square given
   * the last measurement, sqrt(|e|^2 + tr C), the largest of the segments. e is the error that the measurement still shows,
   * which is what the law has left (friction, an unfinished motion); C is the covariance of its rotation. An end beyond three
   * times this says that the covariance is wrong. Infinite if unknown.
   */
  double expected_end_rotation_deg = 0.;
  double expected_end_translation_mm = 0.; //!< Expected translation error, likewise.
  double left_end_rotation_deg = 0.;   //!< Part |e| of #expected_end_rotation_deg that the law has left; the largest.
  double left_end_translation_mm = 0.; //!< Part of #expected_end_translation_mm that the law has left.
  double yaw_range_deg = 0.;           //!< Largest minus smallest yaw.
  double ideal_yaw_range_deg = 0.;     //!< Largest minus smallest yaw of the goals (and the start).
  double out_of_view_s = 0.;           //!< Time during which a corner of the object is out of the image.
  //! Time until the error stays below 2 deg and 5 mm, the segment's duration if it never does; mean over the segments.
  double settle_s = 0.;
  double path_length_m = 0.;      //!< Length of the camera's path.
  double peak_linear_mps = 0.;    //!< Peak linear speed of the executed motion.
  double peak_angular_radps = 0.; //!< Peak angular speed of the executed motion.
  /*!
   * Largest linear part of the change of vpServoSample::commanded, within the plant's speed limits, from one cycle to
   * the next, divided by the cycle. The first change is from rest, so a step at t = 0 appears here as a number that
   * grows with the loop rate.
   */
  double peak_linear_acceleration_mps2 = 0.;
  double peak_angular_acceleration_radps2 = 0.; //!< Likewise for the angular part.
  double peak_linear_jerk_mps3 = 0.;    //!< Largest second difference of the same commands over the cycle squared.
  double peak_angular_jerk_radps3 = 0.; //!< Likewise for the angular part.
  double rms_linear_jerk_mps3 = 0.;     //!< Root mean square of the linear jerk.
  double rms_angular_jerk_radps3 = 0.;  //!< Likewise for the angular part.
  double bounds_exceeded_cycles =
      0.;                  //!< Cycles with speed, acceleration or jerk above vpServoRunSpec::bounds; 0 without.
  double view_losses = 0.; //!< How often a corner of the object left the image.
  int deadlock_cycles = 0; //!< Number of cycles with vpServoStatus::Deadlock.
  std::string status;      //!< "ok", or a sentence on the failure (target lost, deadlock).
};

//! \brief A finished run.
struct vpServoRun {
  vpServoRunSpec spec;                    //!< Specification of the run.
  std::vector<vpServoSample> samples;     //!< Log, one per cycle of the loop.
  vpServoMetrics metrics;                 //!< Metrics.
  std::vector<vpArmSample> arm;           //!< Arm at the end of each cycle, as many as samples; empty without an arm.
  std::optional<vpArmMetrics> armMetrics; //!< Metrics of the arm, if there is one.
};

/*!
 * Runs one experiment.
 * \param spec : Specification; validated first.
 * \param progress : If given, called periodically with the completed fraction, 0..1; return false to stop early.
 * \throw vpException naming the error in the spec (unknown law, measure, plant field, target image,
 * limit of the shaper).
 */
[[nodiscard]] vpServoRun runServoExperiment(const vpServoRunSpec &spec,
                                            const std::function<bool(double)> &progress = {});

/*!
 * Computes the metrics of a log.
 */
[[nodiscard]] vpServoMetrics evaluateServoRun(const vpServoRunSpec &spec, const std::vector<vpServoSample> &samples);

END_VISP_NAMESPACE
#endif
