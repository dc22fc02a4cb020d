/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Obstacles in images: position in the base, size, uncertainty, and why some are not seen.
#include "vpAvoidanceTestKit.h"
#include "vpCatch.h"
#include "vpPlanarScene.h"

#include <visp3/avoidance/vpObstacleDetector.h>
#include <visp3/core/vpException.h>
#include <visp3/core/vpPixelMeterConversion.h>
#include <visp3/vision/vpPose.h>

#include <Eigen/Eigenvalues>

using namespace vpAvoidanceTestKit;

namespace
{
const double depths[3] = {0., 0.05, 0.12}; // m; the first is not known

struct Photo {
  const char *name;
  vpPlanarScene::Target target;
};

const std::vector<Photo> &photos()
{
  static const std::vector<Photo> list = {{"klimt", {vpPlanarScene::photo("klimt.jpg"), 0.16, 0.16}},
                                          {"starry-night", {vpPlanarScene::photo("starry-night.jpg"), 0.2, 0.16}},
                                          {"box", {vpPlanarScene::photo("box.png"), 0.16, 0.11}}};
  return list;
}

vpObstacleDetector detector(int count, const vpObstacleDetectorSpec &spec = {})
{
  vpPlanarTargetDatabase database(vpPlanarScene::camera(), vpObstacleDetector::fastTargets());
  for (int i = 0; i < count; ++i) {
    const Photo &photo = photos()[static_cast<std::size_t>(i)];
    database.add(photo.name, photo.target.image, photo.target.width, photo.target.height, depths[i]);
  }
  return vpObstacleDetector(std::move(database), vpPlanarScene::camera(), spec);
}

//! A camera somewhere above the base.
vpRigidTransform someCamera(std::mt19937_64 &rng) { return {vpSO3::exp(2. * point(rng, 1.)), point(rng, 1.)}; }

std::string errorOf(const vpObstacleDetectorSpec &spec)
{
  try {
    spec.validate();
  }
  catch (const vpException &error) {
    return error.getStringMessage();
  }
  return "";
}
} // namespace

TEST_CASE("Three obstacles of one picture are boxes behind their photographs, in the base", "[detector]")
{
  auto rng = vpTestSupport::generator(721);
  CAPTURE(vpTestSupport::seed());
  vpObstacleDetector eye = detector(3);
  CHECK_FALSE(eye.detections()[0].seen);
  CHECK(eye.detections()[0].message == "No picture was taken yet.");
  const double x[3] = {-0.17, 0.13, -0.10}, y[3] = {-0.11, -0.11, 0.13};
  vpRigidTransform fMc = someCamera(rng);
  std::vector<vpRigidTransform> truth;
  for (int i = 0; i < 3; ++i) {
    truth.push_back(fMc *
                    vpRigidTransform::fromHomogeneous(vpPlanarScene::pose(x[i], y[i], 0.75, 0.05 * i, 0.25, -0.15)));
  }
  for (int frame = 0; frame < 3; ++frame) {
    // The camera moves by more than tracking alone could handle.
    fMc = fMc * vpRigidTransform{vpSO3::exp(Vector3d(0., 0., 0.1)), Vector3d(0.03, -0.02, 0.01)};
    vpPlanarScene::Image I = vpPlanarScene::background(rng);
    for (int i = 0; i < 3; ++i) {
      vpPlanarScene::draw(I, photos()[static_cast<std::size_t>(i)].target, vpPlanarScene::camera(),
                          (fMc.inverse() * truth[static_cast<std::size_t>(i)]).toHomogeneous());
    }
    const std::vector<vpObstacleDetection> &seen = eye.process(I, fMc, 0.1 * frame);
    REQUIRE(seen.size() == 3);
    for (std::size_t i = 0; i < 3; ++i) {
      CAPTURE(frame, seen[i].sighting.name, seen[i].message);
      REQUIRE(seen[i].seen);
      CHECK(seen[i].status == (frame == 0 ? vpPlanarTargetStatus::Acquired : vpPlanarTargetStatus::Tracked));
      const vpObjectSighting &sighting = seen[i].sighting;
      const double depth = i == 0 ? vpObstacleDetectorSpec().thickness : depths[i];
      CHECK(sighting.name == photos()[i].name);
      CHECK(sighting.time == 0.1 * frame);
      CHECK(sighting.shape.size() == Vector3d(photos()[i].target.width, photos()[i].target.height, depth));
      const Vector3d middle = truth[i].p + 0.5 * depth * truth[i].R.col(2);
      CHECK((sighting.pose.p - middle).norm() < 4. * sighting.positionSigma);
      CHECK((sighting.pose.p - middle).norm() < 3e-3);
      CHECK(vpSO3::log(sighting.pose.R * truth[i].R.transpose()).norm() < 4. * sighting.angleSigma);
      // The body lies on the other side of its face.
      CHECK((sighting.pose.p - fMc.p).norm() > (truth[i].p - fMc.p).norm());
    }
  }
}

