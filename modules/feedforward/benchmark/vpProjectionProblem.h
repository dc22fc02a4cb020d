/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpProjectionProblem.h
 * \brief Quadratic programs of the size of the view filter's, for vpTwistProjection and its peers.
 */
#ifndef vpProjectionProblem_h
#define vpProjectionProblem_h

#include <visp3/feedforward/vpTwistProjection.h>

#include <cmath>
#include <random>
#include <vector>

BEGIN_VISP_NAMESPACE

//! \brief min |x - start|^2 with A x >= b: 16 random rows, feasible at zero; more of them are active than the filter usually has.
struct vpProjectionProblem {
  static constexpr int rows = 16;
  Eigen::Matrix<double, rows, 6> A;
  Eigen::Matrix<double, rows, 1> b;
  vpTwistProjection::Vector start;

  //! 64 different ones, so that no branch predictor learns them by heart.
  static const std::vector<vpProjectionProblem> &all()
  {
    static const std::vector<vpProjectionProblem> problems = [] {
      std::mt19937_64 rng(11);
      std::normal_distribution<double> gauss;
      std::vector<vpProjectionProblem> drawn(64);
      for (vpProjectionProblem &problem : drawn) {
        problem.A = problem.A.NullaryExpr([&] { return gauss(rng); });
        problem.b = problem.b.NullaryExpr([&] { return -0.2 * std::abs(gauss(rng)); });
        problem.start = problem.start.NullaryExpr([&] { return gauss(rng); });
      }
      return drawn;
    }();
    return problems;
  }

  //! By vpTwistProjection, as the view filter uses it: rows are added, then solved.
  [[nodiscard]] bool solve(vpTwistProjection &qp) const noexcept
  {
    qp.clear();
    bool added = true;
    for (int i = 0; i < rows; ++i) {
      added = qp.addRow(A.row(i).transpose(), b[i]) && added;
    }
    return added && qp.solve(start) == vpTwistProjection::Result::Solved;
  }

  //! Distance of \e x from our solution, which is compared before a peer's time is taken.
  [[nodiscard]] double error(const vpTwistProjection::Vector &x) const
  {
    vpTwistProjection qp;
    return solve(qp) ? (qp.solution() - x).norm() : HUGE_VAL;
  }
};

END_VISP_NAMESPACE
#endif
