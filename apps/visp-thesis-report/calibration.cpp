/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Figure 7.10: displacement of a pixel by radial distortion, by the calibration's own model. Table 7.4: a microscope with
// the thesis's distortion, calibrated from single images of a grid and of the product.
#include "patternItems.h"

#include "numberText.h"

#include <visp3/pattern/vpPlanarMicroscopeCalibration.h>

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <random>

namespace thesisReport
{
namespace
{
using vpApp::fixed;
using vpApp::number;

constexpr double PIXEL = 4.5;             // um of product
constexpr double FAR_OFF = 200.;          // px, position at which the thesis states the distortion
constexpr double EDGE = 80.;              // px, half the width of its image for control
constexpr double KAPPA = -3.84e-10;       // um^-2, table 7.4, industrial grid
constexpr double THREE_SIGMA = 2.55;      // um, from the thesis
constexpr double OUR_THREE_SIGMA = 0.045; // px

//! A lens with this distortion, px^-2.
vpMicroscopeCalibration lens(double kappa1)
{
  vpMicroscopeCalibration microscope;
  microscope.scaleX = microscope.scaleY = 1e6 / PIXEL;
  microscope.kappa1 = kappa1;
  return microscope;
}

vpMicroscopeCalibration lensOfShare(double share) { return lens(share / (FAR_OFF * FAR_OFF)); }

//! Displacement of a pixel \e r px from the centre, px.
double mismatch(const vpMicroscopeCalibration &lens, double r)
{
  return std::fabs(lens.toPlane(r, 0.)[0] * lens.scaleX - r);
}

std::vector<Quantity> mismatches()
{
  const vpMicroscopeCalibration one = lensOfShare(0.01), tenth = lensOfShare(0.001),
                                thesis = lens(KAPPA * PIXEL * PIXEL);
  const double here = mismatch(thesis, EDGE);
  const char *const units =
      "It does not follow from its kappa1: kappa1 r^2 at 80 px = 360 um is 0.005 %, 0.018 um. At "
      "160 px, the whole width "
      "of the image, the same kappa1 gives 0.032 px = 0.14 um; so do the 0.1 % at 200 px of the text, scaled "
      "by (80/200)^2. Either way px were taken for %. What it concludes holds all the more.";
  return {{"mismatch of 1 % distortion at 200 px", "px", 2., mismatch(one, FAR_OFF), Tolerance::factor(1.01),
           Good::Neither, "", "By vpMicroscopeCalibration: from the pixel that is seen to where it belongs."},
          {"mismatch of 0.1 % distortion at 200 px", "px", 0.2, mismatch(tenth, FAR_OFF), Tolerance::factor(1.01),
           Good::Neither, "", ""},
          {"the same on the product", "um", 0.9, PIXEL * mismatch(tenth, FAR_OFF), Tolerance::factor(1.01),
           Good::Neither, "", ""},
          {"mismatch of the thesis's lens at 80 px, share", "%", 0.03, 100. * here / EDGE, Tolerance::factor(1.2),
           Good::Neither, units, "kappa1 = -3.84e-10 um^-2 of table 7.4, a pixel of 4.5 um."},
          {"mismatch of the thesis's lens at 80 px", "um", 0.15, PIXEL * here, Tolerance::factor(1.2), Good::Neither,
           units, ""},
          {"the same over 3 sigma of the thesis's centres", "1", 0.1, PIXEL * here / THREE_SIGMA, Tolerance::atMost(),
           Good::Smaller, "", "The thesis: \"much smaller\", so that no calibration is needed."},
          {"the same over 3 sigma of our centres (0.045 px)", "1", std::nullopt, here / OUR_THREE_SIGMA,
           Tolerance::factor(1.1), Good::Neither, "",
           "Three times the 0.015 px of the tracker along the rows, see figure 7.11."},
          {"mismatch of the thesis's lens at 160 px", "um", std::nullopt, PIXEL * mismatch(thesis, 2. * EDGE),
           Tolerance::factor(1.1), Good::Neither, "", number(mismatch(thesis, 2. * EDGE), 3) + " px."},
          {"mismatch of 0.1 % distortion at 80 px", "px", std::nullopt, mismatch(tenth, EDGE), Tolerance::factor(1.1),
           Good::Neither, "", "It falls with the cube of the distance."}};
}

vpApp::Plot mismatchPlot()
{
  vpApp::Plot plot;
  plot.title = "Mismatch of pixel locations";
  plot.xLabel = "distance from the middle of the image (px)";
  plot.yLabel = "mismatch (px)";
  const auto add = [&](const std::string &label, const vpMicroscopeCalibration &lens) {
    std::vector<double> r, m;
    for (double d = 0.; d <= FAR_OFF; d += 4.) {
      r.push_back(d);
      m.push_back(mismatch(lens, d));
    }
    addCurve(plot, label, r, m);
  };
  for (const double share : {0.01, 0.005, 0.002, 0.001}) {
    add(fixed(100. * share, 1) + " % at 200 px", lensOfShare(share));
  }
  add("kappa1 of table 7.4", lens(KAPPA * PIXEL * PIXEL));
  plot.marks = {{EDGE, "edge of a 160 px image"}};
  return plot;
}

constexpr unsigned int WIDTH = 640, HEIGHT = 480;     // px
constexpr double GRID_PITCH = 200., GRID_MARK = 100.; // um
constexpr double SHIFT = 100.;                        // px

//! \brief A pattern under the microscope, with ground truth.
struct CalibrationPattern {
  std::string name;
  vpProductPatternSpec spec;      //!< Pattern without distortion, 640 x 480 px.
  vpCalibrationPitch pitch;       //!< m.
  double umPerPixel = 1.;         //!< True magnification.
  double kappa = 0.;              //!< True distortion, per um^2 of product.
  vpPatternMethod thesisMethod{}; //!< Point detection of the thesis.
};

//! \brief Results of the experiments, each from one image.
struct CalibrationOutcome {
  Spread kappa;        //!< um^-2.
  Spread umPerPixel;   //!< um.
  Spread error;        //!< Distance of each point from its position by the calibration, um of product.
  double points = 0.;  //!< Mean number of points of an image.
  int significant = 0; //!< Experiments in which kappa1 differs significantly from zero.
  vpMicroscopeCalibration last;
};

vpProductPatternSpec viewOf(double pitchX, double pitchY, double openingX, double openingY, double umPerPixel,
                            unsigned int seed)
{
  vpProductPatternSpec spec = thesisProduct(seed);
  spec.width = WIDTH;
  spec.height = HEIGHT;
  spec.pixelSize = umPerPixel;
  spec.pitchX = pitchX / umPerPixel;
  spec.pitchY = pitchY / umPerPixel;
  spec.openingX = openingX / umPerPixel;
  spec.openingY = openingY / umPerPixel;
  spec.cornerRadius = 20. / umPerPixel;
  return spec;
}

CalibrationPattern grid(const std::string &name, vpProductShape shape, vpPatternMethod method, unsigned int seed)
{
  CalibrationPattern pattern{name, {}, {}, 4.03, KAPPA, method};
  pattern.spec = viewOf(GRID_PITCH, GRID_PITCH, GRID_MARK, GRID_MARK, pattern.umPerPixel, seed);
  pattern.spec.shape = shape;
  pattern.spec.dark = 200.; // between the marks, which are dark, like chrome on glass
  pattern.spec.bright = 40.;
  pattern.pitch.columns = pattern.pitch.rows = GRID_PITCH * 1e-6;
  return pattern;
}

//! Position in the undistorted image for each pixel of the distorted one.
cv::Mat mapOf(const vpMicroscopeCalibration &lens)
{
  cv::Mat map(HEIGHT, WIDTH, CV_32FC2);
  for (int v = 0; v < map.rows; ++v) {
    for (int u = 0; u < map.cols; ++u) {
      const Eigen::Vector2d place = lens.toPlane(u, v) * lens.scaleX;
      map.at<cv::Vec2f>(v, u) = {static_cast<float>(place.x() + lens.u0), static_cast<float>(place.y() + lens.v0)};
    }
  }
  return map;
}

//! The renderer's image without noise, through the lens; then vpProductPatternSpec::noise, and rounding.
void seen(const vpProductPattern &pattern, double x, double y, const cv::Mat &map, std::mt19937_64 &rng,
          vpImage<unsigned char> &image)
{
  vpImage<float> straight;
  pattern.expected(x, y, 0., 0., straight);
  const cv::Mat source(HEIGHT, WIDTH, CV_32FC1, straight.bitmap);
  cv::Mat bent;
  cv::remap(source, bent, map, cv::Mat(), cv::INTER_LANCZOS4, cv::BORDER_REPLICATE);
  std::normal_distribution<double> normal;
  image.resize(HEIGHT, WIDTH);
  for (unsigned int i = 0; i < image.getSize(); ++i) {
    const double grey = bent.ptr<float>()[i];
    const double noisy = grey + pattern.spec().noise * std::sqrt(0.36 + std::max(0., grey) / 157.) * normal(rng);
    image.bitmap[i] = static_cast<unsigned char>(std::clamp(std::lround(noisy), 0L, 255L));
  }
}

std::vector<vpCalibrationPoint> pointsOf(const vpImage<unsigned char> &image, const CalibrationPattern &pattern,
                                         vpPatternMethod method)
{
  vpPatternTrackerSpec options;
  options.method = method;
  vpPatternTracker tracker(WIDTH, HEIGHT, options);
  return vpCalibrationPoints(tracker.process(image), pattern.pitch);
}

void addExperiment(const std::vector<vpCalibrationPoint> &points, CalibrationOutcome &outcome)
{
  vpMicroscopeCalibrationSpec options;
  options.sigmaFromResiduals = true;
  vpPlanarMicroscopeCalibration careful(WIDTH, HEIGHT, options);
  careful.addView(points);
  outcome.significant += careful.compute().kappa1Status == vpKappa1Status::Estimated ? 1 : 0;
  options.minSignificance = options.minEffect = 0.; // the thesis gives kappa1 without a significance test, and no tilt
  options.maxCornerSigma = 1e6;
  options.estimateTilt = false;
  vpPlanarMicroscopeCalibration calibration(WIDTH, HEIGHT, options);
  calibration.addView(points);
  const vpMicroscopeCalibration found = calibration.compute().calibration;
  outcome.kappa.add(1e-12 * found.kappa1PerSquareMetre());
  outcome.umPerPixel.add(found.pixelSizeUm());
  for (const vpCalibrationPoint &point : points) {
    const Eigen::Vector2d expected = found.toImage(point.x, point.y);
    outcome.error.add(found.pixelSizeUm() * std::hypot(expected.x() - point.u, expected.y() - point.v));
  }
  outcome.points += static_cast<double>(points.size());
  outcome.last = found;
}

//! Squares of 100 um every 200 um, dark on bright, with the magnification and kappa1 of the thesis's industrial grid.
CalibrationPattern squareGrid(unsigned int seed)
{ // the thesis finds all four edges of squares with sub-pixel accuracy
  return grid("industrial grid", vpProductShape::Rectangle, vpPatternMethod::ThesisAlgorithmFixed, seed);
}

//! Round dots instead of the squares.
CalibrationPattern dotGrid(unsigned int seed)
{
  return grid("grid of round dots", vpProductShape::Dot, vpPatternMethod::ThesisAlgorithm, seed);
}

//! The display, with the magnification and kappa1 found by the thesis.
CalibrationPattern displayPattern(unsigned int seed)
{
  CalibrationPattern pattern{"product", {}, {}, 4.26, -6.72e-10, vpPatternMethod::ThesisAlgorithm};
  pattern.spec = viewOf(220., 80., 178., 52., pattern.umPerPixel, seed);
  pattern.pitch.columns = 220e-6;
  pattern.pitch.rows = 80e-6;
  return pattern;
}

//! The microscope for a pattern: its principal point is the image centre.
vpMicroscopeCalibration truthOf(const CalibrationPattern &pattern)
{
  vpMicroscopeCalibration truth;
  truth.width = WIDTH;
  truth.height = HEIGHT;
  truth.scaleX = truth.scaleY = 1e6 / pattern.umPerPixel;
  truth.kappa1 = pattern.kappa * pattern.umPerPixel * pattern.umPerPixel;
  truth.u0 = 0.5 * (WIDTH - 1.);
  truth.v0 = 0.5 * (HEIGHT - 1.);
  return truth;
}

/*!
 * Calibrate from \e experiments images of a pattern, each separately and shifted by up to 100 px in each direction.
 * \param methods : Point detection methods; one outcome for each, all from the same images.
 */
std::vector<CalibrationOutcome> calibrate(const CalibrationPattern &pattern,
                                          const std::vector<vpPatternMethod> &methods, int experiments,
                                          unsigned int seed)
{
  const vpProductPattern source(pattern.spec);
  const cv::Mat map = mapOf(truthOf(pattern));
  std::mt19937_64 rng(seed + 7400);
  std::uniform_real_distribution<double> shift(-SHIFT, SHIFT);
  vpImage<unsigned char> image;
  std::vector<CalibrationOutcome> outcomes(methods.size());
  for (int k = 0; k < experiments; ++k) {
    const double x = shift(rng), y = shift(rng);
    seen(source, x, y, map, rng, image);
    for (std::size_t m = 0; m < methods.size(); ++m) {
      addExperiment(pointsOf(image, pattern, methods[m]), outcomes[m]);
    }
  }
  for (CalibrationOutcome &outcome : outcomes) {
    outcome.points /= experiments;
  }
  return outcomes;
}

constexpr int EXPERIMENTS = 8;

//! The thesis's image error, um.
struct ThesisError {
  double mean, deviation;
};

struct Found {
  CalibrationPattern pattern;
  std::vector<CalibrationOutcome> outcomes; // by the thesis's method, by edges
};

Found found(const CalibrationPattern &pattern, const Setting &setting, double progress)
{
  Found result{pattern, calibrate(pattern, {pattern.thesisMethod, vpPatternMethod::HalfMaximumEdges}, EXPERIMENTS,
                                  setting.seed)};
  setting.progress(progress);
  return result;
}

std::string methodName(const CalibrationPattern &pattern, std::size_t method)
{
  return method == 1                                                ? "edges at half height"
         : pattern.thesisMethod == vpPatternMethod::ThesisAlgorithm ? "Algorithm 7.4"
                                                                    : "Algorithm 7.4 on four edges";
}

void addRows(Item &item, const Found &f, std::size_t method, const ThesisError &thesis)
{
  const CalibrationOutcome &o = f.outcomes[method];
  const std::string of = ", " + f.pattern.name + ", " + methodName(f.pattern, method);
  item.quantities.push_back({"kappa1" + of, "um^-2", f.pattern.kappa, o.kappa.mean(),
                             Tolerance::factor(method == 0 ? 1.5 : 1.1), Good::Neither, "",
                             "Mean of " + std::to_string(EXPERIMENTS) + " single images, " + number(o.points, 3) +
                                 " points each; deviation between images " + number(o.kappa.sigma(), 2) +
                                 " um^-2; significantly different from zero in " + std::to_string(o.significant) +
                                 "."});
  item.quantities.push_back({"magnification" + of, "um/px", f.pattern.umPerPixel, o.umPerPixel.mean(),
                             Tolerance::distance(0.01), Good::Neither, "",
                             "Deviation between images " + number(o.umPerPixel.sigma(), 2) + " um/px."});
  item.quantities.push_back({"image error, mean" + of, "um", thesis.mean, o.error.mean(), Tolerance::factor(1.5),
                             Good::Smaller, "", "Distance of a point from where the calibration expects it."});
  item.quantities.push_back({"image error, standard deviation" + of, "um", thesis.deviation, o.error.sigma(),
                             Tolerance::factor(1.5), Good::Smaller, "",
                             "Largest " + number(o.error.largest(), 3) + " um."});
}

//! Round dots, without a value in the thesis.
void addDots(Item &item, const Found &f)
{
  for (std::size_t method = 0; method < f.outcomes.size(); ++method) {
    const CalibrationOutcome &o = f.outcomes[method];
    const std::string of = ", " + f.pattern.name + ", " + methodName(f.pattern, method);
    item.quantities.push_back({"kappa1" + of, "um^-2", std::nullopt, o.kappa.mean(), Tolerance::factor(1.1),
                               Good::Neither, "",
                               "True: " + number(f.pattern.kappa, 3) + "; deviation between images " +
                                   number(o.kappa.sigma(), 2) + " um^-2."});
    item.quantities.push_back(
        {"image error, mean" + of, "um", std::nullopt, o.error.mean(), Tolerance::factor(1.1), Good::Neither, "", ""});
  }
}

//! Error of each calibration over the distance from the centre.
vpApp::Plot errorPlot(const std::vector<std::pair<std::string, vpMicroscopeCalibration>> &found)
{
  vpApp::Plot plot;
  plot.title = "Distortion that was found, and that of the thesis";
  plot.xLabel = "distance from the middle of the image (px)";
  plot.yLabel = "correction kappa1 r^3 (px)";
  for (const auto &entry : found) {
    std::vector<double> r, correction;
    for (double d = 0.; d <= 400.; d += 8.) {
      r.push_back(d);
      correction.push_back(entry.second.kappa1 * d * d * d);
    }
    addCurve(plot, entry.first, r, correction,
             entry.first.find("thesis") == std::string::npos ? vpApp::PlotStyle::Solid : vpApp::PlotStyle::Dashed);
  }
  return plot;
}
} // namespace

std::vector<Item> distortion(const Setting &)
{
  Item item;
  item.id = "fig7.10";
  item.quantities = mismatches();
  item.quantities.push_back({"area of an image of 640 x 480 px of 4.5 um", "mm^2", 6.2, 640. * 480. * 4.5e-3 * 4.5e-3,
                             Tolerance::distance(0.05), Good::Neither, "", ""});
  item.remarks = {
      "(7.5) says nothing but u (1 + kappa1 r^2): 1 % at 200 px is 2 px there by definition. The values of kappa1 "
      "that the figure draws are not in the text.",
      "kappa1 of table 7.4 is taken per um^2 of product, as (7.7) has the pixel in the unit of the image of the "
      "product; per um^2 of the sensor (1.5 times as large) its effect would be 2.3 times as large, which "
      "does not give the 0.15 um either."};
  item.parameters = {{"pixel", "4.5 um of product"}};
  addPlot(item, "mismatch", "Mismatch of pixel locations for several radial distortions",
          "It grows with the cube of the distance from the middle.", {mismatchPlot()});
  return {item};
}

std::vector<Item> calibrations(const Setting &setting)
{
  const Found grid = found(squareGrid(setting.seed), setting, 0.3),
              display = found(displayPattern(setting.seed), setting, 0.7),
              dots = found(dotGrid(setting.seed), setting, 1.);
  Item item;
  item.id = "table7.4";
  for (const std::size_t method : {0U, 1U}) {
    addRows(item, grid, method, {0.6, 0.3});
    addRows(item, display, method, {1.3, 0.7});
  }
  item.quantities.push_back({"image error, product over industrial grid, by the thesis's methods", "1", 1.,
                             display.outcomes[0].error.mean() / grid.outcomes[0].error.mean(), Tolerance::atLeast(),
                             Good::Neither, "", "The thesis: \"lesser accuracy for the product pattern\"."});
  for (const Found *f : {&grid, &display}) {
    item.quantities.push_back({"pixel by the calibration of the thesis, " + f->pattern.name, "um", PIXEL,
                               f->pattern.umPerPixel, Tolerance::distance(0.05), Good::Neither, "",
                               "Table 7.4 against the size that the thesis computes with."});
  }
  addDots(item, dots);
  item.remarks = {
      "The thesis's kappa1 and magnification are the truth of the rendered pictures, each pattern with its own: rows "
      "of "
      "kappa1 and magnification say how well a calibration finds them back. One lens cannot have both; the thesis's "
      "two "
      "patterns give magnifications that differ by 5.7 %.",
      "Pictures are the renderer's without noise, warped through vpMicroscopeCalibration (Lanczos), then given the "
      "noise "
      "of the thesis's camera and rounded to 8 bit. Grid and product are perfectly even here, and light is too, so the "
      "image "
      "errors are those of the detection alone; the thesis's have all else in them.",
      "M_0 = T_z / f of the table is the inverse of M_o = f / t_z of (7.7). 4.03 is read as um a pixel, kappa1 per "
      "um^2 "
      "of product.",
      "The thesis does not say what its industrial grid shows. Squares are taken, since its detection is made for "
      "rectangles: of squares on all four edges, of the product on two, as section 7.2.2 has it. Algorithm "
      "7.4 as printed does badly on round dots, which it is not made for: they were tried first and stand in the last "
      "rows, "
      "beside edges at half height, which do well."};
  item.parameters = {
      {"image", "640 x 480 px, noise 4, principal point in the middle and known"},
      {"industrial grid", "squares of 100 um every 200 um, grey 40 on 200"},
      {"grid of round dots", "dots of 100 um every 200 um, grey 40 on 200"},
      {"product", "openings of 178 x 52 um every 220 x 80 um, grey 170 on 60"},
      {"experiments", std::to_string(EXPERIMENTS) + " for each pattern, shifted by up to 100 px each way"}};
  addPlot(item, "distortion", "Distortion found with two patterns",
          "From the last image of each pattern. Dashed: the truth, which is the thesis's.",
          {errorPlot({{"grid, thesis", truthOf(grid.pattern)},
                      {"grid, Algorithm 7.4", grid.outcomes[0].last},
                      {"grid, edges", grid.outcomes[1].last},
                      {"product, thesis", truthOf(display.pattern)},
                      {"product, Algorithm 7.4", display.outcomes[0].last},
                      {"product, edges", display.outcomes[1].last}})});
  return {item};
}
} // namespace thesisReport
