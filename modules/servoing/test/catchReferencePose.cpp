/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Pose, plane and distance from one reference image: against the truth, ViSP's pose, and with broken input.
#include "vpCatch.h"

#include <visp3/servoing/vpReferencePose.h>

#include <visp3/core/vpException.h>
#include <visp3/core/vpPoint.h>
#include <visp3/direct_core/vpSO3.h>
#include <visp3/vision/vpPose.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <cmath>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

VISP_DIRECT_USING_NAMESPACE

using vpTestSupport::generator;
using vpTestSupport::longer;
using vpTestSupport::seed;
using vpTestSupport::uniform;

namespace
{
constexpr double undefined = std::numeric_limits<double>::quiet_NaN();
constexpr double pixel = 1. / 800.; // normalised

Eigen::Vector3d randomVector(std::mt19937_64 &rng, double size)
{
  const double x = uniform(rng, -size, size), y = uniform(rng, -size, size);
  return {x, y, uniform(rng, -size, size)};
}

vpReferencePoseSpec wide()
{
  vpReferencePoseSpec spec;
  spec.nearest = 0.2;
  spec.farthest = 1.2;
  return spec;
}

// A tilted plane with points, and a camera that goes from one place to another; the robot's base is anywhere.
struct Scene {
  explicit Scene(std::mt19937_64 &random) : rng(random)
  {
    distance = uniform(rng, 0.25, 1.);
    const double tilt = uniform(rng, 0.1, 0.5), azimuth = uniform(rng, 0., 6.3);
    normal << std::sin(tilt) * std::cos(azimuth), std::sin(tilt) * std::sin(azimuth), std::cos(tilt);
    for (int i = 0; i < 30; ++i) {
      const double x = uniform(rng, -0.15, 0.15);
      const Eigen::Vector3d m(x, uniform(rng, -0.15, 0.15), 1.);
      points.push_back(distance / normal.dot(m) * m);
    }
    fMr = {vpSO3::exp(randomVector(rng, 1.)), randomVector(rng, 1.)};
    from = {vpSO3::exp(randomVector(rng, 0.25)),
            distance * Eigen::Vector3d(uniform(rng, 0.1, 0.3), uniform(rng, -0.3, -0.1), uniform(rng, -0.5, -0.1))};
    to = {vpSO3::exp(randomVector(rng, 0.15)), distance * randomVector(rng, 0.1)};
  }
  [[nodiscard]] vpRigidTransform camera(double share) const
  {
    const Eigen::Vector3d turn = vpSO3::log(from.R.transpose() * to.R);
    return {from.R * vpSO3::exp(share * turn), from.p + share * (to.p - from.p)};
  }
  std::vector<vpServoPoint> image(const vpRigidTransform &rMc, double noise)
  {
    std::normal_distribution<double> N(0., 1.);
    std::vector<vpServoPoint> seen(points.size());
    for (std::size_t i = 0; i < seen.size(); ++i) {
      const Eigen::Vector2d x = Eigen::Vector3d(rMc.R.transpose() * (points[i] - rMc.p)).hnormalized();
      seen[i].x = x.x() + noise * N(rng);
      seen[i].y = x.y() + noise * N(rng);
    }
    return seen;
  }
  std::vector<Eigen::Vector2d> reference(double noise)
  {
    std::vector<Eigen::Vector2d> all;
    for (const vpServoPoint &p : image({}, noise)) {
      all.emplace_back(p.x, p.y);
    }
    return all;
  }
  //! An estimator taught by an image of a tenth of a pixel.
  [[nodiscard]] vpReferencePose taught(const vpReferencePoseSpec &spec = wide())
  {
    return vpReferencePose(reference(0.1 * pixel), 0.1 * pixel, spec);
  }
  //! One image, of half a pixel. \param hasOdometry : The robot tells where the camera is.
  const vpReferencePoseResult &show(const vpRigidTransform &rMc, vpReferencePose &pose, bool hasOdometry = true)
  {
    const vpRigidTransform fMc = fMr * rMc;
    return pose.add(image(rMc, 0.5 * pixel), 0.5 * pixel, hasOdometry ? &fMc : nullptr);
  }
  //! The whole way. \return Its end.
  vpRigidTransform go(vpReferencePose &pose, bool hasOdometry = true)
  {
    for (int k = 0; k <= 40; ++k) {
      show(camera(k / 40.), pose, hasOdometry);
    }
    return camera(1.);
  }
  std::mt19937_64 &rng;
  double distance = 0.;
  Eigen::Vector3d normal;
  std::vector<Eigen::Vector3d> points; // m, reference camera
  vpRigidTransform fMr, from, to;
};

double angle(const Eigen::Matrix3d &A, const Eigen::Matrix3d &B) { return vpSO3::log(A.transpose() * B).norm(); }

//! Many of them, each of its own seed.
template <class Test> void onScenes(int count, const Test &test)
{
  CAPTURE(seed());
  for (int i = 0; i < count; ++i) {
    CAPTURE(i);
    auto rng = generator(static_cast<unsigned int>(i));
    Scene scene(rng);
    test(scene);
  }
}
} // namespace

