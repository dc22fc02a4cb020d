/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Pictures against brute-force integration of the outline, centroids and phases against the true places.
#include "vpCatch.h"

#include <visp3/rendering/vpProductPattern.h>

#include <algorithm>
#include <cmath>
#include <complex>

VISP_DIRECT_USING_NAMESPACE

namespace
{
//! Cells so far apart that their blurs do not touch.
vpProductPatternSpec isolated(vpProductShape shape)
{
  vpProductPatternSpec spec;
  spec.width = 200;
  spec.height = 160;
  spec.pitchX = 71.3;
  spec.pitchY = 47.7;
  spec.openingX = 29.4;
  spec.openingY = 13.7;
  spec.cornerRadius = 4.2;
  spec.shape = shape;
  spec.noise = 0.;
  return spec;
}

struct Point {
  double x, y;
};

//! First moments of the difference from the ground, in a window around a cell.
template <class Grey>
Point centroid(const vpImage<Grey> &I, const vpPatternTruthCell &cell, double reach, double ground)
{
  double sum = 0., sx = 0., sy = 0.;
  for (int v = int(std::ceil(cell.y - reach)); v <= int(std::floor(cell.y + reach)); ++v) {
    for (int u = int(std::ceil(cell.x - reach)); u <= int(std::floor(cell.x + reach)); ++u) {
      if (v >= 0 && u >= 0 && v < int(I.getHeight()) && u < int(I.getWidth())) {
        const double weight = I[v][u] - ground;
        sum += weight;
        sx += weight * u;
        sy += weight * v;
      }
    }
  }
  return {sx / sum, sy / sum};
}

//! \brief Largest and mean error of the centroids of complete cells.
struct CentroidError {
  double worst = 0., meanX = 0., meanY = 0.;
  int cells = 0;
};

template <class Grey>
void measure(const vpProductPattern &product, double x, double y, const vpImage<Grey> &I, CentroidError &error)
{
  const double halfDiagonal = std::hypot(product.spec().openingX, product.spec().openingY) / 2.;
  for (const vpPatternTruthCell &cell : product.cells(x, y)) {
    const double reach = std::min(halfDiagonal + 5. * product.spec().psf + 3., product.spec().pitchY / 2.);
    const bool inside = cell.x > reach && cell.y > reach && cell.x < product.spec().width - reach - 1. &&
                        cell.y < product.spec().height - reach - 1.;
    if (inside && !cell.defective) {
      const Point found = centroid(I, cell, reach, product.spec().dark);
      error.worst = std::max({error.worst, std::fabs(found.x - cell.x), std::fabs(found.y - cell.y)});
      error.meanX += found.x - cell.x;
      error.meanY += found.y - cell.y;
      ++error.cells;
    }
  }
}

//! True if a point in product axes, relative to the centre of an opening, is open; independent implementation.
bool isOpen(const vpProductPatternSpec &spec, double p, double q)
{
  const double a = spec.openingX / 2., b = spec.openingY / 2.;
  if (spec.shape == vpProductShape::Dot) {
    return p * p / (a * a) + q * q / (b * b) <= 1.;
  }
  const double r = spec.shape == vpProductShape::Rounded ? spec.cornerRadius : 0.;
  const double dx = std::fabs(p) - (a - r), dy = std::fabs(q) - (b - r);
  return dx <= r && dy <= r && (dx <= 0. || dy <= 0. || dx * dx + dy * dy <= r * r);
}

//! Mean grey value of pixel (u, v): quasi-random points on the pixel, in the blur and in the exposure.
double integrate(const vpProductPatternSpec &spec, const vpPatternTruthCell &cell, double u, double v, double vx,
                 double vy)
{
  constexpr int points = 60000;
  constexpr double phi[5] = {0.88027, 0.77489, 0.68213, 0.60046, 0.52857}; // powers of 1 / the root of g^6 = g + 1
  const double c = std::cos(spec.rotation), s = std::sin(spec.rotation);
  const auto part = [](double x) { return x - std::floor(x); };
  int open = 0;
  for (int k = 0; k < points; ++k) {
    const double radius = spec.psf * std::sqrt(-2. * std::log(1. - part(phi[0] * k + 0.5)));
    const double angle = 2. * M_PI * part(phi[1] * k + 0.5);
    const double time = spec.exposure * (part(phi[4] * k + 0.5) - 0.5);
    const double x = u + part(phi[2] * k + 0.5) - 0.5 + radius * std::cos(angle) - cell.x - vx * time;
    const double y = v + part(phi[3] * k + 0.5) - 0.5 + radius * std::sin(angle) - cell.y - vy * time;
    open += isOpen(spec, c * x + s * y, c * y - s * x) ? 1 : 0;
  }
  return spec.dark + (spec.bright - spec.dark) * open / points;
}
} // namespace

