/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpServoMeasurement.h
 * \brief Input of a servo law: the goal, once, and the measurement, each cycle.
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
  bool visible = true; //!< False when this point was not measured in this frame; x, y, Z are then ignored.
};

/*!
 * \ingroup group_feedforward
 * \brief The goal: desired pose of the object in the camera, and the corresponding image.
 */
struct VISP_EXPORT vpServoGoal {
  vpHomogeneousMatrix cdMo;         //!< Pose of the object in the desired camera frame, m.
  std::vector<vpServoPoint> points; //!< The object's points in the desired camera, at least one.
  /*!
   * Desired image position of the mean of the points during the motion, for the laws that control the gaze (`ff-sum`,
   * `ff-lookat`); by default the mean of #points.
   */
  [[nodiscard]] vpServoPoint mean() const;
};

/*!
 * \ingroup group_feedforward
 * \brief Measurement of one cycle. Reuse one object: assigning to its members then allocates nothing.
 *
 * \code
 * vpServoMeasurement seen;
 * seen.valid = true;                                          // false where the target was not found
 * seen.time = now();                                          // of the capture, s
 * seen.cMo = vpHomogeneousMatrix(0.02, 0., 0.5, 0., 0., 0.3); // m, rad
 * for (const double x : {-0.08, 0., 0.08}) {
 *   vpPoint point(x, 0.05, 0.); // on the object, m
 *   point.track(seen.cMo);      // in practice measured
 *   seen.points.push_back({point.get_x(), point.get_y(), point.get_Z()}); // in the order of the goal's points
 * }
 * seen.outline = seen.points;
 * \endcode
 */
struct VISP_EXPORT vpServoMeasurement {
  bool valid = false; //!< False when the target was not found; all other members except #time are then ignored.
  /*!
   * Time of capture, s, on the clock of the caller. **A measurement counts as current**, and setting the time does not
   * compensate latency; `dtg` and `ff-dtg` tell images apart by it, no other law reads it. vpOdometryBridge uses it to predict a late measurement at the current time,
   * as input for the law.
   */
  double time = 0.;
  vpHomogeneousMatrix cMo;           //!< Pose of the object in the current camera frame, m.
  std::vector<vpServoPoint> points;  //!< Current image of the goal's points, same order; see vpServoPoint::visible.
  std::vector<vpServoPoint> outline; //!< Points that must stay in view (usually the target's corners), for `+cbf`.
  vpPoseCovariance covariance; //!< Covariance of #cMo, unknown by default; `ff-lookat-pi` ignores errors within it.
};

END_VISP_NAMESPACE
#endif
