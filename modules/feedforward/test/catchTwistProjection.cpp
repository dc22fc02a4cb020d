/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The projection against its optimality conditions, against all subsets of rows, and against ViSP's vpQuadProg.
#include "vpCatch.h"

#include <visp3/core/vpQuadProg.h>
#include <visp3/feedforward/vpTwistProjection.h>

#include <Eigen/LU>
#include <Eigen/QR>

#include <limits>
#include <vector>

VISP_DIRECT_USING_NAMESPACE

namespace
{
using Vector = vpTwistProjection::Vector;
using Result = vpTwistProjection::Result;

struct Problem {
  std::vector<Vector> a;
  std::vector<double> b;
  Vector x0;
};

// Feasible by construction: a random interior point satisfies all rows; a third of them duplicates or combinations of
// others, so that active rows are often dependent.
Problem randomProblem(std::mt19937_64 &rng, int rows)
{
  std::normal_distribution<double> gauss;
  std::uniform_real_distribution<double> slack(0., 0.5);
  const auto vector = [&]() { return Vector(Vector::NullaryExpr([&]() { return gauss(rng); })); };
  Problem p;
  p.x0 = 2. * vector();
  const Vector inside = 0.3 * vector();
  for (int i = 0; i < rows; ++i) {
    Vector a = vector();
    if (i > 1 && i % 3 == 0) {
      a = i % 2 == 0 ? 2. * p.a[i - 1] : Vector(p.a[i - 1] + p.a[i - 2]);
    }
    p.a.push_back(a);
    p.b.push_back(a.dot(inside) - (i % 5 == 0 ? 0. : slack(rng)));
  }
  return p;
}

Result solve(vpTwistProjection &qp, const Problem &p)
{
  qp.clear();
  for (std::size_t i = 0; i < p.a.size(); ++i) {
    REQUIRE(qp.addRow(p.a[i], p.b[i]));
  }
  return qp.solve(p.x0);
}

// Optimal if and only if feasible and x - x0 is a non-negative combination of rows that hold with equality.
double kktResidual(const vpTwistProjection &qp, const Problem &p)
{
  const Vector &x = qp.solution();
  double residual = 0.;
  for (std::size_t i = 0; i < p.a.size(); ++i) {
    residual = std::max(residual, (p.b[i] - p.a[i].dot(x)) / p.a[i].norm());
  }
  Vector rest = x - p.x0;
  for (int k = 0; k < qp.activeCount(); ++k) {
    const int i = qp.activeRow(k);
    residual = std::max({residual, -qp.multiplier(k), std::abs(p.b[i] - p.a[i].dot(x)) / p.a[i].norm()});
    rest -= qp.multiplier(k) * p.a[i] / p.a[i].norm();
  }
  return std::max(residual, rest.norm());
}

// Tries every subset of rows as the active set. True if one gives a feasible point, the nearest of which is returned.
bool bruteForce(const Problem &p, Vector &best)
{
  double distance = std::numeric_limits<double>::infinity();
  for (unsigned int mask = 0; mask < (1u << p.a.size()); ++mask) {
    Eigen::MatrixXd A(6, 0);
    Eigen::VectorXd b(0);
    for (std::size_t i = 0; i < p.a.size(); ++i) {
      if (mask >> i & 1u) {
        A.conservativeResize(6, A.cols() + 1);
        b.conservativeResize(b.size() + 1);
        A.rightCols(1) = p.a[i];
        b[b.size() - 1] = p.b[i];
      }
    }
    if (A.cols() > 6) {
      continue;
    }
    const Vector x =
        A.cols() == 0 ? p.x0 : Vector(p.x0 + A * (A.transpose() * A).fullPivLu().solve(b - A.transpose() * p.x0));
    bool feasible = (x - p.x0).norm() < distance;
    for (std::size_t i = 0; feasible && i < p.a.size(); ++i) {
      feasible = p.a[i].dot(x) >= p.b[i] - 1e-9;
    }
    if (feasible) {
      distance = (x - p.x0).norm();
      best = x;
    }
  }
  return distance < std::numeric_limits<double>::infinity();
}
} // namespace