TEST_CASE("without noise a short way gives pose, plane and distance exactly", "[reference]")
{
  onScenes(longer(30), [](Scene &scene) {
    vpReferencePose pose(scene.reference(0.), 0.01 * pixel, wide());
    vpRigidTransform rMc;
    for (int k = 0; k <= 10; ++k) {
      rMc = scene.camera(0.1 * k);
      const vpRigidTransform fMc = scene.fMr * rMc;
      pose.add(scene.image(rMc, 0.), 0.01 * pixel, &fMc);
    }
    const vpReferencePoseResult &r = pose.result();
    INFO(r.message);
    CHECK(r.status == vpReferenceStatus::Unique);
    CHECK(angle(r.R, rMc.R) < 1e-4);
    CHECK((r.tau - rMc.p / scene.distance).norm() < 1e-4);
    CHECK((r.normal - scene.normal).norm() < 1e-4);
    CHECK(r.distance == Approx(scene.distance).epsilon(1e-3));
    CHECK(r.message.find("The reference plane is 0.") == 0);
  });
}

TEST_CASE("the errors of pose and distance are as large as told", "[reference]")
{
  // With the right covariance C of an error e the mean of e^T C^-1 e is the number of its components, within
  // sqrt(2 n / count); the wrong plane, where it is chosen, would show as a much larger one.
  const int count = longer(200);
  double pose6 = 0.;
  int within = 0, unique = 0;
  onScenes(count, [&](Scene &scene) {
    vpReferencePose pose = scene.taught();
    const vpRigidTransform rMc = scene.go(pose);
    const vpReferencePoseResult &r = pose.result();
    unique += r.status == vpReferenceStatus::Unique ? 1 : 0;
    within += std::abs(r.distance - scene.distance) < 2. * r.distanceSigma ? 1 : 0;
    Eigen::Matrix<double, 6, 1> e;
    e << rMc.p / scene.distance - r.tau, vpSO3::log(r.R.transpose() * rMc.R);
    pose6 += e.dot(Eigen::Map<const Eigen::Matrix<double, 6, 6>>(r.covariance.data()).inverse() * e) / count;
  });
  std::cout << "unique " << unique << ", d within 2 sigma " << within << " of " << count << ", pose " << pose6 << " (6)"
            << std::endl;
  CHECK(unique > 0.98 * count);
  CHECK(std::abs(within - 0.9545 * count) < 3. * std::sqrt(0.9545 * 0.0455 * count) + 1.);
  CHECK(std::abs(pose6 - 6.) < 4. * std::sqrt(12. / count));
}

