/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Time of distances and motion checks, compared with FCL on the same pairs and motions.
#include "vpBenchmark.h"

#include <visp3/avoidance/vpCertifiedMotion.h>
#include <visp3/avoidance/vpCollisionSceneJson.h>
#include <visp3/avoidance/vpDiscreteMotion.h>
#include <visp3/avoidance/vpFclChecker.h>
#include <visp3/direct_core/vpQuantile.h>
#include <visp3/direct_core/vpSO3.h>
#include <visp3/manipulator/vpArmJson.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <vector>

VISP_DIRECT_USING_NAMESPACE

namespace
{
std::string dataFile(const std::string &name) { return std::string(VISP_DIRECT_DATA_DIR) + "/" + name; }

// AMOR with seven capsules, one per link, so that 10 of the pairs of capsules are not adjacent.
const vpArmModel &arm()
{
  static const vpArmModel model = [] {
    vpArmSpec spec = vpLoadArmJson(dataFile("robot/amor.json")).spec();
    spec.capsules = {{1, {0., 0., 0.}, {-0.0623, 0.155, 0.}, 0.07},   {2, {0., 0., -0.02}, {0., 0., 0.02}, 0.05},
                     {3, {0., 0., 0.}, {-0.097, -0.41946, 0.}, 0.06}, {4, {0., 0., -0.02}, {0., 0., 0.02}, 0.05},
                     {5, {0., 0., 0.}, {-0.0502, -0.3582, 0.}, 0.05}, {6, {0., 0., -0.02}, {0., 0., 0.02}, 0.045},
                     {7, {0., 0., -0.07}, {0., 0., 0.1}, 0.045}};
    return vpArmModel(spec);
  }();
  return model;
}

// The same arm with 30 thinner capsules about the seven, as a cover of its links by several has them.
const vpArmModel &coveredArm()
{
  static const vpArmModel model = [] {
    std::mt19937_64 rng(11);
    std::uniform_real_distribution<double> u(-1., 1.);
    vpArmSpec spec = arm().spec();
    spec.capsules.clear();
    for (int k = 0; k < 30; ++k) {
      vpArmCapsule capsule = arm().spec().capsules[static_cast<std::size_t>(k % 7)];
      const Eigen::Vector3d along = capsule.to - capsule.from, shift(u(rng), u(rng), u(rng));
      const double begin = 0.3 * (k / 7 % 3), end = begin + 0.4;
      capsule.to = capsule.from + end * along + 0.3 * capsule.radius * shift;
      capsule.from = capsule.from + begin * along + 0.3 * capsule.radius * shift;
      capsule.radius *= 0.9;
      spec.capsules.push_back(capsule);
    }
    return vpArmModel(spec);
  }();
  return model;
}

// Spheres, capsules, boxes and cylinders around the arm, smaller if they are many; of the pairs of links ten are checked.
vpCollisionScene makeScene(const vpArmModel &model, int objects)
{
  const double size = std::min(1., std::sqrt(20. / objects)); // the same share of the view
  std::mt19937_64 rng(3);
  std::uniform_real_distribution<double> u(-1., 1.);
  vpCollisionSceneSpec spec;
  for (int j = 0; j < objects; ++j) {
    vpCollisionObject object;
    object.name = "o" + std::to_string(j);
    object.shape = j % 4 == 0   ? vpCollisionShape::sphere(size * 0.08)
                   : j % 4 == 1 ? vpCollisionShape::capsule(size * 0.05, size * 0.3)
                   : j % 4 == 2 ? vpCollisionShape::box({size * 0.2, size * 0.1, size * 0.3})
                                : vpCollisionShape::cylinder(size * 0.06, size * 0.25);
    Eigen::Vector3d p(u(rng), u(rng), u(rng));
    object.pose.p = (0.7 + 0.3 * u(rng)) * p.normalized();
    object.pose.R = vpSO3::exp(3. * Eigen::Vector3d(u(rng), u(rng), u(rng)));
    spec.objects.push_back(object);
  }
  // 15 pairs are not adjacent; leave five out.
  spec.allowedLinks = {{1, 3}, {2, 4}, {3, 5}, {4, 6}, {5, 7}};
  return vpCollisionScene(model, spec);
}

// Ten objects: 70 pairs, and 10 of 21 pairs of capsules.
const vpCollisionScene &scene()
{
  static const vpCollisionScene made = makeScene(arm(), 10);
  return made;
}

// 30 capsules and 20 objects: 600 pairs.
const vpCollisionScene &coveredScene()
{
  static const vpCollisionScene made = makeScene(coveredArm(), 20);
  return made;
}

const std::vector<vpJointVector> &configurations()
{
  static const std::vector<vpJointVector> all = [] {
    std::mt19937_64 rng(5);
    std::uniform_real_distribution<double> share(0., 1.);
    std::vector<vpJointVector> list(1024, vpJointVector(7));
    for (vpJointVector &q : list) {
      for (int i = 0; i < 7; ++i) {
        const double lower = arm().isContinuous(i) ? -3. : arm().lower()(i),
                     upper = arm().isContinuous(i) ? 3. : arm().upper()(i);
        q(i) = lower + share(rng) * (upper - lower);
      }
    }
    return list;
  }();
  return all;
}

// A third of the way between two random configurations; free ones or any.
struct Motion {
  vpJointVector from, to;
};
std::vector<Motion> makeMotions(const vpCollisionScene &among, bool free)
{
  std::vector<Motion> list;
  const vpCertifiedMotion certified(among);
  vpMotionScratch scratch;
  for (std::size_t k = 0; list.size() < 256 && k + 1 < 16384; ++k) {
    const vpJointVector from = configurations()[k % 1024], to = configurations()[(k * 7 + 1) % 1024];
    const Motion m{from, from + (to - from) / (3. + static_cast<double>(k / 1024))};
    if (!free || certified.check(m.from, m.to, scratch).isFree()) {
      list.push_back(m);
    }
  }
  return list;
}
const std::vector<Motion> &motions(bool onlyFree)
{
  static const std::vector<Motion> all = makeMotions(scene(), false), free = makeMotions(scene(), true);
  return onlyFree ? free : all;
}

// The least distance of each link and object and of two links, with nearest points: here all of the 80.
void allPairsOwn(benchmark::State &state)
{
  vpCollisionData data;
  vpNearPairs near;
  std::size_t k = 0;
  for (auto _ : state) {
    scene().place(configurations()[k++ % 1024], data);
    scene().near(data, 1e9, near);
    benchmark::DoNotOptimize(near.pairs.data());
  }
  state.counters["pairs"] = near.count;
}
BENCHMARK(allPairsOwn);

// As in a control cycle: pairs nearer than 0.35 m.
void nearPairsOwn(benchmark::State &state)
{
  vpCollisionData data;
  vpNearPairs near;
  std::size_t k = 0;
  for (auto _ : state) {
    scene().place(configurations()[k++ % 1024], data);
    scene().near(data, 0.35, near);
    benchmark::DoNotOptimize(near.pairs.data());
  }
}
BENCHMARK(nearPairsOwn);

void nearPairsOf30Capsules(benchmark::State &state)
{
  vpCollisionData data;
  vpNearPairs near;
  std::size_t k = 0, dropped = 0, pairs = 0;
  std::vector<double> times; // us
  for (auto _ : state) {
    const auto begin = std::chrono::steady_clock::now();
    coveredScene().place(configurations()[k++ % 1024], data);
    coveredScene().near(data, 0.35, near);
    times.push_back(1e6 * std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    dropped += near.dropped ? 1 : 0;
    pairs += static_cast<std::size_t>(near.count);
    benchmark::DoNotOptimize(near.pairs.data());
  }
  state.counters["us_p50"] = vpQuantile(times, 0.5);
  state.counters["us_p99"] = vpQuantile(times, 0.99);
  state.counters["dropped_%"] = 100. * static_cast<double>(dropped) / static_cast<double>(k);
  state.counters["pairs"] = static_cast<double>(pairs) / static_cast<double>(k);
}
BENCHMARK(nearPairsOf30Capsules);

void reachBounds(benchmark::State &state)
{
  for (auto _ : state) {
    benchmark::DoNotOptimize(vpReachBounds(coveredArm()).holds(configurations()[0]));
  }
}
BENCHMARK(reachBounds);

// Of an arm whose reach bounds are known: a scene for each task of a planner.
void setUpOfScene(benchmark::State &state)
{
  static_cast<void>(coveredScene().reach());
  for (auto _ : state) {
    benchmark::DoNotOptimize(makeScene(coveredScene().arm(), 20).reach());
  }
}
BENCHMARK(setUpOfScene);

// With reach bounds that the scene has already.
void setUpOfCertifiedMotion(benchmark::State &state)
{
  for (auto _ : state) {
    vpMotionScratch scratch;
    benchmark::DoNotOptimize(
        vpCertifiedMotion(coveredScene()).check(configurations()[0], configurations()[0], scratch).evaluated);
  }
}
BENCHMARK(setUpOfCertifiedMotion);

// 100,000 cubes of 1 cm on a ball, a floor and a wall, as a depth camera sees surfaces, in no order.
const std::vector<vpOctreeCell> &cubes()
{
  static const std::vector<vpOctreeCell> all = [] {
    constexpr std::size_t count = 100000;
    constexpr double size = 0.01;
    std::mt19937_64 rng(13);
    std::uniform_real_distribution<double> u(-1., 1.);
    std::set<std::array<long, 3>> places;
    std::vector<vpOctreeCell> cells;
    while (cells.size() < count) {
      const Eigen::Vector3d d(u(rng), u(rng), u(rng));
      const Eigen::Vector3d p = cells.size() % 3 == 0   ? Eigen::Vector3d(0.9 * d.normalized())
                                : cells.size() % 3 == 1 ? Eigen::Vector3d(2. * d.x(), 2. * d.y(), -0.5)
                                                        : Eigen::Vector3d(1.2, 1.5 * d.y(), 1.5 * d.z());
      const Eigen::Vector3d corner = (p / size).array().floor();
      if (places.insert({std::lround(corner.x()), std::lround(corner.y()), std::lround(corner.z())}).second) {
        cells.push_back({size * (corner + Eigen::Vector3d::Constant(0.5)), size});
      }
    }
    return cells;
  }();
  return all;
}

void octreeFromCubes(benchmark::State &state)
{
  for (auto _ : state) {
    benchmark::DoNotOptimize(vpOctree(cubes()).cells().data());
  }
}
BENCHMARK(octreeFromCubes)->Unit(benchmark::kMillisecond);

void clearanceFromCubes(benchmark::State &state)
{
  vpCollisionObject map;
  map.name = "map";
  map.shape = vpCollisionShape::octree(vpOctree(cubes()));
  vpCollisionScene mapped(arm());
  mapped.add(map);
  vpSceneChecker checker(mapped);
  std::size_t k = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(checker.clearance(configurations()[k++ % 1024], 1e9).distance);
  }
}
BENCHMARK(clearanceFromCubes);

template <class Checker> void leastClearance(benchmark::State &state)
{
  Checker checker(scene());
  std::size_t k = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(checker.clearance(configurations()[k++ % 1024], 1e9).distance);
  }
}
void leastClearanceOwn(benchmark::State &state) { leastClearance<vpSceneChecker>(state); }
void leastClearanceFcl(benchmark::State &state) { leastClearance<vpFclChecker>(state); }
BENCHMARK(leastClearanceOwn);
BENCHMARK(leastClearanceFcl);

