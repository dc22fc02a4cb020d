/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpFeedforwardErrors.h"
#include "vpServoLaws.h"
#include "vpServoCheck.h"

#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
// Averaging time of measurements, s, and standard deviation of the mean relative to that of one measurement.
constexpr double meanTime = 1., meanShare = 1. / 3.;
// Remaining fraction of an integral, with reversed sign, when the error shows that it is wrong.
constexpr double turned = 0.8;
// A mean beyond this multiple of its noise, and this angle in rad, shows that the integral is wrong: smaller errors are
// removed by the next cycles anyway, however accurately they are known.
constexpr double unwindDeviations = 2., unwindLeast = 0.004;

// Pose of the camera relative to a goal.
struct Gaze {
  vpServoPose::Error error;
  vpLookAt lookAt;
  Eigen::Vector3d e = Eigen::Vector3d::Zero(); // log(R_la^T R), rad, where R_la is defined
  double distance;                             // of the object's origin, m

  Gaze(const vpHomogeneousMatrix &cdMo, const vpHomogeneousMatrix &cMo)
    : error(vpServoPose::error(cdMo, cMo)), lookAt(vpServoPose::translation(cdMo), error.t),
      distance((vpServoPose::translation(cdMo) - error.t).norm())
  {
    if (lookAt.defined) {
      e = vpSO3::log(lookAt.rotation.transpose() * error.R);
    }
  }
};

/*
 * The recommended FF-PBVS law. The camera translates as in pbvs1 and rotates towards R_la (vpLookAt). With the error
 * e = log(R_la^T R) and the rate of R_la, caused by the commanded translation, fed forward, w = -k e + R^T rate d',
 * e' = J_r^-1(e) (w - R^T rate d') = -k e exactly. R_la becomes the identity when the translation is done, so the
 * commanded pose is reached.
 */
class vpServoLookAt : public vpServoLaw
{
public:
  vpServoLookAt(const std::string &id, const vpServoGains &gains, double rotationFactor)
    : vpServoLaw(id, gains, rotationFactor)
  {}

protected:
  vpServoCommand compute(const vpServoMeasurement &measurement, double dt) noexcept VP_OVERRIDE
  {
    const Gaze gaze(m_goal.cdMo, measurement.cMo);
    if (!gaze.lookAt.defined) {
      return {vpTwist(), vpServoStatus::Degenerate};
    }
    const Eigen::Matrix3d toCamera = gaze.error.R.transpose();
    const Eigen::Vector3d v = -m_gains.lambda * (toCamera * gaze.error.t);
    // d' = -t' = lambda t.
    const Eigen::Vector3d feedforward = toCamera * (gaze.lookAt.rate * (m_gains.lambda * gaze.error.t));
    const Eigen::Vector3d w = -rotationGain() * gaze.e + feedforward;
    return {vpServoPose::twist(v, w - integral(measurement, gaze, w, dt)), vpServoStatus::Servoing};
  }

  //! Angular velocity to subtract from the desired one \e w, camera frame, rad/s; zero in this law.
  virtual Eigen::Vector3d integral(const vpServoMeasurement &, const Gaze &, const Eigen::Vector3d & /*w*/,
                                   double) noexcept
  {
    return Eigen::Vector3d::Zero();
  }
};

/*
 * `ff-lookat` with an integral term against friction and other velocity errors of the rotation axes. The integrand is
 * not e but its distance from e_m, where e_m' = -k e_m starts at the first error and jumps with e when the goal does.
 * So the way to a far goal, which is no disturbance, leaves the integral at zero and causes no overshoot. Anti-windup:
 * - bounded norm;
 * - no integration over a step whose predecessor was not executed as commanded (e_m restarts);
 * - errors within the noise are not integrated. The noise is that of the mean of e - e_m over the last second, a third
 *   of the standard deviation of one measurement (for ten independent ones per second it is 0.22 of it), which comes
 *   from the covariance of the pose: the rotation, and the translation over the distance. Only the part of the mean
 *   beyond it counts. Nothing is subtracted when the covariance is not known;
 * - a wrong integral (after a period of biased measurements) does not stay: on an axis where that mean is clearly, by
 *   twice its noise, on the other side, friction now acts against the other direction, and the integral changes its
 *   sign. Not all of it: a part not due to friction vanishes after a few reversals;
 * - friction reverses with the motion: when the law requires an axis to rotate against the integral and faster than it,
 *   the integral of this axis restarts from zero. Otherwise it would double the disturbance after each reversal.
 */
