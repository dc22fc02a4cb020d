/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Tables 7.1 and 7.2: three threshold methods, timed and tested on images in changing light, and Algorithm 7.4 as
// printed with four derivative operators.
#include "patternItems.h"

#include "numberText.h"

#include <array>
#include <cmath>
#include <map>
#include <random>
#include <utility>

namespace thesisReport
{
namespace
{
using vpApp::number;

constexpr std::size_t METHODS = 3; // in the order of the table
const std::array<vpPatternThreshold, METHODS> methods = {vpPatternThreshold::Isodata, vpPatternThreshold::MinimumError,
                                                         vpPatternThreshold::Otsu};
constexpr int STILL = 200;    // images in constant light
constexpr int CHANGING = 300; // images in changing light
constexpr int REPEATED = 200; // calls timed together: the clock is too coarse for one
constexpr double MUCH = 2.;   // "much slower", "large deviations": more than what still counts as "similar"

//! \brief Results of one method.
struct ThresholdOutcome {
  Spread ns;    // per call
  Spread still; // thresholds in constant light
  Spread off;   // (threshold - mean of the two grey values) / their difference, in changing light
  std::size_t found = 0, whole = 0;
  [[nodiscard]] double share() const { return static_cast<double>(found) / static_cast<double>(whole); }
  [[nodiscard]] double lost() const { return 1. - share(); }
};
using ThresholdOutcomes = std::array<ThresholdOutcome, METHODS>;

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
void still(const Setting &setting, ThresholdOutcomes &outcomes)
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
           ThresholdOutcome &outcome)
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

void changing(const Setting &setting, ThresholdOutcomes &outcomes)
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

std::vector<Quantity> ratios(const ThresholdOutcomes &all)
{
  const ThresholdOutcome &isodata = all[0], &minimum = all[1], &otsu = all[2];
  return {
      {"time, minimum error over Otsu", "1", MUCH, minimum.ns.median() / otsu.ns.median(), Tolerance::atLeast(),
       Good::Neither, "", "The thesis: medium against fast, \"much slower\". Medians of a call on the histogram."},
      {"time, Isodata over Otsu", "1", 1., isodata.ns.median() / otsu.ns.median(), Tolerance::atMost(MUCH - 1.),
       Good::Smaller,
       "Isodata needs a few steps only, of one pass over the histogram for all; Otsu tries every "
       "threshold.",
       "The thesis: both fast."},
      {"deviation of the threshold in constant light, minimum error over Otsu", "1", MUCH,
       minimum.still.sigma() / otsu.still.sigma(), Tolerance::atLeast(), Good::Neither, "",
       "The thesis: \"large deviations in threshold value\". Standard deviation over " + std::to_string(STILL) +
           " images."},
      {"distance from the middle grey in changing light, minimum error over Otsu", "1", MUCH,
       minimum.off.rms() / otsu.off.rms(), Tolerance::atLeast(), Good::Neither, "",
       "As above; root mean square over " + std::to_string(CHANGING) + " images, each in units of its own contrast."},
      {"share of the cells lost, Isodata over Otsu", "1", 1., isodata.lost() / otsu.lost(),
       Tolerance::atMost(MUCH - 1.), Good::Smaller, "",
       "The thesis: both applicable. Algorithm 7.4 with this threshold; found: within 2 px."},
      {"share of the cells lost, minimum error over Otsu", "1", 1., minimum.lost() / otsu.lost(), Tolerance::atLeast(),
       Good::Neither, "",
       "The thesis: not applicable, against applicable, without a measure. Compared is which of them is worse."}};
}

std::string csvOf(const ThresholdOutcomes &all)
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

Item itemOf(const ThresholdOutcomes &all)
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
    item.quantities.push_back({std::string("share of the cells found, ") + vpToString(methods[m]), "1", std::nullopt,
                               all[m].share(), Tolerance::factor(2.), Good::Larger, "", "In changing light."});
  }
  item.remarks = {
      "The table of the thesis has words. Here \"fast\" and \"medium\" are ratios of times, \"large deviations\" "
      "a ratio of deviations. For \"applicable\" it gives no measure: compared is which method loses more cells. "
      "Minimum error loses the most and still finds " +
          number(100. * all[1].share(), 3) + " % here.",
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

constexpr std::size_t OPERATORS = 4; // in the order of the table
const std::array<vpPatternDerivative, OPERATORS> derivativesOfTable = {
    vpPatternDerivative::Prewitt, vpPatternDerivative::Roberts, vpPatternDerivative::Sobel,
    vpPatternDerivative::Symmetric};
enum Operator : std::size_t { Prewitt, Roberts, Sobel, Symmetric };
constexpr double ALIKE = 1.25; // factor within which errors are "very similar"

constexpr int IMAGES = 400;     // images of a moving product
constexpr int PLACES = 20;      // positions of a product at rest
constexpr int REPETITIONS = 25; // images per position

//! \brief Results of one operator, px.
struct DerivativeOutcome {
  CentreErrors moving;
  double noise = 0.; // standard deviation of y due to noise alone
};
using DerivativeOutcomes = std::array<DerivativeOutcome, OPERATORS>;

vpPatternTrackerSpec optionsFor(vpPatternDerivative derivative)
{
  vpPatternTrackerSpec options;
  options.method = vpPatternMethod::ThesisAlgorithm;
  options.derivative = derivative;
  return options;
}

//! Same positions with different noise: scatter of each cell's y about its own mean.
double noiseOf(const vpProductPattern &product, vpPatternDerivative derivative)
{
  vpImage<unsigned char> image;
  Spread deviations;
  for (int place = 0; place < PLACES; ++place) {
    vpPatternTracker tracker(product.spec().width, product.spec().height, optionsFor(derivative));
    const double x = 17.31 * place, y = 2.39 * place; // all sub-pixel phases
    std::map<std::pair<int, int>, Spread> cells;
    for (int k = 0; k < REPETITIONS; ++k) {
      product.render(x, y, 0., 0., static_cast<unsigned int>(place * REPETITIONS + k), image);
      for (const vpPatternCell &cell : tracker.process(image).cells) {
        if (cell.valid) {
          cells[{cell.row, cell.column}].add(cell.y);
        }
      }
    }
    for (const auto &cell : cells) {
      if (cell.second.count() > REPETITIONS / 2) {
        deviations.add(cell.second.sigma());
      }
    }
  }
  return deviations.rms();
}

DerivativeOutcomes measure(const Setting &setting)
{
  const vpProductPattern product(thesisProduct(setting.seed));
  DerivativeOutcomes outcomes;
  for (std::size_t i = 0; i < OPERATORS; ++i) {
    const double done = static_cast<double>(i);
    outcomes[i].moving = centreErrors(product, optionsFor(derivativesOfTable[i]), IMAGES,
                                      [&](double share) { setting.progress((done + 0.5 * share) / OPERATORS); });
    outcomes[i].noise = noiseOf(product, derivativesOfTable[i]);
  }
  return outcomes;
}

std::vector<Quantity> comparisons(const DerivativeOutcomes &all)
{
  const auto error = [&](Operator a, Operator b) { return all[a].moving.y.rms() / all[b].moving.y.rms(); };
  const auto noise = [&](Operator a, Operator b) { return all[a].noise / all[b].noise; };
  const std::string over =
      "Root mean square error of y over " + std::to_string(IMAGES) + " images of a moving product.";
  const std::string still = "Standard deviation of y over " + std::to_string(REPETITIONS) + " images of each of " +
                            std::to_string(PLACES) + " places.";
  const char *const kernels =
      "Algorithm 7.4 takes the mean of three columns anyway, which makes five columns of a 3 x 3 kernel. Against "
      "independent noise the equal weights of Prewitt are then the better ones: sqrt(19)/9 = 0.48 against 0.50 of "
      "Sobel.";
  return {{"error, Roberts over Symmetric", "1", ALIKE, error(Roberts, Symmetric), Tolerance::atLeast(), Good::Neither,
           "", "The thesis: performance low against medium, and the exception from \"very similar\". " + over},
          {"error, Prewitt over Symmetric", "1", 1., error(Prewitt, Symmetric), Tolerance::atMost(), Good::Neither, "",
           "The thesis: high against medium."},
          {"error, Sobel over Symmetric", "1", 1., error(Sobel, Symmetric), Tolerance::atMost(), Good::Neither, "",
           "The thesis: high against medium."},
          {"error, Prewitt over Symmetric, how alike", "1", 1., error(Prewitt, Symmetric), Tolerance::factor(ALIKE),
           Good::Smaller, "", "The thesis: \"very similar, with exception of Roberts\"."},
          {"error, Sobel over Symmetric, how alike", "1", 1., error(Sobel, Symmetric), Tolerance::factor(ALIKE),
           Good::Smaller, "", "As above."},
          {"noise, Roberts over Symmetric", "1", 1., noise(Roberts, Symmetric), Tolerance::atLeast(), Good::Neither, "",
           "The thesis: suppression low against medium. " + still},
          {"noise, Sobel over Symmetric", "1", 1., noise(Sobel, Symmetric), Tolerance::atMost(), Good::Neither, "",
           "The thesis: high against medium."},
          {"noise, Sobel over Prewitt", "1", 1., noise(Sobel, Prewitt), Tolerance::atMost(), Good::Neither, kernels,
           "The thesis: high against medium."},
          {"noise, Prewitt over Symmetric, how alike", "1", 1., noise(Prewitt, Symmetric), Tolerance::factor(ALIKE),
           Good::Smaller, "", "The thesis: both medium."}};
}

std::string csvOf(const DerivativeOutcomes &all)
{
  std::string csv =
      "operator,rms error of y (px),deviation of y (px),bias of y (px),deviation of y by noise alone (px)\n";
  for (std::size_t i = 0; i < OPERATORS; ++i) {
    const Spread &y = all[i].moving.y;
    csv += std::string(vpToString(derivativesOfTable[i])) + "," + number(y.rms(), 4) + "," + number(y.sigma(), 4) +
           "," + number(y.mean(), 3) + "," + number(all[i].noise, 4) + "\n";
  }
  return csv;
}

void draw(Item &item, const DerivativeOutcomes &all)
{
  vpApp::Plot plot;
  plot.title = "Error of the centre across the rows";
  plot.yLabel = "px";
  plot.fromZero = true;
  plot.height = 340;
  vpApp::PlotCurve error{"rms error, product in motion", colour(0), vpApp::PlotStyle::Points, 6., {}, {}};
  vpApp::PlotCurve noise{"deviation by noise alone", colour(1), vpApp::PlotStyle::Points, 6., {}, {}};
  for (std::size_t i = 0; i < OPERATORS; ++i) {
    plot.categories.emplace_back(vpToString(derivativesOfTable[i]));
    error.x.push_back(static_cast<double>(i) - 0.06); // side by side: the two are nearly equal
    noise.x.push_back(static_cast<double>(i) + 0.06);
    error.y.push_back(all[i].moving.y.rms());
    noise.y.push_back(all[i].noise);
  }
  plot.curves = {error, noise};
  plot.xRange = {-0.5, OPERATORS - 0.5};
  addPlot(item, "operators", "Error of y by derivative operator", "Algorithm 7.4 as printed; smaller is better.",
          {plot});
}
} // namespace

