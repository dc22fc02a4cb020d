/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpCatch.h"
#include "vpServoScene.h"

#include <visp3/feedforward/vpServoController.h>
#include <visp3/feedforward/vpViewConstraintFilter.h>

#include <cstdio>
#include <limits>

namespace
{
using namespace vpServoScene;

vpViewConstraintSpec vga()
{
  vpViewConstraintSpec spec;
  spec.left = -halfWidth;
  spec.right = halfWidth;
  spec.top = -halfHeight;
  spec.bottom = halfHeight;
  return spec;
}

// Distance of the outline to the nearest border, normalised; negative when a point is outside.
double clearance(const std::vector<vpServoPoint> &outline)
{
  double least = 1e9;
  for (const vpServoPoint &p : outline) {
    least = std::min({least, halfWidth - std::abs(p.x), halfHeight - std::abs(p.y)});
  }
  return least;
}

struct Task {
  std::vector<Eigen::Vector3d> points;
  vpHomogeneousMatrix cdMo, start;
};

// The object is inside both views, anywhere up to the border; everything else is random.
Task randomTask(std::mt19937_64 &rng)
{
  Task task;
  task.points = object(rng, uniform(rng, 0.05, 0.2), 12);
  std::vector<vpServoPoint> seen;
  for (vpHomogeneousMatrix *cMo : {&task.cdMo, &task.start}) {
    do {
      *cMo = randomPose(rng, 0.3, 1.2, 0.4, 1.4);
      project(*cMo, task.points, seen);
    } while (!inView(seen));
  }
  return task;
}

vpServoCommand wanted(const vpTwist &v) { return {v, vpServoStatus::Servoing}; }

struct Outcome {
  int reached = 0, deadlocks = 0, unfinished = 0, violated = 0;
};

// A share of the tasks with each law, on a perfect free-flying camera at dt = 10 ms.
Outcome runTasks(const std::string &suffix, int count)
{
  const std::vector<std::string> ids = lawsWithoutPlan(); // a bounded twist is not the one that the filter allows
  vpServoControllerSpec spec;
  spec.view = vga();
  spec.recovery.holdTime = 1e3;
  Outcome outcome;
  vpServoMeasurement measurement;
  for (int run = 0; run < count; ++run) {
    auto rng = vpTestSupport::generator(5000 + run);
    const Task task = randomTask(rng);
    auto servo = vpServoController::create(ids[run % ids.size()] + suffix, spec);
    servo.setGoal(goal(task.cdMo, task.points));
    vpHomogeneousMatrix cMo = task.start;
    bool reached = false, violated = false;
    int stuck = 0;
    for (int i = 0; i < 2000 && !reached && stuck < 100; ++i) {
      measure(cMo, task.points, measurement);
      violated = violated || !(clearance(measurement.outline) >= 0.);
      const vpServoCommand command = servo.step(measurement, 0.01);
      stuck = command.status == vpServoStatus::Deadlock || command.status == vpServoStatus::Degenerate ? stuck + 1 : 0;
      cMo = move(cMo, vpLimitTwist(command.v, spec.view.maxLinear, spec.view.maxAngular), 0.01);
      reached = translationError(task.cdMo, cMo) < 2e-3 && rotationError(task.cdMo, cMo) < 4e-3;
    }
    outcome.reached += reached;
    outcome.deadlocks += stuck >= 100;
    outcome.unfinished += !reached && stuck < 100;
    outcome.violated += violated;
  }
  return outcome;
}
} // namespace

TEST_CASE("1000 random tasks: the outline never leaves the view with the filter, often without", "[filter]")
{
  const unsigned int seed = vpTestSupport::seed();
  const Outcome with = runTasks("+cbf", 1000), without = runTasks("", 1000);
  for (const auto &row : {std::make_pair("with   ", with), std::make_pair("without", without)}) {
    std::printf("%s +cbf: %d of 1000 left the view, %d reached, %d stuck, %d on the way after 20 s\n", row.first,
                row.second.violated, row.second.reached, row.second.deadlocks, row.second.unfinished);
  }
  CAPTURE(seed);
  CHECK(with.violated == 0);
  CHECK(without.violated > 100);
  CHECK(with.reached > 600);
}

