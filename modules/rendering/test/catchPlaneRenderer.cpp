/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpCatch.h"

#include <visp3/core/vpMeterPixelConversion.h>
#include <visp3/core/vpPixelMeterConversion.h>
#include <visp3/io/vpImageIo.h>
#include <visp3/robot/vpImageSimulator.h>
#include <visp3/rendering/vpPlaneRenderer.h>

#include <Eigen/LU>

#include <cmath>
#include <cstdlib>

VISP_DIRECT_USING_NAMESPACE

namespace
{
constexpr unsigned int width = 640, height = 480;
const vpHomogeneousMatrix behind(0., 0., -1., 0., 0., 0.);

vpCameraParameters makeCamera()
{
  vpCameraParameters camera;
  camera.initPersProjWithoutDistortion(790., 810., 318.3, 241.6);
  return camera;
}

// A photograph from a function of the pixel.
template <class Function> vpImage<unsigned char> makePhoto(unsigned int w, unsigned int h, Function grey)
{
  vpImage<unsigned char> photo(h, w);
  for (unsigned int v = 0; v < h; ++v) {
    for (unsigned int u = 0; u < w; ++u) {
      photo[v][u] = static_cast<unsigned char>(std::lround(grey(double(u), double(v))));
    }
  }
  return photo;
}

vpImage<unsigned char> render(vpPlaneRenderer &renderer, const vpHomogeneousMatrix &cMo)
{
  vpImage<unsigned char> image;
  renderer.render(cMo, vpCameraFaults(), 1, image);
  return image;
}

// Pixel of an image to pixel of the photograph, by the convention of the class and nothing else.
class ToPhoto
{
public:
  ToPhoto(const vpHomogeneousMatrix &cMo, double photoWidth, double photoHeight, double objectWidth,
          double objectHeight)
    : m_size(photoWidth, photoHeight), m_object(objectWidth, objectHeight)
  {
    for (unsigned int r = 0; r < 3; ++r) {
      m_toPlane.row(r) << cMo[r][0], cMo[r][1], cMo[r][3];
    }
    m_toPlane = m_toPlane.inverse().eval();
  }
  Eigen::Array2d operator()(double u, double v) const
  {
    double x = 0., y = 0.;
    vpPixelMeterConversion::convertPoint(m_camera, u, v, x, y);
    const Eigen::Vector3d q = m_toPlane * Eigen::Vector3d(x, y, 1.);
    return (q.head<2>().array() / q.z() / m_object + 0.5) * m_size - 0.5;
  }
  // Whether a pixel of the picture shows the photograph, at least this many of its pixels from the edge.
  bool inside(const Eigen::Array2d &p, double margin) const
  {
    return (p > margin).all() && (p < m_size - 1. - margin).all();
  }

private:
  Eigen::Array2d m_size, m_object;
  Eigen::Matrix3d m_toPlane;
  vpCameraParameters m_camera = makeCamera();
};

bool same(const vpImage<unsigned char> &a, vpImage<unsigned char> b) { return b == a; } // operator== is not const

vpHomogeneousMatrix randomView(std::mt19937_64 &rng, double tilt)
{
  std::uniform_real_distribution<double> unit(-1., 1.);
  return vpHomogeneousMatrix(0.04 * unit(rng), 0.03 * unit(rng), 0.6 + 0.1 * unit(rng), tilt * unit(rng),
                             tilt * unit(rng), unit(rng));
}
} // namespace

