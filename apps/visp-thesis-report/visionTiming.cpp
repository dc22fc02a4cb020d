/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Table 7.3: time from exposure to the cell centres.
#include "curves.h"
#include "patternItems.h"
#include "patternRun.h"

#include "numberText.h"

namespace thesisReport
{
namespace
{
using vpApp::number;

constexpr double RATE = 1600.;                   // Hz
constexpr double EXPOSURE = 50., READOUT = 500.; // us, camera of the thesis
constexpr std::size_t IMAGES = 6000;
const char *const PROCESSOR = "A processor of today, against an FPGA that works at the pace of the readout.";

//! A bar of the time line from \e begin to \e end, us.
void addBar(vpApp::Plot &plot, const std::string &label, double row, double begin, double end,
            const std::string &colour)
{
  plot.curves.push_back({label, colour, vpApp::PlotStyle::Solid, 12., {begin, end}, {row, row}});
}

void draw(Item &item, double processing)
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
  const TrackingTime tracker = timeTracking(images, vpPatternTrackerSpec(), IMAGES);
  setting.progress(0.5);
  vpPatternTrackerSpec literal;
  literal.method = vpPatternMethod::ThesisAlgorithm;
  const TrackingTime thesis = timeTracking(images, literal, IMAGES);
  const double p99 = tracker.us.quantile(0.99);
  Item item;
  item.id = "table7.3";
  item.quantities = {
      {"camera update", "us", 600., 1e6 / RATE, Tolerance::factor(1.1), Good::Neither, "",
       "A setting: 1 over the frame rate of 1600 Hz."},
      {"visual processing", "us", 950., p99, Tolerance::factor(1.2), Good::Smaller, PROCESSOR,
       "99 % quantile over " + std::to_string(IMAGES) + " images, time of the core; median " +
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
  draw(item, p99);
  return {item};
}
} // namespace thesisReport
