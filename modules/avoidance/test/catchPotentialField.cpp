/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// (8.1)-(8.2) as printed and as corrected: what each does wrong or right, and the local minimum that both have.
#include "vpAvoidanceTestKit.h"
#include "vpCatch.h"

#include <visp3/avoidance/vpPotentialFieldAvoidance.h>
#include <visp3/core/vpException.h>

#include <iostream>

using namespace vpAvoidanceTestKit;

TEST_CASE("Weights (8.2): as printed 0.76 in contact, corrected 1, both fall with distance", "[potential]")
{
  vpFieldWeightSpec spec{0.1, 0.1, 0.5};
  CHECK(vpFieldWeight(spec, vpFieldForm::Thesis, 0.) == Approx(std::tanh(1.)));
  CHECK(vpFieldWeight(spec, vpFieldForm::Thesis, 0.) == Approx(0.7616).epsilon(1e-4));
  CHECK(vpFieldWeight(spec, vpFieldForm::Corrected, 0.) == Approx(1.));
  CHECK(vpFieldWeight(spec, vpFieldForm::Corrected, -0.5) == Approx(1.)); // deep inside it still is
  CHECK(vpFieldWeight(spec, vpFieldForm::Thesis, -0.5) < 0.01);           // as printed it fades behind the centre
  auto rng = vpTestSupport::generator(971);
  CAPTURE(vpTestSupport::seed());
  for (int k = 0; k < 2000; ++k) {
    spec.centre = uniform(rng, 0.01, 0.3);
    spec.width = uniform(rng, 0.01, 0.3);
    const double d = uniform(rng, 0., 1.), e = d + uniform(rng, 1e-3, 0.2);
    for (const vpFieldForm form : {vpFieldForm::Thesis, vpFieldForm::Corrected}) {
      const double near = vpFieldWeight(spec, form, d), far = vpFieldWeight(spec, form, e);
      REQUIRE(near >= far);
      REQUIRE(far >= 0.);
      REQUIRE(near <= 1.);
      REQUIRE(vpFieldWeight(spec, vpFieldForm::Thesis, -d) == Approx(vpFieldWeight(spec, vpFieldForm::Thesis, d)));
    }
  }
}

TEST_CASE("As printed the axes act by themselves and more height reverses the task", "[potential]")
{
  const vpFieldWeightSpec spec{120., 60., 0.5};
  const Vector3d task(0.2, 0., 0.), avoid(-0.25, -0.25, 0.);
  // An obstacle far away on u, but level with the image's centre on v: pushed on v all the same.
  const Vector3d pushed = vpBlendAsPrinted(spec, {400., 0.}, avoid, task);
  CHECK(pushed.x() == Approx(0.2).margin(1e-3));
  CHECK(pushed.y() < -0.2);
  vpFieldWeightSpec high = spec;
  high.height = 1.;
  const Vector3d none(0., 0., 0.);
  CHECK(vpBlendAsPrinted(high, {0., 400.}, none, task).x() < -0.1); // (1 - w) < 0
  CHECK(vpBlendAsPrinted(spec, {0., 400.}, none, task).x() > 0.);
}

TEST_CASE("Corrected, contact never comes nearer, and ways along or away stay", "[potential]")
{
  const vpFieldWeightSpec spec;
  auto rng = vpTestSupport::generator(972);
  CAPTURE(vpTestSupport::seed());
  for (int k = 0; k < 2000; ++k) {
    const Vector3d normal = point(rng, 1.).normalized(), task = point(rng, 0.5);
    const double speed = uniform(rng, 0., 0.5), d = uniform(rng, 0., 0.3);
    const Vector3d v = vpBlendRadial(spec, d, normal, speed, task);
    REQUIRE((v - task).cross(normal).norm() < 1e-12);                            // only along the normal
    REQUIRE(v.dot(normal) >= task.dot(normal) - 1e-12);                          // never nearer than wished
    REQUIRE(vpBlendRadial(spec, 0., normal, speed, task).dot(normal) >= -1e-12); // in contact never nearer at all
    const Vector3d away = task - std::min(0., task.dot(normal) - speed) * normal;
    REQUIRE((vpBlendRadial(spec, d, normal, speed, away) - away).norm() < 1e-12);
  }
}

TEST_CASE("Both forms of the field stand still before a wall between them and the goal", "[potential]")
{
  // The local minimum that trajectories with vias leave: a plate across the straight way, wider than the field reaches.
  vpArmData data;
  vpArmKinematics::forward(amor(), amor().home(), data);
  vpAvoidanceGoal goal;
  goal.position = data.tool.p + Vector3d(0., 0.25, 0.);
  vpCollisionScene scene(amor());
  vpCollisionObject wall;
  wall.name = "wall";
  wall.shape = vpCollisionShape::box({0.5, 0.02, 0.5});
  wall.pose.p = data.tool.p + Vector3d(0., 0.14, 0.);
  scene.add(wall);
  vpPotentialFieldAvoidance field(scene);
  REQUIRE(field.start(amor().home(), goal) == vpAvoidanceStatus::Moving);
  vpAvoidanceOutput output;
  vpJointVector q = amor().home();
  for (int k = 0; k < 3000; ++k) {
    field.step(q, output);
    q += 0.005 * output.velocity;
  }
  vpArmKinematics::forward(amor(), q, data);
  CHECK(output.status != vpAvoidanceStatus::Arrived);
  CHECK((data.tool.p - goal.position).norm() > 0.1);
  REQUIRE(output.pair.kind == vpCollisionKind::Object);
  CHECK(output.pair.other == 0);
}

TEST_CASE("Parameters of the field are checked", "[potential]")
{
  const vpCollisionScene scene(amor());
  vpPotentialFieldAvoidanceSpec spec;
  spec.metres.height = 0.7;
  CHECK_THROWS_WITH(vpPotentialFieldAvoidance(scene, spec),
                    Catch::Contains("height of the potential field is 0.7, must be 0.5 in the corrected form"));
  spec = {};
  spec.pixels.width = 0.;
  CHECK_THROWS_WITH(vpPotentialFieldAvoidance(scene, spec), Catch::Contains("width of the potential field is 0"));
  spec = {};
  spec.focal = -1.;
  CHECK_THROWS_WITH(vpPotentialFieldAvoidance(scene, spec), Catch::Contains("focal of the potential field is -1"));
}
