/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Tracking against patterns in closed form: accuracy, reported sigma, identity, loss, invalid input, allocation.
#include "vpAnalyticPattern.h"

#include "vpCatch.h"
#include "vpDotScene.h"

#include <visp3/core/vpException.h>
#include <visp3/core/vpMath.h>
#include <visp3/pattern/vpPatternTracker.h>

#include <map>

VISP_DIRECT_USING_NAMESPACE
using vpPatternTest::Pattern;

namespace
{
// Errors of the valid cells, cell by cell, against the nearest true one.
struct Statistics {
  double sx = 0., sy = 0., xx = 0., yy = 0., chi = 0., motion = 0.;
  int count = 0, motions = 0, far = 0, slips = 0;
  std::map<std::pair<int, int>, std::pair<int, int>> names;
  unsigned int epoch = 0;

  void add(const Pattern &pattern, const vpPatternFrame &frame, double dx)
  {
    if (frame.epoch != epoch) {
      names.clear();
      epoch = frame.epoch;
    }
    for (const vpPatternCell &cell : frame.cells) {
      if (!cell.valid) {
        continue;
      }
      const int column = static_cast<int>(std::lround((cell.x - pattern.x) / pattern.pitchX));
      const int row = static_cast<int>(std::lround((cell.y - pattern.y) / pattern.pitchY));
      const double ex = cell.x - pattern.cellPositionX(row, column), ey = cell.y - pattern.cellPositionY(row, column);
      far += std::hypot(ex, ey) > 1. ? 1 : 0;
      const auto name = names.emplace(std::make_pair(cell.row, cell.column), std::make_pair(row, column)).first;
      slips += name->second != std::make_pair(row, column) ? 1 : 0;
      sx += ex;
      sy += ey;
      xx += ex * ex;
      yy += ey * ey;
      chi += 0.5 * (ex * ex / (cell.sigmaX * cell.sigmaX) + ey * ey / (cell.sigmaY * cell.sigmaY));
      ++count;
    }
    if (frame.hasMotion) {
      motion += (frame.dx - dx) * (frame.dx - dx);
      ++motions;
    }
  }
  double meanX() const { return sx / count; }
  double meanY() const { return sy / count; }
  double sigmaX() const { return std::sqrt(xx / count - meanX() * meanX()); }
  double sigmaY() const { return std::sqrt(yy / count - meanY() * meanY()); }
};

// Track until locked; false when that takes too long.
bool lock(Pattern &pattern, vpPatternTracker &tracker, std::mt19937_64 &rng, double vx, double vy)
{
  vpImage<unsigned char> image;
  for (int i = 0; i < 150; ++i) {
    pattern.x += vx;
    pattern.y += vy;
    pattern.render(rng, image);
    if (tracker.process(image).status == vpPatternStatus::Tracking) {
      return true;
    }
  }
  return false;
}

Statistics run(Pattern &pattern, vpPatternTracker &tracker, std::mt19937_64 &rng, int frames, double vx, double vy)
{
  Statistics statistics;
  vpImage<unsigned char> image;
  for (int i = 0; i < frames; ++i) {
    pattern.x += vx;
    pattern.y += vy;
    pattern.render(rng, image);
    const vpPatternFrame &frame = tracker.process(image);
    REQUIRE(frame.status == vpPatternStatus::Tracking);
    statistics.add(pattern, frame, vx);
  }
  return statistics;
}

// Largest error across the rows, where both forms measure the same edges, over the valid cells of 400 images, px.
double worstAcross(vpPatternMethod method, std::mt19937_64 &rng)
{
  Pattern pattern;
  pattern.noise = 16.;
  pattern.blur = 2.;
  vpPatternTrackerSpec spec;
  spec.method = method;
  vpPatternTracker tracker(160, 100, spec);
  vpImage<unsigned char> image;
  double worst = 0.;
  int count = 0;
  for (int i = 0; i < 400; ++i) {
    pattern.x += 3.37;
    pattern.y += 0.21;
    pattern.render(rng, image);
    for (const vpPatternCell &cell : tracker.process(image).cells) {
      if (!cell.valid) {
        continue;
      }
      const int column = static_cast<int>(std::lround((cell.x - pattern.x) / pattern.pitchX));
      const int row = static_cast<int>(std::lround((cell.y - pattern.y) / pattern.pitchY));
      worst = std::max(worst, std::abs(cell.y - pattern.cellPositionY(row, column)));
      ++count;
    }
  }
  REQUIRE(count > 3000);
  return worst;
}
} // namespace

