/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The value type: image and product plane, ViSP's camera and its file.
#include "vpCatch.h"

#include <visp3/pattern/vpMicroscopeCalibration.h>

#include <visp3/core/vpException.h>
#include <visp3/core/vpMeterPixelConversion.h>
#include <visp3/core/vpPixelMeterConversion.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include <unistd.h>

VISP_DIRECT_USING_NAMESPACE

namespace
{
vpMicroscopeCalibration randomCalibration(std::mt19937_64 &rng)
{
  std::uniform_real_distribution<double> unit(-1., 1.);
  vpMicroscopeCalibration c;
  c.width = 640;
  c.height = 480;
  c.scaleX = 1e6 / (4. + 2. * unit(rng));
  c.scaleY = c.scaleX * (1. + 0.1 * unit(rng));
  c.rotation = M_PI * unit(rng);
  c.mirrored = unit(rng) > 0.;
  c.tx = 1e-3 * unit(rng);
  c.ty = 1e-3 * unit(rng);
  c.kappa1 = 3e-7 * unit(rng);
  c.u0 = 319.5 + 30. * unit(rng);
  c.v0 = 239.5 + 30. * unit(rng);
  return c;
}

//! \brief A file name that is free, and gone afterwards.
class FreeFile
{
public:
  FreeFile() : m_path(std::filesystem::temp_directory_path() / ("microscope-" + std::to_string(getpid()) + ".xml"))
  {
    std::filesystem::remove(m_path);
  }
  ~FreeFile() { std::filesystem::remove(m_path); }
  FreeFile(const FreeFile &) = delete;
  FreeFile &operator=(const FreeFile &) = delete;
  [[nodiscard]] std::string path() const { return m_path.string(); }

private:
  std::filesystem::path m_path;
};
} // namespace

TEST_CASE("image to plane is (7.7), and back is its inverse", "[calibration]")
{
  auto rng = vpTestSupport::generator(500);
  CAPTURE(vpTestSupport::seed());
  std::uniform_real_distribution<double> share(0., 1.);
  for (int problem = 0; problem < 20000; ++problem) {
    const vpMicroscopeCalibration c = randomCalibration(rng);
    const double u = 639. * share(rng), v = 479. * share(rng);
    const Eigen::Vector2d plane = c.toPlane(u, v);
    // (7.7), written out.
    const double y = c.mirrored ? -plane.y() : plane.y();
    const double du = u - c.u0, dv = (v - c.v0) * c.scaleX / c.scaleY, bend = 1. + c.kappa1 * (du * du + dv * dv);
    const double cs = std::cos(c.rotation), sn = std::sin(c.rotation);
    REQUIRE(du * bend == Approx(c.scaleX * (cs * plane.x() - sn * y + c.tx)).margin(1e-8));
    REQUIRE(dv * bend == Approx(c.scaleX * (sn * plane.x() + cs * y + c.ty)).margin(1e-8));
    const Eigen::Vector2d again = c.toImage(plane.x(), plane.y());
    REQUIRE(again.x() == Approx(u).margin(1e-8));
    REQUIRE(again.y() == Approx(v).margin(1e-8));
  }
}

TEST_CASE("strong distortions are inverted to the end of their range, beyond it there is nothing", "[calibration]")
{
  vpMicroscopeCalibration c;
  c.scaleX = c.scaleY = 1.;
  for (const double kappa : {1e-6, 1e-4, 1., -1e-6, -1e-4}) {
    c.kappa1 = kappa;
    const double end = kappa < 0. ? 1. / std::sqrt(-3. * kappa) : 1e4; // where the seen radius no longer grows
    CAPTURE(kappa);
    for (double share = 0.01; share < 0.9999; share += 0.01) {
      const double r = share * end;
      CHECK(c.toImage(r * (1. + kappa * r * r), 0.).x() == Approx(r).epsilon(1e-9));
    }
    if (kappa < 0.) {
      CHECK(std::isnan(c.toImage(1.001 * end * (1. + kappa * end * end), 0.).x()));
    }
  }
}

