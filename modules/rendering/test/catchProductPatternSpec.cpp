/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Properties of a product: positions, identities, defects, noise, illumination, and rejected parameters.
#include "vpCatch.h"

#include <visp3/rendering/vpProductPattern.h>

#include <algorithm>
#include <cmath>
#include <map>

VISP_DIRECT_USING_NAMESPACE

namespace
{
using Key = std::pair<int, int>;

std::map<Key, vpPatternTruthCell> byName(const std::vector<vpPatternTruthCell> &cells)
{
  std::map<Key, vpPatternTruthCell> map;
  for (const vpPatternTruthCell &cell : cells) {
    map[{cell.row, cell.column}] = cell;
  }
  CHECK(map.size() == cells.size());
  return map;
}

std::string refusalOf(const vpProductPatternSpec &spec)
{
  try {
    const vpProductPattern product(spec);
  }
  catch (const vpException &error) {
    return error.getStringMessage();
  }
  return "accepted";
}
} // namespace

TEST_CASE("Cells keep their numbers and their places on the product", "[pattern]")
{
  auto rng = vpTestSupport::generator(1);
  CAPTURE(vpTestSupport::seed());
  std::uniform_real_distribution<double> unit(-1., 1.);
  for (int problem = 0; problem < 60; ++problem) {
    vpProductPatternSpec spec;
    spec.width = 300;
    spec.height = 200;
    spec.rotation = 3.1 * unit(rng);
    spec.jitter = 0.3;
    spec.flexAmplitudeX = 2.;
    spec.flexPeriodX = 12.;
    spec.missing = 0.1;
    spec.seed = problem;
    const vpProductPattern product(spec);
    const double far = problem % 2 == 0 ? 1000. : 5e7;
    const double x = far * unit(rng), y = far * unit(rng), dx = 40. * unit(rng), dy = 40. * unit(rng);
    const auto before = byName(product.cells(x, y));
    const auto after = byName(product.cells(x + dx, y + dy));
    int common = 0;
    for (const auto &[name, cell] : before) {
      const double u = cell.x + dx, v = cell.y + dy;
      const bool stays =
          u > -0.5 + 1e-6 && v > -0.5 + 1e-6 && u < spec.width - 0.5 - 1e-6 && v < spec.height - 0.5 - 1e-6;
      const auto found = after.find(name);
      if (stays) {
        REQUIRE(found != after.end());
        CHECK(found->second.x == Approx(u).margin(1e-6));
        CHECK(found->second.y == Approx(v).margin(1e-6));
        CHECK(found->second.defective == cell.defective);
        ++common;
      }
      // The opening's corners, straight from the definition.
      const double c = std::cos(spec.rotation), s = std::sin(spec.rotation);
      const double a = spec.openingX / 2. - spec.cornerRadius, b = spec.openingY / 2. - spec.cornerRadius;
      bool inside = true;
      for (const int sides : {0, 1, 2, 3}) {
        const double p = sides % 2 == 0 ? a : -a, q = sides < 2 ? b : -b;
        const double cu = cell.x + c * p - s * q, cv = cell.y + s * p + c * q, r = spec.cornerRadius;
        inside =
            inside && cu - r >= -0.5 && cu + r <= spec.width - 0.5 && cv - r >= -0.5 && cv + r <= spec.height - 0.5;
      }
      CHECK(cell.complete == inside);
    }
    // As many as the area holds, give or take half of those that the border can cut, and the corners.
    const double border = (spec.width + spec.height) / std::min(spec.pitchX, spec.pitchY) + 4.;
    CHECK(double(before.size()) ==
          Approx(spec.width * spec.height / (spec.pitchX * spec.pitchY)).epsilon(0.).margin(border));
    CHECK(common > 20);
  }
}

