/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The features for vpServo against finite differences, and our laws against vpServo with ViSP's own features; with ours:
// catchFeedforwardTask.
#include "vpCatch.h"
#include "vpServoScene.h"

#include <visp3/feedforward/vpFeatureFeedforwardSum.h>
#include <visp3/feedforward/vpFeatureLookAt.h>
#include <visp3/feedforward/vpFeedforwardStability.h>
#include <visp3/visual_features/vpFeatureDepth.h>
#include <visp3/visual_features/vpFeaturePoint.h>
#include <visp3/visual_features/vpFeatureThetaU.h>
#include <visp3/visual_features/vpFeatureTranslation.h>
#include <visp3/vs/vpServo.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <limits>

namespace
{
using namespace vpServoScene;

struct Situation {
  vpHomogeneousMatrix cdMo, cMo;
  vpHomogeneousMatrix cdMc() const { return cdMo * cMo.inverse(); }
};

Situation randomSituation(std::mt19937_64 &rng, double rotation)
{
  Situation s;
  do {
    s.cdMo = randomPose(rng, 0.4, 1.2, 0.3, 0.6);
    s.cMo = pose(turn(uniform(rng, 0., rotation), direction(rng)), uniform(rng, 0., 0.4) * direction(rng)).inverse() *
            s.cdMo;
  } while (translation(s.cMo).z() < 0.2 || translation(s.cMo).head<2>().norm() > translation(s.cMo).z());
  return s;
}

vpServoPoint origin(const vpHomogeneousMatrix &cMo)
{
  const Eigen::Vector3d t = translation(cMo);
  return {t.x() / t.z(), t.y() / t.z(), t.z(), true};
}

// Columns: rate of the feature for each unit twist.
template <class Build> vpMatrix numericInteraction(const Situation &s, Build build)
{
  const double h = 1e-5;
  vpMatrix L(3, 6);
  for (unsigned int k = 0; k < 6; ++k) {
    vpTwist v;
    v[k] = 1.;
    const vpColVector plus = build(move(s.cMo, v, h)), minus = build(move(s.cMo, v, -h));
    for (unsigned int i = 0; i < 3; ++i) {
      L[i][k] = (plus[i] - minus[i]) / (2. * h);
    }
  }
  return L;
}

double largest(const vpMatrix &M)
{
  double value = 0.;
  for (unsigned int i = 0; i < M.size(); ++i) {
    value = std::max(value, std::abs(M.data[i]));
  }
  return value;
}

void setPoint(vpFeaturePoint &feature, const vpServoPoint &p) { feature.buildFrom(p.x, p.y, p.Z); }

// ViSP's own task for the situation; gains on all features alike.
vpColVector compute(vpServo &task, double lambda)
{
  task.setServo(vpServo::EYEINHAND_CAMERA);
  task.setInteractionMatrixType(vpServo::CURRENT, vpServo::PSEUDO_INVERSE);
  task.setLambda(lambda);
  vpColVector v = task.computeControlLaw();
  task.kill();
  return v;
}

vpTwist answer(const std::string &id, const vpServoGains &gains, const Situation &s,
               const std::vector<Eigen::Vector3d> &points)
{
  auto law = vpServoLaw::create(id, gains);
  law->setGoal(goal(s.cdMo, points));
  vpServoMeasurement measurement;
  measure(s.cMo, points, measurement);
  const vpServoCommand command = law->step(measurement, 0.01);
  REQUIRE(command.status == vpServoStatus::Servoing);
  return command.v;
}

void requireSame(const vpTwist &ours, const vpColVector &theirs)
{
  for (unsigned int i = 0; i < 6; ++i) {
    REQUIRE(std::abs(ours[i] - theirs[i]) < 1e-7 * (1. + std::abs(theirs[i])));
  }
}
} // namespace

TEST_CASE("the look-at feature's matrix equals finite differences of its error", "[features]")
{
  const unsigned int seed = vpTestSupport::seed();
  auto rng = vpTestSupport::generator(31);
  for (int run = 0; run < 1000; ++run) {
    CAPTURE(seed, run);
    const Situation s = randomSituation(rng, 2.5);
    vpServoGains gains;
    gains.rotation = uniform(rng, 0.2, 3.);
    vpFeatureLookAt gaze(gains);
    gaze.buildFrom(s.cdMc(), s.cdMo);
    const vpMatrix rates = numericInteraction(s, [&](const vpHomogeneousMatrix &cMo) {
      vpFeatureLookAt moved(gains);
      moved.buildFrom(s.cdMo * cMo.inverse(), s.cdMo);
      return moved.get_s() / (2. * gains.rotation);
    });
    REQUIRE(largest(gaze.interaction() - rates) < 1e-7);
  }
}

