/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Motions on SE(3): the twist against finite differences of the pose, transitions, limits, rotations up to pi.
#include "vpCatch.h"
#include "vpWildNumbers.h"

#include <visp3/core/vpException.h>
#include <visp3/direct_core/vpSO3.h>
#include <visp3/trajectory/vpPoseTrajectory.h>

#include <Eigen/Geometry>

VISP_DIRECT_USING_NAMESPACE

namespace
{
Eigen::Vector3d gaussian(std::mt19937_64 &rng)
{
  std::normal_distribution<double> gauss;
  return {gauss(rng), gauss(rng), gauss(rng)};
}

vpHomogeneousMatrix pose(const Eigen::Matrix3d &R, const Eigen::Vector3d &t)
{
  vpCameraState x;
  x.fRc = R;
  x.ftc = t;
  vpHomogeneousMatrix M;
  x.copyTo(M);
  return M;
}

vpHomogeneousMatrix randomPose(std::mt19937_64 &rng, double angle)
{
  return pose(vpSO3::exp(angle * gaussian(rng).normalized()), 0.3 * gaussian(rng));
}

Eigen::Vector3d linear(const vpTwist &v) { return {v[0], v[1], v[2]}; }
Eigen::Vector3d angular(const vpTwist &v) { return {v[3], v[4], v[5]}; }

// Twist and acceleration of the plan at t against central differences of its poses and twists.
void checkRates(const vpPoseTrajectory &trajectory, double t)
{
  const double h = 1e-5;
  const vpCameraState a = trajectory.at(t - h), x = trajectory.at(t), b = trajectory.at(t + h);
  const Eigen::Vector3d v = x.fRc.transpose() * (b.ftc - a.ftc) / (2. * h);
  const Eigen::Vector3d w = vpSO3::log(a.fRc.transpose() * b.fRc) / (2. * h);
  REQUIRE((v - linear(x.v)).norm() < 2e-8);
  REQUIRE((w - angular(x.v)).norm() < 2e-8);
  const Eigen::Vector3d pdd = (b.fRc * linear(b.v) - a.fRc * linear(a.v)) / (2. * h);
  REQUIRE((x.fRc.transpose() * pdd - linear(x.a)).norm() < 1e-6);
  REQUIRE(((angular(b.v) - angular(a.v)) / (2. * h) - angular(x.a)).norm() < 1e-6);
}
} // namespace

TEST_CASE("the camera twist is the derivative of the pose, for turns up to pi", "[pose]")
{
  auto rng = vpTestSupport::generator(100);
  CAPTURE(vpTestSupport::seed());
  std::uniform_real_distribution<double> angle(0., M_PI);
  for (int k = 0; k < 600; ++k) {
    vpPoseTrajectorySpec spec;
    spec.rotation = k % 2 == 0 ? vpRotationPath::Geodesic : vpRotationPath::RotationVector;
    spec.cruise = k % 3 == 0;
    vpPoseTrajectory trajectory(spec);
    const double theta = k % 5 == 0 ? M_PI - 1e-9 : angle(rng);
    const vpTwist v(0.05, -0.1, 0.02, 0.1, -0.2, 0.15), a(0.1, 0., -0.1, 0.2, 0.1, -0.3);
    const vpHomogeneousMatrix start = randomPose(rng, angle(rng)), goal = randomPose(rng, theta);
    REQUIRE(trajectory.reset(start, k % 2 == 0 ? v : vpTwist(), k % 2 == 0 ? a : vpTwist()).isGood());
    REQUIRE(trajectory.setGoal(goal).isGood());
    REQUIRE(trajectory.step(1e-3).isGood());
    CAPTURE(k, theta, trajectory.duration());
    const double T = trajectory.duration();
    const vpCameraState begin = trajectory.at(0.), end = trajectory.at(T);
    if (k % 2 == 0) { // starts with the given motion
      REQUIRE((linear(begin.v) - linear(v)).norm() < 1e-12);
      REQUIRE((angular(begin.v) - angular(v)).norm() < 1e-12);
      REQUIRE((linear(begin.a) - linear(a)).norm() < 1e-12);
      REQUIRE((angular(begin.a) - angular(a)).norm() < 1e-12);
    }
    vpHomogeneousMatrix reached;
    end.copyTo(reached);
    for (unsigned int r = 0; r < 3; ++r) {
      for (unsigned int c = 0; c < 4; ++c) {
        REQUIRE(std::abs(reached[r][c] - goal[r][c]) < 1e-12);
      }
    }
    for (int s = 1; s < 40; ++s) {
      const double t = T * (s + 0.1) / 40.;
      const vpCameraState x = trajectory.at(t);
      REQUIRE(x.v.linearNorm() <= spec.linearVelocity * (k % 2 == 0 ? 1. : std::sqrt(3.)) + 1e-9);
      REQUIRE(x.v.angularNorm() <= spec.angularVelocity * (k % 2 == 0 ? 1. : std::sqrt(3.)) + 1e-9);
      REQUIRE(linear(x.a).norm() <= spec.linearAcceleration * (k % 2 == 0 ? 1. : std::sqrt(3.)) + 1e-9);
      const double curved = 0.32 * std::pow(x.v.angularNorm(), 2);
      REQUIRE(angular(x.a).norm() <= spec.angularAcceleration * (k % 2 == 0 ? 1. : std::sqrt(3.)) + curved + 1e-9);
    }
    for (const double t : {0.137, 0.421, 0.77, 0.93}) {
      bool joint = false; // differences across a joint of the polynomials are meaningless
      for (int i = 0; i < 6; ++i) {
        for (int s = 0; s < trajectory.plan().segments(i); ++s) {
          joint = joint || std::abs(trajectory.plan().segment(i, s).begin - t * T) < 1e-4;
        }
      }
      if (!joint) {
        checkRates(trajectory, t * T);
      }
    }
  }
}