TEST_CASE("the centroid of a blob lies where it is projected", "[renderer]")
{
  auto rng = vpTestSupport::generator(1);
  CAPTURE(vpTestSupport::seed());
  std::uniform_real_distribution<double> unit(-1., 1.);
  const double W = 401, H = 300, objectWidth = 0.2, objectHeight = 0.15, sigma = 12.;
  for (int problem = 0; problem < 25; ++problem) {
    const double bu = 200. + 60. * unit(rng), bv = 150. + 30. * unit(rng);
    const auto photo = makePhoto(401, 300, [&](double u, double v) {
      return 20. + 230. * std::exp(-((u - bu) * (u - bu) + (v - bv) * (v - bv)) / (2. * sigma * sigma));
    });
    vpPlaneRenderer renderer(photo, objectWidth, objectHeight, makeCamera(), width, height);
    // Without tilt the centroid of the image is the image of the centroid. From finer to coarser than the photograph.
    const double Z = 0.25 + 0.03 * problem;
    const vpHomogeneousMatrix cMo(0.01 * unit(rng), 0.01 * unit(rng), Z, 0., 0., unit(rng));
    const auto image = render(renderer, cMo);
    const double X = ((bu + 0.5) / W - 0.5) * objectWidth, Y = ((bv + 0.5) / H - 0.5) * objectHeight;
    double u = 0., v = 0.;
    vpMeterPixelConversion::convertPoint(makeCamera(), (cMo[0][0] * X + cMo[0][1] * Y + cMo[0][3]) / Z,
                                         (cMo[1][0] * X + cMo[1][1] * Y + cMo[1][3]) / Z, u, v);
    const int reach = static_cast<int>(4. * sigma * objectWidth / W * 800. / Z);
    double sum = 0., su = 0., sv = 0.;
    for (int r = int(v) - reach; r <= int(v) + reach; ++r) {
      for (int c = int(u) - reach; c <= int(u) + reach; ++c) {
        const double weight = image[r][c] - 20.;
        sum += weight;
        su += weight * c;
        sv += weight * r;
      }
    }
    CAPTURE(problem, Z, u, v);
    REQUIRE(std::fabs(su / sum - u) < 0.02);
    REQUIRE(std::fabs(sv / sum - v) < 0.02);
  }
}

TEST_CASE("the photograph covers the object edge to edge", "[renderer]")
{
  auto rng = vpTestSupport::generator(2);
  CAPTURE(vpTestSupport::seed());
  // Coarse photographs, where leaving out half a pixel at each edge would take away up to a tenth of the area.
  const unsigned int size = GENERATE(8u, 20u, 333u, 1200u);
  const auto photo = makePhoto(size, size, [](double, double) { return 255.; });
  vpPlaneRenderer renderer(photo, 0.2, 0.15, makeCamera(), width, height);
  const auto background = render(renderer, behind);
  for (int problem = 0; problem < 20; ++problem) {
    const vpHomogeneousMatrix cMo = randomView(rng, 0.7);
    const auto image = render(renderer, cMo);
    double u[4], v[4], area = 0.;
    for (int i = 0; i < 4; ++i) {
      const double X = (i == 0 || i == 3) ? -0.1 : 0.1, Y = i < 2 ? -0.075 : 0.075;
      const double Z = cMo[2][0] * X + cMo[2][1] * Y + cMo[2][3];
      vpMeterPixelConversion::convertPoint(makeCamera(), (cMo[0][0] * X + cMo[0][1] * Y + cMo[0][3]) / Z,
                                           (cMo[1][0] * X + cMo[1][1] * Y + cMo[1][3]) / Z, u[i], v[i]);
    }
    for (int i = 0; i < 4; ++i) {
      const int k = (i + 1) % 4;
      area += 0.5 * (u[i] * v[k] - u[k] * v[i]);
    }
    double covered = 0.;
    for (unsigned int r = 0; r < height; ++r) {
      for (unsigned int c = 0; c < width; ++c) {
        covered += (double(image[r][c]) - background[r][c]) / (255. - background[r][c]);
      }
    }
    CAPTURE(size, problem, area);
    REQUIRE(covered == Approx(area).epsilon(0.001));
  }
}

