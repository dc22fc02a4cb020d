/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "lab/printing/vpPrintEvaluation.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

BEGIN_VISP_NAMESPACE

namespace
{
void evaluateVelocities(vpPrintRun &run, const std::vector<vpPrintPass> &passes)
{
  const vpPrintExperimentSpec &spec = run.spec;
  vpPrintMetrics &m = run.metrics;
  double measured = 0., truth = 0.;
  int count = 0;
  for (std::size_t i = std::max<std::size_t>(1, static_cast<std::size_t>(spec.evaluateFrom)); i < run.samples.size();
       ++i) {
    const vpPrintSample &s = run.samples[i];
    measured += std::pow(s.measuredVelocity - run.samples[i - 1].referenceVelocity, 2);
    truth += std::pow(s.vx - s.referenceVelocity, 2);
    ++count;
  }
  m.rms_velocity_error = std::sqrt(measured / std::max(1, count));
  m.rms_true_velocity_error = std::sqrt(truth / std::max(1, count));
  double centre = 0.;
  count = 0;
  for (const vpPrintPass &pass : passes) {
    if (pass.time >= spec.evaluateFrom) {
      const double error = std::fabs(pass.velocity - spec.dropVelocity);
      centre += error * error;
      m.centre_velocity_worst = std::max(m.centre_velocity_worst, error);
      ++count;
    }
  }
  m.centre_velocity_error = std::sqrt(centre / std::max(1, count));
}

void evaluateDrops(vpPrintRun &run, const std::vector<vpPrintPass> &passes, double end)
{
  const vpPrintExperimentSpec &spec = run.spec;
  vpPrintMetrics &m = run.metrics;
  std::sort(run.drops.begin(), run.drops.end(),
            [](const vpPrintDrop &a, const vpPrintDrop &b) { return a.landTime < b.landTime; });
  std::map<std::pair<int, int>, int> drops;
  double sum = 0.;
  int within = 0;
  for (const vpPrintDrop &drop : run.drops) {
    const double distance = std::hypot(drop.errorX, drop.errorY);
    sum += distance * distance;
    m.landing_worst_um = std::max(m.landing_worst_um, distance);
    within += distance <= 10. ? 1 : 0;
    ++drops[{drop.row, drop.column}];
  }
  const double n = static_cast<double>(run.drops.size());
  m.landing_rms_um = n > 0. ? std::sqrt(sum / n) : 0.;
  m.landed_within_10um = n > 0. ? within / n : 0.;
  for (const auto &cell : drops) {
    ++m.printed;
    m.doubled += cell.second > 1 ? 1 : 0;
  }
  // The drop of a cell that passed in the last frames may still be pending.
  for (const vpPrintPass &pass : passes) {
    const bool over = pass.time + 4. + spec.travelTime + spec.electronicsDelay <= end;
    m.missed += over && drops.count({pass.row, pass.column}) == 0 ? 1 : 0;
  }
  if (run.drops.size() > 1) {
    const double time = run.drops.back().landTime - run.drops.front().landTime;
    m.throughput_cells_per_s = (n - 1.) / time * spec.frameRate;
  }
  double constant = 0., taken = 0.;
  for (std::size_t i = 1; i < passes.size(); ++i) {
    if (passes[i].row == passes[i - 1].row) {
      const double way = passes[i].x - passes[i - 1].x;
      constant += std::fabs(way) / spec.dropVelocity;
      taken += passes[i].time - passes[i - 1].time;
    }
  }
  m.gain_over_constant = taken > 0. ? constant / taken - 1. : 0.;
}
} // namespace

void vpEvaluatePrintRun(vpPrintRun &run, const std::vector<vpPrintPass> &passes, double end)
{
  run.metrics.frames = static_cast<int>(run.samples.size());
  run.metrics.complete = static_cast<long>(passes.size()) == static_cast<long>(run.spec.rows) * run.spec.cellsPerRow;
  evaluateVelocities(run, passes);
  evaluateDrops(run, passes, end);
}

END_VISP_NAMESPACE