TEST_CASE("from rest the rotation follows the geodesic and position a straight line", "[pose]")
{
  auto rng = vpTestSupport::generator(101);
  CAPTURE(vpTestSupport::seed());
  std::uniform_real_distribution<double> angle(0.1, M_PI);
  for (int k = 0; k < 100; ++k) {
    vpPoseTrajectory trajectory;
    const double theta = angle(rng);
    const Eigen::Vector3d axis = gaussian(rng).normalized(), way = 0.3 * gaussian(rng);
    REQUIRE(trajectory.setGoal(pose(vpSO3::exp(theta * axis), way)).isGood());
    REQUIRE(trajectory.step(1e-3).isGood());
    for (int s = 0; s <= 20; ++s) {
      const vpCameraState x = trajectory.at(trajectory.duration() * s / 20.);
      REQUIRE(vpSO3::log(x.fRc).cross(axis).norm() < 1e-9);
      REQUIRE(x.ftc.cross(way).norm() < 1e-12);
      REQUIRE(angular(x.v).cross(axis).norm() < 1e-12);
    }
  }
}

TEST_CASE("a new goal at any moment: twist and its rate go on without a jump", "[pose]")
{
  auto rng = vpTestSupport::generator(102);
  CAPTURE(vpTestSupport::seed());
  std::uniform_real_distribution<double> angle(0.2, M_PI - 0.05);
  for (const auto policy : {vpReplanPolicy::EventMinTime, vpReplanPolicy::KeepArrival}) {
    vpPoseTrajectorySpec spec;
    spec.policy = policy;
    spec.minimumDuration = 0.3;
    vpPoseTrajectory trajectory(spec);
    REQUIRE(trajectory.reset(randomPose(rng, 1.)).isGood());
    vpCameraState before = trajectory.state();
    for (int i = 0; i < 20000; ++i) {
      if (i % 400 == 0) {
        REQUIRE(trajectory.setGoal(randomPose(rng, angle(rng))).isGood());
      }
      const vpTrajectoryStatus status = trajectory.step(1e-3);
      REQUIRE(status.isGood());
      const vpCameraState &x = trajectory.state();
      CAPTURE(i, status.message());
      if (i % 400 == 0) { // the new plan begins exactly in the commanded state, up to the second derivative
        const vpCameraState begin = trajectory.at(0.);
        REQUIRE((begin.fRc - before.fRc).norm() < 1e-14);
        REQUIRE((begin.ftc - before.ftc).norm() < 1e-14);
        for (std::size_t k = 0; k < 6; ++k) {
          REQUIRE(std::abs(begin.v[k] - before.v[k]) < 1e-13);
          REQUIRE(std::abs(begin.a[k] - before.a[k]) < 1e-13);
        }
      }
      for (std::size_t k = 0; k < 6; ++k) { // and over every cycle the velocity changes as its rate says
        REQUIRE(std::abs(x.v[k] - before.v[k] - 0.5e-3 * (x.a[k] + before.a[k])) <
                1e-3 * std::abs(x.a[k] - before.a[k]) + 1e-4);
      }
      REQUIRE(x.v.linearNorm() <= spec.linearVelocity + 1e-9);
      REQUIRE(x.v.angularNorm() <= spec.angularVelocity + 1e-9);
      REQUIRE((x.fRc * x.fRc.transpose() - Eigen::Matrix3d::Identity()).norm() < 1e-13);
      before = x;
    }
  }
}

