/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "report.h"

#include "htmlReport.h"

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

void addTruthTable(const RunResults &results, vpApp::HtmlReport &page)
{
  vpApp::HtmlTable table;
  table.header.push_back({vpApp::HtmlCell("", "left"), vpApp::HtmlCell("centres, x and y", "", 4),
                          vpApp::HtmlCell("displacement, x and y", "", 2), vpApp::HtmlCell("wrong", "", 3)});
  table.header.push_back({{"status"},
                          {"number"},
                          {"mean (px)"},
                          {"sigma (px)"},
                          {"error / reported sigma"},
                          {"number"},
                          {"sigma (px)"},
                          {"2 px off"},
                          {"no cell there"},
                          {"other name"}});
  const auto row = [&table](const char *name, const TruthErrors &e) {
    if (e.x.n == 0) {
      return;
    }
    const auto number = [](double value, const char *format) {
      return std::isfinite(value) ? text(format, value) : std::string("-");
    };
    table.rows.push_back({vpApp::HtmlCell(name, "left"),
                          {std::to_string(e.x.n)},
                          {number(e.x.mean(), "%+.4f") + ", " + number(e.y.mean(), "%+.4f")},
                          {number(e.x.sigma(), "%.4f") + ", " + number(e.y.sigma(), "%.4f")},
                          {number(e.x.normalisedRms(), "%.2f") + ", " + number(e.y.normalisedRms(), "%.2f")},
                          {std::to_string(e.dx.n)},
                          {number(e.dx.sigma(), "%.4f") + ", " + number(e.dy.sigma(), "%.4f")},
                          {std::to_string(e.far)},
                          {std::to_string(e.noCell)},
                          {std::to_string(e.slips)}});
  };
  row("Acquiring", results.acquiring);
  row("Tracking", results.tracking);
  page.table(table,
             "Found against true. The errors over the standard deviations that the tracker reports are 1 (rms) when "
             "these are right. Wrong: centres more than 2 px off, which are not in the other figures; cells "
             "where there is none; cells that had another row and column before.");
}

void addSettings(const RunResults &results, const Options &options, const std::string &commandLine,
                 vpApp::HtmlReport &page)
{
  std::vector<std::pair<std::string, std::string>> facts = {
      {"Command", commandLine},
      {"Input", results.input},
      {"Image size", text("%u x %u px", results.width, results.height)},
      {"Method, threshold",
       std::string(vpToString(options.tracker.method)) + ", " + vpToString(options.tracker.threshold)}};
  if (options.roi) {
    facts.emplace_back("Looked only at", text("%u x %u px from (%u, %u)", options.roi->width, options.roi->height,
                                              options.roi->x, options.roi->y));
  }
  if (results.calibration) {
    facts.emplace_back("Calibration",
                       options.calibration + text(", %.6g um a pixel", results.calibration->pixelSizeUm()));
  }
  page.facts(facts, "What was asked for.");
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
    lines.push_back(text("No pattern was found in any of the %zu image%s. The tracker says: %s", n, plural(n),
                         mostFrequentMessage(results).c_str()));
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
      text("The tracker took %.*f us per image (median; %.0f us at most), on this machine as busy as it was.",
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

std::string reportPage(const RunResults &results, const Options &options, const std::string &video,
                       const std::string &commandLine)
{
  const auto svg = [](const std::string &document) { return vpApp::dataUri("image/svg+xml", document); };
  vpApp::HtmlReport page("Tracking of a repetitive product",
                         text("%zu image%s of %u x %u px, %s%s", results.frames.size(), plural(results.frames.size()),
                              results.width, results.height, results.input.c_str(),
                              results.ending == Ending::Complete ? "" : text(" (%s)", results.endingWord()).c_str()));
  page.section("What came out");
  page.highlight(findings(results));
  page.picture(vpApp::dataUri("image/png", results.picture), "an image with the cells that were found",
               "One of the images, enlarged. Green crosses: centres of cells that were measured. Red: cells that are "
               "there by the lattice but were not measured, because of dirt or because the pattern ends there.");
  if (!video.empty()) {
    page.videos({{vpApp::dataUri("video/mp4", video), "All images, as in overlay.mp4."}});
  }
  page.section("Status");
  page.picture(
      svg(statusFigure(results)), "status of every image",
      "Acquiring: looking for the lattice, or learning what a cell looks like; cells are measured by their edges "
      "meanwhile. Tracking: all holds. Degraded: fewer cells than there should be, or restarted identities. "
      "Lost: nothing in that image is valid.");
  const bool moves = std::isfinite(quantile(column(results, &FrameRecord::dx), 0.5));
  if (moves) {
    page.section("Motion");
    page.picture(svg(motionFigure(results)), "displacement of every image",
                 "How far the product moved since the image before: x to the right, y down. A gap in the curve: not "
                 "known, as where "
                 "images are missing.");
    if (results.hasTruth) {
      page.picture(svg(errorFigure(results)), "error of the displacement", "The same, minus the truth.");
    }
  }
  page.section("Accuracy");
  if (results.hasTruth) {
    addTruthTable(results, page);
  }
  if (std::isfinite(quantile(column(results, &FrameRecord::sigmaX), 0.5))) {
    page.picture(svg(sigmaFigure(results)), "standard deviations per image",
                 "What the tracker expects its errors to be, from the noise of each image, after learning. It knows "
                 "nothing of errors that all images share, such as those of the lens.");
  }
  const DeviationMap map = deviationMap(results);
  if (!map.svg.empty()) {
    page.section("How regular the product is");
    page.picture(svg(map.svg), "map of the deviations from the lattice",
                 text("Where the %zu cells lie off the regular lattice. Grey dots: the lattice, as on the product, not "
                      "turned. Blue: the cells, their deviations drawn %g times as long; the bar shows the scale. Root "
                      "mean square: %.3f px along the rows, %.3f px across.",
                      map.cells, map.factor, map.rmsX, map.rmsY));
  }
  page.section("Time");
  page.picture(
      svg(timeFigure(results)), "histogram of the time per image",
      "Time of the tracker alone, without reading and drawing. The slow images are those in which it searches or "
      "learns; the two per cent that took longest may lie outside.");
  page.section("Settings");
  addSettings(results, options, commandLine, page);
  page.paragraph(
      "Beside this page: cells.csv (every cell of every image), motion.csv (every image), summary.json. Their "
      "columns are described in data/pattern/README.md.");
  return page.html();
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
