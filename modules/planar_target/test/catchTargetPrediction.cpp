/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The derivatives of a prediction, by position, pose and blur, against differences of predictions.
#include "vpCatch.h"
#include "vpPlanarScene.h"
#include "vpTargetPrediction.h"

#include <visp3/direct_core/vpSO3.h>

#include <functional>

namespace
{
using Vector6 = Eigen::Matrix<double, 6, 1>;

constexpr double blur = 0.7;

// Waves of 70 texels, some 40 px: between bilinear samples the prediction itself is smooth only over a texel and more.
vpPlanarScene::Image waves()
{
  vpPlanarScene::Image image(560, 560);
  for (unsigned int r = 0; r < image.getHeight(); ++r) {
    for (unsigned int c = 0; c < image.getWidth(); ++c) {
      image[r][c] = static_cast<unsigned char>(std::lround(
          125. + 55. * std::sin(0.07 * c + 0.02 * r) * std::cos(0.08 * r) + 40. * std::sin(0.05 * (c + 1.4 * r))));
    }
  }
  return image;
}

struct Scene {
  vpPlanarScene::Target target{waves(), 0.2, 0.2};
  vpTargetPlane plane{target.width, target.height, static_cast<int>(target.image.getWidth()),
                      static_cast<int>(target.image.getHeight())};
  vpTargetTexture texture{cv::Mat(plane.rows, plane.cols, CV_8UC1, target.image.bitmap), plane};
  vpPinhole camera{800., 790., 320., 240., 0.};
};

vpRigidPose moved(const vpRigidPose &pose, const Vector6 &e)
{
  return {vpSO3::exp(e.tail<3>()) * pose.R, pose.t + e.head<3>()};
}

vpRigidPose randomPose(std::mt19937_64 &rng)
{
  return vpRigidPose::fromMatrix(vpPlanarScene::randomPose(rng, M_PI / 6.));
}

/*!
 * Largest relative deviation, root mean square over the pixels that all three predictions hold, of
 * \e derivative(prediction, row, column, u, v) from the difference of grey values between \e plus and \e minus over
 * \e step.
 */
double deviation(const vpTargetPrediction &at, const vpTargetPrediction &plus, const vpTargetPrediction &minus,
                 double step, const std::function<double(int, int)> &derivative)
{
  double error = 0., size = 0.;
  for (int r = 0; r < at.area().height; ++r) {
    for (int c = at.spans()[static_cast<std::size_t>(r)].begin; c < at.spans()[static_cast<std::size_t>(r)].end; ++c) {
      const auto grey = [&](const vpTargetPrediction &p, double &value) {
        const int row = at.area().y + r - p.area().y, col = at.area().x + c - p.area().x;
        if (row < 0 || row >= p.area().height) {
          return false;
        }
        const vpTargetPrediction::Span span = p.spans()[static_cast<std::size_t>(row)];
        value = col >= span.begin && col < span.end ? p.grey().at<float>(row, col) : 0.;
        return col >= span.begin && col < span.end;
      };
      double a, b;
      if (grey(plus, a) && grey(minus, b)) {
        const double difference = (a - b) / step, d = derivative(r, c);
        error += (d - difference) * (d - difference);
        size += difference * difference;
      }
    }
  }
  REQUIRE(size > 0.);
  return std::sqrt(error / size);
}
} // namespace

TEST_CASE("derivatives of the predicted grey values by the pose agree with differences", "[planar_target]")
{
  CAPTURE(vpTestSupport::seed());
  Scene scene;
  for (const double kud : {0., -0.15}) {
    scene.camera.kud = kud;
    for (unsigned int i = 0; i < 2; ++i) {
      auto rng = vpTestSupport::generator(i);
      const vpRigidPose pose = randomPose(rng);
      vpTargetPrediction at(scene.plane), plus(scene.plane), minus(scene.plane);
      REQUIRE(at.predict(scene.texture, pose, scene.camera, {640, 480}, blur));
      for (int k = 0; k < 6; ++k) {
        const double h = k < 2 ? 6e-4 : k == 2 ? 3e-3 : k == 5 ? 5e-3 : 1e-2; // about a pixel
        REQUIRE(plus.predict(scene.texture, moved(pose, Vector6::Unit(k) * h), scene.camera, {640, 480}, blur));
        REQUIRE(minus.predict(scene.texture, moved(pose, -Vector6::Unit(k) * h), scene.camera, {640, 480}, blur));
        CAPTURE(kud, i, k);
        // A wave of w rad/px differs by w^2 / 6 from its difference over two pixels, 0.6 %, plus rounded grey values.
        CHECK(
            deviation(at, plus, minus, 2. * h, [&](int r, int c) {
              const Vector6 motion =
                  -(at.du().at<float>(r, c) * pixelMotion(pose, scene.camera, at.area().x + c, at.area().y + r).row(0) +
                    at.dv().at<float>(r, c) * pixelMotion(pose, scene.camera, at.area().x + c, at.area().y + r).row(1))
                       .transpose();
              return motion(k);
            }) < 0.015);
      }
    }
  }
}

TEST_CASE("the derivative by the blur agrees with differences, from sharp to soft", "[planar_target]")
{
  CAPTURE(vpTestSupport::seed());
  Scene scene;
  auto rng = vpTestSupport::generator(9);
  const vpRigidPose pose = randomPose(rng);
  for (const double sigma : {0.3, 0.5, 0.8, 1.5, 3.}) {
    vpTargetPrediction at(scene.plane), plus(scene.plane), minus(scene.plane);
    const double h = 0.01;
    REQUIRE(at.predict(scene.texture, pose, scene.camera, {640, 480}, sigma));
    REQUIRE(plus.predict(scene.texture, pose, scene.camera, {640, 480}, std::sqrt(sigma * sigma + 2. * h)));
    REQUIRE(minus.predict(scene.texture, pose, scene.camera, {640, 480}, std::sqrt(sigma * sigma - 2. * h)));
    CAPTURE(sigma);
    // The kernel ends at three deviations, where a Gaussian has 3 % of its second moment and 10 % of its change.
    CHECK(deviation(at, plus, minus, 2. * h, [&](int r, int c) { return at.dBlur().at<float>(r, c); }) < 0.12);
  }
}

TEST_CASE("the motion of a pixel agrees with that of the point which it shows", "[planar_target]")
{
  CAPTURE(vpTestSupport::seed());
  Scene scene;
  scene.camera.kud = 0.1;
  for (unsigned int i = 0; i < 200; ++i) {
    auto rng = vpTestSupport::generator(100 + i);
    const vpRigidPose pose = randomPose(rng);
    std::uniform_real_distribution<double> place(200., 440.), unit(-1., 1.);
    const double u = place(rng), v = 0.5 * place(rng), h = 1e-5;
    Vector6 e;
    for (int k = 0; k < 6; ++k) {
      e(k) = unit(rng);
    }
    const Eigen::Vector2d difference = (pixelShift(pose, moved(pose, h * e), scene.camera, u, v) -
                                        pixelShift(pose, moved(pose, -h * e), scene.camera, u, v)) /
                                       (2. * h);
    const Eigen::Vector2d motion = pixelMotion(pose, scene.camera, u, v) * e;
    CAPTURE(i);
    CHECK((motion - difference).norm() < 1e-4 * (1. + difference.norm()));
  }
}
