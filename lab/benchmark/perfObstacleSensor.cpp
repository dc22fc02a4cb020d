/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// One frame of 640x480 px with three photographs on boxes and five other obstacles: rendering and detection.
#include "vpBenchmark.h"

#include <visp3/io/vpImageIo.h>
#include <visp3/manipulator/vpArmJson.h>
#include "lab/avoidance/vpCameraObstacleSensors.h"

#include <string>
#include <vector>

VISP_DIRECT_USING_NAMESPACE

namespace
{
using Eigen::Vector3d;

const vpArmModel &amor()
{
  static const vpArmModel model = vpLoadArmJson(std::string(VISP_DIRECT_DATA_DIR) + "/robot/amor.json");
  return model;
}

vpScenePhoto photo(const std::string &name, const std::string &file, double width, double height)
{
  vpScenePhoto result;
  result.object = name;
  result.size = {width, height};
  vpImageIo::read(result.image, std::string(VISP_DIRECT_DATA_DIR) + "/target/" + file);
  return result;
}

struct Bench {
  vpSceneCameraSpec spec;
  vpCollisionSceneSpec objects;
  vpCollisionData arm;
  vpRigidTransform fMc;

  Bench()
  {
    spec.photos = {photo("klimt", "klimt.jpg", 0.16, 0.16), photo("starry-night", "starry-night.jpg", 0.2, 0.16),
                   photo("box", "box.png", 0.16, 0.11)};
    vpJointVector q(7);
    q << .246, .868, -1.237, -2.390, -2.591, -1.099, .324;
    const vpCollisionScene empty(amor());
    empty.place(q, arm);
    fMc = vpArmKinematics::camera(amor(), arm.arm);
    const double x[3] = {-0.14, 0.14, -0.05}, y[3] = {-0.08, -0.09, 0.12};
    for (std::size_t i = 0; i < 3; ++i) {
      const Eigen::Vector2d size = spec.photos[i].size;
      add(spec.photos[i].object, vpCollisionShape::box({size.x(), size.y(), 0.05}), {x[i], y[i], 0.6});
    }
    add("ball", vpCollisionShape::sphere(0.1), {0.3, 0.2, 0.9});
    add("pillar", vpCollisionShape::cylinder(0.05, 1.), {-0.4, 0., 1.});
    add("bar", vpCollisionShape::capsule(0.03, 0.5), {0.2, -0.3, 0.8});
    add("wall", vpCollisionShape::box({2., 2., 0.05}), {0., 0., 1.4});
    add("block", vpCollisionShape::box({0.2, 0.3, 0.2}), {0.4, 0., 1.1});
  }
  void add(const std::string &name, const vpCollisionShape &shape, const Vector3d &place)
  {
    vpCollisionObject object;
    object.name = name;
    object.shape = shape;
    object.pose = fMc * vpRigidTransform{Eigen::Matrix3d::Identity(), place};
    objects.objects.push_back(object);
  }
  [[nodiscard]] vpObstacleDetector detector() const
  {
    vpPlanarTargetDatabase targets(spec.camera, vpObstacleDetector::fastTargets());
    for (const vpScenePhoto &p : spec.photos) {
      targets.add(p.object, p.image, p.size.x(), p.size.y(), 0.05);
    }
    return vpObstacleDetector(std::move(targets), spec.camera);
  }
};

const vpCameraFaults faults = [] {
  vpCameraFaults result;
  result.noise = 2.;
  result.blur = 0.5;
  return result;
}();
} // namespace

static void drawPicture(benchmark::State &state)
{
  const Bench bench;
  const vpCollisionScene scene(amor(), bench.objects);
  vpSceneCamera camera(bench.spec);
  vpImage<unsigned char> picture;
  unsigned int seed = 0;
  for (auto _ : state) {
    camera.picture(scene, bench.fMc, state.range(0) != 0 ? faults : vpCameraFaults(), ++seed, picture);
  }
}
BENCHMARK(drawPicture)->ArgName("faults")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

static void drawDepth(benchmark::State &state)
{
  const Bench bench;
  const vpCollisionScene scene(amor(), bench.objects);
  vpSceneCamera camera(bench.spec);
  vpDepthFaults noisy;
  noisy.noise = 0.002;
  vpImage<float> depth;
  unsigned int seed = 0;
  for (auto _ : state) {
    camera.depth(scene, bench.fMc, noisy, ++seed, depth);
  }
}
BENCHMARK(drawDepth)->Unit(benchmark::kMillisecond);

//! Detection alone: while tracking, or with all targets newly detected.
static void detect(benchmark::State &state)
{
  const Bench bench;
  const vpCollisionScene scene(amor(), bench.objects);
  vpSceneCamera camera(bench.spec);
  vpImage<unsigned char> picture;
  camera.picture(scene, bench.fMc, faults, 1, picture);
  vpObstacleDetector detector = bench.detector();
  int seen = 0, frames = 0;
  for (auto _ : state) {
    if (state.range(0) != 0) {
      detector.reset();
    }
    for (const vpObstacleDetection &detection : detector.process(picture, bench.fMc, 0.)) {
      seen += detection.seen ? 1 : 0;
    }
    ++frames;
  }
  state.counters["seen"] = static_cast<double>(seen) / frames;
}
BENCHMARK(detect)->ArgName("fresh")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

//! Rendering and detection: from the true scene to sightings.
static void look(benchmark::State &state)
{
  const Bench bench;
  vpCollisionScene scene(amor(), bench.objects);
  vpImageObstacleSensorSpec spec;
  spec.faults = faults;
  vpImageObstacleSensor sensor(vpSceneCamera(bench.spec), bench.detector(), spec);
  std::vector<vpObjectSighting> sightings;
  std::size_t seen = 0, frames = 0;
  for (auto _ : state) {
    // One of them moves at 0.15 m/s, back and forth by 0.1 m.
    const Vector3d step = (frames / 20 % 2 == 0 ? 0.005 : -0.005) * bench.fMc.R.col(0);
    static_cast<void>(scene.moveObject(0, {scene.object(0).pose.R, scene.object(0).pose.p + step}));
    sensor.look(scene, bench.arm, static_cast<double>(frames) / 30., sightings);
    seen += sightings.size();
    ++frames;
  }
  state.counters["seen"] = static_cast<double>(seen) / static_cast<double>(frames);
}
BENCHMARK(look)->Unit(benchmark::kMillisecond);

static void lookDepth(benchmark::State &state)
{
  const Bench bench;
  const vpCollisionScene scene(amor(), bench.objects);
  vpDepthObstacleSensorSpec spec;
  spec.map.stride = static_cast<int>(state.range(0));
  vpDepthObstacleSensor sensor(vpSceneCamera(bench.spec), spec);
  std::vector<vpObjectSighting> sightings;
  double time = 0.;
  for (auto _ : state) {
    sensor.look(scene, bench.arm, time += 0.1, sightings);
  }
  state.counters["cubes"] = static_cast<double>(sightings[0].shape.octree().cells().size());
}
BENCHMARK(lookDepth)->ArgName("stride")->Arg(2)->Arg(4)->Arg(8)->Unit(benchmark::kMillisecond);

VP_BENCHMARK_MAIN();