TEST_CASE("a goal with a twist is met with that twist", "[pose]")
{
  auto rng = vpTestSupport::generator(103);
  CAPTURE(vpTestSupport::seed());
  for (int k = 0; k < 100; ++k) {
    vpPoseTrajectory trajectory;
    const vpTwist twist(0.05, 0.02, -0.04, 0.1, -0.05, 0.08);
    const vpHomogeneousMatrix goal = randomPose(rng, 2.);
    REQUIRE(trajectory.setGoal(goal, twist).isGood());
    REQUIRE(trajectory.step(1e-3).isGood());
    const vpCameraState end = trajectory.at(trajectory.duration());
    CHECK((linear(end.v) - linear(twist)).norm() < 1e-12);
    CHECK((angular(end.v) - angular(twist)).norm() < 1e-12);
    // A constant body twist: no angular acceleration, and the origin rotates with the frame.
    CHECK(angular(end.a).norm() < 1e-12);
    CHECK((linear(end.a) - angular(twist).cross(linear(twist))).norm() < 1e-12);
  }
}

TEST_CASE("finished, holding, fixed arrival and bad poses", "[pose]")
{
  vpPoseTrajectorySpec spec;
  spec.policy = vpReplanPolicy::FixedArrival;
  spec.arrivalTime = 4.;
  vpPoseTrajectory trajectory(spec);
  REQUIRE(trajectory.setGoal(pose(vpSO3::exp({0., 0.4, 0.}), {0.1, 0., 0.})).isGood());
  int cycles = 1;
  while (trajectory.step(1e-2).result == vpTrajectoryResult::Working) {
    ++cycles;
  }
  CHECK(cycles == 400);
  CHECK(trajectory.step(1e-2).result == vpTrajectoryResult::Holding);
  CHECK(trajectory.state().v.linearNorm() == 0.);
  CHECK(trajectory.step(-1.).result == vpTrajectoryResult::InvalidInput);

  vpHomogeneousMatrix bad;
  bad[1][3] = NAN;
  CHECK_THAT(trajectory.setGoal(bad).message(), Catch::Contains("goal state of axis 1 has the value nan"));
  bad = vpHomogeneousMatrix();
  bad[0][0] = 0.9;
  CHECK_THAT(trajectory.setGoal(bad).message(),
             Catch::Contains("the rotation of the pose differs from an orthonormal one by 0.1899999"));
  CHECK_THAT(trajectory.setGoal(vpHomogeneousMatrix(), vpTwist(9., 0., 0., 0., 0., 0.)).message(),
             Catch::Contains("has the norm 9"));
  CHECK(trajectory.step(1e-2).result == vpTrajectoryResult::Holding); // nothing of it was taken
  spec.angularVelocity = -1.;
  CHECK_THROWS_WITH(trajectory.setSpec(spec),
                    Catch::Contains("angular velocity limit of the pose trajectory is -1 rad/s, must be > 0"));
}