TEST_CASE("the optimality conditions hold on random problems of every size", "[projection]")
{
  const unsigned int seed = vpTestSupport::seed();
  auto rng = vpTestSupport::generator(41);
  vpTwistProjection qp;
  int changed = 0, full = 0;
  for (int run = 0; run < 20000; ++run) {
    const Problem p = randomProblem(rng, run % (vpTwistProjection::capacity + 1));
    if (solve(qp, p) != Result::Solved || !(kktResidual(qp, p) < 1e-8)) {
      CAPTURE(seed, run, static_cast<int>(qp.solve(p.x0)), kktResidual(qp, p));
      FAIL("not optimal");
    }
    changed += qp.activeCount() > 0;
    full += qp.activeCount() == 6;
  }
  CHECK(changed > 15000); // the problems are not trivial,
  CHECK(full > 100);      // including some without freedom left
}

TEST_CASE("small problems agree with trying all active sets, infeasible ones included", "[projection]")
{
  const unsigned int seed = vpTestSupport::seed();
  auto rng = vpTestSupport::generator(42);
  vpTwistProjection qp;
  int infeasible = 0;
  for (int run = 0; run < 400; ++run) {
    Problem p = randomProblem(rng, run % 8);
    if (run % 4 == 3 && p.a.size() > 1) { // contradict the first row, half of the time by a combination
      p.a.back() = -p.a[0] - (run % 8 == 3 ? p.a[1] : Vector::Zero());
      p.b.back() = -p.b[0] - (run % 8 == 3 ? p.b[1] : 0.) + 0.1;
    }
    Vector best;
    const bool feasible = bruteForce(p, best);
    CAPTURE(seed, run);
    REQUIRE((solve(qp, p) == Result::Solved) == feasible);
    if (feasible) {
      REQUIRE((qp.solution() - best).norm() < 1e-7);
    }
    infeasible += !feasible;
  }
  CHECK(infeasible > 50);
}

TEST_CASE("agrees with vpQuadProg", "[projection]")
{
  const unsigned int seed = vpTestSupport::seed();
  auto rng = vpTestSupport::generator(43);
  vpTwistProjection qp;
  vpMatrix Q(6, 6);
  Q.eye();
  for (int run = 0; run < 500; ++run) {
    const Problem p = randomProblem(rng, 2 + run % 30);
    REQUIRE(solve(qp, p) == Result::Solved);
    vpMatrix C(p.a.size(), 6);
    vpColVector d(p.a.size()), r(6), x;
    for (unsigned int i = 0; i < p.a.size(); ++i) {
      for (unsigned int k = 0; k < 6; ++k) {
        C[i][k] = -p.a[i][k];
      }
      d[i] = -p.b[i];
    }
    for (unsigned int k = 0; k < 6; ++k) {
      r[k] = p.x0[k];
    }
    vpQuadProg oracle;
    if (!oracle.solveQPi(Q, r, C, d, x)) {
      continue; // it gives up on some of the dependent rows; the test above covers them
    }
    CAPTURE(seed, run);
    double distance = 0.;
    for (unsigned int k = 0; k < 6; ++k) {
      distance += (x[k] - p.x0[k]) * (x[k] - p.x0[k]);
    }
    REQUIRE((qp.solution() - p.x0).norm() < std::sqrt(distance) + 1e-5);
  }
}

TEST_CASE("odd rows and full capacity", "[projection]")
{
  vpTwistProjection qp;
  CHECK(qp.solve(Vector::Ones()) == Result::Solved);
  CHECK(qp.solution() == Vector::Ones());
  CHECK_FALSE(qp.addRow(Vector::Constant(std::numeric_limits<double>::quiet_NaN()), 0.));
  CHECK_FALSE(qp.addRow(Vector::Ones(), std::numeric_limits<double>::infinity()));
  CHECK(qp.rowCount() == 0);
  CHECK(qp.addRow(Vector::Zero(), -1.)); // 0 >= -1: true
  CHECK(qp.solve(Vector::Ones()) == Result::Solved);
  CHECK(qp.addRow(Vector::Zero(), 1.)); // 0 >= 1: never
  CHECK(qp.solve(Vector::Ones()) == Result::Infeasible);
  qp.clear();
  for (int i = 0; i < vpTwistProjection::capacity; ++i) {
    REQUIRE(qp.addRow(Vector::Unit(i % 6), 0.));
  }
  CHECK_FALSE(qp.addRow(Vector::Unit(0), 0.));
  CHECK(qp.solve(-Vector::Ones()) == Result::Solved);
  CHECK(qp.solution().norm() < 1e-12);
}