TEST_CASE("Deviations are those of a pose from four corners with that noise, seen from anywhere", "[detector]")
{
  auto rng = vpTestSupport::generator(722);
  CAPTURE(vpTestSupport::seed());
  vpObstacleDetectorSpec spec;
  spec.greySigma = spec.cameraAngleSigma = spec.cameraPositionSigma = spec.scaleSigma = 0.;
  spec.pixelSigma = 0.4;
  const vpPlanarScene::Target &target = photos()[0].target;
  const double middle = 0.5 * spec.thickness;
  int compared = 0;
  for (int problem = 0; problem < 6; ++problem) {
    const vpHomogeneousMatrix cMo =
        vpPlanarScene::pose(uniform(rng, -0.1, 0.1), uniform(rng, -0.05, 0.05), uniform(rng, 0.4, 0.8),
                            uniform(rng, -1., 1.), uniform(rng, 0.3, 0.7), uniform(rng, -0.6, -0.3));
    vpPlanarScene::Image I = vpPlanarScene::background(rng);
    vpPlanarScene::draw(I, target, vpPlanarScene::camera(), cMo);
    vpObstacleDetector eye = detector(1, spec);
    const vpObstacleDetection seen = eye.process(I, vpRigidTransform(), 0.)[0];
    CAPTURE(problem, seen.message);
    REQUIRE(seen.seen);
    const double noise = spec.pixelSigma / eye.targets()[0].result.visible;
    const vpRigidTransform truth = vpRigidTransform::fromHomogeneous(cMo);
    Eigen::Matrix3d place = Eigen::Matrix3d::Zero(), turn = place;
    constexpr int draws = 600;
    for (int k = 0; k < draws; ++k) {
      vpPose pose;
      std::vector<vpPoint> corners;
      for (int i = 0; i < 4; ++i) {
        vpPoint corner((i % 2 == 0 ? -0.5 : 0.5) * target.width, (i / 2 == 0 ? -0.5 : 0.5) * target.height, 0.);
        corner.track(cMo);
        corner.set_x(corner.get_x() + std::normal_distribution<double>(0., noise / 800.)(rng));
        corner.set_y(corner.get_y() + std::normal_distribution<double>(0., noise / 800.)(rng));
        corners.push_back(corner);
      }
      pose.addPoints(corners);
      vpHomogeneousMatrix found = cMo;
      REQUIRE(pose.computePose(vpPose::VIRTUAL_VS, found));
      const vpRigidTransform other = vpRigidTransform::fromHomogeneous(found);
      const Vector3d dp = other.p + middle * other.R.col(2) - truth.p - middle * truth.R.col(2);
      const Vector3d dr = vpSO3::log(other.R * truth.R.transpose());
      place += dp * dp.transpose() / draws;
      turn += dr * dr.transpose() / draws;
    }
    const auto worst = [](const Eigen::Matrix3d &m) {
      return std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(m).eigenvalues()(2));
    };
    CHECK(seen.sighting.positionSigma == Approx(worst(place)).epsilon(0.2));
    CHECK(seen.sighting.angleSigma == Approx(worst(turn)).epsilon(0.2));
    ++compared;
  }
  CHECK(compared == 6);
}

