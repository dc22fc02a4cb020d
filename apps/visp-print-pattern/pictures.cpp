/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "pictures.h"

#include "appMain.h"
#include "videoFile.h"

#include <visp3/pattern/vpPatternTracker.h>
#include <visp3/rendering/vpProductPattern.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace printPattern
{
namespace
{
constexpr double DROP_DIAMETER = 50.; // um, from the thesis
constexpr int SHIFT = 4;              // fractional bits of OpenCV's sub-pixel coordinates

const cv::Scalar GOOD(60, 180, 60), BAD(40, 40, 230), CENTRE(0, 0, 0), FOUND(230, 120, 30), NOZZLE(0, 200, 255);

cv::Mat enlarged(const vpImage<unsigned char> &image, int scale)
{
  const cv::Mat grey(static_cast<int>(image.getHeight()), static_cast<int>(image.getWidth()), CV_8UC1, image.bitmap);
  cv::Mat large, colour;
  cv::resize(grey, large, cv::Size(), scale, scale, cv::INTER_NEAREST);
  cv::cvtColor(large, colour, cv::COLOR_GRAY2BGR);
  return colour;
}

//! Point of the small image in the enlarged one, in fractions of a pixel.
cv::Point place(double x, double y, int scale)
{
  const double unit = 1 << SHIFT;
  return {static_cast<int>(std::lround(((x + 0.5) * scale - 0.5) * unit)),
          static_cast<int>(std::lround(((y + 0.5) * scale - 0.5) * unit))};
}

void cross(cv::Mat &picture, double x, double y, int scale, const cv::Scalar &colour)
{
  const double arm = 1.2;
  cv::line(picture, place(x - arm, y, scale), place(x + arm, y, scale), colour, 1, cv::LINE_AA, SHIFT);
  cv::line(picture, place(x, y - arm, scale), place(x, y + arm, scale), colour, 1, cv::LINE_AA, SHIFT);
}

void circle(cv::Mat &picture, double x, double y, double radius, int scale, const cv::Scalar &colour)
{
  cv::circle(picture, place(x, y, scale), static_cast<int>(std::lround(radius * scale * (1 << SHIFT))), colour, 2,
             cv::LINE_AA, SHIFT);
}

const cv::Scalar &colourOf(const vpPrintDrop &drop)
{
  return std::hypot(drop.errorX, drop.errorY) <= Landing::tolerance ? GOOD : BAD;
}

using Drops = std::multimap<std::pair<int, int>, const vpPrintDrop *>;

Drops dropsByCell(const vpPrintRun &run)
{
  Drops drops;
  for (const vpPrintDrop &drop : run.drops) {
    drops.emplace(std::make_pair(drop.row, drop.column), &drop);
  }
  return drops;
}

//! Draws drops and cell centres into an image of the product at a displacement.
void drawDrops(cv::Mat &picture, const vpProductPattern &product, double x, double y, const Drops &drops, double until,
               int scale)
{
  const double pixel = product.spec().pixelSize;
  for (const vpPatternTruthCell &cell : product.cells(x, y)) {
    bool any = false;
    const auto range = drops.equal_range({cell.row, cell.column});
    for (auto found = range.first; found != range.second; ++found) {
      const vpPrintDrop &drop = *found->second;
      if (drop.landTime <= until) {
        circle(picture, cell.x + drop.errorX / pixel, cell.y + drop.errorY / pixel, 0.5 * DROP_DIAMETER / pixel, scale,
               colourOf(drop));
        any = true;
      }
    }
    if (any) {
      cross(picture, cell.x, cell.y, scale, CENTRE);
    }
  }
}

//! One strip of the product with the cells around a column, with all printed rows that fit.
cv::Mat strip(const vpPrintRun &run, const Drops &drops, int row, int column, const std::string &title)
{
  constexpr int scale = 3;
  vpProductPatternSpec spec = run.spec.product;
  const int rows = std::min(4, run.spec.rows);
  spec.width = static_cast<unsigned int>(std::ceil(6. * spec.pitchX));
  spec.height = static_cast<unsigned int>(std::ceil((rows + 1) * spec.pitchY));
  spec.noise = 1.;
  const vpProductPattern product(spec);
  // The product moves by minus the cell position, so that the cell is at the centre.
  const int first = std::clamp(row - rows / 2, 0, run.spec.rows - rows);
  const double x = -(column + 0.5) * spec.pitchX, y = -(first + 0.5 * (rows - 1)) * spec.pitchY;
  vpImage<unsigned char> image;
  product.render(x, y, 0., 0., 0, image);
  cv::Mat picture = enlarged(image, scale);
  drawDrops(picture, product, x, y, drops, INFINITY, scale);
  cv::copyMakeBorder(picture, picture, 26, 6, 0, 0, cv::BORDER_CONSTANT, cv::Scalar(255, 255, 255));
  cv::putText(picture, title, {4, 18}, cv::FONT_HERSHEY_SIMPLEX, 0.5, CENTRE, 1, cv::LINE_AA);
  return picture;
}
} // namespace

cv::Mat printedProduct(const vpPrintRun &run)
{
  const Drops drops = dropsByCell(run);
  const auto worst =
      std::max_element(run.drops.begin(), run.drops.end(), [](const vpPrintDrop &a, const vpPrintDrop &b) {
        return std::hypot(a.errorX, a.errorY) < std::hypot(b.errorX, b.errorY);
      });
  cv::Mat picture = strip(run, drops, 0, -3, "The first cells (cell -1 is printed first)");
  if (worst != run.drops.end()) {
    const cv::Mat second = strip(run, drops, worst->row, worst->column,
                                 "Around the drop with the largest error: row " + std::to_string(worst->row) +
                                     ", column " + std::to_string(worst->column));
    cv::vconcat(picture, second, picture);
  }
  return picture;
}

cv::Mat detection(const vpPrintExperimentSpec &spec)
{
  constexpr int scale = 4;
  const vpProductPattern product(spec.product);
  vpPatternTrackerSpec options;
  options.method = vpPatternMethod::ThesisAlgorithm;
  vpPatternTracker tracker(spec.product.width, spec.product.height, options);
  vpImage<unsigned char> image;
  const vpPatternFrame *frame = nullptr;
  double x = 0.;
  for (unsigned int k = 0; k < 5; ++k) { // until the standard deviations are known
    x = 4. * k;
    product.render(x, 0., 4., 0., k, image);
    frame = &tracker.process(image);
  }
  vpPatternHistogram histogram{};
  for (unsigned int i = 0; i < image.getSize(); ++i) {
    ++histogram[image.bitmap[i]];
  }
  const int threshold = vpFindThreshold(histogram, vpPatternThreshold::Otsu).threshold;
  cv::Mat right = enlarged(image, scale);
  for (unsigned int i = 0; i < image.getSize(); ++i) {
    image.bitmap[i] = image.bitmap[i] > threshold ? 255 : 0;
  }
  cv::Mat left = enlarged(image, scale);
  for (const vpPatternCell &cell : frame->cells) {
    if (cell.valid) {
      const double halfX = 0.5 * spec.product.openingX, halfY = 0.5 * spec.product.openingY;
      cv::rectangle(right, place(cell.x - halfX, cell.y - halfY, scale), place(cell.x + halfX, cell.y + halfY, scale),
                    FOUND, 1, cv::LINE_AA, SHIFT);
      circle(right, cell.x, cell.y, 0.8, scale, FOUND);
    }
  }
  for (const vpPatternTruthCell &cell : product.cells(x, 0.)) {
    if (cell.complete) {
      cross(right, cell.x, cell.y, scale, CENTRE);
    }
  }
  cv::copyMakeBorder(left, left, 0, 0, 0, 8, cv::BORDER_CONSTANT, cv::Scalar(255, 255, 255));
  cv::Mat picture;
  cv::hconcat(left, right, picture);
  return picture;
}

cv::Mat cameraView(const vpPrintRun &run, std::size_t sample, int scale)
{
  const vpProductPattern product(run.spec.product);
  const vpPrintSample &s = run.samples[std::min(sample, run.samples.size() - 1)];
  vpImage<unsigned char> image;
  product.render(s.x, s.y, s.vx, s.vy, static_cast<unsigned int>(s.frame), image);
  cv::Mat picture = enlarged(image, scale);
  drawDrops(picture, product, s.x, s.y, dropsByCell(run), s.frame, scale);
  const double nozzle = 0.5 * (image.getWidth() - 1.) + run.spec.nozzleOffset, middle = 0.5 * (image.getHeight() - 1.);
  for (const double sign : {-1., 1.}) { // one mark above and one below, hiding no drop
    cv::line(picture, place(nozzle, middle + sign * 0.5 * image.getHeight(), scale),
             place(nozzle, middle + sign * (0.5 * image.getHeight() - 4.), scale), NOZZLE, 2, cv::LINE_AA, SHIFT);
  }
  return picture;
}

void writeVideo(const vpPrintRun &run, const std::string &file)
{
  constexpr int scale = 4;
  constexpr double rate = 25.;
  const int width = static_cast<int>(run.spec.product.width) * scale,
            height = static_cast<int>(run.spec.product.height) * scale;
  vpApp::VideoFile video(file, width, height, rate);
  for (std::size_t i = 0; i < run.samples.size(); ++i) {
    vpApp::throwIfInterrupted();
    video.write(cameraView(run, i, scale));
  }
  video.close();
}

std::string pngOf(const cv::Mat &picture)
{
  std::vector<unsigned char> bytes;
  if (!cv::imencode(".png", picture, bytes)) {
    throw std::runtime_error("a picture cannot be written as PNG");
  }
  return std::string(bytes.begin(), bytes.end());
}
} // namespace printPattern