class vpServoLookAtPi : public vpServoLookAt
{
public:
  vpServoLookAtPi(const std::string &id, const vpServoGains &gains, double rotationFactor)
    : vpServoLookAt(id, gains, rotationFactor)
  {}
  void notifyInterrupted() noexcept VP_OVERRIDE { m_restart = true; }

protected:
  void goalChanged() VP_OVERRIDE
  {
    // Several goals may be set between two steps; the model belongs to the one of the last step.
    if (!m_goalMoved) {
      m_modelGoal = m_lastGoal;
      m_goalMoved = true;
    }
    m_lastGoal = m_goal.cdMo;
  }

  void stateReset() VP_OVERRIDE
  {
    m_restart = true;
    m_integral.setZero();
  }

  Eigen::Vector3d integral(const vpServoMeasurement &measurement, const Gaze &gaze, const Eigen::Vector3d &w,
                           double dt) noexcept VP_OVERRIDE
  {
    const Eigen::Vector3d &e = gaze.e;
    if (m_goalMoved && !m_restart) {
      const Gaze before(m_modelGoal, measurement.cMo);
      m_restart = !before.lookAt.defined;
      m_model += e - before.e;
    }
    if (m_restart) {
      m_model = e;
      m_mean.setZero();
    }
    m_goalMoved = m_restart = false;

    for (int axis = 0; axis < 3; ++axis) {
      // The integral is subtracted: with the same sign as w it opposes it.
      if (w[axis] * m_integral[axis] > 0. && std::abs(w[axis]) > std::abs(m_integral[axis])) {
        m_integral[axis] = 0.;
      }
    }
    const bool known = measurement.covariance.known;
    const double noise = known ? meanShare * std::hypot(measurement.covariance.rotationDeviation(),
                                                        measurement.covariance.positionDeviation() / gaze.distance)
                               : 0.;
    const double clear = std::max(unwindDeviations * noise, unwindLeast);
    const Eigen::Vector3d x = e - m_model;
    m_mean += (1. - std::exp(-dt / meanTime)) * (x - m_mean);
    for (int axis = 0; axis < 3; ++axis) {
      if (x[axis] * m_integral[axis] < 0. && m_mean[axis] * m_integral[axis] < 0. && std::abs(m_mean[axis]) > clear) {
        m_integral[axis] *= -turned;
      }
    }
    const double size = known ? m_mean.norm() : 1.;
    if (size > noise) {
      m_integral += m_gains.integral * dt * (1. - noise / size) * x;
    }
    const double norm = m_integral.norm();
    if (norm > m_gains.integralLimit) {
      m_integral *= m_gains.integralLimit / norm;
    }
    m_model *= std::exp(-rotationGain() * dt);
    return m_integral;
  }

private:
  bool m_restart = true;
  bool m_goalMoved = false;
  vpHomogeneousMatrix m_lastGoal;  // current cdMo
  vpHomogeneousMatrix m_modelGoal; // cdMo of m_model, when the goal has moved since
  Eigen::Vector3d m_model = Eigen::Vector3d::Zero();
  Eigen::Vector3d m_mean = Eigen::Vector3d::Zero(); // mean of e - e_m
  Eigen::Vector3d m_integral = Eigen::Vector3d::Zero();
};
} // namespace

std::unique_ptr<vpServoLaw> vpServoLaws::makeLookAt(const std::string &id, const vpServoGains &gains,
                                                    double rotationFactor)
{
  return std::make_unique<vpServoLookAt>(id, gains, rotationFactor);
}

std::unique_ptr<vpServoLaw> vpServoLaws::makeLookAtPi(const std::string &id, const vpServoGains &gains,
                                                      double rotationFactor)
{
  return std::make_unique<vpServoLookAtPi>(id, gains, rotationFactor);
}

END_VISP_NAMESPACE
