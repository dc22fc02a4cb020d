/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Table 7.1: three threshold methods, timed and tested on images in changing light.
#include "coreTime.h"
#include "curves.h"
#include "patternItems.h"
#include "patternRun.h"

#include "numberText.h"

#include <array>
#include <cmath>
#include <random>

namespace thesisReport
{
namespace
{
using vpApp::number;

constexpr std::size_t METHODS = 3; // in the order of the table
const std::array<vpPatternThreshold, METHODS> methods = {vpPatternThreshold::Isodata, vpPatternThreshold::MinimumError,
                                                         vpPatternThreshold::Otsu};
constexpr int STILL = 200;          // images in constant light
constexpr int CHANGING = 300;       // images in changing light
constexpr int REPEATED = 200;       // calls timed together: the clock is too coarse for one
constexpr double APPLICABLE = 0.95; // fraction of the cells that a method must find

//! \brief Results of one method.
struct Outcome {
  Spread ns;    // per call
  Spread still; // thresholds in constant light
  Spread off;   // (threshold - mean of the two grey values) / their difference, in changing light
  std::size_t found = 0, whole = 0;
  [[nodiscard]] double share() const { return static_cast<double>(found) / static_cast<double>(whole); }
};
using Outcomes = std::array<Outcome, METHODS>;

vpPatternHistogram histogramOf(const vpImage<unsigned char> &image)
{
  vpPatternHistogram histogram{};
  for (unsigned int i = 0; i < image.getSize(); ++i) {
    ++histogram[image.bitmap[i]];
  }
  return histogram;
}

double nanosecondsOf(const vpPatternHistogram &histogram, vpPatternThreshold method)
{
  volatile int result = 0; // prevents removal of the calls
  const double begin = coreSeconds();
  for (int i = 0; i < REPEATED; ++i) {
    result = vpFindThreshold(histogram, method).threshold;
  }
  static_cast<void>(result);
  return 1e9 * (coreSeconds() - begin) / REPEATED;
}

//! Constant light: the same moving product, only noise and position differ.
void still(const Setting &setting, Outcomes &outcomes)
{
  const vpProductPattern product(thesisProduct(setting.seed));
  vpImage<unsigned char> image;
  for (int k = 0; k < STILL; ++k) {
    product.render(4.37 * k, 0.37 * k, 4.37, 0.37, static_cast<unsigned int>(k), image);
    const vpPatternHistogram histogram = histogramOf(image);
    for (std::size_t m = 0; m < METHODS; ++m) {
      outcomes[m].ns.add(nanosecondsOf(histogram, methods[m]));
      outcomes[m].still.add(vpFindThreshold(histogram, methods[m]).threshold);
    }
    setting.progress(0.3 * k / STILL);
  }
}

//! Varying light, contrast, noise and blur: the same images for all methods.
vpProductPatternSpec inSomeLight(std::mt19937_64 &rng)
{
  const auto uniform = [&](double from, double to) { return std::uniform_real_distribution<double>(from, to)(rng); };
  vpProductPatternSpec spec = thesisProduct(static_cast<unsigned int>(rng()));
  spec.dark = uniform(30., 90.);
  spec.bright = spec.dark + uniform(60., 130.);
  spec.illuminationX = uniform(-0.2, 0.2);
  spec.illuminationY = uniform(-0.2, 0.2);
  spec.noise = uniform(1., 8.);
  spec.psf = uniform(0.6, 1.4);
  return spec;
}

void count(const vpProductPattern &product, double x, const vpImage<unsigned char> &image, vpPatternThreshold method,
           Outcome &outcome)
{
  vpPatternTrackerSpec options;
  options.method = vpPatternMethod::ThesisAlgorithm;
  options.threshold = method;
  vpPatternTracker tracker(product.spec().width, product.spec().height, options);
  const vpPatternFrame &frame = tracker.process(image);
  for (const vpPatternTruthCell &cell : product.cells(x, 0.)) {
    if (!cell.complete) {
      continue;
    }
    ++outcome.whole;
    for (const vpPatternCell &c : frame.cells) {
      outcome.found += c.valid && std::hypot(c.x - cell.x, c.y - cell.y) < 2. ? 1 : 0;
    }
  }
}

void changing(const Setting &setting, Outcomes &outcomes)
{
  std::mt19937_64 rng(setting.seed + 7100);
  vpImage<unsigned char> image;
  for (int k = 0; k < CHANGING; ++k) {
    const vpProductPattern product(inSomeLight(rng));
    const double x = std::uniform_real_distribution<double>(-100., 100.)(rng);
    product.render(x, 0., 4., 0., 0, image);
    const vpPatternHistogram histogram = histogramOf(image);
    const double difference = product.spec().bright - product.spec().dark;
    for (std::size_t m = 0; m < METHODS; ++m) {
      const int threshold = vpFindThreshold(histogram, methods[m]).threshold;
      outcomes[m].off.add((threshold + 0.5 - 0.5 * (product.spec().bright + product.spec().dark)) / difference);
      count(product, x, image, methods[m], outcomes[m]);
    }
    setting.progress(0.3 + 0.7 * k / CHANGING);
  }
}

std::vector<Quantity> ratios(const Outcomes &all)
{
  const Outcome &isodata = all[0], &minimum = all[1], &otsu = all[2];
  return {
      {"time, minimum error over Otsu", "1", 1., minimum.ns.median() / otsu.ns.median(), Tolerance::atLeast(),
       Good::Neither, "", "The thesis: medium against fast, \"much slower\". Medians of a call on the histogram."},
      {"time, Isodata over Otsu", "1", 1., isodata.ns.median() / otsu.ns.median(), Tolerance::factor(2.), Good::Smaller,
       "Isodata needs a few steps only, of one pass over the histogram for all; Otsu tries every "
       "threshold.",
       "The thesis: both fast."},
      {"deviation of the threshold in constant light, minimum error over Otsu", "1", 1.,
       minimum.still.sigma() / otsu.still.sigma(), Tolerance::atLeast(), Good::Neither, "",
       "The thesis: \"large deviations in threshold value\". Standard deviation over " + std::to_string(STILL) +
           " images."},
      {"distance from the middle grey in changing light, minimum error over Otsu", "1", 1.,
       minimum.off.rms() / otsu.off.rms(), Tolerance::atLeast(), Good::Neither, "",
       "As above; root mean square over " + std::to_string(CHANGING) + " images, each in units of its own contrast."},
      {"share of the cells found, Otsu", "1", APPLICABLE, otsu.share(), Tolerance::atLeast(), Good::Larger, "",
       "The thesis: applicable. Algorithm 7.4 with this threshold, centre within 2 px."},
      {"share of the cells found, Isodata", "1", APPLICABLE, isodata.share(), Tolerance::atLeast(), Good::Larger, "",
       "The thesis: applicable."},
      {"share of the cells found, minimum error over Otsu", "1", 1., minimum.share() / otsu.share(),
       Tolerance::atMost(), Good::Neither, "", "The thesis: not applicable, so it should find fewer."}};
}

std::string csvOf(const Outcomes &all)
{
  std::string csv =
      "method,time (ns),deviation in constant light (grey),distance from the middle in changing light (share "
      "of the contrast),cells found (share)\n";
  for (std::size_t m = 0; m < METHODS; ++m) {
    csv += std::string(vpToString(methods[m])) + "," + number(all[m].ns.median(), 4) + "," +
           number(all[m].still.sigma(), 4) + "," + number(all[m].off.rms(), 4) + "," + number(all[m].share(), 5) + "\n";
  }
  return csv;
}

vpApp::Plot bars(const std::string &title, const std::string &label, const std::array<double, METHODS> &values)
{
  vpApp::Plot plot;
  plot.title = title;
  plot.yLabel = label;
  plot.height = 300;
  plot.fromZero = true;
  for (std::size_t m = 0; m < METHODS; ++m) { // a bar as an outline
    const double x = static_cast<double>(m), y = values[m];
    plot.categories.emplace_back(vpToString(methods[m]));
    addCurve(plot, vpToString(methods[m]), {x - 0.3, x - 0.3, x + 0.3, x + 0.3}, {0., y, y, 0.});
  }
  plot.xRange = {-0.6, METHODS - 0.4};
  return plot;
}

Item itemOf(const Outcomes &all)
{
  Item item;
  item.id = "table7.1";
  item.quantities = ratios(all);
  for (std::size_t m = 0; m < METHODS; ++m) {
    item.quantities.push_back(
        {std::string("time of a threshold, ") + vpToString(methods[m]), "us", std::nullopt, 1e-3 * all[m].ns.median(),
         Tolerance::factor(2.), Good::Neither, "",
         "From a histogram of 160 x 100 px; making the histogram is not in it. Time of the core; it "
         "differs from run to run."});
  }
  item.remarks = {
      "The table of the thesis has words. Here \"fast\" and \"medium\" are ratios of times, \"large deviations\" "
      "a ratio of deviations, and \"applicable\" is that at least 95 % of the cells are found.",
      "Its row \"complexity\", how hard a method is to build, is no property that can be measured and is left "
      "out."};
  item.parameters = {
      {"constant light", "product of the thesis, noise 4, in motion, " + std::to_string(STILL) + " images"},
      {"changing light", std::to_string(CHANGING) +
                             " products: dark 30 to 90, contrast 60 to 130 grey values, light falling off by up "
                             "to 20 % each way, noise 1 to 8, blur 0.6 to 1.4 px"},
      {"image", "160 x 100 px"}};
  item.data.push_back({"methods.csv", csvOf(all)});
  addPlot(
      item, "thresholds", "Time, steadiness and place of three thresholds",
      "Top: time from a histogram. Middle and bottom: what the threshold does by noise alone, and in changing light.",
      {bars("Time of a threshold", "us",
            {1e-3 * all[0].ns.median(), 1e-3 * all[1].ns.median(), 1e-3 * all[2].ns.median()}),
       bars("Deviation in constant light", "grey values",
            {all[0].still.sigma(), all[1].still.sigma(), all[2].still.sigma()}),
       bars("Distance from the middle grey in changing light", "share of contrast",
            {all[0].off.rms(), all[1].off.rms(), all[2].off.rms()})});
  return item;
}
} // namespace

std::vector<Item> thresholds(const Setting &setting)
{
  Outcomes outcomes;
  still(setting, outcomes);
  changing(setting, outcomes);
  return {itemOf(outcomes)};
}
} // namespace thesisReport