TEST_CASE("no twist whatever takes a point over the border", "[filter]")
{
  // Hostile input: twists far beyond the limits, new ones at random times, all at full speed near the border.
  const unsigned int seed = vpTestSupport::seed();
  const vpViewConstraintSpec spec = vga();
  std::vector<vpServoPoint> outline;
  double closest = 1e9;
  for (int run = 0; run < 200; ++run) {
    auto rng = vpTestSupport::generator(7000 + run);
    vpViewConstraintFilter filter(spec);
    Task task = randomTask(rng);
    task.points.resize(4);
    vpHomogeneousMatrix cMo = task.start;
    vpTwist v;
    for (int i = 0; i < 500; ++i) {
      if (i % 25 == 0) {
        v = randomTwist(rng, uniform(rng, 0., 3.), uniform(rng, 0., 4.));
      }
      project(cMo, task.points, outline);
      const vpServoCommand command = filter.filter(wanted(v), outline, spec.period);
      CAPTURE(seed, run, i, clearance(outline));
      const bool within = command.v.linearNorm() <= spec.maxLinear * (1. + 1e-9) &&
                          command.v.angularNorm() <= spec.maxAngular * (1. + 1e-9);
      if (!within || !(clearance(outline) >= 0.)) {
        FAIL("limits or view broken");
      }
      closest = std::min(closest, clearance(outline));
      cMo = move(cMo, command.v, spec.period);
    }
  }
  CHECK(closest < 0.005); // the border was approached: 4 px
}

TEST_CASE("wrong depths within their bound do no harm", "[filter]")
{
  const unsigned int seed = vpTestSupport::seed();
  vpViewConstraintSpec spec = vga();
  spec.depthUncertainty = 0.3;
  std::vector<vpServoPoint> outline;
  for (int run = 0; run < 100; ++run) {
    auto rng = vpTestSupport::generator(8000 + run);
    vpViewConstraintFilter filter(spec);
    Task task = randomTask(rng);
    task.points.resize(4);
    vpHomogeneousMatrix cMo = task.start;
    double factor[4];
    for (double &f : factor) {
      f = 1. / uniform(rng, 0.7, 1.3); // true depth = (1 +- 0.3) x the given depth
    }
    vpTwist v;
    for (int i = 0; i < 300; ++i) {
      if (i % 25 == 0) {
        v = randomTwist(rng, 1., 1.);
      }
      project(cMo, task.points, outline);
      CAPTURE(seed, run, i);
      if (!(clearance(outline) >= 0.)) {
        FAIL("view broken");
      }
      for (int k = 0; k < 4; ++k) {
        outline[k].Z *= factor[k];
      }
      cMo = move(cMo, filter.filter(wanted(v), outline, spec.period).v, spec.period);
    }
  }
}

TEST_CASE("a point outside the view comes back and never goes farther out", "[filter]")
{
  const unsigned int seed = vpTestSupport::seed();
  const vpViewConstraintSpec spec = vga();
  std::vector<vpServoPoint> outline;
  int outside = 0, back = 0;
  for (int run = 0; run < 300; ++run) {
    auto rng = vpTestSupport::generator(9000 + run);
    vpViewConstraintFilter filter(spec);
    const auto points = object(rng, 0.1, 4);
    vpHomogeneousMatrix cMo = randomPose(rng, 0.4, 1., 0.55, 0.5);
    project(cMo, points, outline);
    if (clearance(outline) >= 0.) {
      continue;
    }
    ++outside;
    const vpTwist v = randomTwist(rng, 0.3, 0.3);
    double before = clearance(outline);
    for (int i = 0; i < 400; ++i) {
      const vpServoCommand command = filter.filter(wanted(v), outline, spec.period);
      cMo = move(cMo, command.v, spec.period);
      project(cMo, points, outline);
      CAPTURE(seed, run, i, before);
      if (before < 0.) {
        REQUIRE(clearance(outline) > before - 1e-4); // at most the curvature of one step
      }
      before = clearance(outline);
    }
    back += before >= -1e-3;
  }
  CHECK(outside > 50);
  CHECK(back == outside);
}

