/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Table 7.3: time from exposure to the cell centres. Figure 7.11: detection of the centres, and its accuracy.
#include "patternItems.h"

#include "numberText.h"

#include "visp-print-pattern/pictures.h"

namespace thesisReport
{
namespace
{
using vpApp::number;

constexpr int MEASURED_IMAGES = 600;
constexpr double SIGMA = 0.18, SIGMA_UM = 0.85, THREE_SIGMA_UM = 2.55; // from the thesis

CentreErrors errorsOf(vpPatternMethod method, const Setting &setting, double from)
{
  vpPatternTrackerSpec options;
  options.method = method;
  return centreErrors(vpProductPattern(thesisProduct(setting.seed)), options, MEASURED_IMAGES,
                      [&](double share) { setting.progress(from + 0.25 * share); });
}

Quantity row(const std::string &name, const CentreErrors &errors)
{
  return {"deviation of a centre along the rows, " + name,
          "px",
          SIGMA,
          errors.x.sigma(),
          Tolerance::factor(1.15),
          Good::Smaller,
          "",
          "Bias " + number(errors.x.mean(), 2) + " px; across the rows " + number(errors.y.sigma(), 3) + " px; " +
              number(100. * errors.share(), 4) + " % of the whole cells found."};
}

constexpr double RATE = 1600.;                   // Hz
constexpr double EXPOSURE = 50., READOUT = 500.; // us, camera of the thesis
constexpr std::size_t TIMED_IMAGES = 6000;
const char *const PROCESSOR = "A processor of today, against an FPGA that works at the pace of the readout.";

//! A bar of the time line from \e begin to \e end, us.
void addBar(vpApp::Plot &plot, const std::string &label, double row, double begin, double end,
            const std::string &colour)
{
  plot.curves.push_back({label, colour, vpApp::PlotStyle::Solid, 12., {begin, end}, {row, row}});
}

void drawTimeline(Item &item, double processing)
{
  vpApp::Plot plot;
  plot.title = "From exposure to the centres of the cells";
  plot.xLabel = "time since the exposure began (us)";
  plot.yLabel = "rows 0, 1: thesis; row 2: here";
  plot.height = 300;
  plot.xRange = {0., 1100.};
  addBar(plot, "exposure", 1., 0., EXPOSURE, colour(3));
  addBar(plot, "readout", 1., EXPOSURE, EXPOSURE + READOUT, colour(0));
  addBar(plot, "processing", 0., EXPOSURE, 1000., colour(2));
  addBar(plot, "", 2., 0., EXPOSURE, colour(3));
  addBar(plot, "", 2., EXPOSURE, EXPOSURE + READOUT, colour(0));
  addBar(plot, "", 2., EXPOSURE + READOUT, EXPOSURE + READOUT + processing, colour(2));
  plot.curves.push_back({"", "#ffffff", vpApp::PlotStyle::Points, 0.1, {0., 0.}, {-0.5, 2.5}}); // room
  addPlot(item, "timeline", "Time line of an image",
          "Thesis: processing (row 0) runs beside the readout (row 1), from its first line on. Here (row 2) it begins "
          "when the "
          "whole image is there; its bar is the 99 % quantile.",
          {plot});
}
} // namespace

std::vector<Item> visionTiming(const Setting &setting)
{
  const auto images = roundTrip(thesisProduct(setting.seed), 40.);
  const TrackingTime tracker = timeTracking(images, vpPatternTrackerSpec(), TIMED_IMAGES);
  setting.progress(0.5);
  vpPatternTrackerSpec literal;
  literal.method = vpPatternMethod::ThesisAlgorithm;
  const TrackingTime thesis = timeTracking(images, literal, TIMED_IMAGES);
  const double p99 = tracker.us.quantile(0.99);
  Item item;
  item.id = "table7.3";
  item.quantities = {
      {"camera update", "us", 600., 1e6 / RATE, Tolerance::factor(1.1), Good::Neither, "",
       "A setting: 1 over the frame rate of 1600 Hz."},
      {"visual processing", "us", 950., p99, Tolerance::factor(1.2), Good::Smaller, PROCESSOR,
       "99 % quantile over " + std::to_string(TIMED_IMAGES) + " images, time of the core; median " +
           number(tracker.us.median(), 3) + " us."},
      {"start-to-end delay", "us", 1000., EXPOSURE + READOUT + p99, Tolerance::factor(1.2), Good::Smaller, PROCESSOR,
       "Exposure and readout of the thesis's camera, then processing. Transfer into the memory of a computer is not in "
       "it."},
      {"visual processing, Algorithm 7.4 as printed", "us", 950., thesis.us.quantile(0.99), Tolerance::factor(1.2),
       Good::Smaller, PROCESSOR, "As above; median " + number(thesis.us.median(), 3) + " us."},
      {"sum of the thesis's exposure, readout and processing", "us", std::nullopt, EXPOSURE + READOUT + 950.,
       Tolerance::factor(1.1), Good::Neither, "", "Its delay is less, so its processing must run beside the readout."}};
  item.remarks = {
      "How the thesis's 1000 us add up: exposure 50 + processing 950, as processing begins with the first line of "
      "the readout (500 us) and so contains it. Here processing begins when the image is complete: 50 + 500 + "
      "processing.",
      "With 99 of 100 images done in " + number(p99, 3) + " us the readout is " +
          number(100. * READOUT / (EXPOSURE + READOUT + p99), 3) +
          " % of the delay. An FPGA answers in the same time always; a computer without a "
          "real-time kernel does not.",
      "Times are those of the core, without waiting for it while other programs run, and differ from run to run."};
  item.parameters = {{"exposure", "50 us, of the thesis"},
                     {"readout", "500 us, of the thesis"},
                     {"image", "160 x 100 px, about 10 whole cells"}};
  drawTimeline(item, p99);
  return {item};
}

std::vector<Item> detection(const Setting &setting)
{
  const CentreErrors printed = errorsOf(vpPatternMethod::ThesisAlgorithm, setting, 0.);
  const CentreErrors mended = errorsOf(vpPatternMethod::ThesisAlgorithmFixed, setting, 0.25);
  const CentreErrors edges = errorsOf(vpPatternMethod::HalfMaximumEdges, setting, 0.5);
  const CentreErrors tracker = errorsOf(vpPatternMethod::GaussNewton, setting, 0.75);
  const double pixel = thesisProduct(setting.seed).pixelSize;
  Item item;
  item.id = "fig7.11";
  item.quantities = {
      row("Algorithm 7.4 as printed", printed),
      {"the same on the product", "um", SIGMA_UM, pixel * printed.x.sigma(), Tolerance::factor(1.15), Good::Smaller, "",
       "The thesis's 0.85 um are 0.19 px of 4.5 um, not 0.18."},
      {"three times that", "um", THREE_SIGMA_UM, 3. * pixel * printed.x.sigma(), Tolerance::factor(1.15), Good::Smaller,
       "", ""},
      {"most whole cells in an image", "1", 15., static_cast<double>(printed.most), Tolerance::distance(0.),
       Good::Neither, "",
       "The thesis: 3 x 5. On average " + number(1. * static_cast<double>(printed.whole) / MEASURED_IMAGES, 3) + "."},
      {"area of an image of 160 x 100 px of 4.5 um", "mm^2", 0.3, 160. * 100. * 4.5e-3 * 4.5e-3,
       Tolerance::distance(0.05), Good::Neither, "", ""},
      row("Algorithm 7.4 mended", mended),
      row("edges at half height", edges),
      row("vpPatternTracker", tracker),
      {"bias along the rows, Algorithm 7.4 as printed", "px", std::nullopt, printed.x.mean(), Tolerance::factor(1.1),
       Good::Neither, "", "(7.12) takes the width where it needs the width less one."}};
  item.remarks = {
      "The noise of the rendered camera was chosen so that Algorithm 7.4 has the thesis's deviation: that the first "
      "rows agree shows that this is possible, not that it must be so. What the other methods make of the same "
      "images is a measurement.",
      "The thesis does not say along which axis its deviation is. Along the rows, where the printing goes, "
      "Algorithm 7.4 is no finer than its bounding box; across them it is five times as good.",
      "Mended: (7.12) with the width less one, and edges found to a part of a pixel on all four sides. The "
      "tracker leaves out cells whose surroundings are not in view."};
  item.parameters = {
      {"product", "openings of 178 x 52 um every 220 x 80 um, rounded, grey 60 and 170, blur 0.8 px"},
      {"camera", "160 x 100 px, 4.5 um a pixel, noise 4 (4.2 grey values at the mean)"},
      {"images", std::to_string(MEASURED_IMAGES) + " for each method, the product moving at 2.5 to 5.5 px/frame"}};
  vpPrintExperimentSpec spec;
  spec.product = thesisProduct(setting.seed);
  item.figures.push_back(
      {"detection",
       "Output of the centre detection",
       "Left: after Otsu's threshold. Right: cells as Algorithm 7.4 finds them (box, circle) and their true "
       "centres (cross); the circles lie half a pixel to the right.",
       {},
       printPattern::pngOf(printPattern::detection(spec)),
       "png"});
  std::string rows = "method,deviation x (px),bias x (px),deviation y (px),bias y (px),cells found (share)\n";
  const std::pair<const char *, const CentreErrors *> methods[] = {{"Algorithm 7.4 as printed", &printed},
                                                                   {"Algorithm 7.4 mended", &mended},
                                                                   {"edges at half height", &edges},
                                                                   {"vpPatternTracker", &tracker}};
  for (const auto &method : methods) {
    const CentreErrors &of = *method.second;
    rows += std::string(method.first) + "," + number(of.x.sigma(), 4) + "," + number(of.x.mean(), 3) + "," +
            number(of.y.sigma(), 4) + "," + number(of.y.mean(), 3) + "," + number(of.share(), 5) + "\n";
  }
  item.data.push_back({"deviations.csv", rows});
  return {item};
}
} // namespace thesisReport
