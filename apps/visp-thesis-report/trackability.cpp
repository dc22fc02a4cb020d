/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// (7.1): magnification times trackability, from closed-loop runs and the tracker's own scale.
#include "curves.h"
#include "patternItems.h"
#include "patternRun.h"

#include "numberText.h"

#include "lab/printing/vpPrintExperiment.h"

namespace thesisReport
{
namespace
{
using vpApp::number;

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
    for (const vpPrintDrop &drop : result.drops) {
      if (drop.landTime >= spec.evaluateFrom) {
        velocity.atCentres.add(drop.velocity * metres);
      }
    }
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

Item play(const Setting &setting)
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
       "Velocity " + number(1e3 * seen, 4) + " mm/s under the drops of " + std::to_string(RUNS) +
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

std::vector<Item> trackability(const Setting &setting) { return {play(setting)}; }
} // namespace thesisReport
