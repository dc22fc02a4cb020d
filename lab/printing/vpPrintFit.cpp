/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "lab/printing/vpPrintFit.h"

#include "lab/printing/vpCovarianceSearch.h"

#include <visp3/core/vpException.h>
#include <visp3/direct_core/vpQuantile.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <locale>
#include <sstream>

BEGIN_VISP_NAMESPACE

namespace vpPrintFit
{
namespace
{
constexpr double dropVelocity = 4., meanVelocity = 5.; // px/frame
constexpr double frameRate = 1600.;                    // Hz
constexpr double cell = 220. / 4.5;                    // px
constexpr int stepFrames = 480, figureFrames = 120;    // 0.3 s; 0.075 s
constexpr int settled = 60;                            // frame from which figures 7.13 to 7.15 are evaluated
constexpr double largestError = 1e3;                   // px/frame: of a motion that runs away
constexpr int coarse = 4;                              // parts of a frame, for the search

//! Value that the parameter with this name has.
double of(const Eigen::VectorXd &values, const char *name)
{
  const auto &all = parameters();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const Parameter &p) { return std::string(p.name) == name; });
  return values(found - all.begin());
}

// Position-dependent friction: in figure 7.12 the stage is slower to follow after 0.15 s, at 4 px/frame.
vpXYStageSpec stageOf(const Eigen::VectorXd &values)
{
  vpXYStageSpec stage;
  stage.x.viscous = of(values, "viscous");
  stage.x.coulomb = of(values, "coulomb");
  stage.x.stiction = stage.x.coulomb * of(values, "stiction over coulomb");
  stage.x.stribeckVelocity = of(values, "stribeck velocity");
  stage.x.viscousRise = of(values, "viscous rise");
  stage.x.viscousRiseFrom = 0.15 * frameRate * dropVelocity;
  stage.x.lag = of(values, "lag");
  stage.y = stage.x;
  stage.y.viscousRise = 0.;
  return stage;
}

vpAlphaBetaGains filterOf(const Eigen::VectorXd &values, const std::string &which)
{
  const double alpha = of(values, (which + "alpha").c_str());
  return {alpha, of(values, (which + "beta share").c_str()) * (4. - 2. * alpha)};
}

vpPrintExperimentSpec common(const Eigen::VectorXd &values)
{
  vpPrintExperimentSpec spec;
  spec.stage = stageOf(values);
  spec.sensorModel = vpPrintSensorModel::thesis();
  spec.product.jitter = 0.3;
  spec.product.noise = 4.;
  spec.reference.mode = vpPrintReferenceMode::FixedArrival;
  spec.reference.dropTime = cell / meanVelocity;
  spec.frames = figureFrames;
  spec.evaluateFrom = settled;
  spec.cellsPerRow = 40;
  spec.controller = vpPrintController::Pid;
  spec.pid = vpPrintVelocityControlSpec();
  spec.pid.kp = of(values, "kp");
  spec.pid.ki = of(values, "ki");
  spec.pid.kd = of(values, "kd");
  spec.filter = filterOf(values, "");
  return spec;
}
} // namespace

const std::vector<Parameter> &parameters()
{
  static const std::vector<Parameter> all = {{"viscous", "1/frame", 0.003, 0.5},
                                             {"coulomb", "px/frame^2", 0.01, 0.4},
                                             {"stiction over coulomb", "1", 1., 2.5},
                                             {"stribeck velocity", "px/frame", 0.05, 2.},
                                             {"viscous rise", "1", 0.1, 1.},
                                             {"lag", "frame", 0.05, 2.},
                                             {"kp", "1/frame", 0.01, 1.5},
                                             {"ki", "1/frame", 1e-4, 0.05},
                                             {"kd", "1", 1e-3, 1.},
                                             {"alpha", "1", 0.05, 0.98},
                                             {"beta share", "1", 0.002, 0.9},
                                             {"kp with feedforward", "1/frame", 0.01, 1.5},
                                             {"ki with feedforward", "1/frame", 1e-5, 0.05},
                                             {"kd with feedforward", "1", 1e-3, 1.},
                                             {"mass of the feedforward", "1", 0.3, 2.},
                                             {"viscous of the feedforward", "1/frame", 0.003, 0.5},
                                             {"coulomb of the feedforward", "px/frame^2", 0.01, 0.4},
                                             {"poor alpha", "1", 0.02, 1.5},
                                             {"poor beta share", "1", 0.002, 0.9}};
  return all;
}

