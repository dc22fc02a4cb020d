/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// From measurements to joint velocities: the goal is reached despite latency, limits are kept, obstacles are not
// touched, and the output is finite for any input.
#include "vpCatch.h"
#include "vpTestArms.h"
#include "vpWildNumbers.h"

#include <visp3/core/vpException.h>
#include <visp3/manipulator/vpTwistAxes.h>
#include <visp3/servoing/vpServoTarget.h>
#include <visp3/servoing/vpVisualServo.h>

#include <deque>

VISP_DIRECT_USING_NAMESPACE
using vpTestArms::amor;

namespace
{
constexpr double period = 0.005; // s
const vpServoTarget plate = vpServoTarget::rectangle(0.16, 0.11);
const vpHomogeneousMatrix cdMo(0., 0., 0.35, 0., 0., 0.);

vpVisualServoSpec spec()
{
  vpVisualServoSpec spec;
  spec.period = period;
  spec.startTime = 0.;
  spec.indices = {vpSelfMotionIndex::jointLimits()};
  return spec;
}

vpRigidTransform cameraAt(const vpJointVector &q)
{
  vpArmData data;
  vpArmKinematics::update(amor(), q, data);
  return vpArmKinematics::camera(amor(), data);
}

//! An ideal arm, and an exact camera at 10 Hz with latency.
struct Bench {
  vpVisualServo servo;
  vpJointVector q = amor().home(), velocity = vpJointVector::Zero(7);
  vpHomogeneousMatrix fMo;
  double latency = 0.1;
  std::deque<vpServoSight> pending;
  int cycle = 0;

  bool told = true; // true: time of exposure reported; otherwise that of arrival

  explicit Bench(const std::string &law, const vpServoControllerSpec &controller = {})
    : servo(vpServoController::create(law, controller), spec(), &amor()),
      fMo(cameraAt(amor().home()).toHomogeneous() * vpHomogeneousMatrix(0.06, 0.04, 0.45, 0.2, -0.3, 0.4))
  {
    servo.setGoal(plate.goal(cdMo));
    servo.start();
  }
  [[nodiscard]] vpHomogeneousMatrix cMo() const { return cameraAt(q).inverse().toHomogeneous() * fMo; }
  const vpVisualServoOutput &step()
  {
    const double now = period * cycle;
    if (cycle++ % 20 == 0) {
      pending.emplace_back();
      plate.measure(cMo(), now, pending.back().measurement);
    }
    while (!pending.empty() && pending.front().measurement.time + latency <= now + 1e-9) {
      vpServoSight seen = pending.front();
      seen.measurement.time = told ? seen.measurement.time : now;
      servo.see(seen);
      pending.pop_front();
    }
    const unsigned long before = vpTestSupport::allocationCount();
    const vpVisualServoOutput &out = servo.step(q, now);
    if (cycle > 1) {
      REQUIRE(vpTestSupport::allocationCount() == before);
    }
    for (int i = 0; i < 7; ++i) {
      REQUIRE(std::abs(out.velocity(i)) <= amor().velocity()(i) * (1. + 1e-9));
      REQUIRE(std::abs(out.velocity(i) - velocity(i)) <= amor().acceleration()(i) * period * (1. + 1e-9) + 1e-12);
    }
    velocity = out.velocity;
    q += period * velocity;
    return out;
  }
  [[nodiscard]] double error() const // m, of the camera position
  {
    return (cdMo * cMo().inverse()).getTranslationVector().frobeniusNorm();
  }
};
} // namespace

TEST_CASE("An arm servo reaches its goal through a latency of 100 ms", "[servoing]")
{
  for (const char *law : {"pbvs1", "ff-lookat", "ff-lookat-pi", "ibvs"}) {
    Bench bench(law);
    for (int i = 0; i < 4000; ++i) {
      bench.step();
    }
    INFO(law << ", " << bench.error() << " m");
    CHECK(bench.error() < 1e-5);
    CHECK(bench.velocity.norm() < 0.3); // the self-motion continues
  }
}

