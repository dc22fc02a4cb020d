/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Vision and control thread side by side: what one hands over arrives whole, and a step neither allocates nor locks. Also
// under the thread sanitizer: scripts/sanitize.sh threads
#include "vpServoBench.h"
#include "vpTestArms.h"

#include "../src/vpPoseHistory.h"
#include "../src/vpTripleBuffer.h"

#include <visp3/core/vpException.h>
#include <visp3/servoing/vpRealTime.h>

#include <atomic>
#include <chrono>
#include <fstream>
#include <mutex>
#include <thread>

#if defined(__linux__)
#include <dlfcn.h>
#include <pthread.h>
#endif

namespace
{
thread_local unsigned long locks = 0; // taken by this thread
}

#if defined(__linux__) && !defined(__SANITIZE_THREAD__) && !defined(__SANITIZE_ADDRESS__)
// Counts the locks of all libraries.
extern "C" int pthread_mutex_lock(pthread_mutex_t *mutex)
{
  using Lock = int (*)(pthread_mutex_t *);
  static const Lock real = reinterpret_cast<Lock>(dlsym(RTLD_NEXT, "pthread_mutex_lock"));
  ++locks;
  return real(mutex);
}
constexpr bool canCountLocks = true;
#else
constexpr bool canCountLocks = false;
#endif

TEST_CASE("The newest value comes through a triple buffer whole, and none comes twice", "[servoing]")
{
  using Value = std::array<unsigned long, 64>;
  vpTripleBuffer<Value> buffer;
  std::atomic<bool> isWriting{true};
  const unsigned long count = static_cast<unsigned long>(vpTestSupport::longer(100000));
  std::thread writer([&]() {
    for (unsigned long i = 1; i <= count; ++i) {
      buffer.back().fill(i);
      buffer.publish();
    }
    isWriting = false;
  });
  unsigned long last = 0, taken = 0, torn = 0, old = 0;
  const auto take = [&]() {
    if (buffer.fetch()) {
      const Value &value = buffer.front();
      torn += value.front() != value.back() || value.front() != value[31];
      old += value.front() <= last;
      last = value.front();
      ++taken;
    }
  };
  while (isWriting) {
    take();
  }
  writer.join();
  take();
  CHECK(last == count);
  CHECK(taken > 0);
  CHECK(torn == 0);
  CHECK(old == 0);
  CHECK(!buffer.fetch());
}

TEST_CASE("A pose history gives the pose of a time, between and shortly after its entries, or says that it has none",
          "[servoing]")
{
  const vpTwist twist(0.1, -0.2, 0.3, 0.5, -0.4, 0.2);
  const auto truth = [&twist](double time) { return vpRigidMotion::exp(twist.scaled(time)); };
  for (int i = 0; i < vpTestSupport::longer(100); ++i) {
    std::mt19937_64 rng = vpTestSupport::generator(static_cast<unsigned int>(i));
    vpPoseHistory history(20);
    vpRigidTransform pose;
    CHECK(!history.at(0., pose));
    std::vector<double> times{vpTestSupport::uniform(rng, -5., 5.)};
    const int count = static_cast<int>(vpTestSupport::uniform(rng, 1., 60.));
    for (int k = 0; k < count; ++k) {
      history.add(times.back(), truth(times.back()));
      times.push_back(times.back() + vpTestSupport::uniform(rng, 0.001, 0.02));
    }
    times.pop_back();
    const double first = times[times.size() > 20 ? times.size() - 20 : 0], last = times.back();
    if (times.size() == 1) {
      CHECK(history.at(last, pose));
      CHECK(!history.at(last + 1e-6, pose));
      continue;
    }
    const double step = last - times[times.size() - 2];
    for (int k = 0; k < 20; ++k) {
      const double time = vpTestSupport::uniform(rng, first, last + 2. * step);
      REQUIRE(history.at(time, pose));
      REQUIRE((pose.R - truth(time).R).norm() < 1e-12);
      REQUIRE((pose.p - truth(time).p).norm() < 1e-12);
    }
    CHECK(!history.at(first - 1e-6, pose));
    CHECK(!history.at(last + 2.01 * step, pose));
    CHECK(!history.at(NAN, pose));
    history.clear();
    CHECK(!history.at(last, pose));
  }
}

TEST_CASE("Poses read from a history while it is written are those of their times", "[servoing]")
{
  vpPoseHistory history(16);
  std::atomic<double> newest{-1.};
  std::atomic<bool> isWriting{true};
  std::atomic<unsigned long> found{0};
  std::thread writer([&]() {
    const int count = vpTestSupport::longer(200000); // more where the reader does not come to its turn
    for (int i = 0; i < count || (found == 0 && i < 100 * count); ++i) {
      vpRigidTransform pose;
      pose.p.setConstant(i);
      history.add(i, pose);
      if (i % 5000 == 4999) {
        history.clear();
      }
      newest = i;
    }
    isWriting = false;
  });
  unsigned long wrong = 0;
  while (isWriting) {
    const double time = newest - 2.5;
    vpRigidTransform pose;
    if (history.at(time, pose)) {
      ++found;
      wrong += !((pose.p.array() - time).abs().maxCoeff() < 1e-6);
    }
  }
  writer.join();
  CHECK(found > 0);
  CHECK(wrong == 0);
}

