/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Servoing to where one reference image was taken: random starts beside the metric law, and any scale in any delay.
#include "vpCatch.h"

#include "lab/servo/vpReferenceExperiment.h"

#include <visp3/core/vpMath.h>
#include <visp3/direct_core/vpQuantile.h>
#include <visp3/direct_core/vpSO3.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <vector>

VISP_DIRECT_USING_NAMESPACE

using vpTestSupport::generator;
using vpTestSupport::longer;
using vpTestSupport::seed;
using vpTestSupport::uniform;

namespace
{
constexpr double pixelNoise = 0.5; // px
constexpr unsigned int taught = 25;

struct Figures {
  int count = 0, arrived = 0, lost = 0, measured = 0, near = 0, within = 0;
  std::vector<double> rotation, translation, settled; // deg, % of d, s

  void add(const vpReferenceStart &start, const vpReferenceRun &run)
  {
    ++count;
    arrived += run.arrived() ? 1 : 0;
    lost += run.outOfView > 0. ? 1 : 0;
    rotation.push_back(vpMath::deg(run.endRotation));
    translation.push_back(100. * run.endTranslation);
    settled.push_back(run.settled);
    if (run.halfDistance > 0.) {
      const double error = std::abs(run.halfDistance - start.distance);
      ++measured;
      near += error < 0.05 * start.distance ? 1 : 0;
      within += error < 2. * run.halfSigma ? 1 : 0;
    }
  }
  [[nodiscard]] double worse(const std::vector<double> Figures::*error, const Figures &peer, double share) const
  {
    return vpQuantile(this->*error, share) / vpQuantile(peer.*error, share);
  }
  void print(const char *name) const
  {
    std::cout << name << ": arrived " << arrived << ", view lost " << lost << " of " << count << "; end "
              << vpMedian(rotation) << " deg (95 %: " << vpQuantile(rotation, 0.95) << "), " << vpMedian(translation)
              << " % of d (" << vpQuantile(translation, 0.95) << "); settled " << vpMedian(settled) << " s ("
              << vpQuantile(settled, 0.95) << "); at half of the way d within 5 % in " << near << ", within 2 sigma in "
              << within << " of " << measured << std::endl;
  }
};

vpReferencePoseSpec statedRange(double nearest, double farthest)
{
  vpReferencePoseSpec spec;
  spec.nearest = nearest;
  spec.farthest = farthest;
  return spec;
}

Figures runFree(int count, const vpReferencePoseSpec &spec, unsigned int images, bool turned = false)
{
  Figures figures;
  for (int i = 0; i < count; ++i) {
    auto rng = generator(static_cast<unsigned int>(i));
    const vpReferenceStart start = vpReferenceStart::draw(rng, turned);
    std::shared_ptr<const vpReferencePose> pose;
    figures.add(start, runReferenceExperiment(start, seePoints(start, pixelNoise, images, spec, rng(), pose)));
  }
  return figures;
}

// Number of events of probability p that n trials may have: mean and 2.6 standard deviations, 99.5 %.
double most(double p, int n) { return p * n + 2.6 * std::sqrt(p * (1. - p) * n) + 0.5; }
} // namespace

TEST_CASE("one reference image leads as near to the goal as the metric law", "[reference][evaluation]")
{
  CAPTURE(seed());
  const int count = std::max(40, longer(40)); // quantiles want as many in each run
  Figures metric;
  for (int i = 0; i < count; ++i) {
    auto rng = generator(static_cast<unsigned int>(i));
    const vpReferenceStart start = vpReferenceStart::draw(rng);
    metric.add(start, runReferenceExperiment(start, seeKnownPoints(start, pixelNoise, taught, rng())));
  }
  metric.print("metric");
  const Figures free = runFree(count, statedRange(0.2, 1.2), taught);
  free.print("one reference image");
  CHECK(metric.arrived == count);
  CHECK(count - free.arrived <= most(0.01, count));
  CHECK(free.lost <= most(0.002, count));
  for (const double share : {0.5, 0.95}) {
    const double bound = share < 0.9 || count >= 400 ? 1.5 : 3.; // 95 % of 40 runs is the third worst of them
    CHECK(free.worse(&Figures::rotation, metric, share) < bound);
    CHECK(free.worse(&Figures::translation, metric, share) < bound);
  }
  REQUIRE(free.measured > 0.9 * count);
  CHECK(free.measured - free.near <= most(0.05, free.measured));
  CHECK(free.measured - free.within <= most(0.05, free.measured));
}