TEST_CASE("ViSP's conversions agree with the calibration", "[calibration]")
{
  auto rng = vpTestSupport::generator(501);
  CAPTURE(vpTestSupport::seed());
  std::uniform_real_distribution<double> share(0., 1.);
  double worst = 0.;
  for (int problem = 0; problem < 2000; ++problem) {
    vpMicroscopeCalibration c = randomCalibration(rng);
    c.kappa1 *= 0.3;
    c.rotation = c.tx = c.ty = 0.;
    c.mirrored = false;
    const vpCameraParameters camera = c.toCamera();
    const double u = 639. * share(rng), v = 479. * share(rng);
    double x = 0., y = 0., uAgain = 0., vAgain = 0.;
    vpPixelMeterConversion::convertPoint(camera, u, v, x, y);
    const Eigen::Vector2d plane = c.toPlane(u, v);
    REQUIRE(x == Approx(plane.x()).epsilon(1e-9).margin(1e-12));
    REQUIRE(y == Approx(plane.y()).epsilon(1e-9).margin(1e-12));
    vpMeterPixelConversion::convertPoint(camera, x, y, uAgain, vAgain);
    worst = std::max(worst, std::hypot(uAgain - u, vAgain - v));
    const double farU = c.u0 > 319.5 ? 0. : 639., farV = c.v0 > 239.5 ? 0. : 479.;
    const Eigen::Vector2d corner = c.toPlane(farU, farV);
    vpMeterPixelConversion::convertPoint(camera, corner.x(), corner.y(), uAgain, vAgain);
    REQUIRE(uAgain == Approx(farU).margin(1e-6));
    REQUIRE(vAgain == Approx(farV).margin(1e-6));
    const vpMicroscopeCalibration again = vpMicroscopeCalibration::fromCamera(camera, 640, 480);
    REQUIRE(again.kappa1 == Approx(c.kappa1).epsilon(1e-12));
    REQUIRE(again.scaleY == c.scaleY);
  }
  CHECK(worst < 0.3); // px; kud is another model than kdu, the two agree at the corner
}

TEST_CASE("a calibration survives ViSP's camera file", "[calibration]")
{
  auto rng = vpTestSupport::generator(502);
  CAPTURE(vpTestSupport::seed());
  const FreeFile file;
  const vpMicroscopeCalibration c = randomCalibration(rng);
  c.saveXml(file.path(), "microscope");
  const vpMicroscopeCalibration again = vpMicroscopeCalibration::loadXml(file.path(), "microscope", 640, 480);
  CHECK(again.width == 640);
  CHECK(again.scaleX == Approx(c.scaleX).epsilon(1e-9));
  CHECK(again.scaleY == Approx(c.scaleY).epsilon(1e-9));
  CHECK(again.u0 == Approx(c.u0).epsilon(1e-9));
  CHECK(again.v0 == Approx(c.v0).epsilon(1e-9));
  CHECK(again.kappa1 == Approx(c.kappa1).epsilon(1e-6));
  CHECK(again.rotation == 0.);
  CHECK_THROWS_WITH(c.saveXml(file.path()), Catch::Contains(file.path() + ": exists, ViSP would add to it"));
  CHECK_THROWS_WITH(vpMicroscopeCalibration::loadXml(file.path(), "telescope", 640, 480),
                    Catch::Contains("has no camera telescope with distortion for images of 640 x 480 px"));
  CHECK_THROWS_WITH(vpMicroscopeCalibration::loadXml(file.path(), "microscope", 160, 100),
                    Catch::Contains("for images of 160 x 100 px"));
  CHECK_THROWS_WITH(vpMicroscopeCalibration::loadXml("/none/camera.xml", "microscope", 640, 480),
                    Catch::Contains("/none/camera.xml: cannot be read"));
  CHECK_THROWS_WITH(c.saveXml("/none/camera.xml"), Catch::Contains("/none/camera.xml: cannot be written"));
  {
    std::ofstream(file.path()) << "no xml at all <";
  }
  CHECK_THROWS_WITH(vpMicroscopeCalibration::loadXml(file.path(), "microscope", 640, 480),
                    Catch::Contains("has no camera"));
}

TEST_CASE("a camera file that holds an impossible camera is named with the camera", "[calibration]")
{
  for (const char *px : {"0", "-600", "nan", "inf"}) {
    CAPTURE(px);
    const FreeFile file;
    std::ofstream(file.path())
        << "<root><camera><name>microscope</name><image_width>640</image_width>"
           "<image_height>480</image_height><model><type>perspectiveProjWithDistortion</type><px>"
        << px << "</px><py>600</py><u0>320</u0><v0>240</v0><kud>0</kud><kdu>0</kdu></model>"
        << "</camera></root>";
    CHECK_THROWS_WITH(vpMicroscopeCalibration::loadXml(file.path(), "microscope", 640, 480),
                      Catch::StartsWith(file.path() + ": camera microscope: "));
  }
}

TEST_CASE("cameras without a scale are refused", "[calibration]")
{
  vpCameraParameters camera(-600., 600., 1., 1.);
  CHECK_THROWS_WITH(vpMicroscopeCalibration::fromCamera(camera, 640, 480),
                    Catch::Contains("px of the camera is -600, must be > 0"));
  CHECK_THROWS_WITH(vpMicroscopeCalibration::fromCamera(vpCameraParameters(), 4, 480),
                    Catch::Contains("width of the calibration is 4 px, must be 8..65536"));
}
