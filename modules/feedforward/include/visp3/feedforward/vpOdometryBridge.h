/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpOdometryBridge.h
 * \brief Predicts the current measurement from the last vision result, which is late and infrequent.
 */
#ifndef vpOdometryBridge_h
#define vpOdometryBridge_h

#include <visp3/direct_core/vpTwist.h>
#include <visp3/feedforward/vpServoMeasurement.h>

#include <Eigen/Core>

#include <cstddef>
#include <vector>

BEGIN_VISP_NAMESPACE

/*!
 * \class vpOdometryBridge
 * \ingroup group_feedforward
 * \brief Compensates latency and bridges the time between frames by the robot's own motion since the capture.
 *
 * The executed twists are integrated to cMn, the pose of the current camera in the camera at capture; the object is
 * then at cMn^-1 cMo, and each point, located in space by its depth, is projected again. The object itself must be
 * static. The covariance of the pose is transformed; the uncertainty of the odometry is not added.
 *
 * The memory is a ring buffer of fixed size, allocated by the constructor; a step allocates nothing once the vectors of
 * the measurements have their sizes. A step does not throw, lock or print. The clock is the caller's; a time that is
 * not finite, runs backwards, or advances by more than the maximum age invalidates all earlier data.
 *
 * \code
 * vpOdometryBridge bridge;
 * vpServoMeasurement present;
 * vpTwist twist;                    // executed in the last cycle, by the encoders
 * for (int k = 1; k <= 100; ++k) {  // every 10 ms
 *   bridge.move(twist, 0.01 * k);   // s
 *   if (k % 10 == 0) {              // a result arrives, captured 80 ms ago
 *     measurement.time = 0.01 * k - 0.08;
 *     if (!bridge.correct(measurement)) {
 *       std::cerr << "captured before the motion is known" << std::endl;
 *     }
 *   }
 *   bridge.predict(present); // present.valid is false where the result is too old
 *   twist = law.step(present, 0.01).v;
 * }
 * \endcode
 */
class VISP_EXPORT vpOdometryBridge
{
public:
  /*!
   * Starts at rest at time 0 s.
   * \param maxAge : Age beyond which a measurement is no longer valid, and the maximum latency of a result, s, > 0.
   * \param rate : Rate of calls of move(), Hz, > 0. At a higher rate, results must arrive sooner. The path holds at
   *   most #longestPath steps.
   * \throw vpException (badValue) naming the number that is out of its range.
   */
  explicit vpOdometryBridge(double maxAge = 1., double rate = 1000.);

  static constexpr int longestPath = 100000; //!< Maximum number of steps.

  /*!
   * The camera moved with \e twist (its own frame) from the time of the previous call until \e time, s.
   * \return False when this breaks the path: an invalid time (see above), or a twist that is not finite.
   */
  bool move(const vpTwist &twist, double time) noexcept;
  /*!
   * A new result; it replaces the previous one. vpServoMeasurement::time is its time of capture.
   * \return False, and the result is ignored, when it was captured in the future, before the path begins, or at a time
   *   that is not finite.
   */
  [[nodiscard]] bool correct(const vpServoMeasurement &result) noexcept;
  /*!
   * Predict the last result at the current time.
   * \param now : Valid if the last result was valid, is not older than the maximum age, and the object is still in
   *   front of the camera. A point that was not visible then, or is behind the camera now, is not visible. The time of
   *   capture is kept.
   */
  void predict(vpServoMeasurement &now) const noexcept;

  [[nodiscard]] double age() const noexcept; //!< Age of the last result, s; infinite when no result can be predicted.

private:
  struct Pose { // pose of the camera in the odometry frame
    Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
    Eigen::Vector3d t = Eigen::Vector3d::Zero();
  };
  struct Instant {
    double time = 0.;
    Pose pose;
    vpTwist twist; // twist that led to pose
  };
  [[nodiscard]] static Pose moved(const Pose &pose, const vpTwist &twist, double dt) noexcept;
  [[nodiscard]] const Instant &at(std::size_t i) const noexcept { return m_ring[(m_first + i) % m_ring.size()]; }
  void restart(double time) noexcept;

  double m_maxAge;
  std::vector<Instant> m_ring;
  std::size_t m_first = 0;
  std::size_t m_count = 1;
  vpServoMeasurement m_last;
  Pose m_capture; // camera pose at the capture of m_last
};

END_VISP_NAMESPACE
#endif