TEST_CASE("a wide range, one taught image, and a camera that only turned do no harm", "[reference][evaluation]")
{
  CAPTURE(seed());
  const int count = longer(20);
  const Figures wide = runFree(count, statedRange(0.05, 5.), taught);
  wide.print("d in 0.05 to 5 m");
  CHECK(count - wide.arrived <= most(0.01, count));
  CHECK(wide.measured - wide.within <= most(0.05, wide.measured));
  const Figures one = runFree(count, statedRange(0.2, 1.2), 1);
  one.print("taught by one image");
  CHECK(count - one.arrived <= most(0.15, count)); // the noise of the reference image stays in the goal
  CHECK(one.measured - one.within <= most(0.05, one.measured));
  const Figures turned = runFree(count, statedRange(0.2, 1.2), taught, true);
  turned.print("only turned");
  CHECK(count - turned.arrived <= most(0.01, count));
}

namespace
{
// Sees pose and tau exactly, and scales with rho d; each image is lost with a probability.
vpReferenceEye seeScaled(const vpReferenceStart &start, double rho, double lost, std::mt19937_64 &rng)
{
  const double scale = rho * start.distance;
  const Eigen::Vector3d O = start.rMo.p / start.distance;
  const vpServoTarget target({Eigen::Vector3d::Zero()});
  const vpServoGoal goal = target.goal(vpRigidTransform{Eigen::Matrix3d::Identity(), scale * O}.toHomogeneous());
  return [=, &rng](const vpRigidTransform &rMc, const vpRigidTransform &, double time, vpServoSight &sight) {
    const Eigen::Vector3d t = scale * rMc.R.transpose() * (O - rMc.p / start.distance);
    target.measure(vpRigidTransform{rMc.R.transpose(), t}.toHomogeneous(), time, sight.measurement);
    sight.measurement.valid = sight.hasGoal = time == 0. || uniform(rng, 0., 1.) > lost;
    sight.goal = goal;
  };
}
} // namespace

TEST_CASE("every scale up to twice the true one is stable in any delay", "[reference][stability]")
{
  // p' = -lambda (p(t) + (rho - 1) p(t - L)): the robot's motion since the capture is right, what was seen is scaled by
  // rho.
  CAPTURE(seed());
  auto rng = generator(7);
  double worst = 0.;
  for (int i = 0; i < longer(40); ++i) {
    const vpReferenceStart start = vpReferenceStart::draw(rng);
    vpReferenceRunSpec spec;
    spec.plant = vpServoPlant();
    spec.plant.latency = uniform(rng, 0., 1.);
    spec.plant.visionRate = uniform(rng, 5., 50.);
    const double rho = uniform(rng, 0.2, 1.99);
    spec.law = "ff-lookat";
    spec.duration = spec.plant.latency + 12. / std::min(rho, 1.);
    CAPTURE(i, rho, spec.plant.latency, spec.plant.visionRate);
    const vpReferenceRun run = runReferenceExperiment(start, seeScaled(start, rho, 0.5, rng), spec);
    worst = std::max(worst, run.overshoot);
    CHECK(run.endTranslation < 0.02);
    CHECK(run.endRotation < 0.02);
  }
  std::cout << "largest overshoot with scales up to twice the true one: " << 100. * worst << " %" << std::endl;
}

TEST_CASE("the overshoot of a scale that is too large is that of the delay equation", "[reference][stability]")
{
  // 10 Hz, latency 100 ms, lag 30 ms: 0 up to rho 2, 0.5 to 0.7 % at 3 (by the phase of images and cycles), 24 % at 5,
  // unstable beyond 10.7 (lambda 1).
  vpReferenceRunSpec spec;
  spec.plant = vpServoPlant();
  spec.plant.latency = 0.1;
  spec.plant.visionRate = 10.;
  spec.plant.lag = 0.03;
  spec.plant.maxLinear = spec.plant.maxAngular = 1000.;
  spec.law = "pbvs1";
  auto rng = generator(8);
  vpReferenceStart start = vpReferenceStart::draw(rng);
  start.rMc = {Eigen::Matrix3d::Identity(), {0., 0., -0.2 * start.distance}};
  const auto overshoot = [&](double rho) {
    return runReferenceExperiment(start, seeScaled(start, rho, 0., rng), spec).overshoot;
  };
  for (const double rho : {0.05, 0.5, 1., 1.5, 2.}) {
    CAPTURE(rho);
    CHECK(overshoot(rho) < 0.001);
  }
  CHECK(overshoot(3.) == Approx(0.006).margin(0.002));
  CHECK(overshoot(5.) == Approx(0.24).margin(0.02));
  CHECK(overshoot(11.5) > 1.);
}