TEST_CASE("KeepArrival of a pose meets an object on its way that is measured with noise", "[pose][policy]")
{
  auto rng = vpTestSupport::generator(64);
  CAPTURE(vpTestSupport::seed());
  std::normal_distribution<double> gauss;
  // The goal moves on a circle of 0.2 m in 8 s, rotating with it; measured at 100 Hz with 0.5 mm and 0.5 mrad.
  const double w = 2. * M_PI / 8.;
  const vpTwist twist(0.2 * w, 0., 0., 0., 0., w); // in its own frame
  double rms[2] = {0., 0.}, jerk[2] = {0., 0.};
  for (const bool keep : {false, true}) {
    vpPoseTrajectorySpec spec;
    spec.linearVelocity = 1.;
    spec.linearAcceleration = 3.;
    spec.angularVelocity = 2.;
    spec.angularAcceleration = 6.;
    spec.policy = keep ? vpReplanPolicy::KeepArrival : vpReplanPolicy::EventMinTime;
    vpPoseTrajectory trajectory(spec);
    const auto poseAt = [&](double t, double noise) {
      const Eigen::Vector3d e(noise * gauss(rng), noise * gauss(rng), w * t + noise * gauss(rng));
      return vpHomogeneousMatrix(0.2 * std::sin(w * t) + noise * gauss(rng),
                                 0.2 - 0.2 * std::cos(w * t) + noise * gauss(rng), noise * gauss(rng), e.x(), e.y(),
                                 e.z());
    };
    REQUIRE(trajectory.reset(poseAt(0., 0.)).isGood());
    Eigen::Vector3d before = Eigen::Vector3d::Zero();
    int counted = 0;
    for (int k = 0; k < 350; ++k) {
      const double t = 0.01 * k;
      REQUIRE(trajectory.setGoal(poseAt(t, 5e-4), twist).isGood());
      static_cast<void>(trajectory.step(0.01));
      const vpHomogeneousMatrix truth = poseAt(t + 0.01, 0.);
      const Eigen::Vector3d a(trajectory.state().a[0], trajectory.state().a[1], trajectory.state().a[2]);
      if (k > 150) {
        rms[keep] += (trajectory.state().ftc - Eigen::Vector3d(truth[0][3], truth[1][3], truth[2][3])).squaredNorm();
        jerk[keep] = std::max(jerk[keep], (a - before).norm() / 0.01);
        ++counted;
      }
      before = a;
    }
    rms[keep] = std::sqrt(rms[keep] / counted);
  }
  WARN("circle of 0.2 m in 8 s, 0.5 mm noise at 100 Hz. rms error (mm), peak jerk (m/s^3): KeepArrival "
       << 1e3 * rms[1] << ", " << jerk[1] << "; EventMinTime " << 1e3 * rms[0] << ", " << jerk[0]);
  CHECK(rms[1] <= rms[0]);
  CHECK(3. * jerk[1] <= jerk[0]);
}

TEST_CASE("no wild number gets through a pose trajectory", "[pose][wild]")
{
  auto rng = vpTestSupport::generator(65);
  CAPTURE(vpTestSupport::seed());
  const auto isSafe = [](const vpCameraState &x) {
    return x.fRc.allFinite() && x.ftc.allFinite() && x.v.isFinite() && x.a.isFinite();
  };
  const auto twistOf = [](const double *x) { return vpTwist(x[0], x[1], x[2], x[3], x[4], x[5]); };
  // A goal pose (12), its twist (6), start twist and acceleration (12), dt.
  std::array<double, 31> ordinary{1., 0., 0., 0.1, 0., 1., 0., -0.1, 0., 0., 1., 0.2, 0.01, 0., 0., 0., 0.02};
  ordinary[30] = 0.01;
  const auto run = [&](const std::array<double, 31> &x, vpReplanPolicy policy) {
    vpPoseTrajectorySpec spec;
    spec.policy = policy;
    spec.arrivalTime = 5.;
    vpPoseTrajectory trajectory(spec);
    static_cast<void>(trajectory.reset(vpHomogeneousMatrix(), twistOf(&x[18]), twistOf(&x[24])));
    for (int k = 0; k < 6; ++k) {
      vpHomogeneousMatrix goal;
      for (unsigned int i = 0; i < 12; ++i) {
        goal.data[i] = k % 2 == 0 ? x[i] : ordinary[i];
      }
      static_cast<void>(trajectory.setGoal(goal, twistOf(&x[12])));
      static_cast<void>(trajectory.step(k % 3 == 2 ? 0.01 : x[30]));
      REQUIRE(isSafe(trajectory.state()));
    }
  };
  for (const auto policy : {vpReplanPolicy::EventMinTime, vpReplanPolicy::KeepArrival, vpReplanPolicy::FixedArrival}) {
    vpWildNumbers::everyPlace(ordinary, [&](const auto &x, std::size_t place, std::size_t value) {
      CAPTURE(static_cast<int>(policy), place, value);
      run(x, policy);
    });
    for (int k = 0; k < 500; ++k) {
      std::array<double, 31> x = ordinary;
      vpWildNumbers::mix(rng, x, 0.1);
      CAPTURE(static_cast<int>(policy), k);
      run(x, policy);
    }
  }
}
