/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// (7.27) by identity: against the known displacement, with cells that appear, leave and fail, and its reported sigma.
#include "vpCatch.h"

#include <visp3/core/vpException.h>
#include <visp3/printing/vpProductOdometer.h>

#include <algorithm>
#include <vector>

VISP_DIRECT_USING_NAMESPACE

namespace
{
constexpr double pitchX = 48.9, pitchY = 17.8;

//! The cells of a row-major lattice that lie in a 160 x 100 image, displaced, with errors.
std::vector<vpPatternCell> look(double x, double y, double sigma, std::mt19937_64 &rng)
{
  std::normal_distribution<double> normal(0., 1.);
  std::uniform_real_distribution<double> unit(0., 1.);
  std::vector<vpPatternCell> cells;
  for (int row = -60; row <= 60; ++row) {
    for (int column = -60; column <= 60; ++column) {
      const double u = 80. + column * pitchX + x, v = 50. + row * pitchY + y;
      if (u > 20. && u < 140. && v > 8. && v < 92.) {
        vpPatternCell cell;
        cell.row = row;
        cell.column = column;
        cell.sigmaX = sigma * (0.5 + unit(rng));
        cell.sigmaY = 0.5 * cell.sigmaX;
        cell.x = u + cell.sigmaX * normal(rng);
        cell.y = v + cell.sigmaY * normal(rng);
        cell.valid = unit(rng) > 0.1;
        if (!cell.valid) {
          cell.x += 1000.;
        }
        cells.push_back(cell);
      }
    }
  }
  return cells;
}
} // namespace

TEST_CASE("The velocity of matched cells is unbiased and as exact as it says", "[velocity]")
{
  auto rng = vpTestSupport::generator(20);
  CAPTURE(vpTestSupport::seed());
  std::uniform_real_distribution<double> place(-30., 30.), velocity(-12., 12.);
  double sum = 0., sum2 = 0.;
  int count = 0;
  for (int problem = 0; problem < 5000; ++problem) {
    const double x = place(rng), y = place(rng), vx = velocity(rng), vy = velocity(rng);
    const double frames = problem % 3 == 0 ? 2. : 1.;
    const auto before = look(x, y, 0.1, rng);
    auto now = look(x + frames * vx, y + frames * vy, 0.1, rng);
    if (problem % 5 == 0) {
      std::shuffle(now.begin(), now.end(), rng); // allowed, but slower
    }
    const vpCellVelocity found = vpFindCellVelocity(before.data(), before.size(), now.data(), now.size(), frames);
    int expected = 0;
    for (const auto &a : before) {
      expected += a.valid && std::any_of(now.begin(), now.end(), [&](const auto &b) {
                    return b.valid && b.row == a.row && b.column == a.column;
                  });
    }
    REQUIRE(found.cells == expected);
    if (found.cells > 0) {
      const double error = (found.vx - vx) / found.sigmaX;
      sum += error;
      sum2 += error * error;
      ++count;
      REQUIRE(std::fabs(error) < 6.);
      REQUIRE(std::fabs(found.vy - vy) < 6. * found.sigmaY);
    }
  }
  CHECK(sum / count == Approx(0.).margin(4. / std::sqrt(count)));
  CHECK(sum2 / count == Approx(1.).margin(4. * std::sqrt(2. / count)));
}

TEST_CASE("Nothing in common is no velocity", "[velocity]")
{
  vpPatternCell a, b;
  a.valid = b.valid = true;
  a.sigmaX = a.sigmaY = b.sigmaX = b.sigmaY = 0.1;
  b.column = 1;
  CHECK(vpFindCellVelocity(&a, 1, &b, 1).cells == 0);
  CHECK(vpFindCellVelocity(nullptr, 0, &b, 1).cells == 0);
  CHECK(vpFindCellVelocity(&a, 1, &a, 1, 0.).cells == 0);
  CHECK(vpFindCellVelocity(&a, 1, &a, 1, NAN).cells == 0);
  CHECK(vpFindCellVelocity(&a, 1, &a, 1).cells == 1);
  b = a;
  b.sigmaX = std::numeric_limits<double>::infinity();
  CHECK(vpFindCellVelocity(&a, 1, &b, 1).cells == 0);
}

TEST_CASE("The odometer loses nothing over dropped frames and bridges a change of epoch", "[odometer]")
{
  auto rng = vpTestSupport::generator(21);
  CAPTURE(vpTestSupport::seed());
  std::uniform_real_distribution<double> unit(0., 1.);
  for (int problem = 0; problem < 20; ++problem) {
    vpProductOdometer odometer;
    double x = 0.;
    for (int k = 0; k < 400; ++k) {
      x += 5. * std::sin(0.02 * k);
      if (k > 0 && k < 399 && unit(rng) < 0.1) {
        continue;
      }
      const auto cells = look(x, 0., 0.0153, rng);
      odometer.step(cells.data(), cells.size(), 0);
      REQUIRE(odometer.output().measured == (k > 0));
    }
    const double start = 0.; // sin(0) is 0: the first frame is at 0
    CHECK(odometer.output().x == Approx(x - start).margin(0.2));
    const auto cells = look(x + 3., 0., 0.0153, rng);
    const double before = odometer.output().x;
    odometer.step(cells.data(), cells.size(), 1, 2.9, 0.);
    CHECK_FALSE(odometer.output().measured);
    CHECK(odometer.output().x == Approx(before + 2.9));
  }
  CHECK_THROWS_WITH(vpProductOdometer(0),
                    Catch::Contains("capacity of the product odometer is 0, must be in [1, 65536]"));
}

TEST_CASE("Velocity and odometer do not allocate", "[velocity]")
{
  auto rng = vpTestSupport::generator(22);
  const auto a = look(0., 0., 0.1, rng), b = look(5., 0., 0.1, rng);
  vpProductOdometer odometer;
  const unsigned long before = vpTestSupport::allocationCount();
  for (int k = 0; k < 100; ++k) {
    odometer.step(a.data(), a.size(), 0);
    odometer.step(b.data(), b.size(), 0);
  }
  CHECK(vpTestSupport::allocationCount() == before);
}
