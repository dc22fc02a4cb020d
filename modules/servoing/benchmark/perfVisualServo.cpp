/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Time of one step of the servo at 1 kHz with images at 33 Hz: camera and arm, with and without supervisor; p50, p99 and the
// longest of the servo's own histogram, p99_cpu_us of the thread's CPU time, which other programs do not lengthen. Baseline: the law
// alone, with the same measurement.
#include "vpBenchmark.h"

#include "../src/vpRigidMotion.h"

#include <visp3/manipulator/vpArmJson.h>
#include <visp3/servoing/vpVisualServo.h>

#include <algorithm>
#include <ctime>
#include <string>
#include <vector>

VISP_DIRECT_USING_NAMESPACE

namespace
{
const vpServoTarget plate = vpServoTarget::rectangle(0.16, 0.11);
const vpHomogeneousMatrix cdMo(0., 0., 0.35, 0., 0., 0.), cMo(0.06, 0.04, 0.45, 0.2, -0.3, 0.4);

const vpArmModel &amor()
{
  static const vpArmModel model = vpLoadArmJson(VISP_DIRECT_DATA_DIR "/robot/amor.json");
  return model;
}

void lawAlone(benchmark::State &state, const std::string &law)
{
  vpServoController controller = vpServoController::create(law);
  controller.setGoal(plate.goal(cdMo));
  vpServoMeasurement seen;
  plate.measure(cMo, 0., seen);
  for (auto _ : state) {
    benchmark::DoNotOptimize(controller.step(seen, 0.001));
  }
}

double cpuTime() // of this thread, us
{
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e6 * static_cast<double>(time.tv_sec) + 1e-3 * static_cast<double>(time.tv_nsec);
}

// The robot stands and the law always wants to move it: every part has work to do. Another goal every 0.3 s, for laws that plan:
// these look for new plans without end. A camera that moves as commanded (isMoving) finds one for each goal.
void stepOf(benchmark::State &state, const std::string &law, bool hasArm, bool isSupervised, bool isMoving = false)
{
  const vpHomogeneousMatrix otherGoal(0.03, -0.02, 0.4, 0.1, 0.1, -0.2);
  vpVisualServoSpec spec;
  spec.period = 0.001;
  spec.followLength = spec.followAngle = std::numeric_limits<double>::infinity();
  if (hasArm) {
    spec.indices = {vpSelfMotionIndex::jointLimits()};
  }
  vpVisualServo servo(vpServoController::create(law), spec, hasArm ? &amor() : nullptr);
  const vpCollisionScene scene(amor(), {});
  if (isSupervised) {
    servo.supervise(scene);
  }
  servo.setGoal(plate.goal(cdMo));
  servo.start();
  vpServoRobotState robot;
  robot.q = amor().home();
  vpServoSight sight;
  const vpRigidTransform object = vpRigidTransform::fromHomogeneous(cMo); // in the camera's first frame
  double now = 0.;
  unsigned long cycle = 0;
  std::vector<double> times;
  for (auto _ : state) {
    if (cycle++ % 30 == 0) {
      state.PauseTiming();
      plate.measure((robot.pose.inverse() * object).toHomogeneous(), now, sight.measurement);
      servo.see(sight);
      if (cycle % 300 == 1) {
        servo.setGoal(plate.goal(cycle / 300 % 2 == 0 ? cdMo : otherGoal));
      }
      state.ResumeTiming();
    }
    now += spec.period;
    const double begin = cpuTime();
    benchmark::DoNotOptimize(servo.step(robot, now).twist);
    times.push_back(cpuTime() - begin);
    if (isMoving) {
      robot.pose = robot.pose * vpRigidMotion::exp(servo.output().twist.scaled(spec.period));
    }
  }
  const auto place = times.begin() + static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(times.size()));
  std::nth_element(times.begin(), place, times.end());
  state.counters["p99_cpu_us"] = *place;
  state.counters["plans"] = servo.controller().law().plans();
  const vpTimingStatistics &step = servo.timing().step;
  state.counters["p50_us"] = 1e6 * step.quantile(0.5);
  state.counters["p99_us"] = 1e6 * step.quantile(0.99);
  state.counters["max_us"] = 1e6 * step.max();
}

BENCHMARK_CAPTURE(lawAlone, ff_lookat_pi, "ff-lookat-pi");
BENCHMARK_CAPTURE(stepOf, camera, "ff-lookat-pi", false, false);
BENCHMARK_CAPTURE(stepOf, camera_cbf, "ff-lookat-pi+cbf", false, false);
BENCHMARK_CAPTURE(stepOf, camera_plans, "ff-dtg", false, false);
BENCHMARK_CAPTURE(stepOf, camera_plans_moving, "ff-dtg", false, false, true);
BENCHMARK_CAPTURE(stepOf, arm, "ff-lookat-pi", true, false);
BENCHMARK_CAPTURE(stepOf, arm_plans, "ff-dtg", true, false);
BENCHMARK_CAPTURE(stepOf, arm_supervised, "ff-lookat-pi", true, true);
} // namespace

int main(int argc, char **argv) { return vpTestSupport::runBenchmarks(argc, argv); }