TEST_CASE("the motion of ff-sum at the goal has four eigenvalues -lambda and two -2 lambda", "[features]")
{
  auto rng = vpTestSupport::generator(36);
  for (int run = 0; run < 20; ++run) {
    CAPTURE(run);
    vpServoGains gains;
    gains.lambda = uniform(rng, 0.3, 3.);
    const vpHomogeneousMatrix cdMo = pose(Eigen::Matrix3d::Identity(), {0., 0., uniform(rng, 0.3, 1.)});
    const std::vector<Eigen::Vector3d> centre(1, Eigen::Vector3d::Zero());
    Eigen::Matrix<double, 6, 6> flow; // d(camera twist) / d(its small displacement)
    for (std::size_t k = 0; k < 6; ++k) {
      vpTwist unit;
      unit[k] = 1.;
      const double h = 1e-5;
      const vpTwist plus = answer("ff-sum", gains, {cdMo, move(cdMo, unit, h)}, centre),
                    minus = answer("ff-sum", gains, {cdMo, move(cdMo, unit, -h)}, centre);
      for (std::size_t i = 0; i < 6; ++i) {
        flow(static_cast<int>(i), static_cast<int>(k)) = (plus[i] - minus[i]) / (2. * h);
      }
    }
    Eigen::Matrix<double, 6, 1> values = flow.eigenvalues().real() / gains.lambda;
    std::sort(values.data(), values.data() + 6);
    for (int i = 0; i < 6; ++i) {
      REQUIRE(values(i) == Approx(i < 2 ? -2. : -1.).epsilon(1e-4)); // a double eigenvalue: the root of the accuracy
    }
  }
}

TEST_CASE("features select rows, copy themselves and refuse bad input", "[features][errors]")
{
  auto rng = vpTestSupport::generator(32);
  const Situation s = randomSituation(rng, 1.);
  vpFeatureLookAt gaze;
  gaze.buildFrom(s.cdMc(), s.cdMo);
  const vpMatrix row = gaze.interaction(vpBasicFeature::FEATURE_LINE[1]);
  REQUIRE(row.getRows() == 1);
  CHECK(row[0][4] == gaze.interaction()[1][4]);
  std::unique_ptr<vpFeatureLookAt> copy(gaze.duplicate());
  CHECK((*copy)[2] == gaze[2]);
  CHECK(largest(copy->interaction() - gaze.interaction()) == 0.);
  CHECK_THROWS_WITH(gaze.buildFrom(pose(Eigen::Matrix3d::Identity(), translation(s.cdMo)), s.cdMo),
                    Catch::Contains("look-at feature is undefined"));
  vpServoGains gains;
  gains.kappa = -1.;
  CHECK_THROWS_WITH(vpFeatureFeedforwardSum(gains), Catch::Contains("kappa of the servo gains is -1"));
  gains = {};
  gains.rotation = 0.;
  CHECK_THROWS_WITH(vpFeatureLookAt(gains), Catch::Contains("rotation of the servo gains is 0"));
  vpFeatureFeedforwardSum sum;
  const std::vector<vpServoPoint> at = {origin(s.cMo)}, wanted = {origin(s.cdMo)};
  sum.buildFrom(s.cdMc(), at, wanted);
  const vpMatrix decoupled = sum.interaction(vpBasicFeature::FEATURE_LINE[2]);
  REQUIRE(decoupled.getRows() == 1);
  CHECK(decoupled[0][5] == 1.);
  CHECK(decoupled.sumSquare() == 1.);
  CHECK_THROWS_WITH(sum.buildFrom(s.cdMc(), {{0.1, 0., -1., true}}, wanted),
                    Catch::Contains("point 0 of the feedforward-sum feature is x = 0.1, y = 0, Z = -1 m"));
  CHECK_THROWS_WITH(sum.buildFrom(s.cdMc(), {}, wanted),
                    Catch::Contains("the feedforward-sum feature has 0 points, its goal 1"));
  CHECK_THROWS_WITH(sum.buildFrom(s.cdMc(), {{0., 0., 1., false}}, wanted),
                    Catch::Contains("no point that is visible"));
  vpHomogeneousMatrix bent;
  bent[0][0] = 2.;
  CHECK_THROWS_WITH(sum.buildFrom(bent, at, wanted), Catch::Contains("cdMc of the feedforward-sum feature is not"));
}

