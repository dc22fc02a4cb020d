/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Figures 6.3 to 6.6: one joint whose goal changes during the motion. Table A.1: peak over mean velocity of the motions
// that minimise the integral of a squared derivative.
#include "part.h"

#include "numberText.h"

#include <visp3/trajectory/vpDirectTrajectory.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>

VISP_DIRECT_USING_NAMESPACE

namespace thesisReport
{
namespace
{
using vpApp::number;

constexpr double PERIOD = 0.001;                                 // s, 1 kHz
constexpr double CHANGE = 1.2;                                   // s
constexpr double MAX_VELOCITY = 0.5, MAX_ACCELERATION = 1.;      // rad/s, rad/s^2
constexpr double FIRST_GOAL = 0.5, SECOND_GOAL = 0.8;            // rad
constexpr double FIRST_DURATION = 1.875;                         // s, first motion at the velocity bound
constexpr double NONE = std::numeric_limits<double>::infinity(); // no limit
constexpr double SETTLED = 1e-6;                                 // s
constexpr double LONGEST = 6.;                                   // s

//! Differences between the figures.
struct Case {
  double maxVelocity = NONE, maxAcceleration = NONE;
  bool keepTime = false; // figure 6.5: t_f is kept
  vpDurationMethod method = vpDurationMethod::Exact;
  int stepsPerCycle = 1000;
  double gain = 1.; // d_v of (6.6), s/(rad/s)
};

struct Motion {
  std::vector<double> t, q, v, a, end; // end: t_f planned in this cycle
  double peakVelocity = 0., peakAcceleration = 0., finalTime = 0., place = 0.;
  int cyclesToSettle = 0; // cycles after the change in which t_f still varied
  double jump = 0.;       // largest change of the acceleration in a cycle
};

vpTrajectoryInput<1> inputOf(const Case &task)
{
  vpTrajectoryInput<1> input;
  input.goal.q[0] = FIRST_GOAL;
  input.maxVelocity[0] = task.maxVelocity;
  input.maxAcceleration[0] = task.maxAcceleration;
  input.spec.minimumDuration = FIRST_DURATION;
  input.spec.freeze = 0.; // replan in every cycle
  return input;
}

void change(const Case &task, vpTrajectoryInput<1> &input)
{
  input.goal.q[0] = SECOND_GOAL;
  input.spec.minimumDuration = 0.;
  input.spec.method = task.method;
  input.spec.thesisStepsPerCycle = task.stepsPerCycle;
  input.spec.thesisVelocityGain = task.gain;
  if (task.keepTime) {
    input.spec.policy = vpReplanPolicy::FixedArrival;
    input.spec.lateArrival = vpLateArrival::ExceedLimits;
    input.spec.arrivalTime = FIRST_DURATION - CHANGE;
  }
}

Motion follow(const Case &task)
{
  vpTrajectoryInput<1> input = inputOf(task);
  vpDirectTrajectory<1> trajectory;
  vpTrajectoryOutput<1> output;
  Motion motion;
  const auto steps = static_cast<long>(LONGEST / PERIOD);
  for (long i = 0; i < steps; ++i) {
    const double now = static_cast<double>(i) * PERIOD;
    if (i == std::lround(CHANGE / PERIOD)) {
      change(task, input);
    }
    const vpTrajectoryResult result = trajectory.step(input, output, PERIOD);
    const double end =
        output.remaining > 0. || motion.end.empty() ? now + PERIOD + output.remaining : motion.end.back();
    if (now > CHANGE && output.remaining > 0. && std::fabs(end - motion.end.back()) > SETTLED) {
      motion.cyclesToSettle = static_cast<int>(i - std::lround(CHANGE / PERIOD)) + 1;
    }
    motion.jump = motion.a.empty() ? 0. : std::max(motion.jump, std::fabs(output.state.a[0] - motion.a.back()));
    motion.t.push_back(now + PERIOD);
    motion.q.push_back(output.state.q[0]);
    motion.v.push_back(output.state.v[0]);
    motion.a.push_back(output.state.a[0]);
    motion.end.push_back(end);
    motion.peakVelocity = std::max(motion.peakVelocity, std::fabs(output.state.v[0]));
    motion.peakAcceleration = std::max(motion.peakAcceleration, std::fabs(output.state.a[0]));
    if (now > CHANGE && (result == vpTrajectoryResult::Finished || result == vpTrajectoryResult::Holding ||
                         (task.keepTime && output.remaining <= 0.))) {
      break;
    }
  }
  motion.finalTime = motion.end.back();
  motion.place = motion.q.back();
  return motion;
}

void draw(Item &item, const Motion &motion, const std::string &title, const std::string &caption)
{
  vpApp::Plot place = vpApp::timePlot("Position", "position (rad)"),
              velocity = vpApp::timePlot("Velocity", "velocity (rad/s)"),
              acceleration = vpApp::timePlot("Acceleration", "acceleration (rad/s^2)"),
              end = vpApp::timePlot("Final time as planned", "t_f (s)");
  addCurve(place, "q", motion.t, motion.q);
  addCurve(velocity, "velocity", motion.t, motion.v);
  addCurve(acceleration, "acceleration", motion.t, motion.a);
  addCurve(end, "t_f", motion.t, motion.end);
  addBound(velocity, MAX_VELOCITY, false);
  addBound(acceleration, MAX_ACCELERATION, true);
  place.marks = {{CHANGE, "the goal moves"}};
  addPlot(item, "motion", title, caption, {place, velocity, acceleration, end});
}

std::vector<std::pair<std::string, std::string>> parameters(const std::string &limits)
{
  return {{"motion",
           "one joint from 0 to 0.5 rad, rest to rest, planned to take 1.875 s; at 1.2 s the goal becomes 0.8 rad"},
          {"bounds", limits},
          {"cycle", "1 ms; figures are taken from every cycle"},
          {"arm", "none: the commanded motion, which is what the figures are about"}};
}

Quantity arrives(const Motion &motion)
{
  return {"position in the end", "rad", SECOND_GOAL, motion.place, Tolerance::distance(1e-6), Good::Neither, "", ""};
}

Quantity continuous(const Motion &motion)
{
  return {"largest change of the acceleration within 1 ms",
          "rad/s^2",
          0.,
          motion.jump,
          Tolerance::atMost(0.1),
          Good::Smaller,
          "",
          "The thesis: the acceleration is continuous. A step would be some rad/s^2."};
}

Item velocityBound()
{
  Case task;
  task.maxVelocity = MAX_VELOCITY;
  const Motion motion = follow(task);
  Item item;
  item.id = "fig6.3";
  item.quantities = {
      {"largest velocity", "rad/s", MAX_VELOCITY, motion.peakVelocity, Tolerance::atMost(1e-9), Good::Smaller, "", ""},
      arrives(motion),
      continuous(motion),
      {"final time after the change", "s", std::nullopt, motion.finalTime, Tolerance::factor(1.1), Good::Neither, "",
       "Only drawn in the thesis. Before the change it is 1.875 s. It is the smallest that keeps the bound."}};
  item.remarks = {"At 1.2 s the time is extended at once, in one cycle, and the bound is kept.",
                  "The moment matters: had the goal moved between 0.52 and 0.93 s, no quintic would keep the bound, "
                  "whatever its time; the planner then puts ramps of the acceleration around one."};
  item.parameters = parameters("velocity 0.5 rad/s, acceleration free");
  draw(item, motion, "Goal moved under way, velocity bounded",
       "The bound of the acceleration is drawn for comparison; it is not in force here.");
  return item;
}

Item accelerationBound()
{
  Case task;
  task.maxAcceleration = MAX_ACCELERATION;
  const Motion motion = follow(task);
  Item item;
  item.id = "fig6.4";
  item.quantities = {{"largest acceleration", "rad/s^2", MAX_ACCELERATION, motion.peakAcceleration,
                      Tolerance::atMost(1e-9), Good::Smaller, "", ""},
                     arrives(motion),
                     continuous(motion),
                     {"final time after the change", "s", std::nullopt, motion.finalTime, Tolerance::factor(1.1),
                      Good::Neither, "", "Only drawn in the thesis."}};
  item.parameters = parameters("acceleration 1 rad/s^2, velocity free");
  item.remarks = {"The first motion takes 1.875 s as in figure 6.3, so that both are in the same state at 1.2 s."};
  draw(item, motion, "Goal moved under way, acceleration bounded",
       "The bound of the velocity is drawn for comparison; it is not in force here.");
  return item;
}

Item timeKept()
{
  Case task;
  task.maxVelocity = MAX_VELOCITY;
  task.maxAcceleration = MAX_ACCELERATION;
  task.keepTime = true;
  const Motion motion = follow(task);
  Item item;
  item.id = "fig6.5";
  item.quantities = {{"largest velocity", "rad/s", MAX_VELOCITY, motion.peakVelocity, Tolerance::atLeast(),
                      Good::Neither, "", "The thesis: the bound is violated when the time is not altered."},
                     {"largest acceleration", "rad/s^2", MAX_ACCELERATION, motion.peakAcceleration,
                      Tolerance::atLeast(), Good::Neither, "", "As above."},
                     {"final time after the change", "s", FIRST_DURATION, motion.finalTime,
                      Tolerance::distance(2. * PERIOD), Good::Neither, "", ""},
                     arrives(motion)};
  item.parameters = parameters("velocity 0.5 rad/s and acceleration 1 rad/s^2, both allowed to be exceeded");
  draw(item, motion, "Goal moved under way, final time kept", "Both bounds are exceeded, as the thesis shows.");
  return item;
}

double largestDifference(const std::vector<double> &a, const std::vector<double> &b)
{
  double largest = 0.;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    largest = std::max(largest, std::fabs(a[i] - b[i]));
  }
  return largest;
}

//! The gain of (6.6) between 0.1 and 10 that settles in the fewest cycles, one step each.
double tunedGain(Case spread)
{
  double best = spread.gain;
  int fewest = std::numeric_limits<int>::max();
  for (int k = -40; k <= 40; ++k) {
    spread.gain = std::pow(10., k / 40.);
    const int cycles = follow(spread).cyclesToSettle;
    if (cycles < fewest) {
      fewest = cycles;
      best = spread.gain;
    }
  }
  return best;
}

Item iterations()
{
  Case exact, whole, spread;
  exact.maxVelocity = whole.maxVelocity = spread.maxVelocity = MAX_VELOCITY;
  whole.method = spread.method = vpDurationMethod::ThesisIteration;
  spread.stepsPerCycle = 1;
  whole.gain = spread.gain = tunedGain(spread);
  const Motion byExact = follow(exact), byWhole = follow(whole), bySpread = follow(spread);
  Item item;
  item.id = "fig6.6";
  item.quantities = {
      {"iterations of (6.6), one each cycle, until t_f is settled", "1", 40.,
       static_cast<double>(bySpread.cyclesToSettle), Tolerance::atMost(), Good::Smaller,
       "(6.6) is a proportional iteration whose rate of convergence changes with the motion; what the thesis takes for "
       "converged it does not say.",
       "With the best of 81 gains from 0.1 to 10, as the thesis says \"when tuned properly\". Settled to 1 us."},
      {"largest difference of the velocity, spread or at once", "rad/s", 0., largestDifference(byWhole.v, bySpread.v),
       Tolerance::atMost(0.01), Good::Smaller,
       "While the iteration is under way the motion follows a time that is still too short.",
       "The thesis: both give a similar velocity."},
      {"largest velocity, exact method in one cycle", "rad/s", MAX_VELOCITY, byExact.peakVelocity,
       Tolerance::atMost(1e-9), Good::Smaller, "", ""},
      {"largest velocity, (6.6) spread over cycles", "rad/s", std::nullopt, bySpread.peakVelocity,
       Tolerance::factor(1.1), Good::Neither, "", "Beyond 0.5 is a violation while it iterates."},
      {"cycles of the exact method until t_f is settled", "1", 1., static_cast<double>(byExact.cyclesToSettle),
       Tolerance::atMost(), Good::Smaller, "", "The thesis: in one iteration for a quintic."}};
  item.parameters = parameters("velocity 0.5 rad/s");
  item.parameters.emplace_back("gain of (6.6)", "d_v = " + number(spread.gain, 3) + " s/(rad/s)");
  vpApp::Plot end = vpApp::timePlot("Final time as planned", "t_f (s)"),
              velocity = vpApp::timePlot("Velocity", "velocity (rad/s)");
  const std::pair<const char *, const Motion *> motions[] = {
      {"exact", &byExact}, {"(6.6) at once", &byWhole}, {"(6.6), a step each cycle", &bySpread}};
  for (const auto &motion : motions) {
    const Motion &m = *motion.second;
    const auto from = m.t.begin() + std::lround((CHANGE - 0.02) / PERIOD);
    const auto to = m.t.begin() + std::lround((CHANGE + 0.15) / PERIOD);
    addCurve(end, motion.first, {from, to}, {m.end.begin() + (from - m.t.begin()), m.end.begin() + (to - m.t.begin())});
    addCurve(velocity, motion.first, m.t, m.v);
  }
  addPlot(item, "iterations", "Constraint optimisation at once and spread over cycles",
          "Top: the time around the change, magnified. Bottom: the whole velocity.", {end, velocity});
  return item;
}

/*!
 * Shortest time from rest to rest over \e h with a stop at h/2 in the middle of the time: one polynomial of order 8, as
 * (6.10) has it.
 */
double stoppedDuration(double h, double maxVelocity, double maxAcceleration)
{
  vpTrajectoryInput<1> input;
  input.goal.q[0] = h;
  input.maxVelocity[0] = maxVelocity;
  input.maxAcceleration[0] = maxAcceleration;
  vpTrajectoryVia<1> via;
  via.q[0] = 0.5 * h;
  via.hasVelocity = via.hasAcceleration = true;
  input.vias.push_back(via);
  vpTrajectoryPlan plan(1);
  static_cast<void>(vpDirectTrajectory<1>::calculate(input, plan));
  return plan.duration();
}

Item viaConstants()
{
  constexpr double velocity = 1.9444, acceleration = 2.6925; // of the thesis
  constexpr double moved = 0.3;                              // rad
  const double printed = acceleration * moved;               // s, (6.10) with alpha_max 1 rad/s^2
  const char *const root = "(6.10) has h outside of the root, where the duration grows with the root of h: by (6.11) "
                           "alpha_8 depends on h.";
  Item item;
  item.id = "eq6.10";
  item.quantities = {
      {"v_8", "1", velocity, stoppedDuration(1., 1., NONE), Tolerance::distance(5e-5), Good::Neither, "",
       "(6.11): duration times largest velocity over the way, with a stop half way."},
      {"alpha_8, way of 1", "1", std::nullopt, stoppedDuration(1., NONE, 1.), Tolerance::distance(5e-5), Good::Neither,
       "", "(6.11): duration times the root of the largest acceleration, over the way; it depends on the way."},
      {"alpha_8, way of 2", "1", acceleration, 0.5 * stoppedDuration(2., NONE, 1.), Tolerance::distance(5e-5),
       Good::Neither, "", "The thesis does not give its way."},
      {"largest acceleration over the limit by (6.10), way of 0.3 rad", "1", 1.,
       std::pow(stoppedDuration(moved, NONE, 1.) / printed, 2), Tolerance::atMost(1e-3), Good::Smaller, root,
       "Limit of 1 rad/s^2; the acceleration goes with the inverse square of the duration."}};
  item.parameters = {{"motion",
                      "three points of position, velocity and acceleration: order 8; at rest at both ends and "
                      "half way, the one choice with which v_8 comes out"}};
  vpApp::Plot plot;
  plot.title = "Duration within 1 rad/s^2";
  plot.xLabel = "way (rad)";
  plot.yLabel = "duration (s)";
  plot.fromZero = true;
  std::vector<double> ways, least, byFormula;
  for (double h = 0.1; h < 3.; h += 0.1) {
    ways.push_back(h);
    least.push_back(stoppedDuration(h, NONE, 1.));
    byFormula.push_back(acceleration * h);
  }
  addCurve(plot, "shortest", ways, least);
  addCurve(plot, "(6.10)", ways, byFormula, vpApp::PlotStyle::Dashed);
  addPlot(item, "duration", plot.title, "Below the solid line the limit is broken.", {plot});
  return item;
}

constexpr double HUMAN = 1.75; // peak over mean velocity of human movements
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
  input.maxAcceleration[0] = NONE;
  input.spec.continuity = continuity;
  vpTrajectoryPlan plan(1);
  static_cast<void>(vpDirectTrajectory<1>::calculate(input, plan));
  return plan.peaks(0).velocity * plan.duration();
}

