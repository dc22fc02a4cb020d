/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// A whole control cycle with whole-arm avoidance: kinematics, redundancy with two indices and limits, and the supervisor
// among ten obstacles; and the parts. Every cycle is timed on its own for the quantiles.
#include "vpBenchmark.h"

#include <visp3/avoidance/vpStopSupervisor.h>
#include <visp3/manipulator/vpArmJson.h>
#include <visp3/manipulator/vpRedundancySolver.h>

#include <algorithm>
#include <chrono>
#include <random>

VISP_DIRECT_USING_NAMESPACE

namespace
{
using Clock = std::chrono::steady_clock;

const vpArmModel &amor()
{
  static const vpArmModel arm = vpLoadArmJson(std::string(VISP_DIRECT_DATA_DIR) + "/robot/amor.json");
  return arm;
}

vpCollisionSceneSpec obstacles(double speed)
{
  std::mt19937_64 rng(7);
  std::uniform_real_distribution<double> unit(-1., 1.);
  vpCollisionSceneSpec spec;
  for (int k = 0; k < 10; ++k) {
    vpCollisionObject object;
    object.name = "object " + std::to_string(k);
    object.shape = k % 2 == 0 ? vpCollisionShape::sphere(0.08) : vpCollisionShape::box({0.2, 0.1, 0.1});
    object.pose.p = Eigen::Vector3d(unit(rng), unit(rng), unit(rng)).normalized() * (0.8 + 0.3 * unit(rng));
    object.velocity = vpTwist(speed * unit(rng), speed * unit(rng), speed * unit(rng), 0., 0., 0.);
    spec.objects.push_back(object);
  }
  return spec;
}

void cycle(benchmark::State &state, double speed, bool supervised)
{
  const vpCollisionScene start(amor(), obstacles(speed));
  vpCollisionScene scene = start;
  vpStopSupervisor supervisor(scene);
  const vpRedundancySolver solver(amor());
  vpArmData data;
  vpRedundancyInput input;
  vpRedundancyOutput output;
  vpSupervisedVelocity answer;
  input.indices[0] = vpSelfMotionIndex::jointLimits();
  input.indices[1] = vpSelfMotionIndex::manipulability();
  input.indexCount = 2;
  std::mt19937_64 rng(8);
  std::uniform_real_distribution<double> unit(-1., 1.);
  vpJointVector q = amor().home();
  answer.velocity = vpJointVector::Zero(7);
  std::vector<double> times;
  int k = 0;
  for (auto step : state) {
    static_cast<void>(step);
    if (k++ % 200 == 0) {
      input.twist = vpTwist(0.4 * unit(rng), 0.4 * unit(rng), 0.4 * unit(rng), unit(rng), unit(rng), unit(rng));
      if (k % 4000 == 1) {
        scene = start;
        q = amor().home();
        answer.velocity.setZero();
        supervisor.reset();
      }
    }
    const auto begin = Clock::now();
    vpArmKinematics::update(amor(), q, data);
    input.previous = answer.velocity;
    solver.step(data, input, output);
    if (supervised) {
      supervisor.step(q, output.velocity, answer);
    }
    else {
      answer.velocity = output.velocity;
    }
    times.push_back(1e6 * std::chrono::duration<double>(Clock::now() - begin).count());
    q += 0.005 * answer.velocity;
    scene.advance(speed > 0. ? 0.005 : 0.);
  }
  std::sort(times.begin(), times.end());
  state.counters["us_p50"] = times[times.size() / 2];
  state.counters["us_p99"] = times[times.size() * 99 / 100];
}
} // namespace

BENCHMARK_CAPTURE(cycle, without_avoidance, 0., false)->Iterations(20000);
BENCHMARK_CAPTURE(cycle, supervised_static, 0., true)->Iterations(20000);
BENCHMARK_CAPTURE(cycle, supervised_moving, 0.2, true)->Iterations(20000);

VP_BENCHMARK_MAIN();