Figures figuresOf(const Eigen::VectorXd &values, PoorFilter poor)
{
  if (values.size() != static_cast<Eigen::Index>(parameters().size())) {
    throw vpException(vpException::dimensionError, "the fit of the figures has %d numbers, must have %d",
                      static_cast<int>(values.size()), static_cast<int>(parameters().size()));
  }
  Figures figures;
  figures.step = figures.pid = figures.feedforward = common(values);
  figures.step.reference.mode = vpPrintReferenceMode::ConstantVelocity;
  figures.step.cellsPerRow = 60;
  figures.step.frames = stepFrames;
  vpPrintExperimentSpec &ahead = figures.feedforward;
  ahead.controller = vpPrintController::PidFeedforward;
  ahead.pid.kp = of(values, "kp with feedforward");
  ahead.pid.ki = of(values, "ki with feedforward");
  ahead.pid.kd = of(values, "kd with feedforward");
  ahead.pid.feedforward = true;
  ahead.pid.model.mass = of(values, "mass of the feedforward");
  ahead.pid.model.viscous = of(values, "viscous of the feedforward");
  ahead.pid.model.coulomb = ahead.pid.model.stiction = of(values, "coulomb of the feedforward");
  figures.poor = poor == PoorFilter::Pid ? figures.pid : figures.feedforward;
  figures.poor.filter = filterOf(values, "poor ");
  return figures;
}

namespace
{
//! Runs of an experiment with several seeds.
class Runs
{
public:
  Runs(vpPrintExperimentSpec spec, int seeds, unsigned int first)
  {
    for (unsigned int i = 0; i < static_cast<unsigned int>(seeds); ++i) {
      spec.seed = spec.product.seed = first + i;
      m_runs.push_back(runPrintExperiment(spec));
    }
  }
  [[nodiscard]] double rms(double vpPrintMetrics::*metric) const
  {
    double sum = 0.;
    for (const vpPrintRun &run : m_runs) {
      sum += std::pow(run.metrics.*metric, 2);
    }
    return std::sqrt(sum / static_cast<double>(m_runs.size()));
  }
  //! Mean of a field from one frame to before another.
  [[nodiscard]] double mean(double vpPrintSample::*field, int from, int to) const
  {
    double sum = 0.;
    int count = 0;
    for (const vpPrintRun &run : m_runs) {
      for (const vpPrintSample &s : run.samples) {
        if (s.frame >= from && s.frame < to) {
          sum += s.*field;
          ++count;
        }
      }
    }
    return sum / count;
  }
  //! Mean true velocity when a cell is at the nozzle.
  [[nodiscard]] double centreVelocity() const
  {
    double sum = 0.;
    for (const vpPrintRun &run : m_runs) {
      sum += run.metrics.centre_velocity_mean;
    }
    return sum / static_cast<double>(m_runs.size());
  }
  //! First frame at which the true velocity exceeds a value; median over the seeds.
  [[nodiscard]] double firstAbove(double velocity) const
  {
    std::vector<double> frames;
    for (const vpPrintRun &run : m_runs) {
      const auto at = std::find_if(run.samples.begin(), run.samples.end(),
                                   [&](const vpPrintSample &s) { return std::fabs(s.vx) > velocity; });
      frames.push_back(static_cast<double>(at - run.samples.begin()));
    }
    return vpMedian(frames);
  }

private:
  std::vector<vpPrintRun> m_runs;
};

Statement value(const std::string &name, const std::string &unit, double thesis, double ours, double scale)
{
  return {name, unit, thesis, ours, scale, (ours - thesis) / scale};
}
Statement atMost(const std::string &name, const std::string &unit, double thesis, double ours, double scale)
{
  return {name, unit, thesis, ours, scale, std::max(0., ours - thesis) / scale};
}
Statement atLeast(const std::string &name, const std::string &unit, double thesis, double ours, double scale)
{
  return {name, unit, thesis, ours, scale, std::max(0., thesis - ours) / scale};
}

void addStep(const Runs &step, std::vector<Statement> &all)
{
  constexpr int early = 120, late = 240; // 0.075 s and 0.15 s
  const double moves = step.firstAbove(1e-6);
  all.push_back(atLeast("figure 7.12: frames before the stage moves", "frame", 3., moves, 1.)); // "several iterations"
  all.push_back(atMost("figure 7.12: frames before the stage moves", "frame", 10., moves, 2.));
  all.push_back(
      atMost("figure 7.12: frames until 95 % of the step", "frame", early, step.firstAbove(0.95 * dropVelocity), 10.));
  all.push_back(value("figure 7.12: mean velocity from 0.075 to 0.15 s", "px/frame", dropVelocity,
                      step.mean(&vpPrintSample::vx, early, late), 0.1));
  all.push_back(value("figure 7.12: mean velocity from 0.15 to 0.3 s", "px/frame", dropVelocity,
                      step.mean(&vpPrintSample::vx, late, stepFrames), 0.1));
  all.push_back(atLeast(
      "figure 7.12: force from 0.15 to 0.3 s over that from 0.075 to 0.15 s", "1", 1.05,
      step.mean(&vpPrintSample::force, late, stepFrames) / step.mean(&vpPrintSample::force, early, late), 0.02));
}

// "If this filter would be omitted, the motion will become unstable."
void addUnfiltered(const vpPrintExperimentSpec &ahead, const Runs &with, unsigned int first,
                   std::vector<Statement> &all)
{
  vpPrintExperimentSpec unfiltered = ahead;
  unfiltered.filter = {1., 1e-9}; // the measured velocity itself
  const auto error = &vpPrintMetrics::rms_true_velocity_error;
  double without = 0.;
  try {
    without = Runs(unfiltered, 1, first).rms(error);
  }
  catch (const vpException &) { // ran away, out of all bounds
    without = largestError;
  }
  all.push_back(atLeast("figure 7.14 without a filter: rms true velocity error over that with it", "1", 2.,
                        without / with.rms(error), 0.5));
}
} // namespace

