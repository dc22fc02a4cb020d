/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Thesis (7.24) and (7.27) as printed on a passing product, compared with those used here. See doc/errata.md.
#include "vpCatch.h"

#include <visp3/printing/vpAlphaBetaFilter.h>
#include <visp3/printing/vpCellVelocity.h>

#include <vector>

VISP_DIRECT_USING_NAMESPACE

namespace
{
constexpr double pitch = 48.9, width = 160.;
constexpr int columns = 200; // to the left: 1000 frames at 8 px/frame at most pass 164

// One row of a product at \e x: the cells that lie in the image, from left to right.
std::vector<vpPatternCell> look(double x)
{
  std::vector<vpPatternCell> cells;
  for (int column = -columns; column <= 4; ++column) {
    vpPatternCell cell;
    cell.column = column;
    cell.x = x + column * pitch;
    cell.sigmaX = cell.sigmaY = 0.1;
    cell.valid = true;
    if (cell.x > 20. && cell.x < width - 20.) {
      cells.push_back(cell);
    }
  }
  return cells;
}
} // namespace

TEST_CASE("(7.27): counted from the left the velocity jumps when a cell enters, by identity it does not", "[errata]")
{
  auto rng = vpTestSupport::generator(31);
  CAPTURE(vpTestSupport::seed());
  std::uniform_real_distribution<double> velocity(2., 8.);
  int jumps = 0, changes = 0;
  double x = 0.;
  for (int k = 0; k < 1000; ++k) {
    const double v = velocity(rng);
    const std::vector<vpPatternCell> before = look(x), now = look(x + v);
    x += v;
    const std::size_t n = std::min(before.size(), now.size()); // n_d of the text
    double printed = 0.;
    for (std::size_t i = 0; i < n; ++i) {
      printed += (now[i].x - before[i].x) / static_cast<double>(n);
    }
    const bool entered = now.front().column != before.front().column;
    changes += entered;
    jumps += std::abs(printed - v) > 0.9 * pitch;
    const vpCellVelocity ours = vpFindCellVelocity(before.data(), before.size(), now.data(), now.size());
    REQUIRE(ours.cells >= 1);
    REQUIRE(ours.vx == Approx(v).margin(1e-9));
  }
  CHECK(changes > 50);
  CHECK(jumps == changes);
}

TEST_CASE("(7.24): with velocities per frame the period is a frame, not the loop time", "[errata]")
{
  const double v = 5., loop = 1. / 1600.; // px/frame, s
  vpAlphaBetaFilter filter(vpAlphaBetaGains::criticallyDamped(0.4), 1.);
  for (int k = 0; k < 200; ++k) {
    filter.step(v * k);
  }
  const double now = v * 199.;
  CHECK(filter.predict(1.) == Approx(now + v).margin(1e-6)); // position of the cell in the next two frames
  CHECK(filter.predict(2.) == Approx(now + 2. * v).margin(1e-6));
  const double printed = filter.state().value + 2. * loop * filter.state().rate;
  CHECK(now + 2. * v - printed > 9.9);
}
