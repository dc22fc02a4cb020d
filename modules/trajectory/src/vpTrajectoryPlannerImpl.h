/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpTrajectoryPlannerImpl.h
 * \brief Scratch memory and steps of vpTrajectoryPlanner.
 */
#ifndef vpTrajectoryPlannerImpl_h
#define vpTrajectoryPlannerImpl_h

#include "vpCoupledAxes.h"

#include <visp3/trajectory/vpTrajectoryPlanner.h>
#include <visp3/trajectory/vpTrajectoryProblem.h>

#include <vector>

BEGIN_VISP_NAMESPACE

/*!
 * \brief The chain of quintics through vias with the least integrated squared jerk.
 *
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
  void solve(const vpTrajectoryProblem &problem, const std::vector<double> &taus, int axis, const vpAxisState &from,
             const vpAxisState &to) noexcept;
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

//! \brief Velocity and acceleration at a single via as shares of those of the motion of degree 6.
struct vpViaPace {
  double velocity = 1., acceleration = 1.;
  [[nodiscard]] bool isSmooth() const { return velocity == 1. && acceleration == 1.; } //!< Degree 6 itself.
};

struct vpTrajectoryPlanner::Impl {
  Impl(int count, int maxVias);
  // Axes that a unit moves along a straight line, as one: all, or those of a group.
  struct Line {
    bool used = false;
    const vpAxisGroup *group = nullptr;
    [[nodiscard]] bool contains(int i) const { return group == nullptr || group->contains(i); }
  };
  [[nodiscard]] vpMotionAxis &axis(int i) { return axes[static_cast<std::size_t>(i)]; }

  void begin()
  {
    fault = {vpTrajectoryResult::Working, vpTrajectoryFault::None, -1, 0.};
    iterations = 0;
    braking = 0.;
  }

  // A leg: all axes from `from` to `to`.
  void setTasks(const vpTrajectoryProblem &problem);
  void makeUnits(const vpTrajectoryProblem &problem);
  vpCoupledAxes &addUnit();
  [[nodiscard]] bool isAtRest(const vpAxisGroup &group);
  bool addLine(const vpTrajectoryProblem &problem, const vpAxisGroup *group, vpMotionAxis &carrier);
  [[nodiscard]] int firstAxis(int unit) const;
  [[nodiscard]] bool isAcross(const vpAxisTask &task, const vpAxisTask &line, int i);
  double searchLeg(const vpTrajectorySpec &spec, double floor, bool independent);
  void emitLeg(vpTrajectoryPlan &plan, double begin, bool viaLeg);
  void noteFaults();
  [[nodiscard]] double groupBraking() const;
  void finish(const vpTrajectoryProblem &problem, vpTrajectoryPlan &plan);
  [[nodiscard]] double coastingRamp(const vpTrajectoryProblem &problem, int i) const;
  void coast(const vpTrajectoryProblem &problem, int i, const vpAxisState &goal, vpTrajectoryPlan &plan);
  void stopAll(const vpTrajectoryProblem &problem, vpTrajectoryPlan &plan);
  vpTrajectoryStatus judge(const vpTrajectoryProblem &problem, vpTrajectoryPlan &plan);
  double planPointToPoint(const vpTrajectoryProblem &problem, double floor, vpTrajectoryPlan &plan);

  // Vias: one T over all of them, or leg by leg.
  [[nodiscard]] vpMotionFamily &segment(int k, int i)
  {
    return chain[static_cast<std::size_t>(k) * static_cast<std::size_t>(n) + static_cast<std::size_t>(i)];
  }
  [[nodiscard]] int segments(const vpTrajectoryProblem &problem) const;
  void makeChain(const vpTrajectoryProblem &problem);
  double searchChain(const vpTrajectoryProblem &problem, double floor);
  void emitChain(const vpTrajectoryProblem &problem, double T, vpTrajectoryPlan &plan);
  double planLegs(const vpTrajectoryProblem &problem, bool withFloors, vpTrajectoryPlan &plan);
  double planVias(const vpTrajectoryProblem &problem, double floor, vpTrajectoryPlan &plan);

  // When each via is passed: given, or chosen for the least duration of the chain.
  void takeTimes(const vpTrajectoryProblem &problem);
  void setShares(const vpTrajectoryProblem &problem);
  [[nodiscard]] double timeOf(const vpTrajectoryProblem &problem, int k);
  void takeShares(int vias);
  [[nodiscard]] double tryShares(const vpTrajectoryProblem &problem, double floor);
  [[nodiscard]] double needOf(const vpTrajectoryProblem &problem, int k, double T);
  void balanceShares(const vpTrajectoryProblem &problem, double T);
  double chooseTimes(const vpTrajectoryProblem &problem, double floor);
  void giveStates(vpTrajectoryProblem &problem, double T);
  bool optimiseVias(vpTrajectoryProblem &problem);

  int n;
  std::vector<vpAxisState> from, to; // of the current leg, positions as in the problem
  std::vector<vpMotionAxis> axes;    // plus one for the straight line of all axes and of each group
  std::vector<vpCoupledAxes> units;
  std::vector<Line> lines; // by unit
  std::vector<double> unitDurations;
  int unitCount = 0;
  bool straight = false;         // one line for all axes
  std::vector<double> direction; // of the straight line of an axis
  vpViaSpline spline;
  std::vector<vpMotionFamily> chain; // segment by segment, axis by axis
  std::vector<const vpMotionFamily *> column;
  std::vector<double> legs;                     // durations
  std::vector<double> taus, shares, bestShares; // of vias, of segments
  vpViaPace pace;
  int iterations = 0;
  double braking = 0.;      // of groups, in the first leg
  vpTrajectoryStatus fault; // fault other than a limit
};

END_VISP_NAMESPACE
#endif
