/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file catchPlannedServo.cpp
 * \brief Laws that plan against servo laws behind a shaper, within the same limits, the object averaged for all of them.
 */
#include "vpCatch.h"

#include "lab/servo/vpServoExperiment.h"
#include "lab/servo/vpServoStart.h"

#include <visp3/direct_core/vpSO3.h>
#include <visp3/manipulator/vpArmJson.h>

#include <algorithm>
#include <cstdio>

VISP_DIRECT_USING_NAMESPACE

namespace
{
using vpTestSupport::uniform;

Eigen::Vector3d randomVector(std::mt19937_64 &rng, double x, double y, double z)
{
  return {uniform(rng, -x, x), uniform(rng, -y, y), uniform(rng, -z, z)};
}

vpHomogeneousMatrix poseOf(const Eigen::Matrix3d &R, const Eigen::Vector3d &t)
{
  vpHomogeneousMatrix M;
  for (unsigned int i = 0; i < 3; ++i) {
    for (unsigned int k = 0; k < 3; ++k) {
      M[i][k] = R(i, k);
    }
    M[i][3] = t[i];
  }
  return M;
}

bool isSeen(const vpServoTask &task, const Eigen::Matrix3d &R, const Eigen::Vector3d &t)
{
  for (const double x : {-0.5, 0.5}) {
    for (const double y : {-0.5, 0.5}) {
      const Eigen::Vector3d X = R * Eigen::Vector3d(x * task.objectWidth, y * task.objectHeight, 0.) + t;
      if (!(std::abs(X.x() / X.z()) < 0.39 && std::abs(X.y() / X.z()) < 0.29)) {
        return false;
      }
    }
  }
  return R(2, 2) > 0.4;
}

// One goal, up to 60 deg and 1 m away, the object in the picture at both ends.
vpServoTask randomTask(std::mt19937_64 &rng)
{
  vpServoTask task = vpServoTask::thesis();
  for (;;) {
    const Eigen::Matrix3d Rd = vpSO3::exp(randomVector(rng, 0.4, 0.4, 0.5));
    const Eigen::Matrix3d R = vpSO3::exp(randomVector(rng, 1., 1., 1.).normalized() * uniform(rng, 0., 1.05)) * Rd;
    const Eigen::Vector3d td = randomVector(rng, 0.05, 0.03, 0.15) + Eigen::Vector3d(0., 0., 0.55);
    const Eigen::Vector3d t = randomVector(rng, 0.15, 0.1, 0.4) + Eigen::Vector3d(0., 0., 0.8);
    if (isSeen(task, Rd, td) && isSeen(task, R, t)) {
      task.initial = poseOf(R, t);
      task.segments = {{"goal", poseOf(Rd, td), 10.}};
      return task;
    }
  }
}

struct Sum {
  double settle = 0., jerk = 0., peak = 0., image = 0., exceeded = 0., losses = 0.;
  double slowed = 0., jointExcess = 0.; // of an arm
  std::vector<double> times;            // to settle, s
  int runs = 0;

