/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpCatch.h"
#include "vpPlanarScene.h"

#include <visp3/planar_target/vpPlaneMatcher.h>
#include <visp3/planar_target/vpTwoViewDecomposition.h>

namespace
{
using Image = vpPlanarScene::Image;

const vpPlanarScene::Target &klimt()
{
  static const vpPlanarScene::Target target = vpPlanarScene::klimt();
  return target;
}

vpPlanarTarget tracker() { return {klimt().image, klimt().width, klimt().height, vpPlanarScene::camera()}; }

Image viewOf(const vpHomogeneousMatrix &cMo, unsigned int seed = 1)
{
  auto rng = vpTestSupport::generator(seed);
  Image I = vpPlanarScene::background(rng);
  vpPlanarScene::draw(I, klimt(), vpPlanarScene::camera(), cMo);
  return I;
}

void requireNoPose(const vpPlanarTargetResult &r)
{
  CHECK_FALSE(r.found());
  CHECK_FALSE(r.message.empty());
  CHECK(r.cMo[2][3] == 0.); // nothing that could be mistaken for a pose
}
} // namespace

TEST_CASE("a target that moves is acquired once and then tracked", "[planar_target]")
{
  vpPlanarTarget target = tracker();
  CHECK(target.result().status == vpPlanarTargetStatus::NoFrame);
  for (int frame = 0; frame < 20; ++frame) {
    const vpHomogeneousMatrix cMo =
        vpPlanarScene::pose(0.002 * frame, -0.001 * frame, 0.5 + 0.003 * frame, 0.01 * frame, 0.1, 0.015 * frame);
    const vpPlanarTargetResult &r = target.process(viewOf(cMo, 10 + frame));
    CAPTURE(frame, r.message);
    REQUIRE(r.status == (frame == 0 ? vpPlanarTargetStatus::Acquired : vpPlanarTargetStatus::Tracked));
    CHECK(vpPlanarScene::positionError(cMo, r.cMo) < 1e-3);
    CHECK(std::sqrt(vpPlanarScene::rotationError(cMo, r.cMo).sumSquare()) < 0.05);
    // Homography, corners and pose agree.
    const double W = klimt().image.getWidth(), H = klimt().image.getHeight();
    const double reference[4][2] = {{-0.5, -0.5}, {W - 0.5, -0.5}, {W - 0.5, H - 0.5}, {-0.5, H - 0.5}};
    for (int k = 0; k < 4; ++k) {
      const auto &h = r.homography;
      const double u = reference[k][0], v = reference[k][1], w = h[6] * u + h[7] * v + h[8];
      CHECK((h[0] * u + h[1] * v + h[2]) / w == Approx(r.corners[k].get_u()).margin(1e-6));
      CHECK((h[3] * u + h[4] * v + h[5]) / w == Approx(r.corners[k].get_v()).margin(1e-6));
    }
  }
}

TEST_CASE("images without the target give a status and never a pose", "[planar_target]")
{
  auto rng = vpTestSupport::generator(20);
  CAPTURE(vpTestSupport::seed());
  vpPlanarTarget target = tracker();

  requireNoPose(target.process(Image(480, 640, 128)));
  CHECK(target.result().status == vpPlanarTargetStatus::NoTexture);
  requireNoPose(target.process(Image(1, 1, 0)));
  CHECK(target.result().status == vpPlanarTargetStatus::NoTexture);

  Image noise(480, 640);
  std::uniform_int_distribution<int> grey(0, 255);
  for (unsigned int i = 0; i < noise.getSize(); ++i) {
    noise.bitmap[i] = static_cast<unsigned char>(grey(rng));
  }
  requireNoPose(target.process(noise));
  CHECK(target.result().status == vpPlanarTargetStatus::TooFewInliers);

  const Image other = vpPlanarScene::photo("starry-night.jpg");
  requireNoPose(target.process(other));
  CHECK(target.result().status == vpPlanarTargetStatus::TooFewInliers);
}