namespace
{
//! What the two threads of a test share about the simulated world, atomically.
struct World {
  std::atomic<double> now{0.};
  std::atomic<bool> isRunning{true};
};

void requireWorkDone(const vpVisualServo &servo)
{
  CHECK(servo.timing().step.count() > 0);
  CHECK(servo.timing().latency.count() > 3);
  CHECK(servo.timing().image.count() > 3);
  CHECK(servo.timing().vision.count() > 3);
  CHECK(servo.timing().step.quantile(0.5) <= servo.timing().step.quantile(0.99));
  CHECK(servo.timing().step.quantile(0.99) <= servo.timing().step.max());
}
} // namespace

TEST_CASE("An arm at 1 kHz beside a busy vision thread comes to its goal without an allocation or a lock in a step",
          "[servoing]")
{
  if (canCountLocks) { // or the count below proves nothing
    std::mutex mutex;
    const unsigned long before = locks;
    const std::lock_guard<std::mutex> lock(mutex);
    REQUIRE(locks == before + 1);
  }
  const vpArmModel &model = vpTestArms::amor();
  const vpServoTarget plate = vpServoTarget::rectangle(0.16, 0.11);
  const vpHomogeneousMatrix cdMo(0., 0., 0.35, 0., 0., 0.);
  vpArmData data;
  vpArmKinematics::update(model, model.home(), data);
  const vpRigidTransform fMo = vpArmKinematics::camera(model, data) *
                               vpRigidTransform::fromHomogeneous(vpHomogeneousMatrix(0.06, 0.04, 0.45, 0.2, -0.3, 0.4));
  vpVisualServoSpec spec;
  spec.period = 0.001;
  vpServoControllerSpec law;
  law.gains.lambda = 2.;
  vpVisualServo servo(vpServoController::create("ff-lookat-pi+cbf", law), spec, &model);
  World world;
  vpVisualServo *const eyes = &servo;
  double capture = 0.; // of the vision thread
  servo.setVision(vpServoVision::poses(
      [eyes, &fMo, &capture](const vpImage<unsigned char> &, vpHomogeneousMatrix &cMo, vpPoseCovariance &) {
        vpRigidTransform camera; // as an image shows it: the pose at the time of capture
        const bool isKnown = eyes->cameraAt(capture, camera);
        cMo = (camera.inverse() * fMo).toHomogeneous();
        return isKnown;
      },
      plate));
  servo.setGoal(plate.goal(cdMo));
  servo.start();
  std::thread vision([&]() {
    vpImage<unsigned char> image(48, 64);
    for (unsigned char number = 0; world.isRunning; ++number) {
      image = vpImage<unsigned char>(48, 64, number); // a new one
      capture = world.now;
      servo.see(image, capture);
      servo.setGoal(plate.goal(cdMo)); // the goal may change at any time
      static_cast<void>(servo.timing().step.quantile(0.99));
    }
  });
  vpJointVector q = model.home();
  unsigned long allocations = 0, taken = 0;
  const auto begin = std::chrono::steady_clock::now();
  const int seconds = vpTestSupport::longer(5);
  // Longer where other work starves the vision thread; NaN: no image in time.
  for (int i = 1; i <= 1000 * seconds || (i < 60000 && !(servo.output().positionError < 0.02)); ++i) {
    std::this_thread::sleep_until(begin + i * std::chrono::milliseconds(1));
    const unsigned long before = vpTestSupport::allocationCount(), lockedBefore = locks;
    const vpVisualServoOutput &out = servo.step(q, 0.001 * i);
    allocations += vpTestSupport::allocationCount() - before;
    taken += locks - lockedBefore;
    q += spec.period * out.velocity;
    world.now = 0.001 * i;
  }
  world.isRunning = false;
  vision.join();
  CHECK(taken == 0);
  CHECK((allocations == 0 || !vpTestSupport::canCountAllocations()));
  INFO(servo.output().message << ", " << servo.output().positionError << " m");
  CHECK(servo.output().positionError < 0.02);
  requireWorkDone(servo);
  WARN("step: p50 " << 1e6 * servo.timing().step.quantile(0.5) << " us, p99 "
                    << 1e6 * servo.timing().step.quantile(0.99) << " us, max " << 1e6 * servo.timing().step.max()
                    << " us; images " << servo.timing().image.count());
}