TEST_CASE("centres reach the Cramer-Rao bound and say how good they are", "[pattern]")
{
  auto rng = vpTestSupport::generator(400);
  CAPTURE(vpTestSupport::seed());
  Pattern pattern;
  const bool dark = GENERATE(false, true);
  if (dark) {
    std::swap(pattern.dark, pattern.bright);
  }
  vpPatternTracker tracker(160, 100);
  REQUIRE(lock(pattern, tracker, rng, 3.3, 0.41));
  const Statistics s = run(pattern, tracker, rng, 250, 3.3, 0.41);
  double boundX = 0., boundY = 0.;
  pattern.bound(boundX, boundY);
  CAPTURE(dark, boundX, boundY, s.count);
  CHECK(s.sigmaX() < 1.1 * boundX);
  CHECK(s.sigmaY() < 1.15 * boundY);
  CHECK(std::abs(s.meanX()) < 0.01);
  CHECK(std::abs(s.meanY()) < 0.01);
  CHECK(s.chi / s.count == Approx(1.).margin(0.2)); // the reported sigmas are correct
  CHECK(std::sqrt(s.motion / s.motions) < 0.008);
  CHECK(s.count > 250 * 8);
  CHECK(s.slips == 0);
}

TEST_CASE("a slope of the illumination moves no centre", "[pattern]")
{
  auto rng = vpTestSupport::generator(401);
  CAPTURE(vpTestSupport::seed());
  Pattern pattern;
  pattern.slope = 0.2;
  vpPatternTracker tracker(160, 100);
  REQUIRE(lock(pattern, tracker, rng, 2.7, -0.3));
  const Statistics s = run(pattern, tracker, rng, 250, 2.7, -0.3);
  CHECK(std::abs(s.meanX()) < 0.02);
  CHECK(std::abs(s.meanY()) < 0.02);
}