TEST_CASE("a known plane gives the pose of ViSP's vpPose", "[reference]")
{
  onScenes(longer(20), [](Scene &scene) {
    vpReferencePoseSpec spec;
    spec.nearest = spec.farthest = scene.distance;
    vpReferencePose pose(scene.reference(0.), 1e-4 * pixel, spec);
    pose.setNormalPrior(scene.normal, 1e-6);
    const std::vector<vpServoPoint> seen = scene.image(scene.from, 0.5 * pixel);
    const vpReferencePoseResult &r = pose.add(seen, 0.5 * pixel, nullptr);
    REQUIRE(r.found());
    vpPose visp;
    for (std::size_t k = 0; k < seen.size(); ++k) {
      vpPoint p(scene.points[k].x(), scene.points[k].y(), scene.points[k].z());
      p.set_x(seen[k].x);
      p.set_y(seen[k].y);
      visp.addPoint(p);
    }
    vpHomogeneousMatrix cMr = vpRigidTransform(scene.from).inverse().toHomogeneous();
    visp.setVvsEpsilon(1e-14);
    visp.setVvsIterMax(1000);
    visp.poseVirtualVS(cMr);
    const vpRigidTransform rMc = vpRigidTransform::fromHomogeneous(cMr).inverse();
    CHECK(angle(r.R, rMc.R) < 5e-4); // the noise makes 1e-2; the steps end at 3 % of a standard deviation
    CHECK((scene.distance * r.tau - rMc.p).norm() < 5e-4 * scene.distance);
  });
}

TEST_CASE("one image leaves two planes, motion decides", "[reference]")
{
  vpReferencePoseSpec spec = wide();
  spec.slowness = 0.01;
  int ambiguous = 0, right = 0, slow = 0;
  const int count = longer(50);
  onScenes(count, [&](Scene &scene) {
    vpReferencePose pose = scene.taught(spec);
    for (int k = 0; k <= 20; ++k) {
      const vpReferencePoseResult &r = scene.show(scene.camera(k / 20.), pose);
      if (k == 0 && r.status == vpReferenceStatus::Ambiguous) {
        ++ambiguous;
        slow += r.speedFactor < 0.05 ? 1 : 0; // without the slowness 0.1
        CHECK(r.message.find("planes explain the images") != std::string::npos);
      }
    }
    right += pose.result().normal.dot(scene.normal) > std::cos(0.1) ? 1 : 0;
  });
  std::cout << ambiguous << " starts of " << count << " ambiguous, " << right << " right at the end" << std::endl;
  CHECK(ambiguous > count / 2);
  CHECK(slow > ambiguous / 8); // where the planes differ by much
  CHECK(right >= 0.98 * count);
}

TEST_CASE("a camera that only turns keeps the stated range, and its rotation is right", "[reference]")
{
  onScenes(longer(20), [](Scene &scene) {
    vpReferencePose pose = scene.taught();
    for (int k = 0; k <= 20; ++k) {
      const vpRigidTransform rMc{scene.camera(k / 20.).R, Eigen::Vector3d::Zero()};
      const vpReferencePoseResult &r = scene.show(rMc, pose);
      REQUIRE(r.found());
      CHECK(angle(r.R, rMc.R) < 0.06);
      CHECK(r.tau.norm() < 0.06);
      CHECK(r.scale < 2. * 0.2);
      CHECK(r.distanceSigma > 0.05);
    }
    CHECK(pose.result().status == vpReferenceStatus::PureRotation);
    CHECK(pose.result().message.find("The camera has only turned") == 0);
  });
}

TEST_CASE("without odometry the pose is right up to the stated range", "[reference]")
{
  int right = 0;
  const int count = longer(30);
  onScenes(count, [&](Scene &scene) {
    vpReferencePose pose = scene.taught();
    const vpRigidTransform rMc = scene.go(pose, false);
    const vpReferencePoseResult &r = pose.result();
    REQUIRE(r.found());
    right += angle(r.R, rMc.R) < 0.03 && (r.tau - rMc.p / scene.distance).norm() < 0.03 ? 1 : 0;
    CHECK(r.scale == Approx(2. / (1. / 0.2 + 1. / 1.2)));
    CHECK(r.message.find("without the robot's motion nothing more is known") != std::string::npos);
  });
  std::cout << right << " of " << count << " right without odometry" << std::endl;
  CHECK(right >= 0.9 * count);
}

