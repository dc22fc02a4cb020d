/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpObjectAverage.h
 * \brief Pose of an object at rest, averaged over images from a moving camera.
 */
#ifndef vpObjectAverage_h
#define vpObjectAverage_h

#include <visp3/direct_core/vpTwist.h>
#include <visp3/feedforward/vpServoMeasurement.h>

#include <Eigen/Core>

BEGIN_VISP_NAMESPACE

/*!
 * \class vpObjectAverage
 * \ingroup group_feedforward
 * \brief Averages the pose of an object in the odometry frame, in which it is at rest.
 *
 * Image n enters with weight 1 / min(n, window): the mean of the first images, later one that forgets. A number of
 * images in a row far from the mean, compared with their own scatter, show that the object was moved: the mean starts
 * again there. The odometry has to be that of the camera's true motion (encoders); errors of it count as motion of the
 * object. Nothing allocates or throws after construction.
 *
 * \code
 * vpObjectAverage object;
 * vpTwist twist; // of the camera since the last cycle, by its encoders
 * // each cycle:
 * object.move(twist, dt);
 * if (!object.see(measurement)) { // as it is now, e.g. by vpOdometryBridge
 *   std::cerr << "no image, the mean of " << object.images() << " remains" << std::endl;
 * }
 * object.predict(measurement); // its cMo is now that of the mean
 * twist = law.step(measurement, dt).v;
 * \endcode
 */
class VISP_EXPORT vpObjectAverage
{
public:
  //! \param window : Number of images that the mean remembers, >= 1. \throw vpException (badValue) naming it otherwise.
  explicit vpObjectAverage(int window = 30);

  //! Forget the object; the odometry frame is that of the current camera.
  void reset() noexcept;
  //! The camera moved with \e twist (its own frame, m/s and rad/s) for \e dt, s. Numbers that are not finite are ignored.
  void move(const vpTwist &twist, double dt) noexcept;
  /*!
   * The object as seen by the current camera. A measurement counts once for each vpServoMeasurement::time, its time of
   * capture; with a time of 0 it always counts.
   * \return True when it counted; false as well when it is invalid or not finite.
   */
  bool see(const vpServoMeasurement &measurement) noexcept;
  //! Replace the pose of a valid measurement by that of the mean; its points stay. Without any image it stays, too.
  void predict(vpServoMeasurement &measurement) const noexcept;

  [[nodiscard]] int images() const { return m_count; } //!< Images since the start or the last restart; 0: not seen.
  [[nodiscard]] const Eigen::Matrix3d &fRc() const { return m_fRc; } //!< Rotation of the camera in the odometry frame.
  [[nodiscard]] const Eigen::Vector3d &ftc() const { return m_ftc; } //!< Position of the camera in it, m.
  [[nodiscard]] const Eigen::Matrix3d &fRo() const { return m_fRo; } //!< Mean rotation of the object in it.
  [[nodiscard]] const Eigen::Vector3d &fto() const { return m_fto; } //!< Mean position of the object in it, m.

private:
  int m_window;
  int m_count = 0;
  int m_outliers = 0;                      // in a row
  bool m_seen = false;                     // m_time is valid
  double m_time = 0.;                      // of capture of the last image
  double m_spread = 0., m_turnSpread = 0.; // mean squares of the distances from the mean, m^2 and rad^2
  Eigen::Matrix3d m_fRc = Eigen::Matrix3d::Identity(), m_fRo = m_fRc;
  Eigen::Vector3d m_ftc = Eigen::Vector3d::Zero(), m_fto = m_ftc;
};

END_VISP_NAMESPACE
#endif
