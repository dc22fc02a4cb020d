/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpCatch.h"

#include <visp3/rendering/vpPlaneRenderer.h>

#include <cmath>

VISP_DIRECT_USING_NAMESPACE

namespace
{
constexpr unsigned int width = 640, height = 480;

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

vpImage<unsigned char> render(vpPlaneRenderer &renderer, const vpHomogeneousMatrix &cMo,
                              const vpCameraFaults &faults = {}, unsigned int seed = 1)
{
  vpImage<unsigned char> image;
  renderer.render(cMo, faults, seed, image);
  return image;
}

bool same(const vpImage<unsigned char> &a, vpImage<unsigned char> b) { return b == a; } // operator== is not const

vpHomogeneousMatrix randomView(std::mt19937_64 &rng, double tilt)
{
  std::uniform_real_distribution<double> unit(-1., 1.);
  return vpHomogeneousMatrix(0.04 * unit(rng), 0.03 * unit(rng), 0.6 + 0.1 * unit(rng), tilt * unit(rng),
                             tilt * unit(rng), unit(rng));
}
} // namespace

TEST_CASE("faults are what they say", "[faults]")
{
  const auto photo =
      makePhoto(64, 64, [](double u, double v) { return u >= 30 && u < 34 && v >= 30 && v < 34 ? 240. : 100.; });
  vpPlaneRenderer renderer(photo, 0.2, 0.2, makeCamera(), width, height);
  const vpHomogeneousMatrix cMo(0., 0., 0.6, 0., 0., 0.);
  const auto clean = render(renderer, cMo);

  SECTION("noise")
  {
    vpCameraFaults faults;
    faults.noise = 5.;
    const auto noisy = render(renderer, cMo, faults, 7);
    double sum = 0., squares = 0., neighbours = 0.;
    for (unsigned int i = 0; i < clean.getSize(); ++i) {
      const double d = double(noisy.bitmap[i]) - clean.bitmap[i];
      sum += d;
      squares += d * d;
      neighbours += i > 0 ? d * (double(noisy.bitmap[i - 1]) - clean.bitmap[i - 1]) : 0.;
    }
    const double n = clean.getSize();
    CHECK(std::sqrt(squares / n - 1. / 12.) == Approx(5.).epsilon(0.02)); // rounding adds 1/12
    CHECK(std::fabs(sum / n) < 0.1);
    CHECK(std::fabs(neighbours / squares) < 0.02);
    CHECK(same(render(renderer, cMo, faults, 7), noisy)); // repeatable
    CHECK_FALSE(same(render(renderer, cMo, faults, 8), noisy));
  }
  SECTION("gain and bias")
  {
    vpCameraFaults faults;
    faults.gain = 0.8;
    faults.bias = 12.;
    const auto image = render(renderer, cMo, faults);
    for (unsigned int i = 0; i < clean.getSize(); ++i) {
      REQUIRE(std::fabs(image.bitmap[i] - (0.8 * clean.bitmap[i] + 12.)) <= 0.5001);
    }
    faults.gain = 4.; // saturates, does not wrap
    CHECK(render(renderer, cMo, faults)[240][320] == 255);
    faults.bias = -1000.;
    CHECK(render(renderer, cMo, faults)[240][320] == 0);
  }
  SECTION("blur adds its variance to the spot and keeps its light")
  {
    vpCameraFaults faults;
    faults.blur = 2.;
    const auto blurred = render(renderer, cMo, faults);
    const auto moments = [](const vpImage<unsigned char> &image, double &light, double &variance) {
      light = variance = 0.;
      for (int r = 200; r < 284; ++r) {
        for (int c = 276; c < 360; ++c) {
          light += image[r][c] - 100.;
          variance += (image[r][c] - 100.) * (c - 318.3) * (c - 318.3);
        }
      }
      variance /= light;
    };
    double light0 = 0., variance0 = 0., light = 0., variance = 0.;
    moments(clean, light0, variance0);
    moments(blurred, light, variance);
    CHECK(light == Approx(light0).epsilon(0.02));
    CHECK(variance - variance0 == Approx(4.).epsilon(0.1));
  }
  SECTION("occlusion hides the share that is asked for, in one place that moves with the object")
  {
    auto rng = vpTestSupport::generator(5);
    CAPTURE(vpTestSupport::seed());
    vpPlaneRenderer white(makePhoto(16, 16, [](double, double) { return 255.; }), 0.2, 0.2, makeCamera(), width,
                          height);
    vpPlaneRenderer black(makePhoto(16, 16, [](double, double) { return 0.; }), 0.2, 0.2, makeCamera(), width, height);
    for (unsigned int occluder = 0; occluder < 10; ++occluder) {
      for (double share : {0.1, 0.25, 0.9}) {
        // White, then black: what neither changes is hidden.
        const vpHomogeneousMatrix view = occluder == 9
                                             ? vpHomogeneousMatrix(0.15, 0., 0.47, 0., 0.2, 0.) // partly outside
                                             : randomView(rng, 0.6);
        vpCameraFaults faults;
        faults.occlusion = share;
        faults.occluder = occluder;
        const auto w = render(white, view), b = render(black, view), wo = render(white, view, faults),
                   bo = render(black, view, faults);
        double area = 0., hidden = 0.;
        for (unsigned int i = 0; i < w.getSize(); ++i) {
          const double coverage = (double(w.bitmap[i]) - b.bitmap[i]) / 255.;
          area += coverage;
          hidden += wo.bitmap[i] == bo.bitmap[i] ? coverage : 0.;
        }
        CAPTURE(occluder, share, area);
        REQUIRE(hidden / area == Approx(share).margin(0.005));
        REQUIRE(same(render(white, view, faults, 99), wo)); // the seed of the noise does not move it
      }
    }
  }
  SECTION("values out of range are named")
  {
    const struct {
      double vpCameraFaults::*field;
      double value;
      const char *sentence;
    } wrong[] = {{&vpCameraFaults::noise, -1., "noise of the camera's faults is -1, must be >= 0"},
                 {&vpCameraFaults::blur, 6., "blur of the camera's faults is 6 px, must be 0..5"},
                 {&vpCameraFaults::gain, 0., "gain of the camera's faults is 0, must be > 0"},
                 {&vpCameraFaults::bias, NAN, "bias of the camera's faults is"},
                 {&vpCameraFaults::occlusion, 0.95, "occlusion of the camera's faults is 0.95, must be 0..0.9"}};
    for (const auto &w : wrong) {
      vpCameraFaults faults;
      faults.*w.field = w.value;
      CHECK_THROWS_WITH(render(renderer, cMo, faults), Catch::Contains(w.sentence));
    }
  }
}