Item smoothestMotions()
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
  std::vector<double> ratios;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const int order = static_cast<int>(i) + 2;
    const std::string label = "least " + names[i] + " (n_od = " + std::to_string(order) + ")";
    const Eigen::VectorXd motion = smoothest(order);
    ratios.push_back(ratioOf(motion, order));
    item.quantities.push_back(
        {label + ", peak over mean velocity", "1", thesis[i], ratios.back(), Tolerance::distance(0.0006), Good::Neither,
         "The ratio is 35/16 = 2.1875 exactly, which rounds to 2.188 or 2.187.",
         "Least squares over all motions on a grid of " + std::to_string(INTERVALS) + " intervals."});
    item.quantities.push_back({label + ", polynomial of the module trajectory", "1", thesis[i],
                               ratioOfPlan(continuities[i]), Tolerance::distance(0.0005), Good::Neither,
                               "The ratio is 35/16 = 2.1875 exactly, which rounds to 2.188 or 2.187.", ""});
    std::vector<double> t, v;
    const double step = 1. / (INTERVALS - (order - 1));
    for (Eigen::Index k = 0; k + 1 < motion.size(); ++k) {
      t.push_back((static_cast<double>(k) + 0.5 - 0.5 * (order - 1)) * step);
      v.push_back((motion[k + 1] - motion[k]) / step);
    }
    addCurve(velocity, label, t, v);
  }
  const auto nearest = std::min_element(ratios.begin(), ratios.end(),
                                        [](double a, double b) { return std::fabs(a - HUMAN) < std::fabs(b - HUMAN); });
  item.quantities.push_back({"least ratio of a peak to that of the order before", "1", 1.,
                             std::min(ratios[1] / ratios[0], ratios[2] / ratios[1]), Tolerance::atLeast(),
                             Good::Neither, "", "The thesis: with increasing order the peak speed increases."});
  item.quantities.push_back({"order whose ratio is nearest to that of human movements, 1.75", "1", 3.,
                             static_cast<double>(nearest - ratios.begin()) + 2., Tolerance::distance(0.), Good::Neither,
                             "", ""});
  item.remarks = {"The ratio of human movements, 1.75, is a measurement on people and is not repeated.",
                  "(A.9) says that the smoothest motion is a polynomial. The motions here are found without that, and "
                  "their peaks are those of the polynomials."};
  item.parameters = {{"motion", "from 0 to 1, at rest at both ends"}};
  addPlot(item, "velocity", "Velocity of the smoothest motions",
          "The higher the derivative that is kept small, the later and faster the motion.", {velocity});
  return item;
}
} // namespace

std::vector<Part> trajectoryParts()
{
  const auto part = [](const char *id, const char *title, Item (*make)()) {
    return Part{"Chapter 6: direct trajectory generation",
                {{id, title}},
                0.5,
                [make](const Setting &) { return std::vector<Item>{make()}; },
                false};
  };
  return {part("eq6.10", "duration of a motion with a stop on the way", viaConstants),
          part("fig6.3", "goal moved under way, velocity bounded", velocityBound),
          part("fig6.4", "goal moved under way, acceleration bounded", accelerationBound),
          part("fig6.5", "goal moved under way, final time kept: bounds violated", timeKept),
          part("fig6.6", "constraint optimisation in one cycle or spread over cycles", iterations)};
}

std::vector<Part> minimumJerkParts()
{
  return {{"Appendix A: minimum jerk",
           {{"tableA.1", "peak over mean velocity of the smoothest motions"}},
           0.5,
           [](const Setting &) { return std::vector<Item>{smoothestMotions()}; },
           false}};
}
} // namespace thesisReport