TEST_CASE("What is not seen has a sentence that says why", "[detector]")
{
  auto rng = vpTestSupport::generator(723);
  const vpHomogeneousMatrix cMo = vpPlanarScene::pose(0.02, 0., 0.6, 0.1, 0.3, 0.2);
  vpPlanarScene::Image I = vpPlanarScene::background(rng);
  vpPlanarScene::draw(I, photos()[0].target, vpPlanarScene::camera(), cMo);
  vpObstacleDetector eye = detector(2);
  const std::vector<vpObstacleDetection> &seen = eye.process(I, vpRigidTransform(), 0.);
  CHECK(seen[0].seen);
  CHECK_FALSE(seen[1].seen); // not in the picture
  CHECK(seen[1].status == vpPlanarTargetStatus::TooFewInliers);
  CHECK_THAT(seen[1].message, Catch::Contains("matches agree on one plane"));

  vpRigidTransform nowhere;
  nowhere.p.x() = std::nan("");
  eye.process(I, nowhere, 0.1);
  CHECK_FALSE(seen[0].seen);
  CHECK(seen[0].message == "Where the camera was, or when, is not finite or out of range.");
  eye.process(I, vpRigidTransform(), 0.2);
  CHECK(seen[0].seen);
  eye.process(vpPlanarScene::Image(8, 8), vpRigidTransform(), 0.3);
  CHECK_FALSE(seen[0].seen);
  CHECK_THAT(seen[0].message, Catch::Contains("The image is 8x8 px"));
  eye.reset();
  CHECK(seen[0].status == vpPlanarTargetStatus::NoFrame);

  vpObstacleDetectorSpec strict;
  strict.maxPositionSigma = 1e-4;
  vpObstacleDetector doubting = detector(1, strict);
  CHECK_FALSE(doubting.process(I, vpRigidTransform(), 0.)[0].seen);
  CHECK_THAT(doubting.detections()[0].message, Catch::Contains("Its place is uncertain by 1 mm"));
}

TEST_CASE("A worse picture and a worse known camera make an obstacle less certain", "[detector]")
{
  auto rng = vpTestSupport::generator(724);
  const vpHomogeneousMatrix cMo = vpPlanarScene::pose(0.02, 0., 0.6, 0.1, 0.3, 0.2);
  vpPlanarScene::Image I = vpPlanarScene::background(rng);
  vpPlanarScene::draw(I, photos()[0].target, vpPlanarScene::camera(), cMo);
  vpObstacleDetector clear = detector(1), noisy = detector(1);
  const vpObjectSighting before = clear.process(I, vpRigidTransform(), 0.)[0].sighting;
  vpPlanarScene::spoil(I, 1., 0.8, 10., rng);
  const vpObstacleDetection after = noisy.process(I, vpRigidTransform(), 0.)[0];
  REQUIRE(after.seen);
  CHECK(after.sighting.angleSigma > 1.2 * before.angleSigma);
  CHECK(after.sighting.positionSigma > before.positionSigma);
  vpObstacleDetectorSpec spec;
  spec.cameraPositionSigma = 0.02;
  vpObstacleDetector shaky = detector(1, spec);
  CHECK(shaky.process(I, vpRigidTransform(), 0.)[0].sighting.positionSigma == Approx(0.02).epsilon(0.05));
}

TEST_CASE("A detector that cannot work is refused", "[detector]")
{
  CHECK_THROWS_WITH(vpObstacleDetector(vpPlanarTargetDatabase(vpPlanarScene::camera()), vpPlanarScene::camera()),
                    Catch::Contains("the database of the obstacle detector has no target"));
  vpObstacleDetectorSpec spec;
  spec.thickness = 0.;
  CHECK(errorOf(spec) == "thickness of the obstacle detector is 0 m, must be > 0");
  spec = vpObstacleDetectorSpec();
  spec.cameraAngleSigma = -1.;
  CHECK(errorOf(spec) == "cameraAngleSigma of the obstacle detector is -1 rad, must be >= 0");
  spec = vpObstacleDetectorSpec();
  spec.pixelSigma = std::nan("");
  CHECK(errorOf(spec) == "pixelSigma of the obstacle detector is nan px, must be > 0 and finite");
}
