/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Wishes of all kinds to joint velocities: paths arrive, shares and limits are kept, broken wishes brake. The frames of
// twists are tested on the simulated arm.
#include "vpCatch.h"
#include "vpTestArms.h"
#include "vpWildNumbers.h"

#include <visp3/manipulator/vpArmMotion.h>

VISP_DIRECT_USING_NAMESPACE
using vpTestArms::amor;

namespace
{
//! An arm that does what it is told.
struct Follower {
  vpArmMotion motion{amor(), vpRedundancySpec(), vpClosedLoopSpec()};
  vpJointVector q = amor().home(), velocity = vpJointVector::Zero(amor().size());

  //! One period; the velocities keep the limits.
  void step()
  {
    const vpJointVector before = velocity;
    velocity = motion.step(q, velocity);
    for (int i = 0; i < amor().size(); ++i) {
      REQUIRE(vpWildNumbers::atMost(std::abs(velocity(i)), amor().velocity()(i) * (1. + 1e-9)));
      REQUIRE(vpWildNumbers::atMost(std::abs(velocity(i) - before(i)),
                                    amor().acceleration()(i) * motion.period() * (1. + 1e-6) + 1e-12));
    }
    q += motion.period() * velocity;
  }
};
} // namespace

TEST_CASE("A joint path arrives, and keeps its share of the velocity limits", "[arm_motion]")
{
  std::mt19937_64 rng(vpTestSupport::generator(71));
  for (int problem = 0; problem < 20; ++problem) {
    Follower arm;
    const double share = vpTestArms::uniform(rng, 0.1, 1.);
    const vpJointVector goal = vpTestArms::configuration(amor(), rng, 0.05);
    arm.motion.jointPath(goal, arm.q, arm.velocity, share);
    double used = 0.;
    for (int k = 0; k < 20000 && !arm.motion.finished(); ++k) {
      arm.step();
      used = std::max(used, (arm.velocity.array().abs() / amor().velocity().array()).maxCoeff());
    }
    REQUIRE(arm.motion.finished());
    CHECK(!arm.motion.failed());
    CHECK(arm.motion.kind() == vpArmTaskKind::Hold);
    CHECK((arm.q - goal).cwiseAbs().maxCoeff() < 1e-9);
    CHECK(used <= share * (1. + 1e-6));
    CHECK(used > 0.3 * share); // the share is what bounds it
  }
}

TEST_CASE("A pose path arrives; hold brakes; wishes that are not finite brake, too", "[arm_motion]")
{
  Follower arm;
  vpArmData data;
  vpArmKinematics::update(amor(), arm.q, data);
  vpRigidTransform goal = data.tool;
  goal.p += Eigen::Vector3d(0.03, -0.02, 0.04);
  arm.motion.posePath(goal, arm.q, arm.velocity);
  for (int k = 0; k < 4000 && !arm.motion.finished(); ++k) {
    arm.step();
  }
  CHECK(arm.motion.poseStatus() == vpClosedLoopStatus::Reached);
  vpArmKinematics::update(amor(), arm.q, data);
  CHECK((data.tool.p - goal.p).norm() < 2e-5);

  arm.motion.twist(vpTwist(0.05, 0., 0., 0., 0., 0.), vpArmTwistFrame::Camera);
  for (int k = 0; k < 100; ++k) {
    arm.step();
  }
  CHECK(arm.velocity.norm() > 0.01);
  arm.motion.hold();
  for (int k = 0; k < 400; ++k) {
    arm.step();
  }
  CHECK(arm.velocity.norm() < 1e-12);

  for (const double wild : vpWildNumbers::values) {
    arm.motion.jointVelocity(vpJointVector::Constant(amor().size(), wild));
    arm.step();
    arm.motion.twist(vpTwist(wild, 0., 0., 0., wild, 0.), vpArmTwistFrame::Mixt);
    arm.step();
  }
}
