/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The loop of the documentation, do { step() } while (vpIsWorking(output)), ends with the arm at rest, for every
// method.
#include "vpAvoidanceTestKit.h"
#include "vpCatch.h"

#include <visp3/avoidance/vpAvoidanceMethods.h>

#include <algorithm>
#include <limits>
#include <random>
#include <string>

using namespace vpAvoidanceTestKit;

namespace
{
constexpr int most = 4000; // 20 s

struct Loop {
  int cycles = 0;
  vpAvoidanceOutput output;
};

Loop run(const std::string &id, const vpAvoidanceGoal &goal, int when, const vpAvoidanceGoal &then)
{
  vpCollisionSceneSpec around;
  vpCollisionObject ball;
  ball.name = "ball";
  ball.shape = vpCollisionShape::sphere(0.03);
  ball.pose.p = Vector3d(0., 0., 3.); // far from everything
  around.objects = {ball};
  const vpCollisionScene scene(amor(), around);
  const auto method = vpMakeAvoidanceMethod(id, scene);
  vpJointVector q = amor().home();
  method->start(q, goal);
  Loop loop;
  do {
    if (loop.cycles == when) {
      method->setGoal(then);
    }
    if (loop.cycles % 8 == 0) {
      method->look();
    }
    method->step(q, loop.output);
    q += 0.005 * loop.output.velocity;
  } while (++loop.cycles < most && vpIsWorking(loop.output));
  return loop;
}
} // namespace

TEST_CASE("a loop of any method ends at the goal and at every error, at its start and on the way", "[loop]")
{
  vpJointVector near = amor().home(), wild = near, outside = near;
  near(0) += 0.4;
  wild(2) = std::numeric_limits<double>::quiet_NaN();
  outside(1) = amor().upper()(1) + 0.5;
  const vpAvoidanceGoal good = vpAvoidanceGoal::at(amor(), near);
  vpAvoidanceGoal notFinite = good, beyond = vpAvoidanceGoal::at(amor(), outside), far = good, huge = good;
  notFinite.q = wild;
  notFinite.position.x() = std::numeric_limits<double>::quiet_NaN();
  far.q.resize(0);
  far.position = Vector3d(5., 0., 5.); // out of the arm's reach
  huge.q.setConstant(1e200);
  huge.position.setConstant(1e200);
  for (const std::string &id : vpAvoidanceMethodNames()) {
    CAPTURE(id);
    const Loop arrives = run(id, good, most, good);
    CHECK(arrives.cycles < most);
    CHECK(arrives.output.status == vpAvoidanceStatus::Arrived);
    int number = 0;
    for (const vpAvoidanceGoal *bad : {&notFinite, &beyond, &far, &huge}) {
      CAPTURE(++number);
      if ((bad == &far || bad == &huge) && id.rfind("potential", 0) == 0) {
        continue; // a potential field does not know what is out of reach
      }
      const Loop atStart = run(id, *bad, most, good), onTheWay = run(id, good, 20, *bad);
      for (const Loop *loop : {&atStart, &onTheWay}) {
        CAPTURE(loop == &atStart, std::string(vpToString(loop->output.status)), loop->cycles);
        CHECK(loop->cycles < most);
        CHECK(loop->output.velocity.allFinite());
        CHECK(loop->output.velocity.norm() < 1e-2);
      }
    }
  }
}

// The tool may be at the goal while the joints are still on their way to a posture.
TEST_CASE("Arrived is told of an arm that stands, whatever posture is asked for", "[loop]")
{
  auto rng = vpTestSupport::generator(70);
  CAPTURE(vpTestSupport::seed());
  std::uniform_real_distribution<double> change(-0.8, 0.8), posture(-4., 4.);
  int arrived = 0;
  for (int k = 0; k < 10; ++k) {
    vpJointVector q = amor().home();
    for (int j = 0; j < q.size(); ++j) {
      q(j) = std::clamp(q(j) + change(rng), amor().lower()(j) + 0.05, amor().upper()(j) - 0.05);
    }
    vpAvoidanceGoal goal = vpAvoidanceGoal::at(amor(), q);
    for (int j = 0; j < q.size(); ++j) {
      goal.q(j) = k % 2 == 0 ? posture(rng) : goal.q(j);
    }
    for (const std::string id : {"potential", "potential-corrected", "dtg", "dtg-via"}) {
      const Loop loop = run(id, goal, most, goal);
      CAPTURE(k, id, loop.cycles, std::string(vpToString(loop.output.status)));
      CHECK((loop.output.status != vpAvoidanceStatus::Arrived || loop.output.velocity.norm() < 1e-2));
      arrived += loop.output.status == vpAvoidanceStatus::Arrived;
    }
  }
  CHECK(arrived > 20);
}