TEST_CASE("grey values are those of the photograph at the back-projected place, tilt and scale whatever", "[renderer]")
{
  auto rng = vpTestSupport::generator(3);
  CAPTURE(vpTestSupport::seed());
  // Wavelengths of 40 px and more: averaging over a pixel changes little, a shift of a tenth of a pixel much.
  const unsigned int W = 500, H = 400;
  const auto grey = [](double u, double v) {
    return 128. + 60. * std::sin(u / 7.) * std::cos(v / 9.) + 30. * std::sin(v / 11.);
  };
  const auto photo = makePhoto(W, H, grey);
  vpPlaneRenderer renderer(photo, 0.2, 0.16, makeCamera(), width, height);
  for (int problem = 0; problem < 20; ++problem) {
    const vpHomogeneousMatrix cMo = randomView(rng, 0.8);
    const auto image = render(renderer, cMo);
    const ToPhoto toPhoto(cMo, W, H, 0.2, 0.16);
    // Least squares for the shift that explains the differences, and what is left.
    Eigen::Matrix2d N = Eigen::Matrix2d::Zero();
    Eigen::Vector2d b = Eigen::Vector2d::Zero();
    double squares = 0.;
    int count = 0;
    for (unsigned int r = 5; r < height - 5; ++r) {
      for (unsigned int c = 5; c < width - 5; ++c) {
        const Eigen::Array2d p = toPhoto(c, r);
        if (!toPhoto.inside(p, 8.)) {
          continue;
        }
        const Eigen::Array2d pu = toPhoto(c + 0.1, r), pv = toPhoto(c, r + 0.1);
        const Eigen::Vector2d gradient((grey(pu.x(), pu.y()) - grey(p.x(), p.y())) / 0.1,
                                       (grey(pv.x(), pv.y()) - grey(p.x(), p.y())) / 0.1);
        const double difference = image[r][c] - grey(p.x(), p.y());
        N += gradient * gradient.transpose();
        b += gradient * difference;
        squares += difference * difference;
        ++count;
      }
    }
    const Eigen::Vector2d shift = N.inverse() * b;
    CAPTURE(problem, shift.transpose(), count);
    REQUIRE(count > 10000);
    REQUIRE(shift.norm() < 0.01);
    REQUIRE(std::sqrt(squares / count) < 1.5);
  }
}

TEST_CASE("the picture agrees with vpImageSimulator, its conventions taken into account", "[renderer]")
{
  auto rng = vpTestSupport::generator(4);
  CAPTURE(vpTestSupport::seed());
  vpImage<unsigned char> photo;
  vpImageIo::read(photo, VISP_DIRECT_DATA_DIR "/target/box.png");
  // Magnified, so that neither averages over texels. vpImageSimulator puts the centres of corner pixels on its corners.
  const double W = photo.getWidth(), H = photo.getHeight(), pixel = 0.0012;
  vpPlaneRenderer renderer(photo, W * pixel, H * pixel, makeCamera(), width, height);
  const double x = 0.5 * (W - 1.) * pixel, y = 0.5 * (H - 1.) * pixel;
  vpColVector corners[4] = {vpColVector({-x, -y, 0.}), vpColVector({x, -y, 0.}), vpColVector({x, y, 0.}),
                            vpColVector({-x, y, 0.})};
  vpImageSimulator peer(vpImageSimulator::GRAY_SCALED);
  peer.setInterpolationType(vpImageSimulator::BILINEAR_INTERPOLATION);
  peer.init(photo, corners);
  for (int problem = 0; problem < 5; ++problem) {
    const vpHomogeneousMatrix cMo = randomView(rng, 0.3);
    const auto image = render(renderer, cMo);
    vpImage<unsigned char> other(height, width, 0);
    peer.setCameraPosition(cMo);
    peer.getImage(other, makeCamera());
    const ToPhoto toPhoto(cMo, W, H, W * pixel, H * pixel);
    double sum = 0., differences = 0.;
    int count = 0;
    for (unsigned int r = 5; r < height - 5; ++r) {
      for (unsigned int c = 5; c < width - 5; ++c) {
        if (toPhoto.inside(toPhoto(c, r), 3.)) {
          sum += std::fabs(double(image[r][c]) - other[r][c]);
          differences += double(image[r][c]) - other[r][c];
          ++count;
        }
      }
    }
    CAPTURE(problem, count);
    REQUIRE(count > 20000);
    REQUIRE(sum / count < 2.5);                          // it does not average over the pixel
    REQUIRE(std::fabs(differences / count - 0.5) < 0.2); // it truncates
  }
}