TEST_CASE("Jitter, flexible pitch and defects are as large and as frequent as asked", "[pattern]")
{
  vpProductPatternSpec spec;
  spec.width = 16384;
  spec.height = 200;
  spec.jitter = 0.3;
  spec.missing = 0.05;
  spec.damaged = 0.1;
  double defective = 0.;
  double sum = 0., squares = 0.;
  const auto cells = vpProductPattern(spec).cells(0., 0.);
  for (const vpPatternTruthCell &cell : cells) {
    const double off = cell.x - (spec.width - 1.) / 2. - cell.column * spec.pitchX;
    sum += off;
    squares += off * off;
    defective += cell.defective ? 1. : 0.;
    CHECK(std::fabs(off) <= 3. * spec.jitter + 1e-6);
  }
  const double n = double(cells.size());
  REQUIRE(n > 3000.);
  CHECK(sum / n == Approx(0.).margin(4. * spec.jitter / std::sqrt(n)));
  CHECK(std::sqrt(squares / n) == Approx(spec.jitter).epsilon(0.04));
  CHECK(defective / n == Approx(0.15).margin(4. * std::sqrt(0.15 * 0.85 / n)));

  spec.jitter = 0.;
  spec.flexAmplitudeX = 5.;
  spec.flexPeriodX = 20.;
  double widest = 0., narrowest = 1e9;
  const auto flexible = byName(vpProductPattern(spec).cells(0., 0.));
  for (const auto &[name, cell] : flexible) {
    const auto next = flexible.find({name.first, name.second + 1});
    if (next != flexible.end()) {
      widest = std::max(widest, next->second.x - cell.x);
      narrowest = std::min(narrowest, next->second.x - cell.x);
    }
    CHECK(cell.y == Approx((spec.height - 1.) / 2. + cell.row * spec.pitchY).margin(1e-9));
  }
  const double most = 2. * spec.flexAmplitudeX * std::sin(M_PI / spec.flexPeriodX);
  CHECK(widest <= spec.pitchX + most + 1e-9);
  CHECK(widest > spec.pitchX + 0.98 * most);
  CHECK(narrowest >= spec.pitchX - most - 1e-9);
  CHECK(narrowest < spec.pitchX - 0.98 * most);
}

TEST_CASE("Noise has the promised variance, is repeatable and independent", "[pattern]")
{
  vpProductPatternSpec spec;
  spec.noise = 4.;
  const vpProductPattern product(spec);
  vpImage<float> mean;
  product.expected(0., 0., 0., 0., mean);
  double count[2] = {0., 0.}, sum[2] = {0., 0.}, squares[2] = {0., 0.};
  double neighbours = 0., frames = 0., all = 0.;
  vpImage<unsigned char> I, former;
  for (unsigned int frame = 0; frame < 60; ++frame) {
    product.render(0., 0., 0., 0., frame, I);
    for (unsigned int v = 0; v < spec.height; ++v) {
      for (unsigned int u = 1; u < spec.width; ++u) {
        const double e = I[v][u] - double(mean[v][u]);
        for (const int k : {0, 1}) {
          const double level = k == 0 ? spec.dark : spec.bright;
          if (std::fabs(mean[v][u] - level) < 0.01) {
            count[k] += 1.;
            sum[k] += e;
            squares[k] += e * e;
          }
        }
        all += e * e;
        neighbours += e * (I[v][u - 1] - double(mean[v][u - 1]));
        frames += frame > 0 ? e * (former[v][u] - double(mean[v][u])) : 0.;
      }
    }
    former = I;
  }
  for (const int k : {0, 1}) {
    const double level = k == 0 ? spec.dark : spec.bright;
    const double variance = spec.noise * spec.noise * (0.36 + level / 157.) + 1. / 12.; // and rounding
    REQUIRE(count[k] > 1e5);
    CHECK(sum[k] / count[k] == Approx(0.).margin(5. * std::sqrt(variance / count[k])));
    CHECK(squares[k] / count[k] == Approx(variance).epsilon(5. * std::sqrt(2. / count[k])));
  }
  CHECK(neighbours / all == Approx(0.).margin(0.006));
  CHECK(frames / all == Approx(0.).margin(0.006));

  vpImage<unsigned char> again;
  vpProductPattern(spec).render(0., 0., 0., 0., 59, again);
  CHECK((again == I)); // operator== is not const
  spec.seed = 2;
  vpProductPattern(spec).render(0., 0., 0., 0., 59, again);
  CHECK_FALSE((again == I));
}