TEST_CASE("a target that leaves, turns away or is covered is lost, and found again", "[planar_target]")
{
  vpPlanarTarget target = tracker();
  const vpHomogeneousMatrix front = vpPlanarScene::pose(0., 0., 0.5, 0., 0., 0.);
  REQUIRE(target.process(viewOf(front)).found());

  // Out of the image, step by step as with a moving camera.
  bool lost = false;
  for (int k = 1; k <= 40 && !lost; ++k) {
    const vpHomogeneousMatrix cMo = vpPlanarScene::pose(0.01 * k, 0., 0.5, 0., 0., 0.);
    const vpPlanarTargetResult &r = target.process(viewOf(cMo));
    if (r.found()) {
      CHECK(vpPlanarScene::positionError(cMo, r.cMo) < 5e-3);
    }
    lost = !r.found();
  }
  REQUIRE(lost);
  CAPTURE(target.result().message);
  CHECK((target.result().status == vpPlanarTargetStatus::OutOfView ||
         target.result().status == vpPlanarTargetStatus::TooFewInliers));
  requireNoPose(target.result());

  REQUIRE(target.process(viewOf(front)).status == vpPlanarTargetStatus::Acquired);
  auto rng = vpTestSupport::generator(30);
  requireNoPose(target.process(vpPlanarScene::background(rng))); // covered altogether
  REQUIRE(target.process(viewOf(front)).status == vpPlanarTargetStatus::Acquired);

  requireNoPose(target.track(viewOf(front), vpPlanarScene::pose(0., 0., 0.5, 0., M_PI, 0.)));
  CHECK(target.result().status == vpPlanarTargetStatus::OutOfView); // a guess from behind
  requireNoPose(target.track(viewOf(front)));                       // nothing to track from
  CHECK(target.result().status == vpPlanarTargetStatus::LowCorrelation);
  REQUIRE(target.track(viewOf(front), vpPlanarScene::pose(0.004, 0., 0.51, 0.02, 0., 0.02)).status ==
          vpPlanarTargetStatus::Tracked);
}

TEST_CASE("distortion of the lens is undone", "[planar_target]")
{
  vpCameraParameters lens;
  lens.initPersProjWithDistortion(800., 800., 319.5, 239.5, -0.2, 0.2);
  const vpHomogeneousMatrix cMo = vpPlanarScene::pose(0.03, -0.01, 0.5, 0.1, 0.2, -0.3);
  // Drawn without distortion, then distorted pixel by pixel: distorted (xd, yd) shows what is at (xd, yd) (1 + kdu
  // rd^2).
  Image straight(720, 960), bent(480, 640);
  vpPlanarScene::draw(straight, klimt(), vpCameraParameters(800., 800., 479.5, 359.5), cMo);
  for (unsigned int i = 0; i < bent.getHeight(); ++i) {
    for (unsigned int j = 0; j < bent.getWidth(); ++j) {
      const double x = (j - 319.5) / 800., y = (i - 239.5) / 800., f = 1. + 0.2 * (x * x + y * y);
      bent[i][j] = straight.getValue(359.5 + 800. * f * y, 479.5 + 800. * f * x);
    }
  }
  vpPlanarTarget target(klimt().image, klimt().width, klimt().height, lens);
  const vpPlanarTargetResult &r = target.process(bent);
  CAPTURE(r.message);
  REQUIRE(r.found());
  // kud = -kdu is ViSP's own first-order inverse: good to 4 kdu^2 r^4, which is 0.02 px here.
  CHECK(vpPlanarScene::positionError(cMo, r.cMo) < 1e-3);
  CHECK(std::sqrt(vpPlanarScene::rotationError(cMo, r.cMo).sumSquare()) < 0.1);
}

TEST_CASE("two photographs of one plane to motion up to scale", "[planar_target][two-view]")
{
  const vpHomogeneousMatrix c1Mo = vpPlanarScene::pose(0., 0., 0.5, 0., 0.1, 0.2);
  const vpHomogeneousMatrix c2Mo = vpPlanarScene::pose(0.02, 0.01, 0.45, 0.1, -0.1, -0.2);
  vpPlanarTargetSpec spec;
  spec.keypoints = vpKeypointType::SIFT;
  vpPlaneMatcher matcher(viewOf(c1Mo), spec);
  const vpPlaneMatch &match = matcher.match(viewOf(c2Mo));
  REQUIRE(match.found());
  vpTwoViewDecomposition decomposition;
  vpColVector prior(3);
  prior[2] = 1.;
  decomposition.setNormalPrior(prior);
  const vpTwoViewResult &motion =
      decomposition.process(match.euclidean(vpPlanarScene::camera()), match.referencePoints(vpPlanarScene::camera()));
  CAPTURE(motion.message);
  REQUIRE(motion.status == vpTwoViewStatus::Unique);
  const vpHomogeneousMatrix c2Mc1 = c2Mo * c1Mo.inverse();
  const vpThetaUVector error(motion.best.c2Rc1 * c2Mc1.getRotationMatrix().t());
  CHECK(std::sqrt(error.sumSquare()) < 0.02); // rad
  const double d = c1Mo[0][2] * c1Mo[0][3] + c1Mo[1][2] * c1Mo[1][3] + c1Mo[2][2] * c1Mo[2][3];
  for (unsigned int i = 0; i < 3; ++i) {
    CHECK(motion.best.t[i] * d == Approx(c2Mc1[i][3]).margin(0.01));
  }
  CHECK_FALSE(matcher.match(Image(480, 640, 7)).found());
}

