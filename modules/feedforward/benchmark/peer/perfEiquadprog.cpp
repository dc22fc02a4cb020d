/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Part of perfServoLaws where the user has eiquadprog's source: general solvers by the method of Goldfarb and Idnani, once with
// sizes that are known at run time, once at compile time.
#include "../vpProjectionProblem.h"

#include <benchmark/benchmark.h>
#include <eiquadprog/eiquadprog-fast.hpp>
#include <eiquadprog/eiquadprog-rt.hpp>

VISP_DIRECT_USING_NAMESPACE

namespace
{
constexpr int rows = vpProjectionProblem::rows;

// Solve: (problem, x), a call that returns false where it failed.
template <typename Solve> void measure(benchmark::State &state, Solve solve)
{
  vpTwistProjection::Vector x;
  for (const vpProjectionProblem &problem : vpProjectionProblem::all()) {
    if (!solve(problem, x) || problem.error(x) > 1e-9) {
      state.SkipWithError("the solutions differ");
      return;
    }
  }
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(solve(vpProjectionProblem::all()[i++ % vpProjectionProblem::all().size()], x));
  }
}

void eiquadprogFast16Rows(benchmark::State &state)
{
  eiquadprog::solvers::EiquadprogFast qp;
  qp.reset(6, 0, rows);
  const Eigen::MatrixXd Q = Eigen::MatrixXd::Identity(6, 6), E(0, 6);
  const Eigen::VectorXd e(0);
  Eigen::MatrixXd C(rows, 6);
  Eigen::VectorXd g(6), d(rows), solution(6);
  measure(state, [&](const vpProjectionProblem &problem, vpTwistProjection::Vector &x) {
    C = problem.A;
    d = -problem.b;
    g = -problem.start;
    const auto status = qp.solve_quadprog(Q, g, E, e, C, d, solution);
    x = solution;
    return status == eiquadprog::solvers::EIQUADPROG_FAST_OPTIMAL;
  });
}

void eiquadprogRt16Rows(benchmark::State &state)
{
  eiquadprog::solvers::RtEiquadprog<6, 0, rows> qp;
  const Eigen::Matrix<double, 6, 6> Q = Eigen::Matrix<double, 6, 6>::Identity();
  const Eigen::Matrix<double, 0, 6> E;
  const Eigen::Matrix<double, 0, 1> e;
  measure(state, [&](const vpProjectionProblem &problem, vpTwistProjection::Vector &x) {
    return qp.solve_quadprog(Q, -problem.start, E, e, problem.A, -problem.b, x) ==
           eiquadprog::solvers::RT_EIQUADPROG_OPTIMAL;
  });
}
} // namespace

BENCHMARK(eiquadprogFast16Rows)->Name("eiquadprog-fast, 16 rows");
BENCHMARK(eiquadprogRt16Rows)->Name("eiquadprog-rt, 16 rows");
