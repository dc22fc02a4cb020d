/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpCatch.h"

#include <visp3/feedforward/vpViewConstraintFilter.h>

#include <limits>

VISP_DIRECT_USING_NAMESPACE

namespace
{
vpServoCommand wanted(const vpTwist &v) { return {v, vpServoStatus::Servoing}; }
} // namespace

TEST_CASE("untouched, limited and stuck are told apart", "[filter]")
{
  const vpViewConstraintSpec spec;
  vpViewConstraintFilter filter(spec);
  const std::vector<vpServoPoint> centre = {{0., 0., 0.5, true}};
  const vpTwist slow(0.01, 0., 0., 0., 0., 0.01);
  vpServoCommand command = filter.filter(wanted(slow), centre, 0.01);
  CHECK(command.status == vpServoStatus::Servoing);
  CHECK(command.v[0] == slow[0]);

  command = filter.filter(wanted(vpTwist(4., 0., 0., 0., 0., 2.)), {}, 0.01);
  CHECK(command.status == vpServoStatus::ViewLimited); // by the speed limit, one factor for all
  CHECK(command.v[0] == Approx(1.));
  CHECK(command.v[5] == Approx(0.5));

  // Two opposite borders reached: the only motion for vz > 0 is blocked, and no other is desired.
  const double inset = filter.margin(0.5, 0.1, 0.15, 0.01);
  const std::vector<vpServoPoint> wide = {{spec.left + inset, 0., 0.5, true}, {spec.right - inset, 0., 0.5, true}};
  command = filter.filter(wanted(vpTwist(0., 0., 0.1, 0., 0., 0.)), wide, 0.01);
  CHECK(command.status == vpServoStatus::Deadlock);
  CHECK(command.v.linearNorm() < 2e-3);
  command = filter.filter(wanted(vpTwist()), wide, 0.01);
  CHECK(command.status == vpServoStatus::Servoing); // no desired motion is no deadlock

  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const vpServoPoint &bad :
       {vpServoPoint{nan, 0., 1., true}, vpServoPoint{0., 0., 0., true}, vpServoPoint{0., 0., -1., true}}) {
    command = filter.filter(wanted(slow), {bad}, 0.01);
    CHECK(command.status == vpServoStatus::InvalidInput);
    CHECK(command.v.linearNorm() == 0.);
  }
  CHECK(filter.filter(wanted(slow), {{nan, nan, -1., false}}, 0.01).status == vpServoStatus::Servoing);
  CHECK(filter.filter(wanted(slow), std::vector<vpServoPoint>(9, centre[0]), 0.01).status ==
        vpServoStatus::InvalidInput);
  CHECK(filter.filter(wanted(slow), centre, 0.).status == vpServoStatus::InvalidInput);
  CHECK(filter.filter({vpTwist(), vpServoStatus::Degenerate}, centre, 0.01).status == vpServoStatus::Degenerate);
}

TEST_CASE("view constraint set-up errors say what is wrong", "[filter][errors]")
{
  using Catch::Contains;
  const auto with = [](double vpViewConstraintSpec::*field, double value) {
    vpViewConstraintSpec spec;
    spec.*field = value;
    return spec;
  };
  CHECK_THROWS_WITH(vpViewConstraintFilter(with(&vpViewConstraintSpec::left, 0.1)),
                    Contains("left border of the view constraint is 0.1, must be finite and < 0"));
  CHECK_THROWS_WITH(vpViewConstraintFilter(with(&vpViewConstraintSpec::gamma, 80.)),
                    Contains("gamma of the view constraint is 80, must be > 0 and at most 0.5 / period"));
  CHECK_THROWS_WITH(vpViewConstraintFilter(with(&vpViewConstraintSpec::depthUncertainty, 1.)),
                    Contains("is 1, must be in 0..0.9"));
  CHECK_THROWS_WITH(vpViewConstraintFilter(with(&vpViewConstraintSpec::maxAngular, -1.)), Contains("maxAngular"));
  CHECK_THROWS_WITH(vpViewConstraintFilter(with(&vpViewConstraintSpec::imageUncertainty, 0.5)),
                    Contains("imageUncertainty"));
  const auto camera = vpViewConstraintSpec::fromCamera(vpCameraParameters(800., 800., 320., 240.), 640, 480);
  CHECK(camera.left == Approx(vpViewConstraintSpec().left));
  CHECK(camera.right == Approx(vpViewConstraintSpec().right));
  CHECK(camera.top == Approx(vpViewConstraintSpec().top));
  CHECK(camera.bottom == Approx(vpViewConstraintSpec().bottom));
  CHECK_THROWS_WITH(vpViewConstraintSpec::fromCamera(vpCameraParameters(800., 800., 700., 240.), 640, 480),
                    Contains("right border of the view constraint is -0.07"));
  CHECK_THROWS_WITH(vpViewConstraintSpec::fromCamera(vpCameraParameters(), 0, 480), Contains("image is 0 x 480 px"));
}
