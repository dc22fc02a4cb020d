/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// From rendered images to the reference pose: keypoints, corners, homography, distance, motion.
#include "vpCatch.h"

#include "lab/servo/vpReferenceExperiment.h"

#include <visp3/core/vpException.h>
#include <visp3/core/vpMath.h>
#include <visp3/direct_core/vpQuantile.h>
#include <visp3/direct_core/vpSO3.h>
#include <visp3/io/vpImageIo.h>
#include <visp3/rendering/vpPlaneRenderer.h>
#include <visp3/servoing/vpReferenceTeacher.h>
#include <visp3/servoing/vpReferenceVision.h>

#include <cmath>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

VISP_DIRECT_USING_NAMESPACE

using vpTestSupport::generator;
using vpTestSupport::longer;
using vpTestSupport::seed;

namespace
{
// A camera that sees a photograph as the object of a start, with noise and blur.
class Camera
{
public:
  explicit Camera(const vpReferenceStart &start, double noise = 3.) : m_start(start)
  {
    vpImage<unsigned char> photo;
    vpImageIo::read(photo, VISP_DIRECT_DATA_DIR "/target/klimt.jpg");
    const double side = 0.25 * start.rMo.p.z();
    m_renderer = std::make_unique<vpPlaneRenderer>(photo, side, side, intrinsics(), 640, 480);
    m_faults.noise = noise;
    m_faults.blur = 0.5;
  }
  static vpCameraParameters intrinsics() { return vpCameraParameters(800., 800., 320., 240.); }
  const vpImage<unsigned char> &look(const vpRigidTransform &rMc)
  {
    m_renderer->render((rMc.inverse() * m_start.rMo).toHomogeneous(), m_faults, ++m_seed, m_image);
    return m_image;
  }

private:
  vpReferenceStart m_start;
  vpImage<unsigned char> m_image;
  std::unique_ptr<vpPlaneRenderer> m_renderer;
  vpCameraFaults m_faults;
  unsigned int m_seed = 0;
};

vpReferenceVisionSpec statedRange()
{
  vpReferenceVisionSpec spec;
  spec.pose.nearest = 0.2;
  spec.pose.farthest = 1.2;
  return spec;
}
} // namespace

TEST_CASE("images lead the camera to where the reference image was taken", "[reference][images]")
{
  CAPTURE(seed());
  const int count = longer(3);
  int unseen = 0;
  std::vector<double> rotation, translation, ratio;
  for (int i = 0; i < count; ++i) {
    CAPTURE(i);
    auto rng = generator(static_cast<unsigned int>(i));
    const vpReferenceStart start = vpReferenceStart::draw(rng);
    Camera camera(start);
    vpReferenceTeacher teacher;
    while (!teacher.isComplete()) {
      REQUIRE(teacher.add(camera.look({})));
    }
    vpReferenceVision vision(teacher.image(), Camera::intrinsics(), statedRange());
    const vpReferenceRun run =
        runReferenceExperiment(start, [&](const vpRigidTransform &rMc, const vpRigidTransform &fMc, double time,
                                          vpServoSight &sight) { vision.see(camera.look(rMc), time, &fMc, sight); });
    INFO(vision.message());
    if (run.endDistance == 0.) { // so small and oblique that no keypoints match: the camera stays, and says so
      ++unseen;
      CHECK(run.endRotation == Approx(vpSO3::log(start.rMc.R).norm()));
      CHECK_FALSE(vision.track().found);
      continue;
    }
    CHECK(run.arrived());
    CHECK(run.outOfView < 0.5);
    rotation.push_back(vpMath::deg(run.endRotation));
    translation.push_back(100. * run.endTranslation);
    ratio.push_back(std::abs(run.endDistance - start.distance) / run.endSigma);
    CHECK(run.endDistance == Approx(start.distance).epsilon(0.02));
  }
  std::cout << count << " runs on images, " << unseen << " not seen at the start; end " << vpMedian(rotation)
            << " deg (95 %: " << vpQuantile(rotation, 0.95) << "), " << vpMedian(translation) << " % of d ("
            << vpQuantile(translation, 0.95) << "), error of d " << vpMedian(ratio) << " sigma ("
            << vpQuantile(ratio, 0.95) << ")" << std::endl;
  CHECK(unseen <= 1 + count / 10);
  CHECK(vpMedian(rotation) < 0.2);
  CHECK(vpMedian(translation) < 0.2);
}