TEST_CASE("Five joints bring place and optical axis of the camera to the goal, with the rotation about it free",
          "[servoing]")
{
  const vpArmModel model = vpLoadArmJson(std::string(VISP_DIRECT_DATA_DIR) + "/robot/five-axis.json");
  vpVisualServoSpec free;
  free.period = period;
  free.startTime = 0.;
  free.free = vpFreeAxes({"rz"});
  vpVisualServo servo(vpServoController::create("pbvs1", {}), free, &model);
  servo.setGoal(plate.goal(cdMo));
  servo.start();
  vpJointVector q = model.home();
  vpArmData data;
  const auto camera = [&]() {
    vpArmKinematics::update(model, q, data);
    return vpArmKinematics::camera(model, data).toHomogeneous();
  };
  const vpHomogeneousMatrix fMo = camera() * vpHomogeneousMatrix(0.03, 0.02, 0.4, 0.1, -0.1, 0.2);
  vpHomogeneousMatrix cMo;
  for (int i = 0; i < 3000; ++i) {
    cMo = camera().inverse() * fMo;
    vpServoSight seen;
    plate.measure(cMo, i * period, seen.measurement);
    const vpVisualServoOutput &out = servo.step(q, i * period);
    servo.see(seen); // for the next period
    REQUIRE(out.twist[5] == 0.);
    q += period * out.velocity;
  }
  const vpHomogeneousMatrix cdMc = cdMo * cMo.inverse();
  CHECK(cdMc.getTranslationVector().frobeniusNorm() < 1e-4);
  CHECK(std::hypot(cdMc[0][2], cdMc[1][2]) < 1e-4);
  CHECK(std::abs(cdMc[0][1]) > 1e-3); // turned about the optical axis
}

TEST_CASE("A measurement that is late and told as new makes the loop swing, one told with its time does not",
          "[servoing]")
{
  vpServoControllerSpec quick;
  quick.gains.lambda = 8.;
  quick.motion = {1., 100., INFINITY, 2., 100., INFINITY};
  double worst[2] = {0., 0.};
  for (const bool told : {true, false}) {
    Bench bench("pbvs1", quick);
    bench.latency = 0.3;
    bench.told = told;
    for (int i = 0; i < 2000; ++i) {
      bench.step();
      if (i > 1000) {
        worst[told] = std::max(worst[told], bench.error());
      }
    }
  }
  CHECK(worst[true] < 1e-4);
  CHECK(worst[false] > 100. * worst[true]);
}

TEST_CASE("A supervised arm servo stops before a ball in its way, which it hits without", "[servoing]")
{
  vpArmData data;
  Bench free("pbvs1");
  for (int i = 0; i < 3000; ++i) {
    free.step();
  }
  vpArmKinematics::update(amor(), free.q, data);
  vpCollisionSceneSpec world;
  vpCollisionObject ball;
  ball.name = "ball";
  ball.shape = vpCollisionShape::sphere(0.05);
  ball.pose.p = data.tool.p; // where the tool would end
  world.objects.push_back(ball);
  const vpCollisionScene scene(amor(), world);
  double least[2] = {1., 1.};
  bool isStopped = false;
  for (const bool isSupervised : {false, true}) {
    Bench bench("pbvs1");
    if (isSupervised) {
      bench.servo.supervise(scene);
    }
    vpCollisionData placed;
    for (int i = 0; i < 3000; ++i) {
      scene.place(bench.q, placed);
      least[isSupervised] = std::min(least[isSupervised], scene.clearance(placed).distance);
      const vpVisualServoOutput &out = bench.step();
      const bool isHeld = out.supervision != vpSupervision::Passed && out.supervision != vpSupervision::Limited;
      isStopped = isHeld || isStopped;
      REQUIRE(out.obstacle.kind == (isHeld ? vpCollisionKind::Object : vpCollisionKind::None));
    }
  }
  CHECK(isStopped);
  CHECK(least[false] < 0.);
  CHECK(least[true] > 0.0099); // the margin less the resolution
  CHECK(least[true] < 0.05);
}

TEST_CASE("A target that is lost stops the arm, and it goes on when it comes back", "[servoing]")
{
  Bench bench("ff-lookat");
  for (int i = 0; i < 200; ++i) {
    bench.step();
  }
  const double before = bench.error();
  bench.pending.clear();
  for (int i = 0; i < 400; ++i) { // no camera
    const auto &out = bench.servo.step(bench.q, period * bench.cycle++);
    bench.velocity = out.velocity;
    bench.q += period * out.velocity;
  }
  CHECK(bench.servo.step(bench.q, period * bench.cycle++).servo != vpServoStatus::Servoing);
  for (int i = 0; i < 4000; ++i) {
    bench.step();
  }
  CHECK(bench.error() < 1e-4);
  CHECK(before > 1e-3);
}