TEST_CASE("a match says how many keypoints and pairs it came from", "[planar_target][two-view]")
{
  const vpHomogeneousMatrix c1Mo = vpPlanarScene::pose(0., 0., 0.5, 0., 0., 0.);
  const Image first = viewOf(c1Mo), second = viewOf(vpPlanarScene::pose(0.02, 0., 0.5, 0.1, 0., 0.));
  vpPlanarTargetSpec spec;
  for (const unsigned int budget : {100U, 400U}) { // SIFT keeps as many when there are more, and equals of the last
    spec.keypoints = vpKeypointType::SIFT;
    spec.maxKeypoints = budget;
    vpPlaneMatcher matcher(first, spec);
    const std::size_t ofReference = matcher.result().referenceKeypoints;
    CHECK(matcher.result().frameKeypoints == 0);
    const vpPlaneMatch &match = matcher.match(second);
    REQUIRE(match.found());
    CHECK(match.referenceKeypoints == ofReference);
    CHECK(ofReference >= budget);
    CHECK(ofReference <= budget + 5);
    CHECK(match.frameKeypoints >= budget);
    CHECK(match.frameKeypoints <= budget + 5);
    CHECK(match.matches >= match.inliers.size());
    CHECK(match.matches < budget);
    CHECK(match.message ==
          std::to_string(match.inliers.size()) + " of " + std::to_string(match.matches) + " matches agree.");
    // The same image: nearly every keypoint matches itself, except those at one position with two directions.
    CHECK(matcher.match(first).matches > 3 * budget / 4);
    // First no match, then no keypoints: unknown values are 0 again.
    CHECK(matcher.match(Image(480, 640, 7)).frameKeypoints == 0);
    CHECK(matcher.result().referenceKeypoints == ofReference);
    CHECK(matcher.match(Image(8, 8, 7)).matches == 0);
  }
}

TEST_CASE("set-up errors name the thing and its value", "[planar_target][errors]")
{
  using Catch::Contains;
  const vpCameraParameters camera = vpPlanarScene::camera();
  const auto make = [&](const Image &image, double width, const vpPlanarTargetSpec &spec = {}) {
    return vpPlanarTarget(image, width, 0.1, camera, spec);
  };
  CHECK_THROWS_WITH(make(Image(1, 1, 0), 0.1), Contains("reference image is 1x1 px, must be at least 32x32"));
  CHECK_THROWS_WITH(make(Image(100, 100, 90), 0.1), Contains("reference image is blank"));
  CHECK_THROWS_WITH(make(klimt().image, NAN), Contains("size of the target is nan x 0.1 m, must be > 0"));
  CHECK_THROWS_WITH(make(klimt().image, 1e308), Contains("size of the target is 1e+308 x 0.1 m, must be > 0"));
  CHECK_THROWS_WITH(make(klimt().image, 1e4), Contains("times as wide as high, must be from 0.1 to 10 times"));
  CHECK_THROWS_WITH(make(klimt().image, -1.), Contains("-1 x 0.1 m"));
  vpPlanarTargetSpec spec;
  spec.inlierThreshold = 0.;
  CHECK_THROWS_WITH(make(klimt().image, 0.1, spec),
                    Contains("inlierThreshold of the planar target is 0 px, must be > 0"));
  CHECK_THROWS_WITH(vpKeypointTypeFromString("FAST"), Contains("'FAST' is not known, choose one of ORB, SIFT, AKAZE"));
  CHECK(vpKeypointTypeFromString("SURF") == vpKeypointType::SURF);
  CHECK_THROWS_WITH(vpPlanarTarget(klimt().image, 0.1, 0.1, vpCameraParameters(0., 800., 1., 1.)), Contains("px = 0"));
  CHECK_THROWS_WITH(vpPlaneMatcher(Image(64, 64, 3)), Contains("too little texture"));
}
