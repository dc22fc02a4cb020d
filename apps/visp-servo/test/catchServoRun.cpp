/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The loop of visp-servo with robots and cameras that fail: it ends with a sentence, the robot is stopped, and what was seen is kept.
#include "vpCatch.h"

#include "recorded.h"
#include "servoRun.h"

#include "testFolder.h"

#include <visp3/direct_core/vpSO3.h>

#include <atomic>
#include <chrono>
#include <limits>
#include <mutex>
#include <stdexcept>
#include <thread>

namespace
{
using namespace visualServo;
using vpTestSupport::uniform;

//! What robot and camera do wrong, and what was done to them.
struct Script {
  std::atomic<int> failRead{-1}, failCommand{-1}, failImage{-1}, endImage{-1}; // at this call; -1: never
  std::atomic<int> reads{0}, commands{0}, images{0}, begun{0}, ended{0};
  double speed = 0., speedAtEnd = 0.; // commanded last, m/s
  int readsAtFailure = 0, readsAtEnd = 0;
};

//! A point-like robot that executes every command exactly.
class ScriptedRobot : public Robot
{
public:
  explicit ScriptedRobot(Script &script) : m_script(script) {}
  [[nodiscard]] vpServoRobotState read() override
  {
    if (m_script.reads++ == m_script.failRead) {
      throw std::runtime_error("the cable is out");
    }
    vpServoRobotState state;
    state.pose = pose();
    return state;
  }
  void command(const vpVisualServoOutput &motion, double period) override
  {
    if (m_script.commands++ == m_script.failCommand) {
      m_script.readsAtFailure = m_script.reads;
      throw std::runtime_error("refused");
    }
    m_script.speed = motion.twist.linearNorm();
    const std::lock_guard<std::mutex> lock(m_mutex);
    const Eigen::Vector3d v(motion.twist[0], motion.twist[1], motion.twist[2]),
        w(motion.twist[3], motion.twist[4], motion.twist[5]);
    m_fMc = m_fMc * vpRigidTransform{vpSO3::exp(period * w), period * v};
  }
  void begin() override { ++m_script.begun; }
  void end() override
  {
    ++m_script.ended;
    m_script.speedAtEnd = m_script.speed;
    m_script.readsAtEnd = m_script.reads;
  }
  [[nodiscard]] vpRigidTransform pose() const override
  {
    const std::lock_guard<std::mutex> lock(m_mutex);
    return m_fMc;
  }
  [[nodiscard]] std::string description() const override { return "the scripted robot"; }

private:
  Script &m_script;
  mutable std::mutex m_mutex;
  vpRigidTransform m_fMc;
};

//! Images whose content is not looked at; by the clock or not.
class ScriptedCamera : public vpApp::ImageSource
{
public:
  ScriptedCamera(Script &script, bool isByClock) : m_script(script), m_isByClock(isByClock) {}
  bool next(vpImage<unsigned char> &image) override
  {
    const int k = m_script.images++;
    if (k == m_script.failImage) {
      throw std::runtime_error("camera 7: gives no image any more");
    }
    if (m_isByClock) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    m_time = m_isByClock ? vpApp::now() : 0.02 * k;
    image.resize(48, 64);
    image = static_cast<unsigned char>(k);
    return k != m_script.endImage;
  }
  [[nodiscard]] std::string name() const override { return "image"; }
  [[nodiscard]] unsigned int number() const override { return static_cast<unsigned int>(m_script.images - 1); }
  [[nodiscard]] double time() const override { return m_time; }
  [[nodiscard]] bool isLive() const override { return true; }
  [[nodiscard]] std::size_t count() const override { return 0; }
  [[nodiscard]] std::string description() const override { return "camera 7"; }

private:
  Script &m_script;
  bool m_isByClock;
  double m_time = 0.;
};

struct Result {
  Ending ending = Ending::Quit;
  std::string failure;
  std::size_t cycles = 0, images = 0, readBack = 0, recorded = 0;
  CycleRow last;
};

//! Runs; vision is the true pose.
Result run(Script &script, bool isByClock, const std::function<void(Options &)> &change, const Screen &screen = {})
{
  const TestFolder folder;
  Options options;
  options.motion.robot.robot = "camera"; // starts by itself
  options.realTime = isByClock;
  options.camera.rate = 50.;
  options.camera.latency = 0.02;
  options.laws = {"pbvs1", "ff-lookat"};
  options.law.gains.lambda = 4.;
  options.law.motion.linearVelocity = 0.5;
  options.law.motion.angularVelocity = 1.;
  options.servo.startTime = 0.1;
  options.duration = 20.;
  change(options);
  ScriptedRobot robot(script);
  ScriptedCamera camera(script, isByClock);
  vpVisualServo servo(vpServoController::create("pbvs1", options.law), options.servo);
  const vpServoTarget target = vpServoTarget::rectangle(0.1, 0.1);
  const vpRigidTransform fMo{vpSO3::exp({0.1, -0.1, 0.2}), {0.03, 0.02, 0.5}};
  servo.setVision(vpServoVision::poses(
      [&](const vpImage<unsigned char> &, vpHomogeneousMatrix &cMo, vpPoseCovariance &) {
        cMo = (robot.pose().inverse() * fMo).toHomogeneous();
        return true;
      },
      target));
  servo.setGoal(target.goal(vpHomogeneousMatrix(0., 0., 0.4, 0., 0., 0.)));
  vpApp::OutputFolder out("visp-servo", folder.file("out"));
  Recording recording(out, nullptr, 50.);
  ServoRun loop(options, camera, robot, servo, recording, screen);
  loop.run();
  recording.close();
  Result result{loop.ending(), loop.failure(), recording.cycleCount(), recording.imageCount(), 0, 0, recording.last()};
  const std::filesystem::path place = std::filesystem::path(out.file("log.csv")).parent_path();
  readCycles(place, [&result](const RecordedCycle &) { ++result.readBack; });
  result.recorded = readImages(place).size();
  return result;
}
} // namespace