template <class Checker> void inCollision(benchmark::State &state)
{
  Checker checker(scene());
  std::size_t k = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(checker.inCollision(configurations()[k++ % 1024], 0.));
  }
}
void inCollisionOwn(benchmark::State &state) { inCollision<vpSceneChecker>(state); }
void inCollisionFcl(benchmark::State &state) { inCollision<vpFclChecker>(state); }
BENCHMARK(inCollisionOwn);
BENCHMARK(inCollisionFcl);

void motionCertified(benchmark::State &state, bool free)
{
  const vpCertifiedMotion certified(scene());
  vpMotionScratch scratch;
  const std::vector<Motion> &list = motions(free);
  std::size_t k = 0;
  double evaluated = 0.;
  for (auto _ : state) {
    const Motion &m = list[k++ % list.size()];
    evaluated += certified.check(m.from, m.to, scratch).evaluated;
  }
  state.counters["configurations"] = evaluated / static_cast<double>(state.iterations());
}
BENCHMARK_CAPTURE(motionCertified, free, true);
BENCHMARK_CAPTURE(motionCertified, any, false);

void motionOf30Capsules(benchmark::State &state)
{
  const vpCertifiedMotion certified(coveredScene());
  vpMotionScratch scratch;
  static const std::vector<Motion> list = makeMotions(coveredScene(), true);
  std::size_t k = 0;
  for (auto _ : state) {
    const Motion &m = list[k++ % list.size()];
    benchmark::DoNotOptimize(certified.check(m.from, m.to, scratch).evaluated);
  }
}
BENCHMARK(motionOf30Capsules);

