/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Figure 7.1, (7.1) and (7.2): frame rate against image size, of other systems and of vpPatternTracker; magnification
// times trackability, from closed-loop runs and the tracker's own scale.
#include "patternItems.h"

#include "numberText.h"

#include "lab/printing/vpPrintExperiment.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace thesisReport
{
namespace
{
using vpApp::number;

constexpr double SWING = 40.;            // px, product motion
constexpr std::size_t SMALL_RUN = 3000;  // images timed at the sizes of other systems
constexpr std::size_t LARGE_RUN = 600;   // images timed at the sizes of (7.2)
constexpr unsigned int FEW_PIXELS = 100; // narrower images see the product at half the magnification

//! \brief A vision system of figure 7.1.
struct System {
  const char *name;
  unsigned int width, height; // px
  double rate;                // Hz
};

const std::vector<System> &systems()
{
  static const std::vector<System> all = {{"the thesis", 160, 100, 1600.},    {"Komuro et al.", 320, 240, 1000.},
                                          {"Nakabo et al.", 128, 128, 1000.}, {"Graetzel et al.", 60, 60, 6000.},
                                          {"Ginhoux et al.", 256, 256, 500.}, {"de Best et al.", 90, 90, 1000.}};
  return all;
}

//! \brief Bandwidth of an interface without protocol overhead.
struct Interface {
  const char *name;
  double bytes; // per second
};

const std::vector<Interface> &interfaces()
{
  static const std::vector<Interface> all = {
      {"IEEE 1394b, 98.3 MB/s", 98.304e6}, {"GigE Vision, 125 MB/s", 125e6},     {"Camera Link Base, 255 MB/s", 255e6},
      {"USB3 Vision, 500 MB/s", 500e6},    {"CoaXPress CXP-6, 625 MB/s", 625e6}, {"Camera Link Full, 680 MB/s", 680e6}};
  return all;
}

vpProductPatternSpec productAt(unsigned int width, unsigned int height, unsigned int seed)
{
  vpProductPatternSpec spec = thesisProduct(seed);
  spec.width = width;
  spec.height = height;
  if (width < FEW_PIXELS) { // two periods in each direction must be in view
    for (double *length : {&spec.pitchX, &spec.pitchY, &spec.openingX, &spec.openingY, &spec.cornerRadius}) {
      *length *= 0.5;
    }
    spec.pixelSize *= 2.;
  }
  return spec;
}

TrackingTime timeAt(unsigned int width, unsigned int height, unsigned int seed, const vpPatternTrackerSpec &options,
                    std::size_t least)
{
  const double amplitude = width < FEW_PIXELS ? 0.5 * SWING : SWING;
  return timeTracking(roundTrip(productAt(width, height, seed), amplitude), options, least);
}

std::string sizeText(unsigned int width, unsigned int height)
{
  return std::to_string(width) + " x " + std::to_string(height) + " px";
}

const char *const HOW = "1 over the 99 % quantile of the time of an image, time that the core "
                        "worked for it.";

void compareRates(Item &item, vpApp::Plot &plot, const Setting &setting)
{
  for (const System &system : systems()) {
    const TrackingTime time = timeAt(system.width, system.height, setting.seed, vpPatternTrackerSpec(), SMALL_RUN);
    item.quantities.push_back({"frame rate that the tracker sustains at " + sizeText(system.width, system.height), "Hz",
                               system.rate, time.sustainedRate(), Tolerance::atLeast(), Good::Larger,
                               "This machine is slower than those that it was tried on.",
                               std::string(HOW) + " The other: " + system.name + "; cells in view here: " +
                                   number(time.cells, 3) + ", locked in " + number(100. * time.locked, 4) + " %."});
    plot.curves.push_back({system.name + std::string(", ") + sizeText(system.width, system.height),
                           colour(plot.curves.size()),
                           vpApp::PlotStyle::Points,
                           5.,
                           {1. * system.width * system.height},
                           {system.rate}});
  }
}

void addInterfaces(vpApp::Plot &plot)
{
  const std::vector<double> pixels = {2e3, 2e6};
  static const std::vector<std::string> greys = {"#c8c8c8", "#a8a8a8", "#888888", "#686868", "#484848", "#282828"};
  for (std::size_t i = 0; i < interfaces().size(); ++i) {
    const Interface &link = interfaces()[i];
    plot.curves.push_back(
        {link.name, greys[i], vpApp::PlotStyle::Dashed, 1.4, pixels, {link.bytes / pixels[0], link.bytes / pixels[1]}});
  }
}

//! \brief Times against size.
struct Scaling {
  std::vector<double> pixels, cells, quick, median, p99; // cells per image; us; quick: a tenth of the images
  void add(std::size_t size, const TrackingTime &time)
  {
    pixels.push_back(static_cast<double>(size));
    cells.push_back(time.cells);
    quick.push_back(time.us.quantile(0.1)); // other programs make some images slower
    median.push_back(time.us.median());
    p99.push_back(time.us.quantile(0.99));
  }
};

//! Both methods on the same images.
void scale(const Setting &setting, Scaling &tracker, Scaling &thesis)
{
  vpPatternTrackerSpec literal;
  literal.method = vpPatternMethod::ThesisAlgorithm;
  for (const unsigned int unit : {2U, 3U, 4U, 6U, 8U, 12U, 16U}) {
    const unsigned int width = 80 * unit, height = 50 * unit;
    const auto images = roundTrip(productAt(width, height, setting.seed), SWING);
    tracker.add(images.front().getSize(), timeTracking(images, vpPatternTrackerSpec(), LARGE_RUN));
    if (setting.wants("eq7.2")) {
      thesis.add(images.front().getSize(), timeTracking(images, literal, LARGE_RUN));
    }
    setting.progress(0.04 * unit);
  }
}

//! \brief Time a + b pixels of an image, by least squares of the relative errors.
struct Line {
  double fixed = 0., perPixel = 0.; //!< us.
  double worst = 0.;                //!< Largest relative error of the line.
  [[nodiscard]] double at(double pixels) const { return fixed + perPixel * pixels; }
};

Line lineThrough(const std::vector<double> &pixels, const std::vector<double> &us)
{
  double ww = 0., wx = 0., xx = 0., wy = 0., xy = 0.;
  for (std::size_t i = 0; i < us.size(); ++i) {
    const double w = 1. / us[i], x = pixels[i] / us[i];
    ww += w * w;
    wx += w * x;
    xx += x * x;
    wy += w;
    xy += x;
  }
  Line line;
  line.perPixel = (ww * xy - wx * wy) / (ww * xx - wx * wx);
  line.fixed = (wy - wx * line.perPixel) / ww;
  for (std::size_t i = 0; i < us.size(); ++i) {
    line.worst = std::max(line.worst, std::fabs(line.at(pixels[i]) / us[i] - 1.));
  }
  return line;
}

vpApp::Plot logarithmic(const std::string &title, const std::string &y)
{
  vpApp::Plot plot;
  plot.title = title;
  plot.xLabel = "pixels of an image";
  plot.yLabel = y;
  plot.logX = plot.logY = true;
  plot.width = 1100;
  plot.height = 560;
  return plot;
}

Item systemsItem(const Scaling &scaling, const Setting &setting)
{
  Item item;
  item.id = "fig7.1";
  vpApp::Plot plot = logarithmic("Frame rate against image size", "frame rate (Hz)");
  compareRates(item, plot, setting);
  std::vector<double> rates;
  Spread load; // MB/s
  for (std::size_t i = 0; i < scaling.p99.size(); ++i) {
    rates.push_back(1e6 / scaling.p99[i]);
    load.add(1e-6 * rates.back() * scaling.pixels[i]);
  }
  plot.curves.push_back(
      {"vpPatternTracker, processing alone", "#000000", vpApp::PlotStyle::Solid, 3.5, scaling.pixels, rates});
  addInterfaces(plot);
  const System &thesis = systems().front();
  item.quantities.push_back({"data of the thesis's camera at 8 bit", "MB/s", 26.,
                             thesis.width * thesis.height * thesis.rate * 1e-6, Tolerance::distance(0.5), Good::Neither,
                             "", "Arithmetic: pixels times frame rate."});
  item.remarks = {
      "The coordinates of the other systems are those of the text of section 7.1.1; they solved other tasks than "
      "following a product, so their rates are compared and not their results.",
      "Ours is the processing alone: nothing is exposed, read out or carried over an interface. From 160 x 100 to 1280 "
      "x "
      "800 px it takes " +
          number(load.quantile(0.), 3) + " to " + number(load.largest(), 3) + " MB/s of images.",
      "Which interfaces the thesis drew is not in its text. Here they are the line rates after line coding, without "
      "the "
      "protocol: IEEE 1394b S800, gigabit Ethernet, Camera Link Base (24 bit at 85 MHz) and Full (64 bit at 85 MHz), "
      "USB "
      "3.0 at 5 Gbit/s with 8b/10b, CoaXPress at 6.25 Gbit/s with 8b/10b."};
  item.parameters = {{"product",
                      "220 x 80 um cells at 4.5 um a pixel, noise 4; at 9 um a pixel in images of less than 100 "
                      "px width, which otherwise show less than two periods"},
                     {"timed", std::to_string(SMALL_RUN) + " images of each size after learning"},
                     {"gradation", "8 bit a pixel"}};
  addPlot(item, "systems", "High-speed vision systems",
          "Dots: systems with camera, as given in the thesis. Solid line: images a second that vpPatternTracker "
          "sustains on "
          "one core. Dashed: what interfaces carry at 8 bit a pixel.",
          {plot});
  return item;
}

Item scalingItem(const Scaling &tracker, const Scaling &thesis)
{
  Item item;
  item.id = "eq7.2";
  const Line ours = lineThrough(tracker.pixels, tracker.quick), printed = lineThrough(thesis.pixels, thesis.quick);
  const auto rows = [&item](const std::string &method, const Line &line, const Scaling &times) {
    item.quantities.push_back({"part of the time of 160 x 100 px that does not grow with the pixels, " + method, "1",
                               0., line.fixed / line.at(times.pixels.front()), Tolerance::distance(0.2), Good::Neither,
                               "Cells that the edge of the image cuts are not measured, and small images have more of "
                               "them, so that the time grows "
                               "faster than the pixels; work for every image grows more slowly.",
                               "a / (a + b pixels), by least squares of the relative errors through the times that a "
                               "tenth of the images do not "
                               "exceed, of the core: " +
                                   number(line.fixed, 3) + " us + " + number(1e3 * line.perPixel, 3) +
                                   " ns a pixel, within " + number(100. * line.worst, 2) + " %."});
    item.quantities.push_back(
        {"time of a pixel, " + method, "ns", std::nullopt, 1e3 * line.perPixel, Tolerance::factor(2.), Good::Neither,
         "",
         "From " + number(times.cells.front(), 3) + " cells of an image to " + number(times.cells.back(), 4) + "."});
    const double little = times.median.front() / times.cells.front(), much = times.median.back() / times.cells.back();
    item.quantities.push_back({"time of a cell, 1280 x 800 px over 160 x 100 px, " + method, "1", std::nullopt,
                               much / little, Tolerance::factor(2.), Good::Neither, "",
                               "Medians, of the core, over the cells that are found: " + number(little, 3) + " and " +
                                   number(much, 3) + " us."});
  };
  rows("vpPatternTracker", ours, tracker);
  rows("Algorithm 7.4", printed, thesis);
  item.remarks = {
      "(7.2) says that the time of an image is proportional to its pixels: nothing but b pixels. Times are those of "
      "the core, which other programs change little."};
  item.parameters = {{"images", "160 x 100 to 1280 x 800 px, in the same magnification: more pixels are more cells"},
                     {"timed", std::to_string(LARGE_RUN) + " images of each size, median"}};
  vpApp::Plot plot = logarithmic("Time of an image against its size", "time of an image (us)");
  addCurve(plot, "vpPatternTracker", tracker.pixels, tracker.median);
  addCurve(plot, "vpPatternTracker, 99 %", tracker.pixels, tracker.p99, vpApp::PlotStyle::Dotted);
  addCurve(plot, "Algorithm 7.4", thesis.pixels, thesis.median);
  const std::pair<Line, const Scaling *> fits[] = {{ours, &tracker}, {printed, &thesis}};
  for (const auto &fit : fits) {
    std::vector<double> times;
    for (const double pixels : fit.second->pixels) {
      times.push_back(fit.first.at(pixels));
    }
    addCurve(plot, fit.second == &tracker ? "a + b pixels" : "", tracker.pixels, times, vpApp::PlotStyle::Dashed);
  }
  addPlot(item, "time", "Time of an image against its size", "Median over the images unless the legend says otherwise.",
          {plot});
  return item;
}

constexpr int RUNS = 4;
constexpr double RATE = 1600.;     // Hz
constexpr double TARGET = 28.8e-3; // m/s, from the thesis
constexpr double LENGTH = 220e-6;  // m, cell length

//! \brief Velocities of the product in closed-loop runs, m/s.
struct Velocity {
  Spread atCentres;
  double mean = 0.;
};

Velocity velocityOf(vpPrintExperimentSpec spec, const Setting &setting)
{
  Velocity velocity;
  Spread all;
  const double metres = spec.product.pixelSize * 1e-6 * spec.frameRate; // m/s per px/frame
  for (int run = 0; run < RUNS; ++run) {
    spec.seed = spec.product.seed = setting.seed + static_cast<unsigned int>(run);
    const vpPrintRun result = runPrintExperiment(spec);
    velocity.atCentres.add(result.metrics.centre_velocity_mean * metres);
    for (const vpPrintSample &sample : result.samples) {
      if (sample.frame >= spec.evaluateFrom) {
        all.add(sample.vx * metres);
      }
    }
    setting.progress(0.3 * (run + 1.) / RUNS);
  }
  velocity.mean = all.mean();
  return velocity;
}

//! n_f M of (7.1). \param velocity : m/s. \param length : m.
double indexOf(double rate, double velocity, double length) { return rate / (velocity / length); }

Item trackabilityItem(const Setting &setting)
{
  const Velocity pid = velocityOf(vpPrintExperimentSpec::thesisFeedforward(), setting);
  const Velocity observer = velocityOf(vpPrintExperimentSpec::withObserver(vpPrintSensorModel::tracker()), setting);
  const vpProductPatternSpec product = thesisProduct(setting.seed);
  const TrackingTime time = timeTracking(roundTrip(product, 40.), vpPatternTrackerSpec(), 3000);
  const double pitch = time.pitchX * product.pixelSize * 1e-6;
  const double seen = pid.atCentres.mean();
  Item item;
  item.id = "eq7.1";
  item.quantities = {
      {"n_f M at the centres of the cells, PID with feedforward", "1", 12., indexOf(RATE, seen, pitch),
       Tolerance::factor(1.1), Good::Larger, "",
       "Velocity " + number(1e3 * seen, 4) + " mm/s with a cell at the nozzle in " + std::to_string(RUNS) +
           " closed-loop runs, length " + number(1e6 * pitch, 5) + " um from the tracker's lattice."},
      {"n_f M at the centres of the cells, observer with preview", "1", 12.,
       indexOf(RATE, observer.atCentres.mean(), pitch), Tolerance::factor(1.1), Good::Larger, "",
       "Velocity " + number(1e3 * observer.atCentres.mean(), 4) + " mm/s."},
      {"velocity at the centres, PID with feedforward", "mm/s", 1e3 * TARGET, 1e3 * seen, Tolerance::factor(1.1),
       Good::Neither, "", "The thesis gives its target."},
      {"length of a cell", "um", 1e6 * LENGTH, 1e6 * pitch, Tolerance::factor(1.01), Good::Neither, "",
       "Distance of neighbouring cells as the tracker sees it, " + number(product.pixelSize, 2) + " um a pixel."},
      {"n_f M at the mean velocity, observer with preview", "1", std::nullopt, indexOf(RATE, observer.mean, pitch),
       Tolerance::factor(1.1), Good::Neither, "", "Between the cells the product is faster."},
      {"n_f M if the camera gave all frames that the tracker can take", "1", std::nullopt,
       indexOf(time.sustainedRate(), seen, pitch), Tolerance::factor(2.), Good::Neither, "",
       "Ogawa et al., as given in the thesis: above 20. " + number(1e-3 * time.sustainedRate(), 3) +
           " kHz by the 99 % quantile of the time of an image, measured here."}};
  item.remarks = {
      "(7.1) does not know the image: in pixels it is the length of the target over its motion from frame to "
      "frame. At 4 px/frame a cell of 48.9 px gives 12.2, whatever the tracker does; the way to a higher value "
      "is a faster camera or a slower product."};
  item.parameters = {{"camera", "1600 frames a second, 4.5 um a pixel"},
                     {"runs",
                      "figure 7.14 (thesis's sensor) and the observer with our tracker's errors, velocity 4 px/frame "
                      "at the centres; from frame 60 on"},
                     {"Ogawa et al.", "n_f M > 20"}};
  std::vector<double> velocities, here, fast, ogawa;
  for (double v = 10.; v <= 60.; v += 1.) {
    velocities.push_back(v);
    here.push_back(indexOf(RATE, 1e-3 * v, pitch));
    fast.push_back(indexOf(5000., 1e-3 * v, pitch));
  }
  vpApp::Plot plot;
  plot.title = "Magnification times trackability";
  plot.xLabel = "velocity of the product (mm/s)";
  plot.yLabel = "n_f M";
  plot.fromZero = true;
  addCurve(plot, "1600 Hz, (7.1)", velocities, here);
  addCurve(plot, "5000 Hz, (7.1)", velocities, fast);
  plot.curves.push_back(
      {"at the centres, PID", colour(3), vpApp::PlotStyle::Points, 5., {1e3 * seen}, {indexOf(RATE, seen, pitch)}});
  plot.curves.push_back({"mean velocity, observer",
                         colour(4),
                         vpApp::PlotStyle::Points,
                         5.,
                         {1e3 * observer.mean},
                         {indexOf(RATE, observer.mean, pitch)}});
  addBound(plot, 20., false, "Ogawa et al.");
  addPlot(item, "index", "Magnification times trackability against velocity",
          "Curves: the formula with the pitch that the tracker sees. Dots: velocities of closed-loop runs.", {plot});
  return item;
}
} // namespace

std::vector<Item> frameRates(const Setting &setting)
{
  Scaling tracker, thesis;
  scale(setting, tracker, thesis);
  std::vector<Item> items;
  if (setting.wants("fig7.1")) {
    items.push_back(systemsItem(tracker, setting));
  }
  if (setting.wants("eq7.2")) {
    items.push_back(scalingItem(tracker, thesis));
  }
  return items;
}

std::vector<Item> dropDelay(const Setting &)
{
  constexpr double HEIGHT = 1e-3, SPEED = 5., PIXEL = 4.5e-6, ALLOWED = 10e-6; // m, m/s, m, m, from the thesis
  constexpr double AT_CENTRE = 4., MEAN = 5., TOLERATED = 2.9;                 // px/frame, from the thesis
  constexpr double flight = HEIGHT / SPEED, unit = PIXEL * RATE, cells = 480.; // s, m/s
  constexpr double row = cells * LENGTH / (MEAN * unit);                       // s
  Item item;
  item.id = "fig7.3";
  const auto add = [&item](const char *name, const char *unitName, double thesis, double follows, double rounding) {
    item.quantities.push_back({name, unitName, thesis, follows, Tolerance::distance(rounding), Good::Neither, "", ""});
  };
  add("way of the stage during the flight of a drop", "um", 5.76, 1e6 * AT_CENTRE * unit * flight, 0.005);
  add("the same in pixels", "px", 1.28, AT_CENTRE * unit * flight / PIXEL, 0.005);
  add("highest velocity at which a drop released at the centre lands within 10 um", "px/frame", 6.9,
      ALLOWED / flight / unit, 0.05);
  add("lowest velocity at which a drop released at the centre lands within 10 um", "px/frame", AT_CENTRE - TOLERATED,
      -ALLOWED / flight / unit, 0.05);
  item.quantities.back().reason = "The drop lands the velocity times 0.2 ms beyond the centre, so the slower the "
                                  "nearer: there is no lower bound.";
  add("tolerance of the velocity, 2.9 px/frame", "mm/s", 20.9, 1e3 * TOLERATED * unit, 0.05);
  add("time of a row of 480 cells", "s", 2.93, row, 0.005);
  add("print frequency", "Hz", 160., cells / row, 5.);
  item.parameters = {{"from the thesis",
                      "5 m/s and 1 mm of flight, 4.5 um a pixel, 1600 fps, 4 px/frame at the centres, "
                      "5 on average, 10 um of tolerance, cells of 220 um"}};
  return {item};
}

std::vector<Item> trackability(const Setting &setting) { return {trackabilityItem(setting)}; }
} // namespace thesisReport
