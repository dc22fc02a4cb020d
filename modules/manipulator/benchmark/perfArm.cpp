/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Time of a cycle of the arm, compared with KDL. The percentiles are over individually measured cycles.
#include "vpBenchmark.h"

#include <visp3/direct_core/vpQuantile.h>
#include <visp3/manipulator/vpArmDynamics.h>
#include <visp3/manipulator/vpArmJson.h>
#include <visp3/manipulator/vpArmKinematics.h>
#include <visp3/manipulator/vpClosedLoopKinematics.h>

#include <Eigen/Cholesky>

#include <kdl/chain.hpp>
#include <kdl/chaindynparam.hpp>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainiksolvervel_wdls.hpp>
#include <kdl/chainjnttojacsolver.hpp>

#include <chrono>
#include <random>
#include <vector>

VISP_DIRECT_USING_NAMESPACE

namespace
{
const vpArmModel &arm()
{
  static const vpArmModel model = vpLoadArmJson(std::string(VISP_DIRECT_DATA_DIR) + "/robot/amor.json");
  return model;
}

KDL::Chain chain()
{
  KDL::Chain result;
  const double a[] = {0.0623, 0., 0.097, 0., 0.0502, 0., 0.}, d[] = {0.155, 0., 0.41946, 0., 0.3582, 0., 0.2455};
  const double right = 1.57079632679489661923, alpha[] = {-right, -right, right, -right, right, -right, 0.};
  for (int i = 0; i < 7; ++i) {
    const KDL::RigidBodyInertia body(1., KDL::Vector(0., 0., 0.1), KDL::RotationalInertia(0.1, 0.1, 0.1));
    result.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::RotZ),
                                   KDL::Frame::DH(a[i], alpha[i], d[i], i == 1 ? 2. * right : 0.), body));
  }
  return result;
}

// Configurations within the limits, a little away from them.
const std::vector<vpJointVector> &configurations()
{
  static const std::vector<vpJointVector> all = [] {
    std::mt19937_64 rng(5);
    std::uniform_real_distribution<double> share(0.1, 0.9);
    std::vector<vpJointVector> list(1024, vpJointVector(7));
    for (vpJointVector &q : list) {
      for (int i = 0; i < 7; ++i) {
        const double lower = arm().isContinuous(i) ? -3. : arm().lower()(i),
                     upper = arm().isContinuous(i) ? 3. : arm().upper()(i);
        q(i) = lower + share(rng) * (upper - lower);
      }
    }
    return list;
  }();
  return all;
}

vpRedundancyInput input()
{
  vpRedundancyInput in;
  in.twist = vpTwist(0.05, -0.03, 0.04, 0.1, -0.05, 0.08);
  in.frame = vpArmFrame::Camera;
  in.indices[0] = vpSelfMotionIndex::manipulability();
  in.indices[1] =
      vpSelfMotionIndex::planeDistance(3, Eigen::Vector3d::Zero(), Eigen::Vector3d(1., -1., 0.), vpIndexSense::Repel);
  in.indices[2] = vpSelfMotionIndex::jointLimits();
  in.indexCount = 3;
  in.previous = vpJointVector::Zero(7);
  return in;
}

void percentiles(benchmark::State &state, const std::vector<double> &times)
{
  state.counters["p50_us"] = vpQuantile(times, 0.5);
  state.counters["p99_us"] = vpQuantile(times, 0.99);
}

void ourKinematics(benchmark::State &state)
{
  vpArmData data;
  std::size_t k = 0;
  for (auto _ : state) {
    vpArmKinematics::update(arm(), configurations()[k++ % 1024], data);
    benchmark::DoNotOptimize(data.J.data());
  }
}
BENCHMARK(ourKinematics);

void kdlKinematics(benchmark::State &state)
{
  const KDL::Chain links = chain();
  KDL::ChainFkSolverPos_recursive fk(links);
  KDL::ChainJntToJacSolver jac(links);
  KDL::JntArray q(7);
  KDL::Jacobian J(7);
  KDL::Frame pose;
  std::size_t k = 0;
  for (auto _ : state) {
    q.data = configurations()[k++ % 1024];
    fk.JntToCart(q, pose);
    jac.JntToJac(q, J);
    benchmark::DoNotOptimize(pose.p(0) + J(0, 0));
  }
}
BENCHMARK(kdlKinematics);

