/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// A whole control cycle with whole-arm avoidance: kinematics, redundancy with two indices and limits, and the
// supervisor among ten obstacles and among a thousand; and without it. Every cycle is timed individually.
#include "vpBenchmark.h"

#include <visp3/avoidance/vpStopSupervisor.h>
#include <visp3/direct_core/vpQuantile.h>
#include <visp3/manipulator/vpArmJson.h>
#include <visp3/manipulator/vpRedundancySolver.h>

#include <algorithm>
#include <ctime>
#include <random>

VISP_DIRECT_USING_NAMESPACE

namespace
{
//! CPU time of this thread, us: independent of other load.
double now()
{
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e6 * static_cast<double>(t.tv_sec) + 1e-3 * static_cast<double>(t.tv_nsec);
}

const vpArmModel &amor()
{
  static const vpArmModel arm = vpLoadArmJson(std::string(VISP_DIRECT_DATA_DIR) + "/robot/amor.json");
  return arm;
}

//! Ten large obstacles, or many small ones that are initially not in the way of the arm.
vpCollisionSceneSpec obstacles(double speed, int count)
{
  std::mt19937_64 rng(7);
  std::uniform_real_distribution<double> unit(-1., 1.);
  vpCollisionSceneSpec spec;
  const double scale = count > 10 ? 0.2 : 1.;
  while (static_cast<int>(spec.objects.size()) < count) {
    vpCollisionObject object;
    object.name = "object " + std::to_string(spec.objects.size());
    object.shape = spec.objects.size() % 2 == 0 ? vpCollisionShape::sphere(scale * 0.08)
                                                : vpCollisionShape::box(scale * Eigen::Vector3d(0.2, 0.1, 0.1));
    object.pose.p = Eigen::Vector3d(unit(rng), unit(rng), unit(rng)).normalized() * (0.8 + 0.3 * unit(rng));
    object.velocity = vpTwist(speed * unit(rng), speed * unit(rng), speed * unit(rng), 0., 0., 0.);
    vpCollisionScene alone(amor());
    alone.add(object);
    vpCollisionData data;
    alone.place(amor().home(), data);
    if (count <= 10 || alone.clearance(data, 0.05).kind != vpCollisionKind::Object) {
      spec.objects.push_back(object);
    }
  }
  return spec;
}

void cycle(benchmark::State &state, double speed, bool supervised, int count = 10)
{
  const vpCollisionScene start(amor(), obstacles(speed, count));
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
    const double begin = now();
    vpArmKinematics::update(amor(), q, data);
    input.previous = answer.velocity;
    solver.step(data, input, output);
    if (supervised) {
      supervisor.step(q, output.velocity, answer);
    }
    else {
      answer.velocity = output.velocity;
    }
    times.push_back(now() - begin);
    q += 0.005 * answer.velocity;
    scene.advance(speed > 0. ? 0.005 : 0.);
  }
  state.counters["us_p50"] = vpQuantileInPlace(times.data(), times.data() + times.size(), 0.5);
  state.counters["us_p99"] = vpQuantileInPlace(times.data(), times.data() + times.size(), 0.99);
  state.counters["us_most"] = *std::max_element(times.begin(), times.end());
  state.counters["us_p99_9"] = vpQuantileInPlace(times.data(), times.data() + times.size(), 0.999);
}
} // namespace

BENCHMARK_CAPTURE(cycle, without_avoidance, 0., false)->Iterations(20000);
BENCHMARK_CAPTURE(cycle, supervised_static, 0., true)->Iterations(20000);
BENCHMARK_CAPTURE(cycle, supervised_moving, 0.2, true)->Iterations(20000);
BENCHMARK_CAPTURE(cycle, supervised_among_1000, 0., true, 1000)->Iterations(4000);

VP_BENCHMARK_MAIN();
