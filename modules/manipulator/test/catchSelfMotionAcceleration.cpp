/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// vpRedundancySpec::selfAcceleration: self-motion that starts and changes with a fraction of the accelerations.
#include "vpArmTestKit.h"
#include "vpCatch.h"

#include <visp3/core/vpException.h>
#include <visp3/manipulator/vpRedundancySolver.h>

using namespace vpArmTestKit;

namespace
{
constexpr double period = 0.005; // s

//! Results of self-motion with the tool at rest over some periods.
struct Course {
  double largestShare = 0.; //!< Largest ratio of a joint's velocity change in a period to its acceleration limit.
  double drift = 0.;        //!< |J v|, m/s and rad/s.
  double speed = 0.;        //!< Final joint speed, rad/s.
};

Course climb(const vpArmModel &model, const vpJointVector &start, double selfAcceleration, int periods)
{
  vpRedundancySpec spec;
  spec.period = period;
  spec.selfAcceleration = selfAcceleration;
  const vpRedundancySolver solver(model, spec);
  vpRedundancyInput in;
  in.frame = vpArmFrame::Base;
  in.indices[0] = vpSelfMotionIndex::posture(start + vpJointVector::Constant(model.size(), 0.4));
  in.indexCount = 1;
  in.previous = vpJointVector::Zero(model.size());
  vpRedundancyOutput out;
  vpJointVector q = start;
  vpArmData data;
  Course course;
  for (int k = 0; k < periods; ++k) {
    vpArmKinematics::update(model, q, data);
    solver.step(data, in, out);
    for (int i = 0; i < model.size(); ++i) {
      course.largestShare = std::max(course.largestShare,
                                     std::fabs(out.velocity(i) - in.previous(i)) / (model.acceleration()(i) * period));
    }
    course.drift = std::max(course.drift, (data.J * out.velocity).norm());
    in.previous = out.velocity;
    q += period * out.velocity;
  }
  course.speed = out.velocity.norm();
  return course;
}
} // namespace

TEST_CASE("Self-motion starts with its share of the accelerations and then goes as fast", "[self-motion]")
{
  auto rng = vpTestSupport::generator(1901);
  CAPTURE(vpTestSupport::seed());
  int moving = 0, faster = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const vpJointVector start = amor().home() + 0.3 * vpJointVector::NullaryExpr(amor().size(), [&](Eigen::Index) {
                                                  return uniform(rng, -1., 1.);
                                                });
    const double share = uniform(rng, 0.02, 0.3);
    const Course slow = climb(amor(), start, share, 4), free = climb(amor(), start, 0., 4);
    CAPTURE(trial, share);
    CHECK(slow.largestShare <= share + 1e-3); // the free direction turns a little from one period to the next
    CHECK(slow.drift < 1e-9);
    moving += slow.speed > 1e-6 ? 1 : 0;
    faster += free.largestShare > share ? 1 : 0;
    // With enough time it reaches the same speed.
    const Course later = climb(amor(), start, 0.3, 100), without = climb(amor(), start, 0., 100);
    CHECK(later.speed == Approx(without.speed).epsilon(0.15).margin(2e-3));
  }
  CHECK(moving > 50);
  CHECK(faster > 30); // without it the self-motion does change faster than that
}

TEST_CASE("selfAcceleration outside its range is named", "[self-motion]")
{
  for (const double bad : {-0.1, 1.1, std::nan("")}) {
    vpRedundancySpec spec;
    spec.selfAcceleration = bad;
    try {
      const vpRedundancySolver solver(amor(), spec);
      FAIL("accepted " << bad);
    }
    catch (const vpException &error) {
      CHECK(std::string(error.getMessage()).find("selfAcceleration") != std::string::npos);
      CHECK(std::string(error.getMessage()).find("in [0, 1]") != std::string::npos);
    }
  }
}