TEST_CASE("while it learns under uneven light, centres are as good as they say", "[pattern]")
{
  auto rng = vpTestSupport::generator(402);
  CAPTURE(vpTestSupport::seed());
  const auto between = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(rng); };
  vpImage<unsigned char> image;
  const int problems = vpTestSupport::longer(8);
  double allX = 0., allY = 0.;
  for (int problem = 0; problem < problems; ++problem) {
    Pattern pattern;
    pattern.width = 320;
    pattern.height = 240;
    pattern.pitchX = between(24., 50.);
    pattern.pitchY = between(18., 30.);
    pattern.cellX = between(0.55, 0.75) * pattern.pitchX;
    pattern.cellY = between(0.55, 0.7) * pattern.pitchY;
    pattern.slope = between(-0.4, 0.4);
    pattern.slopeY = between(-0.25, 0.25);
    pattern.bright = between(130., 150.);
    pattern.rotation = vpMath::rad(between(-3., 3.));
    const double vx = between(-4., 4.), vy = between(-1., 1.);
    vpPatternTracker tracker(pattern.width, pattern.height);
    double xx = 0., yy = 0., sx = 0., sy = 0.;
    int count = 0, images = 0;
    for (int k = 0; k < 40; ++k) {
      pattern.x += vx;
      pattern.y += vy;
      pattern.render(rng, image);
      const vpPatternFrame &frame = tracker.process(image);
      if (frame.status != vpPatternStatus::Acquiring) {
        continue;
      }
      ++images;
      for (const vpPatternCell &cell : frame.cells) {
        if (!cell.valid || !std::isfinite(cell.sigmaX)) {
          continue;
        }
        const double du = cell.x - pattern.x, dv = cell.y - pattern.y;
        const double c = std::cos(pattern.rotation), s = std::sin(pattern.rotation);
        const int column = static_cast<int>(std::lround((c * du + s * dv) / pattern.pitchX));
        const int row = static_cast<int>(std::lround((-s * du + c * dv) / pattern.pitchY));
        const double ex = (cell.x - pattern.centreX(row, column)) / cell.sigmaX;
        const double ey = (cell.y - pattern.centreY(row, column)) / cell.sigmaY;
        xx += ex * ex;
        yy += ey * ey;
        sx += cell.sigmaX;
        sy += cell.sigmaY;
        ++count;
      }
    }
    CAPTURE(problem, pattern.pitchX, pattern.pitchY, pattern.cellX, pattern.cellY, pattern.slope, pattern.slopeY,
            pattern.rotation, images, sx / count, sy / count);
    REQUIRE(count > 300);
    // Beyond 1.5 in one of fifty: errors that do not change while the product moves along the pixels are not in the sigma.
    CHECK(std::sqrt(xx / count) == Approx(1.2).margin(0.6));
    CHECK(std::sqrt(yy / count) == Approx(1.2).margin(0.6));
    allX += xx / count;
    allY += yy / count;
  }
  CHECK(std::sqrt(allX / problems) == Approx(1.05).margin(0.25));
  CHECK(std::sqrt(allY / problems) == Approx(1.05).margin(0.25));
}

TEST_CASE("cells keep their row and column over a long way, forth and back", "[pattern]")
{
  auto rng = vpTestSupport::generator(402);
  CAPTURE(vpTestSupport::seed());
  Pattern pattern;
  pattern.jitter = 0.5;
  vpPatternTracker tracker(160, 100);
  REQUIRE(lock(pattern, tracker, rng, 1., 1.));
  const unsigned int epoch = tracker.frame().epoch;
  Statistics s;
  s.epoch = epoch;
  vpImage<unsigned char> image;
  for (int i = 0; i < 900; ++i) {
    const double vx = 9. * std::sin(i * 0.013), vy = 3. * std::cos(i * 0.021);
    pattern.x += vx;
    pattern.y += vy;
    pattern.render(rng, image);
    const vpPatternFrame &frame = tracker.process(image);
    CAPTURE(i, frame.message(), frame.validCells, frame.cells.size());
    REQUIRE(frame.status == vpPatternStatus::Tracking);
    s.add(pattern, frame, vx);
  }
  CHECK(s.slips == 0);
  CHECK(s.far == 0);
  CHECK(tracker.frame().epoch == epoch);
  // The map of deviations shows the deviations of the cells as generated, up to a common part.
  double error = 0.;
  int n = 0;
  for (const vpPatternCell &cell : tracker.frame().cells) {
    const auto truth = s.names.find({cell.row, cell.column});
    if (cell.valid && truth != s.names.end()) {
      const double made = pattern.deviation(truth->second.first, truth->second.second, 0);
      error += std::pow(cell.deviationX - made, 2);
      ++n;
    }
  }
  CHECK(std::sqrt(error / n) < 0.3);
}