// The same among 10, 100 and 1000 obstacles.
const vpCollisionScene &among(int objects)
{
  static std::map<int, std::unique_ptr<vpCollisionScene>> made;
  auto &scene = made[objects];
  if (!scene) {
    scene = std::make_unique<vpCollisionScene>(makeScene(arm(), objects));
  }
  return *scene;
}
const std::vector<Motion> &motionsAmong(int objects, bool free)
{
  static std::map<std::pair<int, bool>, std::vector<Motion>> made;
  std::vector<Motion> &list = made[{objects, free}];
  if (list.empty()) {
    list = makeMotions(among(objects), free);
    const vpCertifiedMotion certified(among(objects));
    vpMotionScratch scratch;
    list.erase(std::remove_if(list.begin(), list.end(),
                              [&](const Motion &m) { return certified.check(m.from, m.to, scratch).isFree() != free; }),
               list.end());
  }
  return list;
}
void motionAmong(benchmark::State &state, bool free)
{
  const int objects = static_cast<int>(state.range(0));
  const vpCertifiedMotion certified(among(objects));
  vpMotionScratch scratch;
  const std::vector<Motion> &list = motionsAmong(objects, free);
  std::size_t k = 0;
  for (auto _ : state) {
    const Motion &m = list[k++ % list.size()];
    benchmark::DoNotOptimize(certified.check(m.from, m.to, scratch).evaluated);
  }
  state.counters["motions"] = static_cast<double>(list.size());
}
BENCHMARK_CAPTURE(motionAmong, free, true)->Arg(10)->Arg(100)->Arg(1000);
BENCHMARK_CAPTURE(motionAmong, colliding, false)->Arg(10)->Arg(100)->Arg(1000);