// Forward kinematics, Jacobian, inverse, three indices, limits.
void ourCycle(benchmark::State &state)
{
  const vpRedundancySolver solver(arm());
  vpArmData data;
  vpRedundancyInput in = input();
  vpRedundancyOutput out;
  std::vector<double> times;
  times.reserve(1U << 22);
  std::size_t k = 0;
  for (auto _ : state) {
    const auto start = std::chrono::steady_clock::now();
    vpArmKinematics::update(arm(), configurations()[k++ % 1024], data);
    solver.step(data, in, out);
    benchmark::DoNotOptimize(out.velocity.data());
    const std::chrono::duration<double, std::micro> time = std::chrono::steady_clock::now() - start;
    if (times.size() < times.capacity()) {
      times.push_back(time.count());
    }
  }
  percentiles(state, times);
}
BENCHMARK(ourCycle);

// The closest KDL equivalent: damped weighted inverse, without indices, self-motion and limits.
void kdlCycle(benchmark::State &state)
{
  const KDL::Chain links = chain();
  KDL::ChainFkSolverPos_recursive fk(links);
  KDL::ChainIkSolverVel_wdls inverse(links);
  inverse.setLambda(0.01);
  KDL::JntArray q(7), v(7);
  KDL::Frame pose;
  const KDL::Twist twist(KDL::Vector(0.05, -0.03, 0.04), KDL::Vector(0.1, -0.05, 0.08));
  std::vector<double> times;
  times.reserve(1U << 20);
  std::size_t k = 0;
  for (auto _ : state) {
    const auto start = std::chrono::steady_clock::now();
    q.data = configurations()[k++ % 1024];
    fk.JntToCart(q, pose);
    inverse.CartToJnt(q, twist, v);
    benchmark::DoNotOptimize(v(0));
    const std::chrono::duration<double, std::micro> time = std::chrono::steady_clock::now() - start;
    if (times.size() < times.capacity()) {
      times.push_back(time.count());
    }
  }
  percentiles(state, times);
}
BENCHMARK(kdlCycle);

// The closed loop of (3.18) with the prediction of its drift: the solver at least twice.
void ourClosedLoop(benchmark::State &state)
{
  vpClosedLoopKinematics loop(arm());
  vpClosedLoopInput in;
  vpArmData data;
  vpArmKinematics::forward(arm(), configurations()[1], data);
  in.goal = data.tool;
  in.indices = input().indices;
  in.indexCount = 3;
  vpClosedLoopOutput out;
  std::vector<double> times;
  times.reserve(1U << 20);
  std::size_t k = 0;
  vpClosedLoopState now;
  for (auto _ : state) {
    if (k % 1000 == 0) {
      now = vpClosedLoopState();
      now.q = configurations()[k / 1000 % 1024];
    }
    ++k;
    const auto start = std::chrono::steady_clock::now();
    loop.step(in, now, out);
    benchmark::DoNotOptimize(now.q.data());
    const std::chrono::duration<double, std::micro> time = std::chrono::steady_clock::now() - start;
    if (times.size() < times.capacity()) {
      times.push_back(time.count());
    }
  }
  percentiles(state, times);
}
BENCHMARK(ourClosedLoop);

void dynamics(benchmark::State &state)
{
  vpArmDynamics of(arm());
  vpJointVector v = vpJointVector::Constant(7, 0.3), torque = vpJointVector::Zero(7), a;
  std::size_t k = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(of.acceleration(configurations()[k++ % 1024], v, torque, a));
  }
}
BENCHMARK(dynamics);

void kdlDynamics(benchmark::State &state)
{
  const KDL::Chain links = chain();
  KDL::ChainDynParam of(links, KDL::Vector(0., 0., -9.81));
  KDL::JntArray q(7), v(7), bend(7), weight(7);
  KDL::JntSpaceInertiaMatrix M(7);
  v.data.setConstant(0.3);
  std::size_t k = 0;
  for (auto _ : state) {
    q.data = configurations()[k++ % 1024];
    of.JntToMass(q, M);
    of.JntToCoriolis(q, v, bend);
    of.JntToGravity(q, weight);
    const Eigen::LLT<vpJointMatrix> factor(vpJointMatrix(M.data));
    benchmark::DoNotOptimize(vpJointVector(factor.solve(-bend.data - weight.data)).data());
  }
}
BENCHMARK(kdlDynamics);
} // namespace

VP_BENCHMARK_MAIN();