TEST_CASE("after a gap the same cells have the same names", "[pattern]")
{
  auto rng = vpTestSupport::generator(403);
  CAPTURE(vpTestSupport::seed());
  Pattern pattern;
  vpPatternTracker tracker(160, 100);
  REQUIRE(lock(pattern, tracker, rng, 4.2, 0.2));
  Statistics s = run(pattern, tracker, rng, 5, 4.2, 0.2);
  const vpImage<unsigned char> black(100, 160, 0);
  for (int i = 0; i < 6; ++i) {
    const vpPatternFrame &frame = tracker.process(black);
    CHECK(frame.status == vpPatternStatus::Lost);
    CHECK(frame.cells.empty());
    CHECK(!frame.hasMotion);
    pattern.x += 4.2;
    pattern.y += 0.2;
  }
  vpImage<unsigned char> image;
  for (int i = 0; i < 5; ++i) {
    pattern.x += 4.2;
    pattern.y += 0.2;
    pattern.render(rng, image);
    const vpPatternFrame &frame = tracker.process(image);
    CHECK(frame.validCells > 0);
    s.add(pattern, frame, 4.2);
  }
  CHECK(tracker.frame().status == vpPatternStatus::Tracking);
  CHECK(tracker.frame().epoch == 0);
  CHECK(s.slips == 0);
}

TEST_CASE("a sudden move below half a pitch is followed, one near half a pitch is reported", "[pattern]")
{
  auto rng = vpTestSupport::generator(404);
  CAPTURE(vpTestSupport::seed());
  Pattern pattern;
  vpPatternTracker tracker(160, 100);
  REQUIRE(lock(pattern, tracker, rng, 0.5, 0.));
  Statistics s = run(pattern, tracker, rng, 5, 0.5, 0.);
  vpImage<unsigned char> image;
  const double share = GENERATE(0.2, 0.35, -0.3, 0.45, 0.55, -0.52);
  CAPTURE(share);
  pattern.x += share * pattern.pitchX;
  pattern.render(rng, image);
  const vpPatternFrame &frame = tracker.process(image);
  if (std::abs(share) < 0.4) {
    CHECK(frame.status == vpPatternStatus::Tracking);
    CHECK(frame.epoch == 0);
    s.add(pattern, frame, share * pattern.pitchX);
    CHECK(s.slips == 0);
    CHECK(frame.dx == Approx(share * pattern.pitchX).margin(0.1));
  }
  else {
    CHECK(frame.status == vpPatternStatus::Degraded);
    CHECK(frame.reason == vpPatternReason::AmbiguousMotion);
    CHECK(frame.epoch == 1);
    CHECK(!frame.hasMotion);
  }
}

TEST_CASE("images without a pattern are never tracked", "[pattern]")
{
  auto rng = vpTestSupport::generator(405);
  CAPTURE(vpTestSupport::seed());
  std::uniform_int_distribution<int> any(0, 255);
  Pattern coarse; // one cell in view, parts of others
  coarse.pitchX = 150.;
  coarse.cellX = 100.;
  coarse.pitchY = 90.;
  coarse.cellY = 60.;
  coarse.x = 80.;
  coarse.y = 50.;
  vpImage<unsigned char> black(100, 160, 0), white(100, 160, 255), noise(100, 160), big;
  const auto fill = [&](int kind) -> const vpImage<unsigned char> & {
    if (kind == 2) {
      std::normal_distribution<double> normal(120., 30.);
      for (unsigned int i = 0; i < noise.getSize(); ++i) {
        noise.bitmap[i] = static_cast<unsigned char>(std::clamp(std::lround(normal(rng)), 0L, 255L));
      }
    }
    else if (kind == 3) {
      for (unsigned int i = 0; i < noise.getSize(); ++i) {
        noise.bitmap[i] = static_cast<unsigned char>(any(rng) < 128 ? 20 : 220);
      }
    }
    else if (kind == 4) {
      coarse.render(rng, noise);
    }
    return kind == 0 ? black : kind == 1 ? white : noise;
  };
  const int kind = GENERATE(0, 1, 2, 3, 4);
  CAPTURE(kind);
  vpPatternTracker tracker(160, 100);
  for (int i = 0; i < 60; ++i) {
    const vpPatternFrame &frame = tracker.process(fill(kind));
    CHECK(frame.status == vpPatternStatus::Acquiring);
    CHECK(frame.reason != vpPatternReason::None);
    CHECK(frame.validCells == 0);
  }
  CHECK(std::string(tracker.frame().message()).find("No lock: ") == 0);
  // A locked tracker reports Lost for any other image.
  Pattern pattern;
  vpPatternTracker locked(160, 100);
  REQUIRE(lock(pattern, locked, rng, 1., 0.));
  for (int i = 0; i < 30; ++i) {
    CHECK(locked.process(fill(kind)).status != vpPatternStatus::Tracking);
  }
}

