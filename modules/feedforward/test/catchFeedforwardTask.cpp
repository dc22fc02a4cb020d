/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// vpServo with our features commands what the laws do: the two share no code beyond the error.
#include "vpCatch.h"
#include "vpServoScene.h"

#include <visp3/core/vpException.h>
#include <visp3/core/vpVelocityTwistMatrix.h>
#include <visp3/feedforward/vpFeedforwardTask.h>
#include <visp3/vs/vpAdaptiveGain.h>

#include <algorithm>
#include <array>
#include <limits>

namespace
{
using namespace vpServoScene;

constexpr double same = 1e-12; // m/s and rad/s, m and rad
const std::array<const char *, 2> laws = {"ff-sum", "ff-lookat"};

struct Problem {
  vpServoGains gains;
  vpServoGoal goal;
  std::vector<Eigen::Vector3d> object;
  vpHomogeneousMatrix cMo;

  // Points hidden at random, in the goal, too; the first one never.
  vpServoMeasurement seen(std::mt19937_64 &rng) const
  {
    vpServoMeasurement measurement;
    measure(cMo, object, measurement);
    for (std::size_t i = 1; i < object.size(); ++i) {
      measurement.points[i].visible = measurement.points[i].visible && uniform(rng, 0., 1.) < 0.7;
    }
    return measurement;
  }
};

bool areAllSeen(const vpHomogeneousMatrix &cMo, const std::vector<Eigen::Vector3d> &object)
{
  std::vector<vpServoPoint> points;
  project(cMo, object, points);
  return std::all_of(points.begin(), points.end(), [](const vpServoPoint &point) { return point.visible; });
}

Problem randomProblem(std::mt19937_64 &rng, double largestTurn)
{
  Problem p;
  p.gains.lambda = uniform(rng, 0.2, 3.);
  p.gains.rotation = uniform(rng, 0.3, 2.);
  p.gains.kappa = uniform(rng, 0., 1.5);
  p.gains.saturation = uniform(rng, 0.1, 1.);
  p.object = object(rng, 0.16, 12);
  do {
    p.goal = goal(randomPose(rng, 0.3, 0.8, 0.2, 0.8), p.object);
    p.cMo =
        pose(turn(uniform(rng, 0., largestTurn), direction(rng)), uniform(rng, 0., 0.4) * direction(rng)).inverse() *
        p.goal.cdMo;
  } while (!areAllSeen(p.goal.cdMo, p.object) || !areAllSeen(p.cMo, p.object));
  for (std::size_t i = 1; i < p.object.size(); ++i) {
    p.goal.points[i].visible = uniform(rng, 0., 1.) < 0.8;
  }
  return p;
}

vpTwist twistOf(const std::string &law, const Problem &p, const vpServoGains &gains, const vpServoMeasurement &seen)
{
  const auto servo = vpServoLaw::create(law, gains);
  servo->setGoal(p.goal);
  const vpServoCommand command = servo->step(seen, 0.01);
  REQUIRE(command.status == vpServoStatus::Servoing);
  return command.v;
}

double difference(const vpColVector &a, const vpTwist &b)
{
  double largest = a.size() == 6 ? 0. : std::numeric_limits<double>::infinity();
  for (unsigned int i = 0; i < 6 && i < a.size(); ++i) {
    largest = std::max(largest, std::abs(a[i] - b[i]));
  }
  return largest;
}

vpMatrix randomJacobian(std::mt19937_64 &rng, unsigned int joints)
{
  vpMatrix J(6, joints);
  for (unsigned int i = 0; i < 6; ++i) {
    for (unsigned int k = 0; k < joints; ++k) {
      J[i][k] = uniform(rng, -0.3, 0.3) + (i == k ? 1. : 0.);
    }
  }
  return J;
}

vpHomogeneousMatrix randomMount(std::mt19937_64 &rng)
{
  return pose(turn(uniform(rng, 0., 3.), direction(rng)), uniform(rng, 0., 0.3) * direction(rng));
}
} // namespace

TEST_CASE("vpServo commands the velocity of the law", "[task]")
{
  const unsigned int seed = vpTestSupport::seed();
  auto rng = vpTestSupport::generator(81);
  for (int run = 0; run < 1000; ++run) {
    const Problem p = randomProblem(rng, 2.5);
    const vpServoMeasurement seen = p.seen(rng);
    for (const std::string law : laws) {
      CAPTURE(seed, run, law);
      vpFeedforwardTask task(law, p.gains);
      task.setGoal(p.goal);
      REQUIRE(difference(task.computeControlLaw(seen), twistOf(law, p, p.gains, seen)) < same);
    }
  }
}