  void add(const Sum &other)
  {
    jerk += other.jerk;
    losses += other.losses;
  }
};

struct Case {
  std::string law, plant;
  double lambda = 1., rate = 100.;
  bool onArm = false;
  double jointJerk = 0.; // limit in units of the acceleration limits, 1/s; no self-motion then; 0: none
};

std::shared_ptr<const vpServoArm> armFor(std::mt19937_64 &rng, vpServoTask &task, double jerk)
{
  static const vpArmModel model = vpLoadArmJson(std::string(VISP_DIRECT_DATA_DIR) + "/robot/amor.json");
  while (rateServoStart(model, task, model.home()) < 0.15) {
    task = randomTask(rng);
  }
  vpServoArm arm{model, {}};
  arm.spec.start = model.home();
  if (jerk > 0.) {
    arm.jerk = jerk * model.acceleration();
  }
  else {
    arm.spec.indices = {vpSelfMotionIndex::jointLimits(), vpSelfMotionIndex::manipulability()};
  }
  return std::make_shared<const vpServoArm>(arm);
}

// Largest share of the joints' limits of velocity, acceleration and, where there are some, jerk, by differences of the commands.
double jointExcess(const vpServoRun &run)
{
  const vpServoArm &arm = *run.spec.arm;
  const double rate = run.spec.plant.loopRate;
  vpJointVector before = vpJointVector::Zero(arm.model.size()), change = before;
  double worst = 0.;
  for (const vpArmSample &s : run.arm) {
    const vpJointVector next = rate * (s.command - before), jerk = rate * (next - change);
    worst = std::max({worst, s.command.cwiseQuotient(arm.model.velocity()).cwiseAbs().maxCoeff(),
                      next.cwiseQuotient(arm.model.acceleration()).cwiseAbs().maxCoeff(),
                      arm.jerk.size() > 0 ? jerk.cwiseQuotient(arm.jerk).cwiseAbs().maxCoeff() : 0.});
    before = s.command;
    change = next;
  }
  return worst;
}

Sum sumOver(const Case &which, int tasks)
{
  Sum sum;
  for (int i = 0; i < tasks; ++i) {
    auto rng = vpTestSupport::generator(static_cast<unsigned int>(i));
    vpServoRunSpec spec;
    spec.law = which.law;
    spec.gains.lambda = which.lambda;
    spec.plant = vpServoPlant::byName(which.plant);
    spec.plant.loopRate = which.rate;
    spec.task = randomTask(rng);
    if (which.onArm) {
      spec.arm = armFor(rng, spec.task, which.jointJerk);
    }
    spec.seed = static_cast<unsigned int>(i + 1);
    spec.bounds.emplace();
    spec.average = true;
    const vpServoRun run = runServoExperiment(spec);
    sum.settle += run.metrics.settle_s;
    sum.times.push_back(run.metrics.settle_s);
    sum.jerk += run.metrics.rms_linear_jerk_mps3;
    sum.peak = std::max(sum.peak, run.metrics.peak_linear_jerk_mps3);
    sum.image += run.metrics.rms_image_error_px;
    sum.exceeded += run.metrics.bounds_exceeded_cycles;
    sum.losses += run.metrics.view_losses > 0.;
    if (which.onArm) {
      sum.slowed += run.armMetrics->limited_s + run.armMetrics->blocked_s;
      sum.jointExcess = std::max(sum.jointExcess, jointExcess(run));
    }
    ++sum.runs;
  }
  std::printf(
      "%-12s lambda %-4g plant %s %s%4g Hz: settle %.2f s, jerk rms %.2f peak %.2f m/s3, image %.1f px, lost view %g, "
      "above limits %g cycles, ",
      which.law.c_str(), which.lambda, which.plant.c_str(), which.onArm ? "arm " : "", which.rate,
      sum.settle / sum.runs, sum.jerk / sum.runs, sum.peak, sum.image / sum.runs, sum.losses, sum.exceeded);
  if (which.onArm) {
    std::printf("joints %.2f of their limits, slowed %.2f s, ", sum.jointExcess, sum.slowed);
  }
  std::printf("%d runs\n", sum.runs);
  std::fflush(stdout);
  return sum;
}

// ff-dtg against the peer at its best gain.
void compare(const std::string &plant, double rate, bool onArm, int tasks)
{
  CAPTURE(vpTestSupport::seed(), plant, rate, onArm);
  const Sum planned = sumOver({"ff-dtg", plant, 1., rate, onArm}, tasks);
  std::vector<Sum> peers;
  for (const double lambda : {2., 2.5, 3., 3.5}) {
    if (!onArm || lambda < 3.) { // beyond, an arm is slower and loses the view
      peers.push_back(sumOver({"ff-lookat-pi", plant, lambda, rate, onArm}, tasks));
    }
  }
  const auto quicker = [](const Sum &a, const Sum &b) { return a.settle < b.settle; };
  const Sum best = *std::min_element(peers.begin(), peers.end(), quicker);
  CHECK(planned.exceeded == 0.);
  CHECK(planned.losses <= best.losses);
  std::printf("  time %.2f, rms jerk %.2f of the quickest ff-lookat-pi\n", planned.settle / best.settle,
              planned.jerk / best.jerk);
  CHECK(planned.settle <= 1.1 * best.settle);
  CHECK(planned.jerk <= 0.5 * best.jerk);
}
} // namespace

TEST_CASE("planned motion keeps its limits, and is as quick as a law behind a shaper with half its jerk", "[plan]")
{
  CAPTURE(vpTestSupport::seed());
  std::vector<double> ratios; // of all plants: single tasks differ by far
  Sum all, peers;
  for (const char *plant : {"A", "B", "D"}) {
    const Sum planned = sumOver({"ff-dtg", plant}, 3), peer = sumOver({"ff-lookat-pi", plant, 3.}, 3);
    CAPTURE(plant);
    CHECK(planned.exceeded == 0.);
    for (std::size_t i = 0; i < planned.times.size(); ++i) {
      ratios.push_back(planned.times[i] / peer.times[i]);
    }
    all.add(planned);
    peers.add(peer);
  }
  std::nth_element(ratios.begin(), ratios.begin() + ratios.size() / 2, ratios.end());
  CHECK(ratios[ratios.size() / 2] < 1.4);
  CHECK(all.jerk < 0.7 * peers.jerk);
  CHECK(all.losses <= peers.losses + 1.);
}

TEST_CASE("planned motion of a camera on an arm keeps the limits of camera and joints", "[plan][arm]")
{
  CAPTURE(vpTestSupport::seed());
  // The last two without self-motion, within limits of the joints' jerk.
  for (const Case &which : {Case{"ff-dtg", "A", 1., 100., true}, Case{"ff-dtg", "D", 1., 100., true},
                            Case{"dtg", "A", 1., 100., true, 0.6}, Case{"dtg", "D", 1., 100., true, 0.6}}) {
    CAPTURE(which.law, which.plant, which.jointJerk);
    const Sum planned = sumOver(which, 1);
    CHECK(planned.exceeded == 0.);
    CHECK(planned.jointExcess <= 1. + 1e-6);
  }
}

TEST_CASE("many tasks: time, jerk and view as the README says", "[plan][long]")
{
  if (vpTestSupport::longer(1) == 1) {
    return; // minutes
  }
  for (const char *plant : {"A", "B", "D"}) {
    DYNAMIC_SECTION("camera at 100 Hz, plant " << plant) { compare(plant, 100., false, vpTestSupport::longer(8)); }
    DYNAMIC_SECTION("arm at 100 Hz, plant " << plant) { compare(plant, 100., true, vpTestSupport::longer(4)); }
    DYNAMIC_SECTION("camera at 1000 Hz, plant " << plant) { compare(plant, 1000., false, vpTestSupport::longer(1)); }
  }
}
