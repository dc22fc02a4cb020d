/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpViaSpline.h
 * \brief The chain of quintics through vias with the least integrated squared jerk.
 */
#ifndef vpViaSpline_h
#define vpViaSpline_h

#include <visp3/trajectory/vpTrajectoryProblem.h>

#include <vector>

BEGIN_VISP_NAMESPACE

/*!
 * Free velocities and accelerations of a via are those for which the third and fourth derivatives are continuous too:
 * the condition for the least integral of the squared jerk at fixed tau. In s they are linear in the given values,
 * hence polynomials in T of degree 2: the chain is a set of vpMotionFamily like any other motion.
 */
class vpViaSpline
{
public:
  //! Allocates for up to this many vias.
  explicit vpViaSpline(int maxVias);
  //! Compute the free values of the vias of one axis. Positions in \e from and \e to are relative to the problem's
  //! start.
  void solve(const vpTrajectoryProblem &problem, int axis, const vpAxisState &from, const vpAxisState &to) noexcept;
  //! Segment \e k = 0 ... vias() of the last chain solved.
  [[nodiscard]] vpMotionFamily segment(int k) const noexcept;

private:
  using Columns = std::array<double, 3>; // coefficients of T^0, T^1, T^2
  struct Node {
    double time = 0.;        // in s
    Columns p{}, d1{}, d2{}; // position, first and second derivative in s of the whole move
  };
  struct Row {
    double below[2][2], diagonal[2][2], above[2][2];
    Columns right[2];
  };
  void assemble(Row &row, const Node &before, const Node &here, const Node &after, int order) const;

  std::vector<Node> m_nodes; // start, vias, goal
  std::vector<Row> m_rows;
};

END_VISP_NAMESPACE
#endif