TEST_CASE("a photograph finer than the picture does not alias", "[renderer]")
{
  const auto photo = makePhoto(600, 600, [](double u, double v) { return (int(u) + int(v)) % 2 ? 255. : 0.; });
  vpPlaneRenderer renderer(photo, 0.2, 0.2, makeCamera(), width, height);
  for (double Z : {0.8, 1.1, 1.7, 3.1}) { // 3 to 12 photograph pixels a pixel
    const auto image = render(renderer, vpHomogeneousMatrix(0., 0., Z, 0.2, -0.1, 0.1));
    const int reach = static_cast<int>(0.06 * 800. / Z);
    for (int r = 240 - reach; r <= 240 + reach; ++r) {
      for (int c = 320 - reach; c <= 320 + reach; ++c) {
        CAPTURE(Z, r, c);
        REQUIRE(std::abs(image[r][c] - 128) < 10);
      }
    }
  }
}

TEST_CASE("objects that cannot be seen leave the background, near ones do not break it", "[renderer]")
{
  const auto photo = makePhoto(50, 40, [](double, double) { return 255.; });
  vpPlaneRenderer renderer(photo, 0.2, 0.2, makeCamera(), width, height);
  const auto background = render(renderer, behind);
  REQUIRE((background.getWidth() == width && background.getHeight() == height));
  unsigned char lowest = 255, highest = 0;
  for (unsigned int i = 0; i < background.getSize(); ++i) {
    lowest = std::min(lowest, background.bitmap[i]);
    highest = std::max(highest, background.bitmap[i]);
  }
  CHECK((lowest > 70 && highest < 190 && highest - lowest > 20));                            // faint, but not flat
  CHECK(same(render(renderer, vpHomogeneousMatrix(0., 0., 0.5, M_PI, 0., 0.)), background)); // its back
  CHECK(same(render(renderer, vpHomogeneousMatrix(5., 0., 0.5, 0., 0., 0.)), background));   // beside the picture
  CHECK(same(render(renderer, vpHomogeneousMatrix(0., -5., 0.5, 0., 0., 0.)), background));
  const auto full = render(renderer, vpHomogeneousMatrix(0., 0., 0.02, 0., 0., 0.)); // fills the picture
  CHECK((full[0][0] == 255 && full[height - 1][width - 1] == 255 && full[240][320] == 255));
  // Partly behind the camera: what is in front is drawn, down to its vanishing.
  const auto floor = render(renderer, vpHomogeneousMatrix(0., 0.02, 0.02, -1.2, 0., 0.));
  CHECK(floor[height - 1][320] == 255);
  CHECK(floor[0][320] == background[0][320]);
}

TEST_CASE("a renderer that cannot work is refused", "[renderer]")
{
  const vpImage<unsigned char> photo(50, 50, 100), tiny(7, 50, 100);
  vpCameraParameters distorting;
  distorting.initPersProjWithDistortion(800., 800., 320., 240., 0.1, -0.1);
  CHECK_THROWS_WITH(vpPlaneRenderer(tiny, 0.2, 0.2, makeCamera(), 640, 480), Catch::Contains("photo is 50x7 px"));
  CHECK_THROWS_WITH(vpPlaneRenderer(photo, 0., 0.2, makeCamera(), 640, 480),
                    Catch::Contains("object's size is 0 x 0.2 m"));
  CHECK_THROWS_WITH(vpPlaneRenderer(photo, 0.2, NAN, makeCamera(), 640, 480),
                    Catch::Contains("must be > 0 and finite"));
  CHECK_THROWS_WITH(vpPlaneRenderer(photo, 0.2, 0.2, distorting, 640, 480), Catch::Contains("distortion"));
  CHECK_THROWS_WITH(vpPlaneRenderer(photo, 0.2, 0.2, makeCamera(), 0, 480), Catch::Contains("image size is 0x480 px"));
}