TEST_CASE("measurement and goal of a sight are the pose at one scale", "[reference]")
{
  auto rng = generator(3);
  Scene scene(rng);
  vpReferencePose pose(scene.reference(0.), 0.1 * pixel, wide());
  vpServoSight sight;
  pose.sight(0., sight);
  CHECK_FALSE(sight.measurement.valid);
  const vpRigidTransform fMc = scene.fMr * scene.from;
  const vpReferencePoseResult &r = pose.add(scene.image(scene.from, 0.), 0.1 * pixel, &fMc);
  pose.sight(2.5, sight);
  REQUIRE(sight.measurement.valid);
  CHECK(sight.hasGoal);
  CHECK(sight.measurement.time == 2.5);
  CHECK(sight.goal.points.size() == sight.measurement.points.size());
  const vpRigidTransform cdMc = vpRigidTransform::fromHomogeneous(sight.goal.cdMo * sight.measurement.cMo.inverse());
  CHECK(angle(cdMc.R, r.R) < 1e-9);
  CHECK((cdMc.p - r.scale * r.tau).norm() < 1e-9);
  // The covariance is that of small errors (a, e) of tau and R, by differences.
  const vpRigidTransform cMo = vpRigidTransform::fromHomogeneous(sight.measurement.cMo);
  const vpRigidTransform rMo = vpRigidTransform{r.R, r.scale * r.tau} * cMo;
  Eigen::Matrix<double, 6, 6> J;
  for (int k = 0; k < 6; ++k) {
    constexpr double h = 1e-6;
    const Eigen::Matrix<double, 6, 1> step = h * Eigen::Matrix<double, 6, 1>::Unit(k);
    const vpRigidTransform rMc{r.R * vpSO3::exp(step.tail<3>()), r.scale * (r.tau + step.head<3>())};
    const vpRigidTransform other = rMc.inverse() * rMo;
    J.col(k) << (other.p - cMo.p) / h, vpSO3::log(other.R * cMo.R.transpose()) / h;
  }
  using Covariance = Eigen::Map<const Eigen::Matrix<double, 6, 6>>; // symmetric
  const Eigen::Matrix<double, 6, 6> C = J * Covariance(r.covariance.data()) * J.transpose();
  CHECK((Covariance(sight.measurement.covariance.C.data()) - C).norm() < 1e-4 * C.norm());
  for (std::size_t i = 0; i < sight.goal.points.size(); ++i) { // of a plane at the distance r.scale
    const vpServoPoint &p = sight.goal.points[i];
    CHECK(p.Z * r.normal.dot(Eigen::Vector3d(p.x, p.y, 1.)) == Approx(r.scale));
  }
}

TEST_CASE("images that fit no plane are refused, and three of them restart", "[reference]")
{
  auto rng = generator(4);
  Scene scene(rng);
  vpReferencePose pose = scene.taught();
  const auto add = [&](double share, double shift) {
    const vpRigidTransform rMc = scene.camera(share), fMc = scene.fMr * rMc;
    std::vector<vpServoPoint> seen = scene.image(rMc, 0.5 * pixel);
    for (std::size_t i = 0; i < seen.size(); ++i) {
      seen[i].x += (i % 2 == 0 ? 1. : -1.) * shift;
    }
    return pose.add(seen, 0.5 * pixel, &fMc).status;
  };
  for (int k = 0; k <= 20; ++k) {
    add(k / 20., 0.);
  }
  REQUIRE(pose.result().status == vpReferenceStatus::Unique);
  const double before = pose.result().distanceSigma;
  CHECK(add(1., 20. * pixel) == vpReferenceStatus::Inconsistent);
  CHECK(add(1., 0.) == vpReferenceStatus::Unique);
  CHECK(pose.result().distanceSigma < 1.5 * before);
  for (int k = 0; k < 3; ++k) {
    CHECK(add(1., 20. * pixel) == vpReferenceStatus::Inconsistent);
  }
  add(0., 0.);
  CHECK(pose.result().found());
  CHECK(pose.result().distanceSigma > 2. * before);
}