TEST_CASE("an image file alone serves as reference, without odometry, and a lost plane is reported",
          "[reference][images]")
{
  auto rng = generator(1);
  const vpReferenceStart start = vpReferenceStart::draw(rng);
  Camera camera(start);
  vpReferenceVision vision(camera.look({}), Camera::intrinsics(), statedRange());
  CHECK(vision.message() == "No image was given yet.");
  vpServoSight sight;
  vision.see(camera.look(start.rMc), 0.5, nullptr, sight);
  CHECK(sight.measurement.valid);
  CHECK(sight.hasGoal);
  CHECK(sight.measurement.time == 0.5);
  CHECK_THAT(vision.message(), Catch::Contains("without the robot's motion nothing more is known"));
  const vpServoGoal goal = vision.goal(sight.goal.cdMo);
  CHECK(goal.points.size() == sight.measurement.points.size());
  vision.see(vpImage<unsigned char>(480, 640, 90), 0.6, nullptr, sight);
  CHECK_FALSE(sight.measurement.valid);
  CHECK_FALSE(sight.hasGoal);
  CHECK_THAT(vision.message(), Catch::Contains("keypoints"));
  vision.see(camera.look({}), 0.7, nullptr, sight); // at the goal: neither turned nor moved
  REQUIRE(sight.measurement.valid);
  CHECK(vpSO3::log(vision.result().R).norm() < 0.01);
  CHECK(vision.result().tau.norm() < 0.01);
  vpReferenceVisionSpec bad = statedRange();
  bad.referenceNoise = 0.;
  CHECK_THROWS_WITH(vpReferenceVision(camera.look({}), Camera::intrinsics(), bad),
                    Catch::Contains("referenceNoise of the reference vision is 0 px, must be > 0"));
}

TEST_CASE("teaching averages the noise away and refuses a camera that moves", "[reference][images]")
{
  auto rng = generator(2);
  const vpReferenceStart start = vpReferenceStart::draw(rng);
  Camera camera(start), clean(start, 0.);
  const vpImage<unsigned char> truth = clean.look({});
  const auto noise = [&truth](const vpImage<unsigned char> &image) {
    double squares = 0.;
    for (unsigned int i = 0; i < truth.getSize(); ++i) {
      squares += (1. * image.bitmap[i] - truth.bitmap[i]) * (1. * image.bitmap[i] - truth.bitmap[i]);
    }
    return std::sqrt(squares / truth.getSize());
  };
  vpReferenceTeacher teacher(16);
  CHECK_THROWS_WITH(teacher.image(), Catch::Contains("was given no image"));
  REQUIRE(teacher.add(camera.look({})));
  const double one = noise(teacher.image());
  while (!teacher.isComplete()) {
    REQUIRE(teacher.add(camera.look({})));
  }
  CHECK(noise(teacher.image()) < 0.3 * one); // 1/4, and rounding
  CHECK(teacher.averageNoise() == Approx(teacher.pointNoise() / 4.));
  CHECK(teacher.pointNoise() < 0.1);
  CHECK_THAT(teacher.message(), Catch::Contains("16 of 16 images, noise of a corner 0.0"));
  CHECK(teacher.add(camera.look({Eigen::Matrix3d::Identity(), {2e-4 * start.distance, 0., 0.}}))); // 0.16 px
  CHECK_FALSE(teacher.add(camera.look({Eigen::Matrix3d::Identity(), {2e-3 * start.distance, 0., 0.}})));
  CHECK_THAT(teacher.message(), Catch::Contains("The camera or the scene has moved by 1."));
  CHECK_FALSE(teacher.isComplete());
  CHECK_THROWS_WITH(teacher.add(vpImage<unsigned char>(240, 320, 0)),
                    Catch::Contains("320x240 px, the first one 640x480"));
  CHECK_THROWS_WITH(vpReferenceTeacher(0), Catch::Contains("images of the reference teacher is 0, must be 1..1000"));
}