TEST_CASE("images of another size and bad spec are refused in words", "[pattern]")
{
  vpPatternTracker tracker(160, 100);
  const vpImage<unsigned char> image(99, 160, 0), empty;
  CHECK(tracker.process(image).status == vpPatternStatus::Lost);
  CHECK(std::string(tracker.frame().message()) == "Lost: the image has not the size that the tracker was made for.");
  CHECK(tracker.process(empty).reason == vpPatternReason::WrongSize);
  vpPatternTrackerSpec spec;
  spec.minPitch = 2.;
  CHECK_THROWS_WITH(vpPatternTracker(160, 100, spec),
                    Catch::Contains("minPitch of the pattern tracker is 2, must be 4..1000"));
  spec = vpPatternTrackerSpec();
  spec.refreshEvery = -1;
  CHECK_THROWS_WITH(vpPatternTracker(160, 100, spec),
                    Catch::Contains("refreshEvery of the pattern tracker is -1, must be 0..1000000"));
  spec = vpPatternTrackerSpec();
  spec.maxCellSigma = NAN;
  CHECK_THROWS_WITH(vpPatternTracker(160, 100, spec), Catch::Contains("maxCellSigma of the pattern tracker is nan"));
  CHECK_THROWS_WITH(vpPatternTracker(8, 100),
                    Catch::Contains("width of the pattern tracker's image is 8 px, must be 16..16384"));
}

TEST_CASE("no image makes the tracker allocate", "[pattern][realtime]")
{
  if (!vpTestSupport::canCountAllocations()) {
    WARN("allocations cannot be counted in this build");
    return;
  }
  auto rng = vpTestSupport::generator(406);
  CAPTURE(vpTestSupport::seed());
  const auto method = static_cast<vpPatternMethod>(GENERATE(0, 1, 2, 3));
  CAPTURE(vpToString(method));
  Pattern pattern;
  pattern.jitter = 0.3;
  std::vector<vpImage<unsigned char>> images(120);
  for (std::size_t i = 0; i < images.size(); ++i) {
    pattern.x += 3.1;
    pattern.y += i == 90 ? 8. : 0.4;
    pattern.render(rng, images[i]);
    if (i % 17 == 16) { // dirt
      for (unsigned int k = 30; k < 60; ++k) {
        images[i][k][k] = images[i][k][k + 1] = 0;
      }
    }
    if (i == 80) {
      images[i] = 0;
    }
  }
  std::uniform_int_distribution<int> any(0, 255);
  for (unsigned int i = 0; i < images[85].getSize(); ++i) {
    images[85].bitmap[i] = static_cast<unsigned char>(any(rng));
  }
  images[86].resize(20, 20);
  vpPatternTrackerSpec spec;
  spec.method = method;
  vpPatternTracker tracker(160, 100, spec);
  const unsigned long before = vpTestSupport::allocationCount();
  for (const vpImage<unsigned char> &image : images) {
    static_cast<void>(tracker.process(image));
  }
  tracker.reset();
  static_cast<void>(tracker.process(images[0]));
  CHECK(vpTestSupport::allocationCount() == before);
}