std::vector<Statement> statementsOf(const Figures &figures, int seeds, unsigned int first, int stepSeeds)
{
  const Runs step(figures.step, stepSeeds > 0 ? stepSeeds : seeds, first), pid(figures.pid, seeds, first),
      ahead(figures.feedforward, seeds, first), poor(figures.poor, seeds, first);
  std::vector<Statement> all;
  const auto error = &vpPrintMetrics::rms_velocity_error, centre = &vpPrintMetrics::centre_velocity_error;
  all.push_back(value("rms velocity error, figure 7.13", "px/frame", 0.57, pid.rms(error), 0.02));
  all.push_back(value("rms velocity error, figure 7.14", "px/frame", 0.40, ahead.rms(error), 0.02));
  all.push_back(value("rms velocity error, figure 7.15", "px/frame", 0.64, poor.rms(error), 0.02));
  const std::pair<const char *, const Runs *> named[] = {{"7.13", &pid}, {"7.14", &ahead}, {"7.15", &poor}};
  for (const auto &[figure, runs] : named) {
    all.push_back(value(std::string("mean velocity, figure ") + figure, "px/frame", meanVelocity,
                        runs->mean(&vpPrintSample::vx, settled, figureFrames), 0.1));
  }
  all.push_back(
      value("mean velocity at the centres, figure 7.14", "px/frame", dropVelocity, ahead.centreVelocity(), 0.1));
  all.push_back(atMost("velocity error at the centres, figure 7.14 over 7.13", "1", 0.8,
                       ahead.rms(centre) / pid.rms(centre), 0.1));
  addStep(step, all);
  addUnfiltered(figures.feedforward, ahead, first, all);
  return all;
}

double costOf(const std::vector<Statement> &statements)
{
  double sum = 0.;
  for (const Statement &s : statements) {
    sum += s.residual * s.residual;
  }
  return sum;
}

namespace
{
Eigen::VectorXd valuesAt(const Eigen::VectorXd &unit)
{
  Eigen::VectorXd values(unit.size());
  for (Eigen::Index i = 0; i < unit.size(); ++i) {
    const Parameter &p = parameters()[static_cast<std::size_t>(i)];
    values(i) = p.low * std::pow(p.high / p.low, unit(i));
  }
  return values;
}
} // namespace

Result search(PoorFilter poor, int generations, int seeds, unsigned int seed,
              const std::function<bool(int, double)> &progress)
{
  vpCovarianceSearch search;
  search.generations = generations;
  search.seed = seed;
  const auto n = static_cast<Eigen::Index>(parameters().size());
  const vpCovarianceSearch::Result found = search.run(
      Eigen::VectorXd::Constant(n, 0.5),
      [&](const Eigen::VectorXd &unit) {
        try {
          Figures figures = figuresOf(valuesAt(unit), poor);
          for (vpPrintExperimentSpec *spec : {&figures.step, &figures.pid, &figures.feedforward, &figures.poor}) {
            spec->stageParts = coarse;
          }
          return costOf(statementsOf(figures, seeds, 1, 1));
        }
        catch (const vpException &) { // the stage ran away
          return std::numeric_limits<double>::infinity();
        }
      },
      progress);
  return {valuesAt(found.x), found.value, found.evaluations};
}

std::string csvOf(const Eigen::VectorXd &values, PoorFilter poor, int seeds)
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(6);
  text << "parameter;unit;value;low;high\n";
  for (std::size_t i = 0; i < parameters().size(); ++i) {
    const Parameter &p = parameters()[i];
    text << p.name << ';' << p.unit << ';' << values(static_cast<Eigen::Index>(i)) << ';' << p.low << ';' << p.high
         << '\n';
  }
  text << "statement;unit;thesis;ours;scale;residual\n";
  for (const Statement &s : statementsOf(figuresOf(values, poor), seeds)) {
    text << s.name << ';' << s.unit << ';' << s.thesis << ';' << s.ours << ';' << s.scale << ';' << s.residual << '\n';
  }
  return text.str();
}

Eigen::VectorXd stored()
{
  Eigen::VectorXd values(19);
  values << 0.5, 0.170541, 2.04873, 0.958306, 0.142509, 0.108944, 0.0184708, 0.0346974, 0.394913, 0.189854, 0.00738254,
      0.149255, 0.05, 0.119568, 1.27209, 0.00826556, 0.0427053, 0.739793, 0.742402;
  return values;
}
} // namespace vpPrintFit

END_VISP_NAMESPACE
