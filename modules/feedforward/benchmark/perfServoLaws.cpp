/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Time of one cycle: every law, the view filter, and, in the same run and for the same task, ViSP's vpServo and
// vpQuadProg.

#include "vpBenchmark.h"
#include "vpProjectionProblem.h"

#include <visp3/core/vpQuadProg.h>
#include <visp3/feedforward/vpFeedforwardTask.h>
#include <visp3/feedforward/vpServoController.h>
#include <visp3/visual_features/vpFeaturePoint.h>
#include <visp3/visual_features/vpFeatureThetaU.h>
#include <visp3/visual_features/vpFeatureTranslation.h>
#include <visp3/vs/vpServo.h>

#include <cmath>
#include <random>

VISP_DIRECT_USING_NAMESPACE

namespace
{
// 30 points on a square of 16 cm, as in the comparison of the laws; outline: its corners.
struct Task {
  vpHomogeneousMatrix cdMo, cMo;
  vpServoGoal goal;
  vpServoMeasurement measurement;

  explicit Task(double aside = 0.) : cdMo(0., 0., 0.47, 0., 0., 0.), cMo(0.02 + aside, -0.01, 0.55, 0.05, 0.3, 0.1)
  {
    std::mt19937_64 rng(7);
    std::uniform_real_distribution<double> side(-0.08, 0.08);
    goal.cdMo = cdMo;
    measurement.valid = true;
    measurement.cMo = cMo;
    for (int i = 0; i < 30; ++i) {
      const double X = i < 4 ? (i % 2 == 0 ? -0.08 : 0.08) : side(rng), Y = i < 4 ? (i < 2 ? -0.08 : 0.08) : side(rng);
      goal.points.push_back(see(cdMo, X, Y));
      measurement.points.push_back(see(cMo, X, Y));
    }
    measurement.outline.assign(measurement.points.begin(), measurement.points.begin() + 4);
  }

  static vpServoPoint see(const vpHomogeneousMatrix &M, double X, double Y)
  {
    const double Z = M[2][0] * X + M[2][1] * Y + M[2][3];
    return {(M[0][0] * X + M[0][1] * Y + M[0][3]) / Z, (M[1][0] * X + M[1][1] * Y + M[1][3]) / Z, Z, true};
  }
};

void stepOf(benchmark::State &state, const std::string &id, double aside)
{
  const Task task(aside);
  auto servo = vpServoController::create(id);
  servo.setGoal(task.goal);
  for (auto _ : state) {
    benchmark::DoNotOptimize(servo.step(task.measurement, 0.01));
  }
  state.SetLabel(vpToString(servo.step(task.measurement, 0.01).status));
}

void prepare(vpServo &task)
{
  task.setServo(vpServo::EYEINHAND_CAMERA);
  task.setInteractionMatrixType(vpServo::CURRENT, vpServo::PSEUDO_INVERSE);
  task.setLambda(1.);
}

void vpServoPbvs1(benchmark::State &state)
{
  const Task scene;
  vpFeatureTranslation t(vpFeatureTranslation::cdMc);
  vpFeatureThetaU r(vpFeatureThetaU::cdRc);
  vpServo task;
  prepare(task);
  task.addFeature(t);
  task.addFeature(r);
  for (auto _ : state) {
    const vpHomogeneousMatrix cdMc = scene.cdMo * scene.cMo.inverse();
    t.buildFrom(cdMc);
    r.buildFrom(cdMc);
    benchmark::DoNotOptimize(task.computeControlLaw());
  }
  task.kill();
}

void vpServoLookAt(benchmark::State &state)
{
  const Task scene;
  vpFeedforwardTask task("ff-lookat");
  task.setGoal(scene.goal);
  for (auto _ : state) {
    benchmark::DoNotOptimize(task.computeControlLaw(scene.measurement));
  }
}

void vpServoIbvs(benchmark::State &state)
{
  const Task scene;
  std::vector<vpFeaturePoint> features(30), goals(30);
  vpServo task;
  prepare(task);
  for (std::size_t i = 0; i < features.size(); ++i) {
    goals[i].buildFrom(scene.goal.points[i].x, scene.goal.points[i].y, scene.goal.points[i].Z);
    task.addFeature(features[i], goals[i]);
  }
  for (auto _ : state) {
    for (std::size_t i = 0; i < features.size(); ++i) {
      const vpServoPoint &p = scene.measurement.points[i];
      features[i].buildFrom(p.x, p.y, p.Z);
    }
    benchmark::DoNotOptimize(task.computeControlLaw());
  }
  task.kill();
}

void projection16Rows(benchmark::State &state)
{
  vpTwistProjection qp;
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(vpProjectionProblem::all()[i++ % vpProjectionProblem::all().size()].solve(qp));
  }
  double active = 0.;
  for (const vpProjectionProblem &problem : vpProjectionProblem::all()) {
    static_cast<void>(problem.solve(qp));
    active += qp.activeCount();
  }
  state.counters["active"] = active / static_cast<double>(vpProjectionProblem::all().size());
}

void vpQuadProg16Rows(benchmark::State &state)
{
  vpMatrix Q(6, 6), C(16, 6);
  vpColVector r(6), d(16), x(6);
  Q.eye();
  std::size_t next = 0;
  for (auto _ : state) {
    const vpProjectionProblem &problem = vpProjectionProblem::all()[next++ % vpProjectionProblem::all().size()];
    for (unsigned int i = 0; i < 16; ++i) {
      for (unsigned int k = 0; k < 6; ++k) {
        C[i][k] = -problem.A(i, k);
        r[k] = problem.start[k];
      }
      d[i] = -problem.b[i];
    }
    vpQuadProg qp; // fresh, so that no active set of the last problem is taken
    benchmark::DoNotOptimize(qp.solveQPi(Q, r, C, d, x));
  }
}
} // namespace

int main(int argc, char **argv)
{
  for (const std::string &id : vpServoController::ids()) {
    benchmark::RegisterBenchmark(id.c_str(), stepOf, id, 0.);
  }
  benchmark::RegisterBenchmark("pbvs1+cbf, far from the border", stepOf, "pbvs1+cbf", 0.);
  benchmark::RegisterBenchmark("pbvs1+cbf, at the border", stepOf, "pbvs1+cbf", 0.135);
  benchmark::RegisterBenchmark("vpServo, as pbvs1", vpServoPbvs1);
  benchmark::RegisterBenchmark("vpServo, as ff-lookat", vpServoLookAt);
  benchmark::RegisterBenchmark("vpServo, as ibvs", vpServoIbvs);
  benchmark::RegisterBenchmark("vpTwistProjection, 16 rows", projection16Rows);
  benchmark::RegisterBenchmark("vpQuadProg, 16 rows", vpQuadProg16Rows);
  return vpTestSupport::runBenchmarks(argc, argv);
}