TEST_CASE("only points visible now and in the goal count", "[task]")
{
  const unsigned int seed = vpTestSupport::seed();
  auto rng = vpTestSupport::generator(87);
  for (int run = 0; run < 300; ++run) {
    CAPTURE(seed, run);
    Problem p = randomProblem(rng, 2.5);
    vpServoMeasurement seen = p.seen(rng);
    vpFeedforwardTask task("ff-sum", p.gains);
    task.setGoal(p.goal);
    const vpColVector v = task.computeControlLaw(seen);
    for (std::size_t i = p.object.size(); i-- > 0;) { // the others are taken away
      if (!seen.points[i].visible || !p.goal.points[i].visible) {
        seen.points.erase(seen.points.begin() + static_cast<long>(i));
        p.goal.points.erase(p.goal.points.begin() + static_cast<long>(i));
      }
    }
    task.setGoal(p.goal);
    REQUIRE(difference(v, twistOf("ff-sum", p, p.gains, seen)) < same);
    REQUIRE((v - task.computeControlLaw(seen)).infinityNorm() < same);
  }
}

TEST_CASE("an adaptive gain is the law's lambda", "[task]")
{
  const unsigned int seed = vpTestSupport::seed();
  auto rng = vpTestSupport::generator(82);
  const vpAdaptiveGain gain(4., 0.4, 30.);
  for (int run = 0; run < 300; ++run) {
    const Problem p = randomProblem(rng, 2.5);
    const vpServoMeasurement seen = p.seen(rng);
    for (const std::string law : laws) {
      CAPTURE(seed, run, law);
      vpFeedforwardTask task(law, p.gains);
      task.setLambda(gain);
      task.setGoal(p.goal);
      vpServoGains gains = p.gains;
      gains.lambda = 1.;
      gains.lambda = gain(twistOf(law, p, gains, seen).toColVector().infinityNorm());
      REQUIRE(difference(task.computeControlLaw(seen), twistOf(law, p, gains, seen)) < same);
    }
  }
}

TEST_CASE("joints move the camera, or the object in the hand, as the law does", "[task]")
{
  const unsigned int seed = vpTestSupport::seed();
  auto rng = vpTestSupport::generator(83);
  for (int run = 0; run < 1000; ++run) {
    const Problem p = randomProblem(rng, 2.5);
    const vpServoMeasurement seen = p.seen(rng);
    const vpHomogeneousMatrix cMe = randomMount(rng), cMf = randomMount(rng), fMe = cMf.inverse() * cMe;
    const vpVelocityTwistMatrix cVe(cMe);
    for (const unsigned int joints : {6U, 7U}) {
      const vpMatrix eJe = randomJacobian(rng, joints);
      for (const std::string law : laws) {
        for (const auto type : {vpServo::EYEINHAND_L_cVe_eJe, vpServo::EYETOHAND_L_cVe_eJe,
                                vpServo::EYETOHAND_L_cVf_fVe_eJe, vpServo::EYETOHAND_L_cVf_fJe}) {
          CAPTURE(seed, run, joints, law, type);
          vpFeedforwardTask task(law, p.gains, type);
          task.set_cVe(cVe);
          task.set_eJe(eJe);
          task.set_cVf(cMf);
          task.set_fVe(fMe);
          task.set_fJe(vpVelocityTwistMatrix(fMe) * eJe);
          task.setGoal(p.goal);
          const vpColVector q = task.computeControlLaw(seen);
          REQUIRE(q.size() == joints);
          const double sign = type == vpServo::EYEINHAND_L_cVe_eJe ? 1. : -1.; // the hand moves, not the camera
          REQUIRE(difference(sign * (vpMatrix(cVe) * (eJe * q)), twistOf(law, p, p.gains, seen)) < 10. * same);
        }
      }
    }
  }
}

TEST_CASE("vpServo takes the camera along the path of the law", "[task]")
{
  const unsigned int seed = vpTestSupport::seed();
  auto rng = vpTestSupport::generator(84);
  for (int run = 0; run < vpTestSupport::longer(50); ++run) {
    const Problem p = randomProblem(rng, 1.05);
    for (const std::string law : laws) {
      CAPTURE(seed, run, law);
      vpFeedforwardTask task(law, p.gains);
      task.setGoal(p.goal);
      const auto servo = vpServoLaw::create(law, p.gains);
      servo->setGoal(p.goal);
      vpHomogeneousMatrix ours = p.cMo, theirs = p.cMo;
      vpServoMeasurement seen;
      const double dt = 0.02 / std::max(p.gains.lambda, 1.);
      for (int cycle = 0; cycle < 400; ++cycle) { // each on its own path
        measure(ours, p.object, seen);
        const vpServoCommand command = servo->step(seen, dt);
        if (command.status != vpServoStatus::Servoing) {
          REQUIRE(law == "ff-sum"); // every point behind the camera
          CHECK_THROWS_AS(task.computeControlLaw(seen), vpException);
          break;
        }
        ours = move(ours, command.v, dt);
        measure(theirs, p.object, seen);
        theirs = move(theirs, vpTwist::fromColVector(task.computeControlLaw(seen)), dt);
        REQUIRE((translation(ours) - translation(theirs)).norm() < same);
        REQUIRE((rotation(ours) - rotation(theirs)).norm() < same);
      }
    }
  }
}

