/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpOdometryBridge.h
 * \brief From the last vision result, which is late and rare, to where the object is now.
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
 * \brief Carries a measurement over latency and between frames by the robot's own motion since its capture.
 *
 * The twists that the robot executed are integrated to cMn, the pose of the camera now in the camera at capture; then
 * the object is at cMn^-1 cMo, and each point, placed in space by its depth, is projected anew. The object itself must
 * stand still in the world. The covariance of the pose is carried along; what the odometry adds to it is not known here.
 *
 * The memory is a ring that is made by the constructor: nothing grows, and a step allocates nothing once the vectors of the
 * measurements have their sizes. It neither throws, locks nor prints. The clock is the caller's; a step of it that is not
 * finite, runs backwards, or is longer than the greatest age breaks the path: nothing seen before is valid after it.
 */
class VISP_EXPORT vpOdometryBridge
{
public:
  /*!
   * Starts at rest at time 0 s.
   * \param maxAge : Age beyond which a measurement is no longer valid, and how late a result may come, s, > 0.
   * \param rate : How often move() is called, Hz, > 0. With a higher rate, results must come sooner. The path reaches back at
   *   most #longestPath steps.
   * \throw vpException (badValue) naming the number that is out of its range.
   */
  explicit vpOdometryBridge(double maxAge = 1., double rate = 1000.);

  static constexpr int longestPath = 100000; //!< Steps.

  /*!
   * The camera moved with \e twist (its own frame) from the time of the call before until \e time, s.
   * \return False when the path is broken there: a bad time (see above), or a twist that is not finite.
   */
  bool move(const vpTwist &twist, double time) noexcept;
  /*!
   * A result arrived; it replaces the one before. Its vpServoMeasurement::time says when it was captured.
   * \return False, and the result is not taken, when it was captured later than now, before the path begins, or at a time that
   *   is not finite.
   */
  [[nodiscard]] bool correct(const vpServoMeasurement &result) noexcept;
  /*!
   * The last result as it would be seen now.
   * \param now : Valid if the last result was, is not older than the greatest age, and the object is still in front of the
   *   camera. A point that was not seen then, or is behind the camera now, is not visible. The time of capture is kept.
   */
  void predict(vpServoMeasurement &now) const noexcept;

  [[nodiscard]] double
  age() const noexcept; //!< Of the last result, s; infinite when there is none that can be carried on.

private:
  struct Pose { // of the camera in the frame of the odometry
    Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
    Eigen::Vector3d t = Eigen::Vector3d::Zero();
  };
  struct Instant {
    double time = 0.;
    Pose pose;
    vpTwist twist; // that led to it
  };
  [[nodiscard]] static Pose moved(const Pose &pose, const vpTwist &twist, double dt) noexcept;
  [[nodiscard]] const Instant &at(std::size_t i) const noexcept { return m_ring[(m_first + i) % m_ring.size()]; }
  void restart(double time) noexcept;

  double m_maxAge;
  std::vector<Instant> m_ring;
  std::size_t m_first = 0;
  std::size_t m_count = 1;
  vpServoMeasurement m_last;
  Pose m_capture; // of m_last
};

END_VISP_NAMESPACE
#endif