TEST_CASE("a point outside the view comes back however little motion is wanted", "[filter]")
{
  const vpViewConstraintSpec spec = vga();
  vpViewConstraintFilter filter(spec);
  const vpServoPoint gone{spec.left - 0.1, 0., 0.5, true};
  const vpServoCommand command = filter.filter(wanted(vpTwist(1e-5, 0., 0., 0., 0., 0.)), {gone}, spec.period);
  CHECK(command.status == vpServoStatus::ViewLimited);
  const double x = gone.x;
  const double xDot = -command.v[0] / gone.Z + x * command.v[2] / gone.Z - (1. + x * x) * command.v[4];
  CHECK(xDot > 1e-6); // towards the image
}

TEST_CASE("a point on the very border stays inside during the next period at full speed", "[filter]")
{
  // Worst case for which the margin is derived. Half of the twists slide the point along the border and roll at the
  // same time, so that its path curves outwards.
  const unsigned int seed = vpTestSupport::seed();
  auto rng = vpTestSupport::generator(71);
  const vpViewConstraintSpec spec = vga();
  vpViewConstraintFilter filter(spec);
  for (int run = 0; run < 20000; ++run) {
    const double x = run & 1 ? halfWidth : -halfWidth, Z = uniform(rng, 0.1, 2.);
    const std::vector<vpServoPoint> point = {{x, uniform(rng, -0.9, 0.9) * halfHeight, Z, true}};
    const vpTwist curve(0., run & 2 ? 1. : -1., 0., 0., 0., run & 4 ? 1.5 : -1.5);
    const vpTwist v = run & 8 ? curve : randomTwist(rng, 1., 1.5);
    const vpServoCommand command = filter.filter(wanted(v), point, spec.period);
    const vpHomogeneousMatrix cMo = pose(Eigen::Matrix3d::Identity(), {x * Z, point[0].y * Z, Z});
    CAPTURE(seed, run, Z, command.v[1], command.v[5]);
    for (double part : {0.25, 0.5, 1.}) {
      const Eigen::Vector3d P = translation(move(cMo, command.v, part * spec.period));
      REQUIRE(std::abs(P.x() / P.z()) <= halfWidth);
    }
  }
}

TEST_CASE("the margin shrinks with the square of the speed and grows near the object", "[filter]")
{
  const vpViewConstraintFilter filter(vga());
  CHECK(filter.margin(0.5, 0., 0., 0.01) == 0.);
  CHECK(filter.margin(0.5, 1., 1.5, 0.01) < 0.02); // 16 px at full speed
  CHECK(filter.margin(0.5, 0.1, 0.15, 0.01) == Approx(filter.margin(0.5, 1., 1.5, 0.01) / 100.).epsilon(0.15));
  CHECK(filter.margin(0.2, 1., 1., 0.01) > filter.margin(0.5, 1., 1., 0.01));
}

