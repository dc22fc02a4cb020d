/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// What the drives of an arm make of friction: the order of the thesis's laws, damping of a URDF, missing torques.
#include "vpArmsOfTests.h"
#include "vpCaseFile.h"
#include "vpCatch.h"

#include "lab/servo/vpServoExperiment.h"
#include "lab/servo/vpServoStart.h"
#include <visp3/core/vpMath.h>
#include <visp3/manipulator/vpArmDynamics.h>

#include <cmath>
#include <iostream>
#include <map>

using namespace vpArmsOfTests;

namespace
{
vpServoArm armOf(const vpArmModel &model, vpDriveReference reference)
{
  vpServoArm arm{model, {}};
  arm.spec.start = findServoStart(model, vpServoTask::thesis());
  arm.spec.indices = {vpSelfMotionIndex::jointLimits(), vpSelfMotionIndex::manipulability()};
  arm.spec.drives.reference = reference;
  return arm;
}

vpServoRun run(const std::string &law, const std::string &plant, const vpServoArm &arm)
{
  vpServoRunSpec spec;
  spec.law = law;
  spec.plant = vpServoPlant::byName(plant);
  spec.arm = std::make_shared<vpServoArm>(arm);
  spec.seed = vpTestSupport::seed();
  const vpServoRun result = runServoExperiment(spec);
  std::cout << arm.model.spec().name << ' ' << plant << ' ' << law << ": yaw range " << result.metrics.yaw_range_deg
            << " of " << result.metrics.ideal_yaw_range_deg << " deg, rms " << result.metrics.rms_image_error_px
            << " px, end " << result.metrics.end_rotation_deg << " deg, " << result.metrics.end_translation_mm
            << " mm; arm: " << result.armMetrics->status << '\n';
  return result;
}
} // namespace

namespace
{
//! Velocity below which the drive of a joint of AMOR does not overcome Coulomb friction, (3.19) on (3.18), rad/s.
double leastVelocity(const vpArmJointSpec &joint, double frictionScale, double period)
{
  return frictionScale * joint.coulomb / (joint.kp * period + joint.kd);
}

//! Largest yaw error at rest of a law with this gain, rad: the law asks for gain times the error, all joints rest.
double largestYawAtRest(const vpServoArm &arm, const vpArmSample &sample, const vpServoPlant &plant, double gain)
{
  vpArmData data;
  vpArmKinematics::update(arm.model, sample.q, data);
  const vpSimulatedArmSpec spec = arm.forPlant(plant);
  const vpArmJacobian J = vpArmKinematics::geometric(arm.model, data, vpArmFrame::Camera);
  double sum = 0.;
  for (int i = 0; i < arm.model.size(); ++i) {
    const vpArmJointSpec &joint = arm.model.spec().joints[static_cast<std::size_t>(i)];
    sum += std::fabs(J(4, i)) * leastVelocity(joint, spec.drives.frictionScale, spec.redundancy.period);
  }
  return sum / gain;
}
} // namespace

TEST_CASE("With measured references the laws come in the order of figures 5.9 and 5.10", "[arm][drives][errata]")
{
  CAPTURE(vpTestSupport::seed());
  const vpServoArm measured = armOf(amor(), vpDriveReference::Measured);
  const vpServoArm integrated = armOf(amor(), vpDriveReference::Integrated);
  for (const char *plant : {"B", "D"}) {
    std::map<std::string, vpServoMetrics> by;
    for (const char *law : {"pbvs1", "kyrki-decoupled", "ff-sum"}) {
      const vpServoRun result = run(law, plant, measured);
      by[law] = result.metrics;
      CAPTURE(plant, law);
      // Half of the missing range is the yaw error at one end.
      const double missing = vpMath::rad(result.metrics.ideal_yaw_range_deg - result.metrics.yaw_range_deg);
      const double most = largestYawAtRest(measured, result.arm.back(), result.spec.plant, result.spec.gains.lambda);
      std::cout << "  missing range " << missing << " rad, at most " << 2. * most << '\n';
      CHECK(missing > 0.02);
      CHECK(missing < 2. * most);
      const vpServoMetrics open = run(law, plant, integrated).metrics;
      CHECK(open.yaw_range_deg == Approx(open.ideal_yaw_range_deg).margin(1.));
      CHECK(open.end_rotation_deg < 0.6);
    }
    CHECK(by["ff-sum"].yaw_range_deg > by["pbvs1"].yaw_range_deg + 1.);
    CHECK(by["ff-sum"].yaw_range_deg > by["kyrki-decoupled"].yaw_range_deg + 1.);
    CHECK(by["ff-sum"].rms_image_error_px < by["pbvs1"].rms_image_error_px);
    CHECK(by["pbvs1"].rms_image_error_px < by["kyrki-decoupled"].rms_image_error_px);
  }
}

TEST_CASE("A run names the joint whose drive is too weak, and the torque that is missing", "[arm][drives]")
{
  vpServoArm arm = armOf(amor(), vpDriveReference::Integrated);
  vpArmSpec spec = amor().spec();
  vpArmDynamics dynamics(amor());
  vpJointVector gravity;
  dynamics.gravity(arm.spec.start, gravity);
  Eigen::Index heaviest = 0;
  gravity.cwiseAbs().maxCoeff(&heaviest);
  vpArmJointSpec &weak = spec.joints[static_cast<std::size_t>(heaviest)];
  weak.torque = 0.9 * std::fabs(gravity(heaviest)); // cannot even hold its load
  arm.model = vpArmModel(spec);
  const vpServoRun result = run("pbvs1", "B", arm);
  CHECK_THAT(result.armMetrics->status, Catch::StartsWith("joint " + weak.name + " did not follow its command at ") &&
                                            Catch::Contains("Nm are missing"));
  CHECK(result.armMetrics->shortfall.joint == heaviest);
  CHECK(result.armMetrics->shortfall.missing() > 0.);
  CHECK(result.armMetrics->saturated_s > 0.1);
  // Slightly too weak for the fastest part of the motion only.
  const vpServoRun full = run("pbvs1", "B", armOf(amor(), vpDriveReference::Integrated));
  double most = 0.;
  for (const vpArmSample &sample : full.arm) {
    most = std::max(most, std::fabs(sample.torque(heaviest)));
  }
  weak.torque = 0.995 * most;
  arm.model = vpArmModel(spec);
  const vpServoRun nearly = run("pbvs1", "B", arm);
  CHECK(nearly.armMetrics->saturated_s > 0.);
  CHECK(nearly.metrics.end_rotation_deg < 0.6);
}

TEST_CASE("An arm with the damping of its URDF reaches the thesis' poses", "[arm][drives]")
{
  const std::string file = vpTestSupport::caseFile("robots/iiwa14_primitive_collision.urdf");
  if (file.empty()) {
    return;
  }
  vpArmUrdfSpec urdf;
  urdf.tip = "iiwa_link_ee";
  urdf.acceleration = 10.;
  const vpArmModel model = vpLoadArmUrdf(file, urdf);
  for (const vpDriveReference reference : {vpDriveReference::Integrated, vpDriveReference::Measured}) {
    const vpServoArm arm = armOf(model, reference);
    for (const char *plant : {"A", "B", "D"}) {
      for (const char *law : {"pbvs1", "ff-lookat-pi"}) {
        const vpServoRun result = run(law, plant, arm);
        CAPTURE(plant, law, static_cast<int>(reference));
        CHECK(result.metrics.end_rotation_deg < 0.5);
        CHECK(result.metrics.end_translation_mm < 2.);
        CHECK(result.armMetrics->status == "ok");
      }
    }
  }
}
