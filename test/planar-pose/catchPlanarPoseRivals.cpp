/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Weak perspective: a plane has two poses with nearly the same image. VISP_DIRECT_LONG_TESTS multiplies the views.
#include "vpPlanarPoseKit.h"

#include <iostream>

using namespace vpPlanarPoseKit;

namespace
{
constexpr double width = 0.2, targetPixels = 120.;

struct Scene {
  double focal, height;
  vpPlaneRenderer renderer;
  vpPlanarTarget target;

  Scene(const Image &photo, double f)
    : focal(f), height(width * photo.getHeight() / photo.getWidth()),
      renderer(photo, width, height, camera(f), cols, rows), target(photo, width, height, camera(f))
  {}
  static vpCameraParameters camera(double f) { return vpCameraParameters(f, f, 0.5 * (cols - 1), 0.5 * (rows - 1)); }

  vpHomogeneousMatrix pose(double azimuth, double tilt, double roll) const
  {
    vpPoseError turn = vpPoseError::Zero(), tilted = vpPoseError::Zero();
    turn(5) = roll;
    tilted << 0., 0., focal * width / targetPixels, tilt * std::cos(azimuth), tilt * std::sin(azimuth), 0.;
    return vpMoved(vpMoved(vpHomogeneousMatrix(), turn), tilted);
  }
  const Image &view(const vpHomogeneousMatrix &cMo, unsigned int seed)
  {
    vpCameraFaults faults;
    faults.noise = 5.;
    faults.blur = 0.5;
    renderer.render(cMo, faults, seed, m_image);
    return m_image;
  }

private:
  Image m_image;
};

const Image &klimt()
{
  static const Image image = [] {
    Image I;
    vpImageIo::read(I, std::string(VISP_DIRECT_DATA_DIR) + "/target/klimt.jpg");
    return I;
  }();
  return image;
}

double turn(const vpHomogeneousMatrix &a, const vpHomogeneousMatrix &b) { return vpErrorOf(a, b).tail<3>().norm(); }

//! cMo is the right one of the two; without a rival, it is not the mirrored one.
bool isRight(const vpPlanarTargetResult &r, const vpHomogeneousMatrix &cMo, double tilt)
{
  return r.rival ? turn(r.cMo, cMo) <= turn(r.rival->cMo, cMo) : turn(r.cMo, cMo) < 1.2 * tilt;
}
} // namespace

TEST_CASE("no wrong pose is called certain at weak perspective", "[planar_target]")
{
  CAPTURE(vpTestSupport::seed());
  int ambiguous = 0;
  for (const double f : {20000., 10000., 5000., 3000.}) {
    Scene scene(klimt(), f);
    for (const double tilt : {4. * M_PI / 180., 8. * M_PI / 180.}) {
      int certain = 0, wrong = 0, undecided = 0, found = 0;
      double nees = 0.;
      const int n = vpTestSupport::longer(8);
      for (int i = 0; i < n; ++i) {
        auto rng = vpTestSupport::generator(static_cast<unsigned int>(f + 1000. * tilt + 100000. * i));
        const vpHomogeneousMatrix cMo = scene.pose(uniform(rng, 0., 2. * M_PI), tilt, uniform(rng, 0., 2. * M_PI));
        const vpPlanarTargetResult &r = scene.target.acquire(scene.view(cMo, static_cast<unsigned int>(rng())));
        CAPTURE(f, tilt, i, r.message);
        if (r.status == vpPlanarTargetStatus::Ambiguous) {
          ++undecided;
          REQUIRE(r.rival);
          CHECK_FALSE(r.found());
          CHECK(r.evidence >= 0.);
          // Both poses are given, and one of them is right; both fit to the noise.
          CHECK(std::min(turn(r.cMo, cMo), turn(r.rival->cMo, cMo)) < 0.6 * tilt);
          CHECK(r.residual == Approx(5.).epsilon(0.2));
          CHECK(r.rival->residual == Approx(r.residual).epsilon(0.02));
        }
        else if (r.found()) {
          ++certain;
          wrong += !isRight(r, cMo, tilt);
        }
        if ((r.found() || r.rival) && isRight(r, cMo, tilt)) {
          ++found;
          nees += squares(vpErrorOf(r.cMo, cMo), matrixOf(r.covariance));
        }
      }
      std::cout << "f " << f << ", tilt " << tilt * 180. / M_PI << ": " << certain << " certain, " << wrong
                << " of them wrong, " << undecided << " ambiguous of " << n << "; NEES of the right ones "
                << nees / found << "\n";
      CHECK(wrong == 0);
      CHECK(certain + undecided >= n * 9 / 10);
      ambiguous += undecided;
      if (f < 6000.) { // the images are over 20 deviations apart
        CHECK(certain >= n * 9 / 10);
      }
    }
  }
  CHECK(ambiguous > 0); // the sweep reaches where one frame cannot decide
}