TEST_CASE("untouched, limited and stuck are told apart", "[filter]")
{
  const vpViewConstraintSpec spec;
  vpViewConstraintFilter filter(spec);
  const std::vector<vpServoPoint> centre = {{0., 0., 0.5, true}};
  const vpTwist slow(0.01, 0., 0., 0., 0., 0.01);
  vpServoCommand command = filter.filter(wanted(slow), centre, 0.01);
  CHECK(command.status == vpServoStatus::Servoing);
  CHECK(command.v[0] == slow[0]);

  command = filter.filter(wanted(vpTwist(4., 0., 0., 0., 0., 2.)), {}, 0.01);
  CHECK(command.status == vpServoStatus::ViewLimited); // by the speed limit, one factor for all
  CHECK(command.v[0] == Approx(1.));
  CHECK(command.v[5] == Approx(0.5));

  // Two opposite borders reached: the only motion for vz > 0 is blocked, and no other is desired.
  const double inset = filter.margin(0.5, 0.1, 0.15, 0.01);
  const std::vector<vpServoPoint> wide = {{spec.left + inset, 0., 0.5, true}, {spec.right - inset, 0., 0.5, true}};
  command = filter.filter(wanted(vpTwist(0., 0., 0.1, 0., 0., 0.)), wide, 0.01);
  CHECK(command.status == vpServoStatus::Deadlock);
  CHECK(command.v.linearNorm() < 2e-3);
  command = filter.filter(wanted(vpTwist()), wide, 0.01);
  CHECK(command.status == vpServoStatus::Servoing); // no desired motion is no deadlock

  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const vpServoPoint &bad :
       {vpServoPoint{nan, 0., 1., true}, vpServoPoint{0., 0., 0., true}, vpServoPoint{0., 0., -1., true}}) {
    command = filter.filter(wanted(slow), {bad}, 0.01);
    CHECK(command.status == vpServoStatus::InvalidInput);
    CHECK(command.v.linearNorm() == 0.);
  }
  CHECK(filter.filter(wanted(slow), {{nan, nan, -1., false}}, 0.01).status == vpServoStatus::Servoing);
  CHECK(filter.filter(wanted(slow), std::vector<vpServoPoint>(9, centre[0]), 0.01).status ==
        vpServoStatus::InvalidInput);
  CHECK(filter.filter(wanted(slow), centre, 0.).status == vpServoStatus::InvalidInput);
  CHECK(filter.filter({vpTwist(), vpServoStatus::Degenerate}, centre, 0.01).status == vpServoStatus::Degenerate);
}

TEST_CASE("view constraint set-up errors say what is wrong", "[filter][errors]")
{
  using Catch::Contains;
  const auto with = [](double vpViewConstraintSpec::*field, double value) {
    vpViewConstraintSpec spec;
    spec.*field = value;
    return spec;
  };
  CHECK_THROWS_WITH(vpViewConstraintFilter(with(&vpViewConstraintSpec::left, 0.1)),
                    Contains("left border of the view constraint is 0.1, must be finite and < 0"));
  CHECK_THROWS_WITH(vpViewConstraintFilter(with(&vpViewConstraintSpec::gamma, 80.)),
                    Contains("gamma of the view constraint is 80, must be > 0 and at most 0.5 / period"));
  CHECK_THROWS_WITH(vpViewConstraintFilter(with(&vpViewConstraintSpec::depthUncertainty, 1.)),
                    Contains("is 1, must be 0..0.9"));
  CHECK_THROWS_WITH(vpViewConstraintFilter(with(&vpViewConstraintSpec::maxAngular, -1.)), Contains("maxAngular"));
  CHECK_THROWS_WITH(vpViewConstraintFilter(with(&vpViewConstraintSpec::imageUncertainty, 0.5)),
                    Contains("imageUncertainty"));
  const auto camera = vpViewConstraintSpec::fromCamera(vpCameraParameters(800., 800., 320., 240.), 640, 480);
  CHECK(camera.left == Approx(vpViewConstraintSpec().left));
  CHECK(camera.right == Approx(vpViewConstraintSpec().right));
  CHECK(camera.top == Approx(vpViewConstraintSpec().top));
  CHECK(camera.bottom == Approx(vpViewConstraintSpec().bottom));
  CHECK_THROWS_WITH(vpViewConstraintSpec::fromCamera(vpCameraParameters(800., 800., 700., 240.), 640, 480),
                    Contains("right border of the view constraint is -0.07"));
  CHECK_THROWS_WITH(vpViewConstraintSpec::fromCamera(vpCameraParameters(), 0, 480), Contains("image is 0 x 480 px"));
}