TEST_CASE("Grey values are those of the outline, integrated by brute force", "[pattern]")
{
  auto rng = vpTestSupport::generator(1);
  CAPTURE(vpTestSupport::seed());
  std::uniform_real_distribution<double> unit(-1., 1.);
  double worst = 0., sum = 0.;
  int count = 0;
  for (int problem = 0; problem < 12; ++problem) {
    vpProductPatternSpec spec = isolated(static_cast<vpProductShape>(problem % 3));
    spec.rotation = problem % 2 == 0 ? 0. : unit(rng);
    spec.psf = problem < 9 ? 0.8 : 1.1 + unit(rng);
    spec.exposure = 0.5;
    const double vx = problem < 4 ? 0. : 12. * unit(rng), vy = problem < 4 ? 0. : 12. * unit(rng);
    const double x = 10. * unit(rng), y = 10. * unit(rng);
    const vpProductPattern product(spec);
    vpImage<float> I;
    product.expected(x, y, vx, vy, I);
    const auto cells = product.cells(x, y);
    const auto middle = std::find_if(cells.begin(), cells.end(), [](auto &c) { return c.row == 0 && c.column == 0; });
    REQUIRE(middle != cells.end());
    for (int k = 0; k < 25; ++k) {
      const int u = int(std::lround(middle->x + 17. * unit(rng))), v = int(std::lround(middle->y + 11. * unit(rng)));
      const double error = I[v][u] - integrate(spec, *middle, u, v, vx, vy);
      worst = std::max(worst, std::fabs(error));
      sum += error;
      ++count;
    }
  }
  CAPTURE(worst, sum / count);
  CHECK(worst < 0.6); // of a contrast of 110; that of the oracle itself
  CHECK(std::fabs(sum / count) < 0.04);
}

TEST_CASE("The centroid of a cell is its true place", "[pattern]")
{
  auto rng = vpTestSupport::generator(2);
  CAPTURE(vpTestSupport::seed());
  std::uniform_real_distribution<double> unit(-1., 1.);
  CentroidError exact, rounded;
  for (int problem = 0; problem < 120; ++problem) {
    vpProductPatternSpec spec = isolated(static_cast<vpProductShape>(problem % 3));
    spec.seed = problem;
    spec.rotation = problem % 4 == 0 ? 0. : 3. * unit(rng);
    spec.psf = 1. + 0.5 * unit(rng); // below 0.5 px the pixels undersample: their sum aliases as exp(-2 pi^2 psf^2)
    spec.jitter = 0.3;
    spec.exposure = 0.2;
    if (problem % 5 == 0) { // dark cells on bright ground
      std::swap(spec.dark, spec.bright);
    }
    const vpProductPattern product(spec);
    const double x = 1e4 * unit(rng), y = 1e4 * unit(rng), vx = 20. * unit(rng), vy = 20. * unit(rng);
    vpImage<float> clean;
    product.expected(x, y, vx, vy, clean);
    measure(product, x, y, clean, exact);
    vpImage<unsigned char> grey;
    product.render(x, y, vx, vy, problem, grey);
    measure(product, x, y, grey, rounded);
  }
  CAPTURE(exact.worst, rounded.worst, rounded.meanX / rounded.cells, rounded.meanY / rounded.cells);
  CHECK(exact.cells > 300);
  CHECK(exact.worst < 2e-4);
  // Rounding moves all pixels of an edge alike where it is parallel to them: each of a dozen columns by 0.0013 px
  // (0.289 of 110 grey levels, at both ends of 34 px), and this is five deviations of their sum; ...
  CHECK(rounded.worst < 0.023);
  CHECK(std::fabs(rounded.meanX / rounded.cells) < 6e-4); // ... without a bias
  CHECK(std::fabs(rounded.meanY / rounded.cells) < 6e-4);
}

TEST_CASE("An opening that is large has its place too", "[pattern]")
{
  vpProductPatternSpec spec = isolated(vpProductShape::Rounded);
  spec.width = 800;
  spec.height = 700;
  spec.pitchX = spec.pitchY = 660.;
  spec.openingX = 301.3;
  spec.openingY = 290.7;
  const vpProductPattern product(spec);
  CentroidError error;
  vpImage<float> I;
  product.expected(3.37, -2.81, 4., 0., I);
  measure(product, 3.37, -2.81, I, error);
  CHECK(error.cells == 1);
  CHECK(error.worst < 2e-3);
}

