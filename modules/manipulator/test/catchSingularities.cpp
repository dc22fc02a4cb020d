/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The solver near singularities: escape, ways out, damping.
#include "vpCatch.h"
#include "vpSolverTestKit.h"

#include <iostream>

using namespace vpSolverTestKit;

TEST_CASE("A stretched arm escapes inwards and says that there is no way out", "[singular]")
{
  // Arm to the side and fully stretched: the elbow is offset, so that is not at 0.
  vpJointVector longest = vector({0.3, 1., 0.2, 0., 0.4, 0.7, 0.1});
  double most = 0.;
  for (int k = 0; k < 1000000; ++k) {
    vpJointVector q = longest;
    q(3) = -1e-6 * k;
    vpArmData data;
    vpArmKinematics::forward(amor(), q, data);
    const double reach = (data.joint[5].p - data.joint[1].p).norm();
    if (reach < most) {
      break;
    }
    most = reach;
    longest = q;
  }
  for (const double bend : {0., 1e-8, 1e-5, 1e-3, 1e-2}) {
    CAPTURE(bend);
    vpJointVector start = longest;
    start(3) -= bend;
    vpArmData data = at(amor(), start);
    // The lost direction is along forearm and upper arm.
    const Eigen::Vector3d along = (data.joint[5].p - data.joint[1].p).normalized();
    const vpRedundancySolver solver(amor());
    Vector6 twist;
    twist << -0.05 * along, 0., 0., 0.;
    vpRedundancyInput in = input(7, twist);
    vpRedundancyOutput out;
    vpJointVector q = start;
    const double length = (data.joint[5].p - data.joint[1].p).norm();
    bool escaped = false;
    for (int k = 0; k < 800; ++k) {
      data = at(amor(), q);
      solver.step(data, in, out);
      escaped = escaped || out.status == vpRedundancyStatus::Escaping;
      in.previous = out.velocity;
      q += 0.005 * out.velocity;
      REQUIRE(q(3) <= 1e-12);
    }
    CHECK((at(amor(), q).joint[5].p - at(amor(), q).joint[1].p).norm() < length - 0.02);
    CHECK((escaped || bend > 5e-3));
  }
}

TEST_CASE("A planar arm stretched straight cannot reach farther, and says so", "[singular]")
{
  vpArmSpec spec;
  spec.name = "planar";
  for (int i = 0; i < 3; ++i) {
    vpArmJointSpec joint = vpArmJointSpec::standardDH(0.5 - 0.1 * i, 0., 0., 0.);
    joint.name = "p" + std::to_string(i);
    joint.type = vpJointType::Continuous;
    joint.velocity = 2.;
    joint.acceleration = 10.;
    spec.joints.push_back(joint);
  }
  const vpArmModel arm(spec);
  const vpRedundancySolver solver(arm);
  for (const double bend : {0., 1e-9, 1e-6, 1e-4}) {
    for (const double sign : {1., -1.}) {
      Vector6 twist = Vector6::Zero();
      twist(0) = 0.05 * sign;
      vpRedundancyInput in = input(3, twist);
      in.free = {false, false, true, true, true, true};
      vpRedundancyOutput out;
      vpJointVector q = vector({0., bend, -0.5 * bend});
      for (int k = 0; k < 400; ++k) {
        solver.step(at(arm, q), in, out);
        in.previous = out.velocity;
        q += 0.005 * out.velocity;
      }
      CAPTURE(bend, sign, out.message(), q.transpose());
      if (sign > 0.) {
        CHECK(out.status == vpRedundancyStatus::BlockedBySingularity);
        CHECK(out.velocity.norm() < 0.01);
        CHECK(at(arm, q).tool.p(0) > 1.2 - 1e-6);
      }
      else {
        CHECK(at(arm, q).tool.p(0) < 1.2 - 0.05);
        CHECK(std::fabs(at(arm, q).tool.p(1)) < 0.02);
      }
    }
  }
}

TEST_CASE("A straight arm whose elbow bends one way only comes in that way", "[singular]")
{
  for (const double side : {1., -1.}) {
    vpArmSpec spec;
    spec.name = "one way";
    for (int i = 0; i < 2; ++i) {
      vpArmJointSpec joint = vpArmJointSpec::standardDH(0.5, 0., 0., 0.);
      joint.name = "p" + std::to_string(i);
      joint.lower = i == 0 ? -3. : std::min(0., 2.5 * side);
      joint.upper = i == 0 ? 3. : std::max(0., 2.5 * side);
      joint.velocity = 2.;
      joint.acceleration = 10.;
      spec.joints.push_back(joint);
    }
    const vpArmModel arm(spec);
    const vpRedundancySolver solver(arm);
    Vector6 twist = Vector6::Zero();
    twist(0) = -0.05;
    vpRedundancyInput in = input(2, twist);
    in.free = {false, false, true, true, true, true};
    vpRedundancyOutput out;
    vpJointVector q = vector({0., 0.});
    for (int k = 0; k < 400; ++k) {
      solver.step(at(arm, q), in, out);
      in.previous = out.velocity;
      q += 0.005 * out.velocity;
    }
    CAPTURE(side, out.message(), q.transpose());
    CHECK(at(arm, q).tool.p(0) < 1. - 0.05);
    CHECK(q(1) * side > 0.3);
  }
}

TEST_CASE("Damping is smooth where it sets in", "[singular]")
{
  // No jump of the output while the elbow straightens through the edge of the singular region.
  const vpArmModel model = unlimited(amor());
  vpRedundancySpec spec;
  spec.escapeSpeed = 0.;
  const vpRedundancySolver solver(model, spec);
  vpRedundancyOutput out;
  vpJointVector before;
  double jump = 0., most = 0.;
  Vector6 twist;
  twist << 0.05, 0.03, -0.04, 0.1, 0.05, 0.02;
  for (int k = 0; k <= 20000; ++k) {
    const vpJointVector q = vector({0.3, 1., 0.2, -0.5 + 2.5e-5 * k, 0.4, 0.7, 0.1});
    solver.step(at(model, q), input(7, twist), out);
    if (k > 0) {
      jump = std::max(jump, (out.velocity - before).norm());
    }
    most = std::max(most, out.velocity.norm());
    before = out.velocity;
  }
  CAPTURE(jump, most);
  CHECK(jump < 2e-3);
  CHECK(most < 3.);
}
