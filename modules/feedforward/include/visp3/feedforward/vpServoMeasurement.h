/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpServoMeasurement.h
 * \brief What a servo law is told: the goal, once, and the measurement, each cycle.
 */
#ifndef vpServoMeasurement_h
#define vpServoMeasurement_h

#include <visp3/core/vpHomogeneousMatrix.h>
#include <visp3/direct_core/vpPoseCovariance.h>

#include <vector>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_feedforward
 * \brief One image point in normalised coordinates with its depth.
 *
 * Normalised: x = X/Z, y = Y/Z in the camera frame, no pixels, no distortion.
 */
struct VISP_EXPORT vpServoPoint {
  double x = 0.;       //!< X/Z, to the right.
  double y = 0.;       //!< Y/Z, downwards.
  double Z = 1.;       //!< Depth along the optical axis, m, > 0. Measured or estimated.
  bool visible = true; //!< False when this point was not measured in this frame; x, y, Z are then not read.
};

/*!
 * \ingroup group_feedforward
 * \brief Where to go: the pose of the object in the camera when the task is done, and the image that belongs to it.
 */
struct VISP_EXPORT vpServoGoal {
  vpHomogeneousMatrix cdMo;         //!< Pose of the object in the desired camera frame, m.
  std::vector<vpServoPoint> points; //!< The object's points as the desired camera sees them. At least one.
  /*!
   * Where the mean of the points shall be seen on the way, for the laws that steer the gaze (`ff-sum`, `ff-lookat`);
   * by default the mean of #points.
   */
  [[nodiscard]] vpServoPoint mean() const;
};

/*!
 * \ingroup group_feedforward
 * \brief What was seen, this cycle. Reuse one object: assigning to its members then allocates nothing.
 */
struct VISP_EXPORT vpServoMeasurement {
  bool valid = false; //!< False when the target was not found; nothing else is read then, except #time.
  /*!
   * Time of capture, s, on the clock of the caller. **No law reads it**: a measurement counts as seen now, and latency is not
   * compensated by telling the time. vpOdometryBridge reads it; it carries a late measurement to now, to be given to the law.
   */
  double time = 0.;
  vpHomogeneousMatrix cMo;           //!< Pose of the object in the current camera frame, m.
  std::vector<vpServoPoint> points;  //!< The goal's points in the same order as seen now; see vpServoPoint::visible.
  std::vector<vpServoPoint> outline; //!< Points that must stay in the view (usually the target's corners), for `+cbf`.
  vpPoseCovariance covariance; //!< Of #cMo; not known by default. `ff-lookat-pi` does not integrate what is within it.
};

END_VISP_NAMESPACE
#endif