TEST_CASE("Threads that start, stop, step and see at random never race", "[servoing]")
{
  vpVisualServoSpec spec;
  spec.period = 0.001;
  spec.objectMoves = true;
  spec.startTime = 0.01;
  vpVisualServo servo(vpServoController::create("ff-lookat"), spec);
  const vpServoTarget plate = vpServoTarget::rectangle(0.1, 0.1);
  servo.setGoal(plate.goal(vpHomogeneousMatrix(0., 0., 0.4, 0., 0., 0.)));
  World world;
  std::mt19937_64 rng = vpTestSupport::generator(0), rngOfVision = vpTestSupport::generator(1),
                  rngOfUser = vpTestSupport::generator(2);
  std::thread vision([&, rng = rngOfVision]() mutable {
    vpServoSight sight;
    while (world.isRunning) {
      const double time = world.now + vpTestSupport::uniform(rng, -0.01, 0.002);
      plate.measure(vpHomogeneousMatrix(vpTestSupport::uniform(rng, -0.1, 0.1), 0., 0.5, 0., 0., 0.), time,
                    sight.measurement);
      sight.measurement.valid = rng() % 4 > 0;
      sight.hasGoal = rng() % 4 == 0;
      sight.goal = plate.goal(vpHomogeneousMatrix(0., 0., 0.4, 0., 0., 0.));
      servo.see(sight);
    }
  });
  std::thread user([&, rng = rngOfUser]() mutable {
    while (world.isRunning) {
      rng() % 2 == 0 ? servo.start() : servo.stop();
      std::this_thread::sleep_for(std::chrono::microseconds(rng() % 1000));
    }
  });
  vpServoRobotState state;
  unsigned int moves = 0;
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  // The steps do not wait for a clock: longer where other work starves the two threads, and nothing moved yet.
  for (int i = 1; i < vpTestSupport::longer(20000) || (moves == 0 && std::chrono::steady_clock::now() < deadline);
       ++i) {
    state.valid = rng() % 100 > 0;
    const vpTwist twist = servo.step(state, 0.001 * i).twist;
    state.pose = state.pose * vpRigidMotion::exp(twist.scaled(0.001));
    world.now = 0.001 * i;
    moves += twist.linearNorm() > 0.;
    REQUIRE(twist.linearNorm() <= 0.25 * (1. + 1e-9));
  }
  world.isRunning = false;
  vision.join();
  user.join();
  CHECK(moves > 0);
}

TEST_CASE("Quantiles of durations are right to the width of a bin", "[servoing]")
{
  for (int i = 0; i < vpTestSupport::longer(20); ++i) {
    std::mt19937_64 rng = vpTestSupport::generator(static_cast<unsigned int>(i));
    vpTimingStatistics statistics;
    std::vector<double> durations;
    for (int k = 0; k < 1000; ++k) {
      durations.push_back(std::pow(10., vpTestSupport::uniform(rng, -6.9, 2.9)));
      statistics.add(durations.back());
    }
    std::sort(durations.begin(), durations.end());
    for (const double share : {0.001, 0.25, 0.5, 0.9, 0.99, 1.}) {
      const double exact = durations[static_cast<std::size_t>(std::ceil(share * 1000.)) - 1];
      CHECK(statistics.quantile(share) >= exact * (1. - 1e-12));
      CHECK(statistics.quantile(share) <= exact * 1.048);
    }
    CHECK(statistics.max() == durations.back());
    CHECK(statistics.count() == 1000);
  }
  vpTimingStatistics wild;
  CHECK(std::isnan(wild.quantile(0.5)));
  for (const double value : {double(NAN), -1., 0., 1e300, double(INFINITY)}) {
    wild.add(value);
  }
  CHECK(wild.invalid() == 2);
  CHECK(wild.count() == 3);
  CHECK(std::isinf(wild.max()));
  CHECK(wild.quantile(0.) <= 1.1e-7);
}

TEST_CASE("What the operating system allowed is as told", "[servoing]")
{
  CHECK_THROWS_WITH(vpRequestRealTime(0), "priority of the real-time thread is 0, must be 1..99");
  CHECK_THROWS_WITH(vpRequestRealTime(100), "priority of the real-time thread is 100, must be 1..99");
#if defined(__linux__)
  std::thread control([]() {
    const vpRealTimeGrant grant = vpRequestRealTime(2);
    int policy = 0;
    sched_param parameters{};
    REQUIRE(pthread_getschedparam(pthread_self(), &policy, &parameters) == 0);
    CAPTURE(grant.message);
    CHECK((policy == SCHED_FIFO) == grant.isScheduled);
    CHECK((parameters.sched_priority == 2) == grant.isScheduled);
    CHECK((grant.message.find("SCHED_FIFO with priority 2") == 0) == grant.isScheduled);
    CHECK((grant.message.find("memory locked") != std::string::npos) == grant.isLocked);
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);) {
      if (line.compare(0, 6, "VmLck:") == 0 && vpTestSupport::canCountAllocations()) { // sanitizers lock nothing
        CHECK((line.find(" 0 kB") == std::string::npos) == grant.isLocked);
      }
    }
  });
  control.join();
#endif
}