std::vector<Item> thresholds(const Setting &setting)
{
  ThresholdOutcomes outcomes;
  still(setting, outcomes);
  changing(setting, outcomes);
  return {itemOf(outcomes)};
}

std::vector<Item> derivatives(const Setting &setting)
{
  const DerivativeOutcomes all = measure(setting);
  Item item;
  item.id = "table7.2";
  item.quantities = comparisons(all);
  for (std::size_t i = 0; i < OPERATORS; ++i) {
    const std::string name = vpToString(derivativesOfTable[i]);
    item.quantities.push_back(
        {"deviation of y, " + name, "px", std::nullopt, all[i].moving.y.sigma(), Tolerance::factor(1.1), Good::Neither,
         "", "Bias " + number(all[i].moving.y.mean(), 2) + " px; by noise alone " + number(all[i].noise, 3) + " px."});
  }
  item.remarks = {
      "The table of the thesis has words; each order that they imply became a ratio. Derivatives act across the "
      "rows only (y): in x Algorithm 7.4 is no finer than its bounding box, whatever the operator.",
      "\"High\" against \"medium\" and \"very similar\" are both in the thesis, so both are tried."};
  item.parameters = {{"product", "that of the thesis, 160 x 100 px, noise 4"},
                     {"algorithm", "7.4 as printed, Otsu's threshold"}};
  item.data.push_back({"table.csv", csvOf(all)});
  draw(item, all);
  return {item};
}
} // namespace thesisReport