TEST_CASE("our laws equal vpServo with ViSP's features", "[features][vs]")
{
  const unsigned int seed = vpTestSupport::seed();
  auto rng = vpTestSupport::generator(35);
  vpServoGains gains;
  gains.lambda = 0.8;
  const std::vector<Eigen::Vector3d> centre(1, Eigen::Vector3d::Zero());
  for (int run = 0; run < 200; ++run) {
    CAPTURE(seed, run);
    const Situation s = randomSituation(rng, 0.8);
    vpFeatureThetaU rotationFeature(vpFeatureThetaU::cdRc);
    rotationFeature.buildFrom(s.cdMc());
    {
      vpFeatureTranslation t(vpFeatureTranslation::cdMc);
      t.buildFrom(s.cdMc());
      vpServo task;
      task.addFeature(t);
      task.addFeature(rotationFeature);
      requireSame(answer("pbvs1", gains, s, centre), compute(task, gains.lambda));
    }
    {
      vpFeatureTranslation t(vpFeatureTranslation::cMo), goalT(vpFeatureTranslation::cMo);
      t.buildFrom(s.cMo);
      goalT.buildFrom(s.cdMo);
      vpServo task;
      task.addFeature(t, goalT);
      task.addFeature(rotationFeature);
      requireSame(answer("pbvs2", gains, s, centre), compute(task, gains.lambda));
    }
    vpFeaturePoint point, goalPoint;
    setPoint(point, origin(s.cMo));
    setPoint(goalPoint, origin(s.cdMo));
    {
      const double Z = origin(s.cMo).Z;
      vpFeatureDepth depth, goalDepth;
      depth.buildFrom(point.get_x(), point.get_y(), Z, std::log(Z / origin(s.cdMo).Z));
      goalDepth.buildFrom(goalPoint.get_x(), goalPoint.get_y(), origin(s.cdMo).Z, 0.);
      vpServo task;
      task.addFeature(point, goalPoint);
      task.addFeature(depth, goalDepth);
      task.addFeature(rotationFeature);
      requireSame(answer("hybrid25d", gains, s, centre), compute(task, gains.lambda));
    }
    {
      vpFeatureTranslation t(vpFeatureTranslation::cdMc);
      t.buildFrom(s.cdMc());
      vpServo task;
      task.addFeature(t);
      task.addFeature(point, goalPoint);
      task.addFeature(rotationFeature, vpFeatureThetaU::selectTUz());
      requireSame(answer("kyrki", gains, s, centre), compute(task, gains.lambda));
    }
    {
      const auto points = object(rng, 0.2, 6);
      std::vector<vpServoPoint> seen, wanted;
      project(s.cMo, points, seen);
      project(s.cdMo, points, wanted);
      std::vector<vpFeaturePoint> features(points.size()), goals(points.size());
      vpServo task;
      for (std::size_t i = 0; i < points.size(); ++i) {
        setPoint(features[i], seen[i]);
        setPoint(goals[i], wanted[i]);
        task.addFeature(features[i], goals[i]);
      }
      requireSame(answer("ibvs", gains, s, points), compute(task, gains.lambda));
    }
  }
}

TEST_CASE("ff-sum is stable around the goal, and not everywhere", "[stability]")
{
  const double degree = M_PI / 180.;
  for (double bearing = 0.; bearing <= 60.; bearing += 10.) {
    for (double rotation = 0.; rotation <= 90.; rotation += 15.) {
      CAPTURE(bearing, rotation);
      REQUIRE(vpFeedforwardSumStabilityMargin(bearing * degree, rotation * degree, 1.) > 0.);
    }
  }
  CHECK(vpFeedforwardSumStabilityMargin(0., 0., 1.) == Approx(1.));
  CHECK(vpFeedforwardSumStabilityMargin(70. * degree, 150. * degree, 1.) < 0.);
  CHECK(vpFeedforwardSumStabilityMargin(60. * degree, 90. * degree, 4.) < 0.); // a large kappa destabilises
  // Without the image term the margin is that of L_theta_u alone: theta/2 cot(theta/2).
  CHECK(vpFeedforwardSumStabilityMargin(0.5, 1.2, 0., 20000) == Approx(0.6 / std::tan(0.6)).epsilon(1e-3));
  CHECK_THROWS_WITH(vpFeedforwardSumStabilityMargin(2., 0., 1.),
                    Catch::Contains("bearing of the stability margin is 2"));
  CHECK_THROWS_WITH(vpFeedforwardSumStabilityMargin(0., -1., 1.),
                    Catch::Contains("rotation of the stability margin is -1"));
  CHECK_THROWS_WITH(vpFeedforwardSumStabilityMargin(0., 0., std::numeric_limits<double>::quiet_NaN()),
                    Catch::Contains("kappa of the stability margin is nan"));
  CHECK_THROWS_WITH(vpFeedforwardSumStabilityMargin(0., 0., 1., 0),
                    Catch::Contains("samples of the stability margin is 0"));
}