TEST_CASE("Algorithm 7.4 has the errors that were published, its correction has not", "[pattern][baseline]")
{
  auto rng = vpTestSupport::generator(407);
  CAPTURE(vpTestSupport::seed());
  const auto derivative = static_cast<vpPatternDerivative>(GENERATE(0, 1, 2, 3));
  CAPTURE(vpToString(derivative));
  Pattern pattern;
  vpPatternTrackerSpec spec;
  spec.derivative = derivative;
  for (const bool literal : {true, false}) {
    spec.method = literal ? vpPatternMethod::ThesisAlgorithm : vpPatternMethod::ThesisAlgorithmFixed;
    vpPatternTracker tracker(160, 100, spec);
    REQUIRE(lock(pattern, tracker, rng, 3.37, 0.21));
    const Statistics s = run(pattern, tracker, rng, 150, 3.37, 0.21);
    CAPTURE(literal, s.sigmaX(), s.sigmaY());
    if (literal) {
      CHECK(s.meanX() == Approx(0.5).margin(0.03));
      CHECK(s.sigmaX() > 0.12);
      CHECK(s.sigmaX() < 0.25);
    }
    else {
      CHECK(std::abs(s.meanX()) < 0.01);
      CHECK(s.sigmaX() < 0.12);
    }
    CHECK(std::abs(s.meanY()) < 0.02);
    CHECK(s.slips == 0);
  }
}

// Thesis (7.14) without a guard compared with the corrected algorithm, on soft and noisy edges. See doc/errata.md.
TEST_CASE("(7.14) runs away where the middle of the three is no maximum; guarded it does not", "[errata]")
{
  auto rng = vpTestSupport::generator(561);
  CAPTURE(vpTestSupport::seed());
  const double printed = worstAcross(vpPatternMethod::ThesisAlgorithm, rng);
  const double guarded = worstAcross(vpPatternMethod::ThesisAlgorithmFixed, rng);
  CAPTURE(printed, guarded);
  CHECK(guarded < 2.);
  CHECK(printed > 1.4 * guarded);
}

TEST_CASE("a lattice that cannot be tracked is named: a single row, rows turned too far", "[pattern]")
{
  using namespace vpPatternTest;
  CAPTURE(vpTestSupport::seed());
  int named = 0;
  for (const DotShape shape : {DotShape::Row, DotShape::Rectangular, DotShape::Hexagonal}) {
    for (unsigned int i = 0; i < 60; ++i) {
      auto rng = vpTestSupport::generator(9000 + 100 * static_cast<unsigned int>(shape) + i);
      DotKind kind{};
      kind.shape = shape;
      const DotScene scene = makeDots(kind, rng);
      vpPatternTracker tracker(scene.image.getWidth(), scene.image.getHeight());
      const vpPatternFrame &frame = tracker.process(scene.image);
      // Of all directions of the lattice: that of a, of b, each both ways, within 45 degrees of the image's rows.
      const double turn = std::abs(std::remainder(std::atan2(scene.a.y(), scene.a.x()), 0.5 * M_PI)) * 180. / M_PI;
      CAPTURE(static_cast<int>(shape), i, turn, frame.message());
      if (shape == DotShape::Row) {
        CHECK(frame.reason == vpPatternReason::SingleRow);
      }
      else if (shape == DotShape::Hexagonal || turn < 30.) { // rows of a hexagonal lattice are shifted by half a column
        CHECK(frame.reason == vpPatternReason::Learning);
      }
      else if (frame.reason != vpPatternReason::Learning) {
        CHECK(frame.reason == vpPatternReason::TurnedTooFar);
        ++named;
      }
    }
  }
  // A third of the rectangular ones is turned too far; those of nearly equal pitches are followed along the diagonal.
  CHECK(named > 0);
  vpPatternFrame frame;
  frame.reason = vpPatternReason::SingleRow;
  CHECK(std::string(frame.message()).find("single row") != std::string::npos);
  frame.reason = vpPatternReason::TurnedTooFar;
  CHECK(std::string(frame.message()).find("more than 30 degrees") != std::string::npos);
  frame.reason = vpPatternReason::NoLattice; // of hexagonal dots, too
  CHECK(std::string(frame.message()).find("rectangular lattice, with one cell a period") != std::string::npos);
}