template <class Checker> void collisionAmong(benchmark::State &state)
{
  Checker checker(among(static_cast<int>(state.range(0))));
  std::size_t k = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(checker.inCollision(configurations()[k++ % 1024], 0.));
  }
}
BENCHMARK_TEMPLATE(collisionAmong, vpSceneChecker)->Arg(10)->Arg(100)->Arg(1000);
BENCHMARK_TEMPLATE(collisionAmong, vpFclChecker)->Arg(10)->Arg(100)->Arg(1000);

template <class Checker> void motionDiscrete(benchmark::State &state, bool free)
{
  Checker checker(scene());
  vpDiscreteMotion discrete(checker, 0.05);
  const std::vector<Motion> &list = motions(free);
  std::size_t k = 0;
  double evaluated = 0.;
  for (auto _ : state) {
    const Motion &m = list[k++ % list.size()];
    evaluated += discrete.check(m.from, m.to).evaluated;
  }
  state.counters["configurations"] = evaluated / static_cast<double>(state.iterations());
}
void motionDiscreteOwn(benchmark::State &state, bool free) { motionDiscrete<vpSceneChecker>(state, free); }
void motionDiscreteFcl(benchmark::State &state, bool free) { motionDiscrete<vpFclChecker>(state, free); }
BENCHMARK_CAPTURE(motionDiscreteOwn, free, true);
BENCHMARK_CAPTURE(motionDiscreteOwn, any, false);
BENCHMARK_CAPTURE(motionDiscreteFcl, free, true);
BENCHMARK_CAPTURE(motionDiscreteFcl, any, false);
} // namespace

VP_BENCHMARK_MAIN();
