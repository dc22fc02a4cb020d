/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Thesis (7.14) without a guard compared with the corrected algorithm, on soft and noisy edges. See doc/errata.md.
#include "vpAnalyticPattern.h"
#include "vpCatch.h"

#include <visp3/pattern/vpPatternTracker.h>

VISP_DIRECT_USING_NAMESPACE
using namespace vpPatternTest;

namespace
{
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
