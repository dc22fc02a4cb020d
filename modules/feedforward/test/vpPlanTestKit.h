/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPlanTestKit.h
 * \brief For the tests of laws that plan: a judge of their commands, random limits, noise and friction.
 */
#ifndef vpPlanTestKit_h
#define vpPlanTestKit_h

#include "vpServoScene.h"

#include <visp3/feedforward/vpServoController.h>

namespace vpPlanTestKit
{
using namespace vpServoScene;
using vpTestSupport::generator;
using vpTestSupport::longer;
using vpTestSupport::seed;

inline vpTwist minus(const vpTwist &a, const vpTwist &b)
{
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2], a[3] - b[3], a[4] - b[4], a[5] - b[5]};
}

// Judges commands by their differences; independent of how they were planned.
class Judge
{
public:
  Judge(const vpServoMotionLimits &limits, double dt) : m_limits(limits), m_dt(dt) {}

  void see(const vpTwist &v)
  {
    const vpTwist a = minus(v, m_v).scaled(1. / m_dt), j = minus(a, m_a).scaled(1. / m_dt);
    const double here =
        std::max({v.linearNorm() / m_limits.linearVelocity, v.angularNorm() / m_limits.angularVelocity,
                  a.linearNorm() / m_limits.linearAcceleration, a.angularNorm() / m_limits.angularAcceleration,
                  j.linearNorm() / m_limits.linearJerk, j.angularNorm() / m_limits.angularJerk});
    worst = std::max(worst, here);
    squares += j.linearNorm() * j.linearNorm();
    m_v = v;
    m_a = a;
  }
  const vpTwist &v() const { return m_v; }
  const vpTwist &a() const { return m_a; }

  double worst = 0., squares = 0.;

private:
  vpServoMotionLimits m_limits;
  double m_dt;
  vpTwist m_v, m_a;
};

inline vpServoMotionLimits randomLimits(std::mt19937_64 &rng)
{
  vpServoMotionLimits limits;
  for (double *field : {&limits.linearVelocity, &limits.linearAcceleration, &limits.linearJerk, &limits.angularVelocity,
                        &limits.angularAcceleration, &limits.angularJerk}) {
    *field *= std::exp(uniform(rng, -1., 1.));
  }
  return limits;
}

inline vpServoController makeServo(const std::string &law, const vpServoMotionLimits &motion = {})
{
  vpServoControllerSpec spec;
  spec.motion = motion;
  return vpServoController::create(law, spec);
}

inline vpHomogeneousMatrix noisy(std::mt19937_64 &rng, const vpHomogeneousMatrix &cMo, double shift, double angle)
{
  std::normal_distribution<double> gauss;
  return pose(turn(angle * gauss(rng), direction(rng)), shift * gauss(rng) * direction(rng)) * cMo;
}

// Camera twist executed with friction on the rotation.
inline vpTwist withFriction(const vpTwist &v, double deadband)
{
  vpTwist moved = v;
  for (std::size_t k = 3; k < 6; ++k) {
    moved[k] = std::copysign(std::max(std::abs(v[k]) - deadband, 0.), v[k]);
  }
  return moved;
}

inline const std::vector<Eigen::Vector3d> square = {{-.08, -.08, 0.}, {.08, -.08, 0.}, {.08, .08, 0.}, {-.08, .08, 0.}};
} // namespace vpPlanTestKit

#endif