TEST_CASE("The phase of the pattern follows the displacement", "[pattern]")
{
  auto rng = vpTestSupport::generator(3);
  CAPTURE(vpTestSupport::seed());
  std::uniform_real_distribution<double> unit(-1., 1.);
  vpProductPatternSpec spec; // whole periods in the image
  spec.pitchX = 40.;
  spec.pitchY = 20.;
  spec.openingX = 28.3;
  spec.noise = 0.;
  const vpProductPattern product(spec);
  const auto phases = [&](double x, double y) {
    vpImage<float> I;
    product.expected(x, y, 7., 3., I);
    std::complex<double> px, py;
    for (unsigned int v = 0; v < spec.height; ++v) {
      for (unsigned int u = 0; u < spec.width; ++u) {
        px += std::polar<double>(I[v][u], -2. * M_PI * u / spec.pitchX);
        py += std::polar<double>(I[v][u], -2. * M_PI * v / spec.pitchY);
      }
    }
    return Point{-std::arg(px) * spec.pitchX / (2. * M_PI), -std::arg(py) * spec.pitchY / (2. * M_PI)};
  };
  const Point start = phases(0., 0.);
  for (int problem = 0; problem < 30; ++problem) {
    const double x = 1000. * unit(rng), y = 1000. * unit(rng);
    const Point now = phases(x, y);
    CHECK(std::remainder(now.x - start.x - x, spec.pitchX) == Approx(0.).margin(1e-4));
    CHECK(std::remainder(now.y - start.y - y, spec.pitchY) == Approx(0.).margin(1e-4));
  }
}

TEST_CASE("Damaged cells move as the others do", "[pattern]")
{
  auto rng = vpTestSupport::generator(4);
  CAPTURE(vpTestSupport::seed());
  std::uniform_real_distribution<double> unit(-1., 1.);
  vpProductPatternSpec spec = isolated(vpProductShape::Rounded);
  spec.damaged = 1.;
  spec.rotation = 0.3;
  const vpProductPattern product(spec);
  const auto middle = [&](double x, double y) {
    vpImage<float> I;
    product.expected(x, y, 0., 0., I);
    for (const vpPatternTruthCell &cell : product.cells(x, y)) {
      if (cell.row == 0 && cell.column == 0) {
        CHECK(cell.defective);
        const Point c = centroid(I, cell, 22., spec.dark);
        CHECK(std::hypot(c.x - cell.x, c.y - cell.y) > 1.); // a part is closed
        return Point{c.x - cell.x, c.y - cell.y};
      }
    }
    FAIL("cell (0, 0) is not in view");
    return Point{};
  };
  const Point start = middle(0., 0.);
  for (int problem = 0; problem < 20; ++problem) {
    const Point now = middle(20. * unit(rng), 20. * unit(rng));
    CHECK(now.x == Approx(start.x).margin(2e-3));
    CHECK(now.y == Approx(start.y).margin(2e-3));
  }
}

TEST_CASE("A displacement by whole pixels is a shift of the whole picture", "[pattern]")
{
  vpProductPatternSpec spec;
  spec.rotation = 0.1;
  spec.jitter = 0.3;
  spec.flexAmplitudeX = 3.;
  spec.flexPeriodX = 15.;
  spec.dust = 10.;
  spec.cracks = 4.;
  spec.missing = 0.1;
  spec.damaged = 0.1;
  const vpProductPattern product(spec);
  vpImage<float> A, B;
  product.expected(0.3, -0.2, 30., 10., A);
  float darkest = 255.F;
  for (const int dx : {-70, 40, 90}) {
    const int dy = dx / 5;
    product.expected(0.3 + dx, -0.2 + dy, 30., 10., B);
    float worst = 0.F;
    for (int v = std::max(0, dy); v < int(spec.height) + std::min(0, dy); ++v) {
      for (int u = std::max(0, dx); u < int(spec.width) + std::min(0, dx); ++u) {
        worst = std::max(worst, std::fabs(B[v][u] - A[v - dy][u - dx]));
        darkest = std::min(darkest, B[v][u]);
      }
    }
    CHECK(worst < 2e-3F);
  }
  CHECK(darkest < 30.F); // there is dust on the ground
}

TEST_CASE("A product of 2048 x 2048 px", "[pattern]")
{
  vpProductPatternSpec spec;
  spec.width = spec.height = 2048;
  const vpProductPattern product(spec);
  vpImage<unsigned char> I;
  product.render(5., 3., 5., 0., 1, I);
  REQUIRE(I.getWidth() == 2048);
  REQUIRE(I.getHeight() == 2048);
  const auto cells = product.cells(5., 3.);
  CHECK(double(cells.size()) == Approx(2048. * 2048. / (spec.pitchX * spec.pitchY)).epsilon(0.03));
  for (const vpPatternTruthCell &cell : cells) {
    if (cell.complete) {
      CHECK(int(I[int(std::lround(cell.y))][int(std::lround(cell.x))]) > 160);
    }
  }
}