TEST_CASE("broken input gives a status or a sentence", "[reference]")
{
  auto rng = generator(5);
  Scene scene(rng);
  vpReferencePose pose = scene.taught();
  const vpRigidTransform fMc = scene.fMr * scene.from;
  std::vector<vpServoPoint> seen = scene.image(scene.from, 0.5 * pixel), blind = seen;
  for (std::size_t i = 0; i < blind.size(); ++i) {
    (i % 2 == 0 ? blind[i].x : blind[i].y) = i % 3 == 0 ? undefined : std::numeric_limits<double>::infinity();
  }
  CHECK(pose.add(blind, pixel, &fMc).status == vpReferenceStatus::TooFewPoints);
  CHECK(pose.result().message == "The image shows 0 points of the reference, at least 8 are needed.");
  CHECK(pose.add(seen, 0.5 * pixel, &fMc).found());
  vpRigidTransform broken = fMc;
  broken.p.x() = undefined;
  CHECK(pose.add(seen, 0.5 * pixel, &broken).status == vpReferenceStatus::NoOdometry);
  CHECK(pose.add(seen, 0.5 * pixel, nullptr).status == vpReferenceStatus::NoOdometry);
  CHECK(pose.add(seen, 0.5 * pixel, &fMc).found());
  std::vector<vpServoPoint> line = seen;
  for (std::size_t i = 0; i < line.size(); ++i) {
    line[i].x = 0.001 * static_cast<double>(i);
    line[i].y = 0.;
  }
  CHECK_FALSE(pose.add(line, 0.5 * pixel, &fMc).found());
  CHECK_THROWS_WITH(pose.add(seen, 0., &fMc), Catch::Contains("sigma of the image points is 0, must be > 0"));
  seen.pop_back();
  CHECK_THROWS_WITH(pose.add(seen, pixel, &fMc), Catch::Contains("the image has 29 points, the reference has 30"));
  CHECK_THROWS_WITH(pose.setNormalPrior(Eigen::Vector3d::Zero(), 0.1),
                    Catch::Contains("the normal prior is (0, 0, 0)"));

  const auto refused = [&scene](void (*spoil)(vpReferencePoseSpec &), const std::string &sentence) {
    vpReferencePoseSpec spec = wide();
    spoil(spec);
    CHECK_THROWS_WITH(vpReferencePose(scene.reference(0.), pixel, spec), Catch::Contains(sentence));
  };
  refused([](vpReferencePoseSpec &s) { s.nearest = 0.; }, "nearest of the reference pose is 0 m, must be > 0");
  refused([](vpReferencePoseSpec &s) { s.farthest = 0.1; },
          "farthest of the reference pose is 0.1 m, must be at least nearest, 0.2 m");
  refused([](vpReferencePoseSpec &s) { s.slowness = undefined; }, "slowness of the reference pose is nan");
  refused([](vpReferencePoseSpec &s) { s.minPoints = 31; }, "the reference has 30 points, at least 31 are needed");
  std::vector<Eigen::Vector2d> points = scene.reference(0.);
  points[3].y() = undefined;
  CHECK_THROWS_WITH(vpReferencePose(points, pixel, wide()), Catch::Contains("reference point 3 is ("));
}

TEST_CASE("hours of images need no more memory or work than minutes", "[reference]")
{
  if (!vpTestSupport::canCountAllocations()) {
    vpTestSupport::skip("this build cannot count allocations");
    return;
  }
  auto rng = generator(6);
  Scene scene(rng);
  vpReferencePose pose = scene.taught();
  std::vector<unsigned long> rounds;
  for (int round = 0; round < 8; ++round) {
    unsigned long sum = 0;
    for (int k = 0; k < 60; ++k) {
      const vpRigidTransform rMc = scene.camera(0.5 + 0.5 * std::sin(0.105 * k)), fMc = scene.fMr * rMc;
      const std::vector<vpServoPoint> seen = scene.image(rMc, 0.5 * pixel);
      const unsigned long before = vpTestSupport::allocationCount();
      pose.add(seen, 0.5 * pixel, &fMc);
      sum += vpTestSupport::allocationCount() - before;
      CHECK(pose.result().images <= 32);
    }
    rounds.push_back(sum);
  }
  CHECK(pose.result().images > 24);
  CAPTURE(rounds);
  CHECK(rounds[7] < 1.3 * rounds[2]);
}
