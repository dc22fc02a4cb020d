/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The examples of the module's README.md: compiled, run, and compared with the text there, line by line.
#include "vpCatch.h"
#include "vpServoScene.h"

#include <visp3/feedforward/vpFeatureLookAt.h>
#include <visp3/feedforward/vpFeedforwardTask.h>
#include <visp3/feedforward/vpServoController.h>
#include <visp3/visual_features/vpFeatureTranslation.h>
#include <visp3/vs/vpServo.h>

#include <fstream>
#include <iterator>

namespace
{
using namespace vpServoScene;

std::string read(const std::string &name)
{
  std::ifstream file(name);
  INFO(name);
  REQUIRE(file.good());
  return std::string(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
}

// Stands in for ViSP's robot: executes the commanded velocity.
struct vpRobot {
  enum Frame { CAMERA_FRAME };
  vpHomogeneousMatrix cMo;
  void setVelocity(Frame, const vpColVector &v) { cMo = move(cMo, vpTwist::fromColVector(v), 0.01); }
};
} // namespace

TEST_CASE("the controller example of the README reaches its goal", "[readme]")
{
  auto rng = vpTestSupport::generator(61);
  const auto points = object(rng, 0.16, 8);
  const vpCameraParameters camera(800., 800., 320., 240.);
  const vpServoGoal goal = vpServoScene::goal(pose(Eigen::Matrix3d::Identity(), {0., 0., 0.5}), points);
  vpRobot robot{pose(turn(0.4, Eigen::Vector3d::UnitY()), {0.05, 0.02, 0.7})};
  const auto look = [&]() {
    vpServoMeasurement seen;
    measure(robot.cMo, points, seen);
    return seen;
  };
  int cycles = 0;
  const auto closeEnough = [&](const vpServoMeasurement &seen) {
    return translationError(goal.cdMo, seen.cMo) < 1e-3 || ++cycles > 2000;
  };
  vpServoMeasurement seen;
  // clang-format off
vpServoControllerSpec spec;
spec.view = vpViewConstraintSpec::fromCamera(camera, 640, 480);
vpServoController servo = vpServoController::create("ff-lookat-pi+cbf", spec);
servo.setGoal(goal);       // cdMo and the object's points in the desired camera
vpServoCommand command;
do {
  seen = look();           // seen.valid = false when the target was not found
  command = servo.step(seen, 0.01);
  robot.setVelocity(vpRobot::CAMERA_FRAME, command.v.toColVector());
} while (vpIsWorking(command.status) && !closeEnough(seen)); // vpMessage(command.status) gives any other reason
robot.setVelocity(vpRobot::CAMERA_FRAME, vpColVector(6));
  // clang-format on
  CHECK(cycles < 2000);
  CHECK(command.status == vpServoStatus::Servoing);
}

TEST_CASE("the vpServo examples of the README command what the law commands", "[readme]")
{
  auto rng = vpTestSupport::generator(62);
  const unsigned int seed = vpTestSupport::seed();
  for (int run = 0; run < 100; ++run) {
    CAPTURE(seed, run);
    const auto points = object(rng, 0.16, 8);
    const vpServoGoal goal = vpServoScene::goal(randomPose(rng, 0.3, 0.8, 0.2, 0.5), points);
    vpServoMeasurement seen;
    measure(randomPose(rng, 0.3, 0.8, 0.3, 1.), points, seen);
    const vpHomogeneousMatrix cdMo = goal.cdMo, cdMc = cdMo * seen.cMo.inverse();
    vpServoGains gains;
    gains.lambda = uniform(rng, 0.3, 3.);
    const auto requireLaw = [&](const vpColVector &v, const vpServoGains &ofLaw) {
      const auto law = vpServoLaw::create("ff-lookat", ofLaw);
      law->setGoal(goal);
      const vpTwist wanted = law->step(seen, 0.01).v;
      for (unsigned int i = 0; i < 6; ++i) {
        REQUIRE(std::abs(v[i] - wanted[i]) < 1e-12);
      }
    };
    {
      // clang-format off
vpFeedforwardTask task("ff-lookat", gains);
task.setGoal(goal);
const vpColVector v = task.computeControlLaw(seen); // each cycle
      // clang-format on
      requireLaw(v, gains);
    }
    // clang-format off
vpFeatureTranslation position(vpFeatureTranslation::cdMc);
vpFeatureLookAt gaze;
vpServo task;
task.setServo(vpServo::EYEINHAND_CAMERA);
task.setInteractionMatrixType(vpServo::CURRENT);
task.setLambda(1.);
task.addFeature(position);
task.addFeature(gaze);
position.buildFrom(cdMc); // these three lines each cycle
gaze.buildFrom(cdMc, cdMo);
const vpColVector v = task.computeControlLaw();
    // clang-format on
    task.kill();
    requireLaw(v, {});
  }
}

TEST_CASE("the README has the examples as they are compiled here", "[readme]")
{
  const std::string readme = read(std::string(VISP_DIRECT_DATA_DIR) + "/../modules/feedforward/README.md");
  const std::string here = read(VISP_DIRECT_DATA_DIR "/../modules/feedforward/test/catchFeedforwardReadme.cpp");
  int blocks = 0;
  for (std::size_t at = readme.find("```cpp\n"); at != std::string::npos; at = readme.find("```cpp\n", at + 7)) {
    const std::string block = readme.substr(at + 7, readme.find("```", at + 7) - at - 7);
    INFO(block);
    CHECK(here.find(block) != std::string::npos);
    ++blocks;
  }
  CHECK(blocks == 3);
}
