/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "findings.h"

#include <visp3/core/vpMath.h>

#include <algorithm>
#include <cmath>

namespace trackPattern
{
namespace
{
const char *plural(std::size_t n) { return n == 1 ? "" : "s"; }

//! Most frequent message of the images without a lock.
std::string mostFrequentMessage(const RunResults &results)
{
  std::map<std::string, std::size_t> counts;
  for (const FrameRecord &frame : results.frames) {
    if (frame.status != vpPatternStatus::Tracking) {
      ++counts[frame.message];
    }
  }
  std::string best;
  std::size_t most = 0;
  for (const auto &[message, count] : counts) {
    if (count > most) {
      most = count;
      best = message;
    }
  }
  return best;
}

//! First message to the reader: images are missing at the end.
std::string endingSentence(const RunResults &results)
{
  const std::size_t n = results.frames.size();
  const std::string until =
      text("%zu", n) + (results.expected > 0 ? text(" of %zu", results.expected) : "") + " image" + plural(n);
  switch (results.ending) {
  case Ending::Complete:
    break;
  case Ending::Interrupted:
    return "The run was interrupted after " + until + "; all below holds for these.";
  case Ending::Incomplete:
    return "Incomplete: " + results.failure + ". All below holds for the " + until + " that were seen.";
  }
  return "";
}

std::size_t epochsOf(const RunResults &results)
{
  unsigned int last = 0;
  for (const FrameRecord &frame : results.frames) {
    last = std::max(last, frame.epoch);
  }
  return last;
}

//! Mean and sum of the displacements. Errors of successive ones cancel where the same cells are seen, so that the standard deviation of
//! independent ones is a bound of that of the sum.
std::string motionSentence(const RunResults &results)
{
  double sumX = 0., sumY = 0., squaresX = 0., squaresY = 0.;
  std::size_t n = 0;
  for (const FrameRecord &frame : results.frames) {
    if (std::isfinite(frame.dx) && std::isfinite(frame.dy)) {
      sumX += frame.dx;
      sumY += frame.dy;
      squaresX += frame.sigmaDx * frame.sigmaDx;
      squaresY += frame.sigmaDy * frame.sigmaDy;
      ++n;
    }
  }
  if (n == 0) {
    return "";
  }
  const double count = static_cast<double>(n);
  std::string line = text("It moved by %+.3f px in x and %+.3f px in y from image to image (mean of %zu), by %+.2f and "
                          "%+.2f px in all (standard deviations of at most %.2g and %.2g px).",
                          sumX / count, sumY / count, n, sumX, sumY, std::sqrt(squaresX), std::sqrt(squaresY));
  const std::size_t unknown = results.frames.size() - 1 - n;
  if (unknown > 0) {
    line += text(" Of %zu more image%s it is not known.", unknown, plural(unknown));
  }
  return line;
}

std::string truthSentence(const RunResults &results)
{
  const TruthErrors &e = results.tracking.x.n > 0 ? results.tracking : results.acquiring;
  if (e.x.n == 0) {
    return "";
  }
  std::string line =
      text("Against the truth, %ld centres are off by %.4f px in x and %.4f px in y (standard deviation; "
           "mean %+.4f and %+.4f px).",
           e.x.n, e.x.sigma(), e.y.sigma(), e.x.mean(), e.y.mean());
  if (e.dx.n > 0) {
    line += text(" Displacements are off by %.4f and %.4f px.", e.dx.sigma(), e.dy.sigma());
  }
  if (e.far > 0) {
    line += text(" %ld centres are more than 2 px off and not in these figures.", e.far);
  }
  return line;
}

nlohmann::ordered_json jsonOf(const TruthErrors &e)
{
  const auto one = [](const Errors &errors) -> nlohmann::ordered_json {
    if (errors.n == 0) {
      return nullptr;
    }
    return {{"number", errors.n},
            {"mean_px", errors.mean()},
            {"sigma_px", errors.sigma()},
            {"rms_over_told_sigma", errors.normalisedRms()}};
  };
  return {{"x", one(e.x)},        {"y", one(e.y)},       {"dx", one(e.dx)},
          {"dy", one(e.dy)},      {"two_px_off", e.far}, {"no_cell_there", e.noCell},
          {"other_name", e.slips}};
}

nlohmann::ordered_json spread(const std::vector<double> &values)
{
  const auto finite = [](double value) -> nlohmann::ordered_json {
    if (std::isfinite(value)) {
      return value;
    }
    return nullptr;
  };
  return {{"min", finite(quantile(values, 0.))},
          {"median", finite(quantile(values, 0.5))},
          {"p99", finite(quantile(values, 0.99))},
          {"max", finite(quantile(values, 1.))}};
}
} // namespace

std::vector<std::string> findings(const RunResults &results)
{
  std::vector<std::string> lines;
  const std::size_t n = results.frames.size(), tracked = results.count(vpPatternStatus::Tracking);
  const std::size_t degraded = results.count(vpPatternStatus::Degraded), lost = results.count(vpPatternStatus::Lost);
  const vpPatternLattice &lattice = results.lattice;
  if (results.ending != Ending::Complete) {
    lines.push_back(endingSentence(results));
  }
  if (results.imagesWithCells() == 0) {
    lines.push_back("No pattern was found in " + (n == 1 ? "the image" : text("any of the %zu images", n)) +
                    ". The tracker says: " + mostFrequentMessage(results));
  }
  else {
    std::string line = text("The product was tracked in %zu of %zu image%s", tracked, n, plural(n));
    const std::size_t acquiring = results.count(vpPatternStatus::Acquiring);
    line += text(" (%zu while its looks were learned, %zu degraded, %zu lost).", acquiring, degraded, lost);
    if (tracked == 0) {
      line += " The tracker says: " + mostFrequentMessage(results);
    }
    lines.push_back(line);
    lines.push_back(text("Its lattice has %.3f px from column to column and %.3f px from row to row, and is turned by "
                         "%+.2f degrees.",
                         lattice.columnPitch(), lattice.rowPitch(), vpMath::deg(lattice.angle())));
    if (!motionSentence(results).empty()) {
      lines.push_back(motionSentence(results));
    }
  }
  const double sigmaX = quantile(column(results, &FrameRecord::sigmaX), 0.5);
  const double sigmaDx = quantile(column(results, &FrameRecord::sigmaDx), 0.5);
  if (std::isfinite(sigmaX) && std::isfinite(sigmaDx)) {
    lines.push_back(text("By its own account a centre is good to %.4f px in x and %.4f px in y, the displacement to "
                         "%.4f and %.4f px (medians of the standard deviations).",
                         sigmaX, quantile(column(results, &FrameRecord::sigmaY), 0.5), sigmaDx,
                         quantile(column(results, &FrameRecord::sigmaDy), 0.5)));
  }
  if (results.hasTruth && !truthSentence(results).empty()) {
    lines.push_back(truthSentence(results));
  }
  if (epochsOf(results) > 0) {
    const std::size_t epochs = epochsOf(results);
    lines.push_back(text("The identities of the cells restarted %zu time%s: rows and columns of different epochs do "
                         "not compare.",
                         epochs, plural(epochs)));
  }
  const std::vector<double> times = column(results, &FrameRecord::microseconds);
  lines.push_back(
      text("The tracker took %.*f us per image (median; %.0f us at most), under the load that this machine had.",
           quantile(times, 0.5) < 100. ? 1 : 0, quantile(times, 0.5), quantile(times, 1.)));
  if (results.calibrated) {
    lines.push_back(text("Calibration from %zu view%s. ", results.calibrationViews, plural(results.calibrationViews)) +
                    results.calibrated->message);
  }
  if (results.calibration) {
    lines.push_back(text("In micrometres: %.5g um a pixel, the displacement is good to %.3g um in x.",
                         results.calibration->pixelSizeUm(), sigmaDx * results.calibration->pixelSizeUm()));
  }
  lines.insert(lines.end(), results.remarks.begin(), results.remarks.end());
  return lines;
}

std::string deviationsCsv(const RunResults &results)
{
  std::string csv = "epoch,row,column,x_px,y_px\n";
  for (const auto &[name, deviation] : results.deviations) {
    csv +=
        text("%u,%d,%d,%.4f,%.4f\n", std::get<0>(name), std::get<1>(name), std::get<2>(name), deviation.x, deviation.y);
  }
  return csv;
}

nlohmann::ordered_json summaryOf(const RunResults &results, const Options &options, const std::string &commandLine)
{
  nlohmann::ordered_json json = {{"version", VISP_DIRECT_VERSION},
                                 {"status", results.endingWord()},
                                 {"command", commandLine},
                                 {"input", results.input},
                                 {"image", {{"width", results.width}, {"height", results.height}}},
                                 {"method", vpToString(options.tracker.method)},
                                 {"threshold", vpToString(options.tracker.threshold)},
                                 {"roi", nullptr},
                                 {"images", results.frames.size()},
                                 {"images_by_status",
                                  {{"acquiring", results.count(vpPatternStatus::Acquiring)},
                                   {"tracking", results.count(vpPatternStatus::Tracking)},
                                   {"degraded", results.count(vpPatternStatus::Degraded)},
                                   {"lost", results.count(vpPatternStatus::Lost)}}},
                                 {"images_with_cells", results.imagesWithCells()},
                                 {"epochs", epochsOf(results) + 1},
                                 {"lattice",
                                  {{"column_pitch_px", results.lattice.columnPitch()},
                                   {"row_pitch_px", results.lattice.rowPitch()},
                                   {"angle_deg", vpMath::deg(results.lattice.angle())}}},
                                 {"sigma_x_px", spread(column(results, &FrameRecord::sigmaX))},
                                 {"sigma_y_px", spread(column(results, &FrameRecord::sigmaY))},
                                 {"sigma_dx_px", spread(column(results, &FrameRecord::sigmaDx))},
                                 {"sigma_dy_px", spread(column(results, &FrameRecord::sigmaDy))},
                                 {"microseconds", spread(column(results, &FrameRecord::microseconds))}};
  if (options.roi) {
    json["roi"] = {options.roi->x, options.roi->y, options.roi->width, options.roi->height};
  }
  if (results.hasTruth) {
    json["errors"] = {{"acquiring", jsonOf(results.acquiring)}, {"tracking", jsonOf(results.tracking)}};
  }
  if (results.calibration) {
    json["calibration"] = {{"file", options.calibration}, {"um_per_px", results.calibration->pixelSizeUm()}};
  }
  if (results.calibrated) {
    json["calibrated"] = {{"um_per_px", results.calibrated->calibration.pixelSizeUm()},
                          {"reliable", results.calibrated->reliable},
                          {"kappa1_status", vpToString(results.calibrated->kappa1Status)},
                          {"views", results.calibrationViews}};
  }
  json["remarks"] = results.remarks;
  json["findings"] = findings(results);
  return json;
}
} // namespace trackPattern