TEST_CASE("the loop reaches the goal, stops the robot, and keeps every cycle and image", "[visp-servo][run]")
{
  for (const bool isByClock : {false, true}) {
    CAPTURE(isByClock);
    Script script;
    const Result result = run(script, isByClock, [](Options &) {});
    CHECK(result.ending == Ending::Converged);
    CHECK(result.failure.empty());
    CHECK(result.last.positionError < 0.001);
    CHECK(script.begun == 1);
    CHECK(script.ended == 1);
    CHECK((!isByClock || script.speedAtEnd == 0.));
    CHECK(result.readBack == result.cycles);
    CHECK(result.recorded == result.images);
    CHECK(result.images > 20);
  }
}

TEST_CASE("a dry run moves nothing and ends with the images", "[visp-servo][run]")
{
  Script script;
  script.endImage = 50;
  const Result result = run(script, false, [](Options &options) {
    options.motion.dryRun = true;
    options.servo.followLength = options.servo.followAngle = std::numeric_limits<double>::infinity();
  });
  CHECK(result.ending == Ending::NoMoreImages);
  CHECK(script.begun == 0);
  CHECK(script.commands == 0);
  CHECK(result.images == 50);
}

TEST_CASE("a robot that is not told to move is not commanded", "[visp-servo][run]")
{
  Script script;
  const Result result = run(script, false, [](Options &options) {
    options.motion.robot.robot = "franka"; // not simulated
    options.duration = 1.;
  });
  CHECK(result.ending == Ending::Duration);
  CHECK(script.begun == 0);
  CHECK(script.commands == 0);
  CHECK(result.last.status == vpVisualServoStatus::Idle);
}

TEST_CASE("a robot or camera that fails in mid-run ends the run with its sentence, and the robot is stopped",
          "[visp-servo][run][errors]")
{
  auto rng = vpTestSupport::generator();
  for (const bool isByClock : {false, true}) {
    for (int kind = 0; kind < 3; ++kind) {
      CAPTURE(isByClock, kind);
      Script script;
      const int when = static_cast<int>(uniform(rng, 10., 40.));
      (kind == 0 ? script.failRead : kind == 1 ? script.failCommand : script.failImage) = when;
      const Result result = run(script, isByClock, [](Options &) {});
      CHECK(result.ending == Ending::Failed);
      CHECK(result.failure == (kind == 0   ? "the scripted robot: the cable is out"
                               : kind == 1 ? "the scripted robot: refused"
                                           : "camera 7: gives no image any more"));
      CHECK(script.begun == script.ended);
      CHECK(result.readBack == result.cycles);
      CHECK(result.cycles >= (kind == 2 ? 1U : static_cast<std::size_t>(when)));
      if (kind == 1) { // nothing is commanded after a refusal
        CHECK(script.commands == when + 1);
        CHECK(script.readsAtEnd == script.readsAtFailure); // stopped at once
      }
      else if (isByClock) { // it was braked before
        CHECK(script.speedAtEnd == 0.);
      }
    }
  }
}

TEST_CASE("keys start, stop, change the law and end", "[visp-servo][run]")
{
  Script script;
  int shown = 0;
  std::vector<bool> moving;
  std::string law;
  const Result result = run(
      script, true, [](Options &options) { options.stay = true; },
      [&](const Moment &moment) {
        moving.push_back(moment.isMoving);
        law = moment.law;
        switch (++shown) {
        case 3:
          return Wish::StartStop;
        case 6:
          return Wish::NextLaw;
        case 8:
          return Wish::StartStop;
        case 12:
          return Wish::Quit;
        default:
          return Wish::None;
        }
      });
  CHECK(result.ending == Ending::Quit);
  REQUIRE(moving.size() == 12);
  CHECK(moving[2]);
  CHECK(!moving[3]);
  CHECK(moving[8]);
  CHECK(law == "ff-lookat");
  CHECK(script.begun == 1);
  CHECK(script.ended == 1);
}