TEST_CASE("Light, dust and cracks multiply the picture", "[pattern]")
{
  vpProductPatternSpec spec;
  spec.width = 1000;
  spec.height = 1000;
  vpImage<float> clean, changed;
  vpProductPattern(spec).expected(0., 0., 0., 0., clean);
  spec.illuminationX = 0.2;
  spec.illuminationY = -0.1;
  vpProductPattern(spec).expected(0., 0., 0., 0., changed);
  for (const unsigned int at : {0U, 100U, 999U}) {
    const double factor = 1. + 0.2 * (2. * at / 999. - 1.) - 0.1 * (2. * (999. - at) / 999. - 1.);
    CHECK(changed[999 - at][at] / clean[999 - at][at] == Approx(factor).epsilon(1e-5));
  }

  spec.illuminationX = spec.illuminationY = 0.;
  spec.dust = 7.5;
  vpProductPattern(spec).expected(0., 0., 0., 0., changed);
  double lost = 0.;
  for (unsigned int v = 0; v < spec.height; ++v) {
    for (unsigned int u = 0; u < spec.width; ++u) {
      CHECK_FALSE(changed[v][u] > clean[v][u]);
      lost += 1. - changed[v][u] / clean[v][u];
    }
  }
  // 750 specks: the mean of opacity * pi * stretch * (half^2 + blur^2).
  CHECK(lost / 750. == Approx(0.7 * M_PI * 1.3 * (3.25 + 0.64 + 1. / 12.)).epsilon(0.08));

  spec.dust = 0.;
  spec.cracks = 3.;
  vpProductPattern(spec).expected(0., 0., 0., 0., changed);
  lost = 0.;
  for (unsigned int k = 0; k < changed.getSize(); ++k) {
    lost += 1. - changed.bitmap[k] / clean.bitmap[k];
  }
  CHECK(lost / 300. == Approx(0.65 * 1.1 * 4. * 11.25).epsilon(0.12)); // opacity, width, length
}

TEST_CASE("What is out of range is refused by name and value", "[pattern]")
{
  CHECK(refusalOf(vpProductPatternSpec()) == "accepted");
  struct Case {
    void (*spoil)(vpProductPatternSpec &);
    std::string sentence;
  };
  const std::vector<Case> cases = {
      {[](auto &s) { s.width = 7; }, "width is 7 px, must be 8..16384"},
      {[](auto &s) { s.height = 20000; }, "height is 20000 px, must be 8..16384"},
      {[](auto &s) { s.pixelSize = 0.; }, "pixelSize is 0 um, must be > 0"},
      {[](auto &s) { s.pitchX = NAN; }, "pitchX is nan px, must be 2..100000"},
      {[](auto &s) { s.openingX = 48.9; }, "openingX is 48.9 px, must be < 48.88889 px, what pitch, jitter and"},
      {[](auto &s) { s.jitter = 1.1; }, "openingY is 11.55555556 px, must be < 11.17778 px"},
      {[](auto &s) { s.flexAmplitudeY = 20.; }, "openingY is 11.55555556 px, must be < 11.52"},
      {[](auto &s) { s.cornerRadius = 6.; }, "cornerRadius is 6 px, must be 0..5.777778"},
      {[](auto &s) { s.rotation = 4.; }, "rotation is 4 rad, must be -3.141593..3.141593"},
      {[](auto &s) { s.bright = 256.; }, "bright is 256, must be 0..255"},
      {[](auto &s) { s.dark = -1.; }, "dark is -1, must be 0..255"},
      {[](auto &s) { s.illuminationX = 0.6, s.illuminationY = -0.5; }, "illuminationY is -0.5, must be such that"},
      {[](auto &s) { s.psf = -0.1; }, "psf is -0.1 px, must be 0..5"},
      {[](auto &s) { s.noise = INFINITY; }, "noise is inf, must be 0..50"},
      {[](auto &s) { s.exposure = 1.1; }, "exposure is 1.1, must be 0..1"},
      {[](auto &s) { s.flexPeriodX = 3.; }, "flexPeriodX is 3 cells, must be 4..1000000"},
      {[](auto &s) { s.dust = 101.; }, "dust is 101, must be 0..100"},
      {[](auto &s) { s.cracks = -1.; }, "cracks is -1, must be 0..100"},
      {[](auto &s) { s.missing = 0.6, s.damaged = 0.6; }, "missing + damaged is 1.2, must be 0..1"},
  };
  for (const Case &bad : cases) {
    vpProductPatternSpec spec;
    bad.spoil(spec);
    CHECK(refusalOf(spec).find(bad.sentence) != std::string::npos);
    CAPTURE(bad.sentence, refusalOf(spec));
    CHECK(refusalOf(spec).find(bad.sentence) == 0);
  }

  const vpProductPattern product{vpProductPatternSpec()};
  vpImage<unsigned char> I;
  CHECK_THROWS_WITH(product.render(NAN, 0., 0., 0., 0, I), Catch::Contains("displacement x is nan px"));
  CHECK_THROWS_WITH(product.cells(0., 2e8), Catch::Contains("displacement y is 2e+08 px, must be within +-1e+08"));
  CHECK_THROWS_WITH(product.render(0., 0., 2e4, 0., 0, I), Catch::Contains("motion during the exposure is 1600 px"));
  CHECK_THROWS_WITH(product.render(0., 0., 0., INFINITY, 0, I), Catch::Contains("velocity y is inf px/frame"));
}