TEST_CASE("a hand takes its object to the goal before a fixed camera", "[task]")
{
  const unsigned int seed = vpTestSupport::seed();
  auto rng = vpTestSupport::generator(85);
  for (int run = 0; run < 40; ++run) {
    Problem p = randomProblem(rng, 0.6);
    p.gains = {};
    const vpHomogeneousMatrix oMe = randomMount(rng);
    const vpMatrix eJe = randomJacobian(rng, 7);
    for (const std::string law : laws) {
      CAPTURE(seed, run, law);
      vpFeedforwardTask task(law, p.gains, vpServo::EYETOHAND_L_cVe_eJe);
      task.setGoal(p.goal);
      vpHomogeneousMatrix cMe = p.cMo * oMe;
      vpServoMeasurement seen;
      for (int cycle = 0; cycle < 500; ++cycle) {
        measure(cMe * oMe.inverse(), p.object, seen);
        task.set_cVe(cMe);
        task.set_eJe(eJe);
        cMe = cMe * vpExponentialMap::direct(eJe * task.computeControlLaw(seen), 0.02); // the hand moves
      }
      REQUIRE(rotationError(p.goal.cdMo, cMe * oMe.inverse()) < 1e-3);
      REQUIRE(translationError(p.goal.cdMo, cMe * oMe.inverse()) < 1e-3);
    }
  }
}

TEST_CASE("errors of the task say what is wrong", "[task][errors]")
{
  using Catch::Contains;
  auto rng = vpTestSupport::generator(86);
  const Problem p = randomProblem(rng, 1.);
  for (const std::string law : {"ibvs", "ff-lookat-pi", "ff-lookat+cbf", ""}) {
    CHECK_THROWS_WITH(vpFeedforwardTask(law),
                      "servo law \"" + law + "\" has no features for vpServo, those that have are: ff-sum, ff-lookat");
  }
  vpServoGains gains;
  gains.lambda = -1.;
  CHECK_THROWS_WITH(vpFeedforwardTask("ff-sum", gains), Contains("lambda of the servo gains is -1 1/s, must be > 0"));
  CHECK_THROWS_WITH(vpFeedforwardTask("ff-sum", {}, vpServo::NONE), Contains("is vpServo::NONE"));

  for (const std::string law : laws) {
    CAPTURE(law);
    vpFeedforwardTask task(law);
    vpServoMeasurement seen;
    measure(p.cMo, p.object, seen);
    CHECK_THROWS_WITH(task.computeControlLaw(seen), "No goal was set.");
    vpServoGoal bad = p.goal;
    bad.points.clear();
    CHECK_THROWS_WITH(task.setGoal(bad), Contains("the servo goal has 0 points"));
    task.setGoal(p.goal);
    const vpColVector before = task.computeControlLaw(seen);

    vpServoMeasurement other = seen;
    other.valid = false;
    CHECK_THROWS_WITH(task.computeControlLaw(other), "the target was not found");
    other = seen;
    other.points.pop_back();
    CHECK_THROWS_WITH(task.computeControlLaw(other), Contains("not the goal's points"));
    other = seen;
    other.cMo[1][3] = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_WITH(task.computeControlLaw(other), Contains("not finite"));
    other = seen;
    other.cMo = p.goal.cdMo;
    for (vpServoPoint &point : other.points) {
      point.visible = false;
    }
    if (law == "ff-sum") {
      CHECK_THROWS_WITH(task.see(other), Contains("no point that is visible now and in the goal, of 12"));
    }
    else { // opposite to the object
      other.cMo = pose(Eigen::Matrix3d::Identity(), -translation(p.goal.cdMo));
      other.cMo = other.cMo * pose(rotation(p.goal.cdMo), Eigen::Vector3d::Zero());
      CHECK_THROWS_WITH(task.see(other), Contains("look-at feature is undefined"));
    }
    const vpColVector after = task.computeControlLaw(); // what was refused changed nothing
    CHECK((after - before).infinityNorm() == 0.);
  }
}