TEST_CASE("While the arm brakes there is no self-motion, and the largest jerk of a joint is reported", "[servoing]")
{
  vpRedundancySpec ofTwin;
  ofTwin.period = period;
  const vpRedundancySolver twin(amor(), ofTwin);
  for (unsigned int problem = 0; problem < static_cast<unsigned int>(vpTestSupport::longer(6)); ++problem) {
    std::mt19937_64 rng = vpTestSupport::generator(problem);
    Bench bench(problem % 2 == 0 ? "ff-lookat" : "ff-dtg");
    vpJointVector rate = vpJointVector::Zero(7);
    const int stop = 60 + static_cast<int>(vpTestSupport::uniform(rng, 0., 100.));
    int braked = 0;
    double most = 0.; // difference of the motions with and without the indices
    CAPTURE(problem, stop);
    for (int i = 0; i < stop + 200; ++i) {
      if (i == stop) {
        bench.servo.stop();
      }
      vpArmData data;
      vpArmKinematics::update(amor(), bench.q, data);
      const vpJointVector before = bench.velocity;
      const vpVisualServoOutput &out = bench.step();
      const vpJointVector now = (bench.velocity - before) / period;
      REQUIRE(out.jointJerk == Approx((now - rate).cwiseAbs().maxCoeff() / period).margin(1e-6));
      rate = now;
      if (i < stop || (out.twist.linearNorm() == 0. && out.twist.angularNorm() == 0.)) {
        continue;
      }
      vpRedundancyInput input;
      input.twist = out.twist;
      input.previous = before;
      vpRedundancyOutput without, with;
      twin.step(data, input, without);
      input.indices[0] = vpSelfMotionIndex::jointLimits();
      input.indexCount = 1;
      twin.step(data, input, with);
      REQUIRE((out.velocity - without.velocity).norm() < 1e-9);
      most = std::max(most, (with.velocity - without.velocity).norm());
      ++braked;
    }
    CHECK(braked > 5);
    CHECK(most > 1e-3); // self-motion would have been seen
  }
}

TEST_CASE("Wild configurations, times and measurements leave the arm's velocities within its limits", "[servoing]")
{
  std::mt19937_64 rng(Catch::rngSeed());
  for (int sequence = 0; sequence < 100; ++sequence) {
    Bench bench("ff-lookat-pi");
    for (int i = 0; i < 100; ++i) {
      const double now = vpWildNumbers::mixed(rng, period * i, 0.1);
      if (bench.servo.output().status >= vpVisualServoStatus::ClockFault) {
        bench.servo.start();
      }
      vpServoSight seen;
      plate.measure(bench.cMo(), vpWildNumbers::mixed(rng, period * i, 0.1), seen.measurement);
      for (unsigned int r = 0; r < 3; ++r) {
        seen.measurement.cMo[r][3] = vpWildNumbers::mixed(rng, seen.measurement.cMo[r][3], 0.1);
      }
      bench.servo.see(seen);
      vpJointVector q = bench.q;
      vpWildNumbers::mix(rng, q, 0.05);
      const vpJointVector &velocity = bench.servo.step(q, now).velocity;
      for (int j = 0; j < 7; ++j) {
        REQUIRE(vpWildNumbers::atMost(std::abs(velocity(j)), amor().velocity()(j) * (1. + 1e-9)));
      }
    }
  }
}

TEST_CASE("A measurement has what was found and no more", "[servoing]")
{
  const vpServoTarget target({{0., 0., 0.}, {0., 0., -1.}}, {{0.1, 0., 0.}});
  vpPlanarTargetResult found;
  found.status = vpPlanarTargetStatus::Tracked;
  found.cMo = vpHomogeneousMatrix(0.1, -0.2, 0.5, 0., 0., 0.);
  found.covariance.known = true;
  found.covariance.C[0] = 2.;
  vpServoMeasurement seen;
  target.measure(found, 3., seen);
  CHECK(seen.valid);
  CHECK(seen.time == 3.);
  CHECK(seen.covariance.known);
  CHECK(seen.covariance.C[0] == 2.);
  REQUIRE(seen.points.size() == 2);
  CHECK(seen.points[0].visible);
  CHECK(seen.points[0].x == Approx(0.2));
  CHECK(seen.points[0].y == Approx(-0.4));
  CHECK(seen.points[0].Z == Approx(0.5));
  CHECK(!seen.points[1].visible); // behind the camera
  REQUIRE(seen.outline.size() == 1);
  CHECK(seen.outline[0].x == Approx(0.4));
  for (const vpPlanarTargetStatus status : {vpPlanarTargetStatus::Ambiguous, vpPlanarTargetStatus::LowCorrelation}) {
    found.status = status;
    target.measure(found, 4., seen);
    CHECK(!seen.valid);
    CHECK(seen.time == 4.);
  }
}

TEST_CASE("What is out of range is named", "[servoing]")
{
  vpVisualServoSpec bad = spec();
  bad.imageTimeout = 0.;
  CHECK_THROWS_WITH(vpVisualServo(vpServoController::create("pbvs1"), bad),
                    "imageTimeout of the visual servo is 0 s, must be > 0");
  bad = spec();
  bad.longestStep = NAN;
  CHECK_THROWS_WITH(vpVisualServo(vpServoController::create("pbvs1"), bad),
                    "longestStep of the visual servo is nan s, must be > 0 and finite");
  CHECK_THROWS_WITH(vpServoTarget::rectangle(0., 1.), "width of the servo target is 0 m, must be > 0");
  CHECK_THROWS_WITH(vpServoTarget({}), "the servo target has no points, must have one or more");
  CHECK_THROWS_WITH(vpServoTarget({{0., NAN, 0.}}), "point 0 of the servo target is (0, nan, 0), must be finite");
}
