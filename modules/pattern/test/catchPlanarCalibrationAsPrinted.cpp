/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Loss of accuracy of the planar calibration as printed in the thesis, where it works and where it fails.
#include "vpCatch.h"
#include "vpPlanarProblem.h"

VISP_DIRECT_USING_NAMESPACE
using namespace vpPatternTest;

TEST_CASE("rows of u and v are stacked: what adding them costs", "[calibration]")
{
  auto rng = vpTestSupport::generator(513);
  CAPTURE(vpTestSupport::seed());
  double least = 1e9, most = 0.;
  for (const double band : {1e9, 100., 25.}) { // the product fills the image, or a band along or across its diagonal
    for (const double side : {1., -1.}) {
      Problem problem = randomProblem(rng, 1, 1.4e-8);
      problem.views[0].rotation = 0.2;
      problem.views[0].tx = 1e-4;
      problem.views[0].ty = 0.7e-3; // not near zero, or (7.8) as printed fails
      problem.views[0].mirrored = false;
      Moments scale[2], kappa[2];
      for (int trial = 0; trial < 300; ++trial) {
        Points points;
        for (const vpCalibrationPoint &point : pointsOf(problem, 0, 0.05, 0.05, rng)) {
          if (std::abs(point.u - problem.truth.u0 + side * (point.v - problem.truth.v0)) < band) {
            points.push_back(point);
          }
        }
        for (const int stacked : {0, 1}) {
          const Literal found = literal(points, problem.truth.u0, problem.truth.v0, false, stacked == 1);
          scale[stacked].add(found.scale);
          kappa[stacked].add(found.kappa);
        }
      }
      const double ratioScale = scale[0].sigma() / scale[1].sigma(), ratioKappa = kappa[0].sigma() / kappa[1].sigma();
      WARN("|u " << (side > 0. ? "+" : "-") << " v| < " << band << " px: deviations of added rows over stacked rows: "
                 << ratioScale << " (scale), " << ratioKappa << " (kappa1)");
      least = std::min({least, ratioScale, ratioKappa});
      most = std::max({most, ratioScale, ratioKappa});
    }
  }
  CHECK(least > 0.9);
  CHECK(most > 3.);
}

TEST_CASE("(7.8) as printed fails where the origin is seen at the centre, the homogeneous form does not",
          "[calibration]")
{
  auto rng = vpTestSupport::generator(514);
  CAPTURE(vpTestSupport::seed());
  constexpr int trials = 300;
  Moments printed, ours, printedFar;
  for (int trial = 0; trial < trials; ++trial) {
    Problem problem = randomProblem(rng, 1, 2e-7);
    for (const bool centred : {false, true}) {
      problem.views[0].tx = centred ? 0. : 0.3e-3;
      problem.views[0].ty = centred ? 0. : 0.5e-3;
      problem.truth = problem.views[0];
      const Points points = pointsOf(problem, 0, 0.05, 0.05, rng);
      const Literal found = literal(points, problem.truth.u0, problem.truth.v0, problem.truth.mirrored, false);
      (centred ? printed : printedFar).add(found.scale / problem.truth.scaleX - 1.);
      vpPlanarMicroscopeCalibration calibration(640, 480);
      calibration.addView(points);
      ours.add(calibration.compute().calibration.scaleX / problem.truth.scaleX - 1.);
    }
  }
  WARN("rms error of the scale: " << printed.rms() << " as printed with the origin at the centre, " << printedFar.rms()
                                  << " with it elsewhere; " << ours.rms() << " here");
  CHECK(printed.rms() > 10. * printedFar.rms());
  CHECK(printed.rms() > 0.01);
  CHECK(ours.rms() < 1e-4);
}
