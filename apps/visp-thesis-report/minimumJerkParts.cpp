/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Table A.1: peak over mean velocity of the motions that minimise the integral of a squared derivative.
#include "curves.h"
#include "part.h"

#include "numberText.h"

#include <visp3/trajectory/vpDirectTrajectory.h>

#include <Eigen/Dense>

VISP_DIRECT_USING_NAMESPACE

namespace thesisReport
{
namespace
{
constexpr int INTERVALS = 400; // intervals of the discretised motion

/*!
 * The motion from 0 to 1 in unit time, at rest (to the order required by the boundary) at both ends, that minimises the
 * integral of the squared derivative: optimised over all motions on a grid, without assuming polynomials, which
 * appendix A proves.
 * \param order : 2 acceleration, 3 jerk, 4 snap.
 */
Eigen::VectorXd smoothest(int order)
{
  const int points = INTERVALS + 1, inner = points - 2 * order; // order samples at each end are given: at rest
  Eigen::MatrixXd difference = Eigen::MatrixXd::Identity(points, points);
  for (int k = 0; k < order; ++k) {
    const Eigen::Index rows = difference.rows() - 1;
    difference = (difference.bottomRows(rows) - difference.topRows(rows)).eval();
  }
  Eigen::VectorXd given = Eigen::VectorXd::Zero(points);
  given.tail(order).setOnes();
  const Eigen::MatrixXd free = difference.middleCols(order, inner);
  Eigen::VectorXd motion = given;
  motion.segment(order, inner) = free.householderQr().solve(-difference * given);
  return motion;
}

//! Peak over mean velocity. The ends rest for (order - 1) samples in total, so the motion is shorter than the grid.
double ratioOf(const Eigen::VectorXd &motion, int order)
{
  const double step = 1. / (INTERVALS - (order - 1));
  return (motion.tail(motion.size() - 1) - motion.head(motion.size() - 1)).maxCoeff() / step;
}

//! Peak over mean velocity of a quintic of the trajectory module, from its exact peaks.
double ratioOfPlan(vpTrajectoryContinuity continuity)
{
  vpTrajectoryInput<1> input;
  input.goal.q[0] = 1.;
  input.maxAcceleration[0] = std::numeric_limits<double>::infinity();
  input.spec.continuity = continuity;
  vpTrajectoryPlan plan(1);
  static_cast<void>(vpDirectTrajectory<1>::calculate(input, plan));
  return plan.peaks(0).velocity * plan.duration();
}

Item play()
{
  Item item;
  item.id = "tableA.1";
  const std::vector<double> thesis = {1.5, 1.875, 2.186};
  const std::vector<std::string> names = {"acceleration", "jerk", "snap"};
  const std::vector<vpTrajectoryContinuity> continuities = {vpTrajectoryContinuity::C1, vpTrajectoryContinuity::C2,
                                                            vpTrajectoryContinuity::C3};
  vpApp::Plot velocity = vpApp::timePlot("Velocity of the smoothest motions", "velocity over mean velocity");
  velocity.xLabel = "time over duration";
  velocity.height = 380;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const int order = static_cast<int>(i) + 2;
    const std::string label = "least " + names[i] + " (n_od = " + std::to_string(order) + ")";
    const Eigen::VectorXd motion = smoothest(order);
    item.quantities.push_back(
        {label + ", peak over mean velocity", "1", thesis[i], ratioOf(motion, order), Tolerance::distance(0.005),
         Good::Neither, "",
         "Least squares over all motions on a grid of " + std::to_string(INTERVALS) + " intervals."});
    item.quantities.push_back({label + ", polynomial of the module trajectory", "1", thesis[i],
                               ratioOfPlan(continuities[i]), Tolerance::distance(0.002), Good::Neither, "",
                               order == 4 ? "35/16 = 2.1875 exactly; the table is rounded down." : ""});
    std::vector<double> t, v;
    const double step = 1. / (INTERVALS - (order - 1));
    for (Eigen::Index k = 0; k + 1 < motion.size(); ++k) {
      t.push_back((static_cast<double>(k) + 0.5 - 0.5 * (order - 1)) * step);
      v.push_back((motion[k + 1] - motion[k]) / step);
    }
    addCurve(velocity, label, t, v);
  }
  item.remarks = {"The ratio of human movements, 1.75, is a measurement on people and is not repeated.",
                  "(A.9) says that the smoothest motion is a polynomial. The motions here are found without that, and "
                  "their peaks are those of the polynomials."};
  item.parameters = {{"motion", "from 0 to 1, at rest at both ends"}};
  addPlot(item, "velocity", "Velocity of the smoothest motions",
          "The higher the derivative that is kept small, the later and faster the motion.", {velocity});
  return item;
}
} // namespace

std::vector<Part> minimumJerkParts()
{
  return {{"Appendix A: minimum jerk",
           {{"tableA.1", "peak over mean velocity of the smoothest motions"}},
           0.5,
           [](const Setting &) { return std::vector<Item>{play()}; }}};
}
} // namespace thesisReport