TEST_CASE("several frames decide what one cannot, and a wrong choice is given up", "[planar_target]")
{
  CAPTURE(vpTestSupport::seed());
  Scene scene(klimt(), 20000.);
  const double tilt = 6. * M_PI / 180.;
  int decided = 0;
  const int n = vpTestSupport::longer(3);
  for (int i = 0; i < n; ++i) {
    auto rng = vpTestSupport::generator(7000000U + static_cast<unsigned int>(i));
    const double azimuth = uniform(rng, 0., 2. * M_PI), roll = uniform(rng, 0., 2. * M_PI);
    CAPTURE(i);
    scene.target.reset();
    // Started at the mirrored pose, as if the target had been mistaken before.
    const vpHomogeneousMatrix mirrored = scene.pose(azimuth + M_PI, tilt, roll);
    bool certain = false;
    for (int frame = 0; frame < 25; ++frame) {
      const vpHomogeneousMatrix cMo = scene.pose(azimuth + 0.02 * frame, tilt, roll);
      const Image &I = scene.view(cMo, static_cast<unsigned int>(rng()));
      const vpPlanarTargetResult &r = frame == 0 ? scene.target.track(I, mirrored) : scene.target.process(I);
      CAPTURE(frame, r.message);
      REQUIRE((r.found() || r.status == vpPlanarTargetStatus::Ambiguous));
      certain = r.found();
      if (certain) {
        CHECK(isRight(r, cMo, tilt));
      }
    }
    decided += certain;
  }
  CHECK(decided == n);
}

TEST_CASE("a target of the usual perspective is never ambiguous, seen from the front either", "[planar_target]")
{
  CAPTURE(vpTestSupport::seed());
  Scene scene(klimt(), 800.);
  for (int i = 0; i < vpTestSupport::longer(10); ++i) {
    auto rng = vpTestSupport::generator(8000000U + static_cast<unsigned int>(i));
    const vpHomogeneousMatrix cMo = scene.pose(uniform(rng, 0., 2. * M_PI), 0.01 * i, uniform(rng, -0.5, 0.5));
    const vpPlanarTargetResult &r =
        scene.target.track(scene.view(cMo, static_cast<unsigned int>(rng())), guess(cMo, rng));
    CAPTURE(i, r.message);
    CHECK(r.status == vpPlanarTargetStatus::Tracked);
    CHECK(squares(vpErrorOf(r.cMo, cMo), matrixOf(r.covariance)) < 6. * mostChi2(6.));
  }
}

TEST_CASE("the mirrored pose at strong perspective, given as the pose to start from, is never called certain",
          "[planar_target]")
{
  // Here one look at the rival decides, from whichever of the two it is seen.
  CAPTURE(vpTestSupport::seed());
  for (const double f : {800., 1500., 2500.}) {
    Scene scene(klimt(), f);
    int certain = 0;
    const int n = vpTestSupport::longer(6);
    for (int i = 0; i < n; ++i) {
      auto rng = vpTestSupport::generator(static_cast<unsigned int>(9000000. + f + 10000. * i));
      const double azimuth = uniform(rng, 0., 2. * M_PI), tilt = uniform(rng, 0.05, 0.5),
                   roll = uniform(rng, -M_PI, M_PI);
      const vpHomogeneousMatrix cMo = scene.pose(azimuth, tilt, roll);
      scene.target.reset();
      const vpPlanarTargetResult &r =
          scene.target.track(scene.view(cMo, static_cast<unsigned int>(rng())), scene.pose(azimuth + M_PI, tilt, roll));
      CAPTURE(f, tilt, i, r.message);
      if (r.found()) {
        ++certain;
        CHECK(turn(r.cMo, cMo) < tilt);
      }
    }
    std::cout << "f " << f << ", started at the mirrored pose: " << certain << " of " << n << " certain\n";
  }
}

TEST_CASE("hints that are no poses, other image sizes, and targets of any size: a status, never a wrong pose",
          "[planar_target]")
{
  CAPTURE(vpTestSupport::seed());
  Scene scene(klimt(), 800.);
  vpHomogeneousMatrix cMo = scene.pose(0.3, 0.2, 0.1);
  cMo[2][3] = 0.5;
  const Image I = scene.view(cMo, 1);
  vpHomogeneousMatrix hint = cMo;
  for (const double bad : {std::nan(""), 1e300, -1e300, HUGE_VAL}) {
    for (unsigned int k = 0; k < 12; ++k) {
      hint = cMo;
      hint[k / 4][k % 4] = bad;
      const vpPlanarTargetResult &r = scene.target.track(I, hint);
      CAPTURE(bad, k, r.message);
      CHECK_FALSE(r.found());
      CHECK_FALSE(r.covariance.known);
    }
  }
  Image small(120, 160), large(1000, 1400), wide(33, 2000);
  for (Image *other : {&small, &large, &wide}) {
    *other = 128;
    CHECK_FALSE(scene.target.track(*other, cMo).found());
    CHECK_FALSE(scene.target.process(*other).found());
  }
  // From as near as fills the frame many times over to a few pixels.
  for (double z = 0.05; z < 30.; z *= 1.3) {
    auto rng = vpTestSupport::generator(static_cast<unsigned int>(1000. * z));
    cMo[2][3] = z;
    const vpPlanarTargetResult &r = scene.target.track(scene.view(cMo, static_cast<unsigned int>(rng())), cMo);
    CAPTURE(z, r.message);
    if (r.found() && r.covariance.known) {
      CHECK(squares(vpErrorOf(r.cMo, cMo), matrixOf(r.covariance)) < 6. * 2. * mostChi2(6.));
    }
    if (z > 0.15 && z < 1.) {
      CHECK(r.covariance.known);
    }
  }
}
