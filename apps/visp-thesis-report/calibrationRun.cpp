/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "calibrationRun.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <random>

namespace thesisReport
{
namespace
{
constexpr unsigned int WIDTH = 640, HEIGHT = 480;     // px
constexpr double GRID_PITCH = 200., GRID_MARK = 100.; // um
constexpr double SHIFT = 100.;                        // px

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
  CalibrationPattern pattern{name, {}, {}, 4.03, -3.84e-10, method};
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

} // namespace

CalibrationPattern squareGrid(unsigned int seed)
{ // the thesis finds all four edges of squares with sub-pixel accuracy
  return grid("industrial grid", vpProductShape::Rectangle, vpPatternMethod::ThesisAlgorithmFixed, seed);
}

CalibrationPattern dotGrid(unsigned int seed)
{
  return grid("grid of round dots", vpProductShape::Dot, vpPatternMethod::ThesisAlgorithm, seed);
}

CalibrationPattern displayPattern(unsigned int seed)
{
  CalibrationPattern pattern{"product", {}, {}, 4.26, -6.72e-10, vpPatternMethod::ThesisAlgorithm};
  pattern.spec = viewOf(220., 80., 178., 52., pattern.umPerPixel, seed);
  pattern.pitch.columns = 220e-6;
  pattern.pitch.rows = 80e-6;
  return pattern;
}

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
} // namespace thesisReport
