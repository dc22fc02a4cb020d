/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpTwistProjection.h
 * \brief The twist nearest to a desired one under linear inequalities: a small quadratic program for real-time code.
 */
#ifndef vpTwistProjection_h
#define vpTwistProjection_h

#include <visp3/direct_core/vpDirectCompat.h>

#include <Eigen/Core>

BEGIN_VISP_NAMESPACE

/*!
 * \class vpTwistProjection
 * \ingroup group_feedforward
 * \brief Solves min |x - x0|^2 subject to a_i^T x >= b_i, for 6 unknowns and a bounded number of rows, exactly.
 *
 * The dual active-set method of Goldfarb and Idnani \cite Goldfarb83 for a unit Hessian: it starts from x0, the
 * unconstrained optimum, and adds the most violated row until none is left. No allocation, no exception; a few
 * microseconds. ViSP's vpQuadProg solves the general problem on the heap.
 *
 * \code
 * vpTwistProjection::Vector wanted, row;
 * wanted << 0.2, 0., 0.1, 0., 0., 0.; // m/s, rad/s
 * row << 0., 0., -1., 0., 0., 0.;
 * vpTwistProjection projection;
 * const bool isAdded = projection.addRow(row, -0.05); // -vz >= -0.05 m/s
 * if (isAdded && projection.solve(wanted) == vpTwistProjection::Result::Solved) {
 *   std::cout << projection.solution().transpose() << std::endl; // 0.2 0 0.05 0 0 0
 * }
 * \endcode
 */
class VISP_EXPORT vpTwistProjection
{
public:
  using Vector = Eigen::Matrix<double, 6, 1>; //!< A twist as six numbers, linear part first.

  static constexpr int capacity = 64; //!< Largest number of rows.

  //! How solve() ended.
  enum class Result {
    Solved,      //!< solution() is the optimum.
    Infeasible,  //!< No x satisfies all rows; solution() is not meaningful.
    NotConverged //!< x0 is not finite, or rounding prevented termination (huge x0); solution() is not meaningful.
  };

  //! Forget all rows.
  void clear() noexcept { m_rowCount = 0; }
  /*!
   * Add a . x >= b. Rows are normalised internally.
   * \return False, and the row is not added, when there are #capacity rows already or a number is not finite.
   */
  [[nodiscard]] bool addRow(const Vector &a, double b) noexcept;
  //! Number of rows.
  [[nodiscard]] int rowCount() const noexcept { return m_rowCount; }

  //! Find the point nearest to \e x0 that satisfies all rows, normalised, to within 1e-10.
  [[nodiscard]] Result solve(const Vector &x0) noexcept;
  //! The optimum of the last solve().
  [[nodiscard]] const Vector &solution() const noexcept { return m_x; }

  //! Number of active rows at the optimum (0 when it is x0 itself).
  [[nodiscard]] int activeCount() const noexcept { return m_activeCount; }
  //! Index, in the order of addRow(), of active row \e i.
  [[nodiscard]] int activeRow(int i) const noexcept { return m_active[i]; }
  /*!
   * Lagrange multiplier of active row \e i, >= 0, for the normalised row: the optimum is x0 + sum multiplier(i)
   * a / |a|, which proves its optimality.
   */
  [[nodiscard]] double multiplier(int i) const noexcept { return m_multipliers[i]; }

private:
  using Matrix = Eigen::Matrix<double, 6, 6>;

  int mostViolatedRow() const noexcept;
  void activate(int row, double multiplier) noexcept;
  void deactivate(int position) noexcept;

  int m_rowCount = 0;
  Eigen::Matrix<double, 6, capacity> m_a;
  Eigen::Matrix<double, capacity, 1> m_b;

  Vector m_x = Vector::Zero();
  int m_activeCount = 0;
  int m_active[6] = {};
  Vector m_multipliers = Vector::Zero();
  Matrix m_J; // orthogonal; its first activeCount columns span the active rows
  Matrix m_R; // upper triangular: active rows = J R
  Vector m_d; // J^T a of the row being added
};

END_VISP_NAMESPACE
#endif
