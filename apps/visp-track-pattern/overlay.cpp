/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "overlay.h"

#include "results.h"

#include "outputFolder.h"
#include "videoFile.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace trackPattern
{
namespace
{
constexpr int WANTED_WIDTH = 640; // px of the overlay
constexpr int TEXT_HEIGHT = 44;
const cv::Scalar GREEN(60, 220, 60), RED(60, 60, 255), ORANGE(0, 165, 255), YELLOW(40, 220, 255), GREY(150, 150, 150);

cv::Scalar colourOf(vpPatternStatus status)
{
  switch (status) {
  case vpPatternStatus::Acquiring:
    return ORANGE;
  case vpPatternStatus::Tracking:
    return GREEN;
  case vpPatternStatus::Degraded:
    return YELLOW;
  case vpPatternStatus::Lost:
    break;
  }
  return RED;
}

void line(cv::Mat &canvas, const cv::Point2d &from, const cv::Point2d &to, const cv::Scalar &colour, int thickness)
{
  constexpr int bits = 4; // sub-pixel bits for drawing in OpenCV
  const auto fixed = [](const cv::Point2d &p) {
    return cv::Point(static_cast<int>(std::lround(p.x * (1 << bits))),
                     static_cast<int>(std::lround(p.y * (1 << bits))));
  };
  cv::line(canvas, fixed(from), fixed(to), colour, thickness, cv::LINE_AA, bits);
}

void drawCell(cv::Mat &canvas, const vpPatternCell &cell, const cv::Point2d &centre, double size)
{
  if (cell.valid) {
    line(canvas, centre - cv::Point2d(size, 0.), centre + cv::Point2d(size, 0.), GREEN, 1);
    line(canvas, centre - cv::Point2d(0., size), centre + cv::Point2d(0., size), GREEN, 1);
  }
  else {
    const double s = 0.7 * size;
    line(canvas, centre - cv::Point2d(s, s), centre + cv::Point2d(s, s), RED, 2);
    line(canvas, centre - cv::Point2d(s, -s), centre + cv::Point2d(s, -s), RED, 2);
  }
}
} // namespace

cv::Mat drawOverlay(const vpImage<unsigned char> &image, const vpPatternFrame &frame, const std::optional<Roi> &roi,
                    unsigned int number)
{
  const int width = static_cast<int>(image.getWidth()), height = static_cast<int>(image.getHeight());
  const int zoom = std::max(1, (WANTED_WIDTH + width - 1) / width);
  const cv::Mat grey(height, width, CV_8UC1, const_cast<unsigned char *>(image.bitmap)); // read only
  cv::Mat large, canvas;
  cv::resize(grey, large, cv::Size(), zoom, zoom, cv::INTER_NEAREST);
  cv::cvtColor(large, large, cv::COLOR_GRAY2BGR);
  const int evenHeight = large.rows + TEXT_HEIGHT + (large.rows + TEXT_HEIGHT) % 2;
  cv::copyMakeBorder(large, canvas, 0, evenHeight - large.rows, 0, large.cols % 2, cv::BORDER_CONSTANT,
                     cv::Scalar(25, 25, 25));
  const double left = roi ? roi->x : 0., top = roi ? roi->y : 0.;
  const auto place = [&](double x, double y) {
    return cv::Point2d((x + left + 0.5) * zoom - 0.5, (y + top + 0.5) * zoom - 0.5);
  };
  if (roi) {
    cv::rectangle(canvas, place(-0.5, -0.5), place(roi->width - 0.5, roi->height - 0.5), YELLOW, 1, cv::LINE_AA);
  }
  const double pitch = zoom * std::min(frame.lattice.columnPitch(), frame.lattice.rowPitch());
  const double size = std::clamp(0.3 * pitch, 4., 12.);
  for (const vpPatternCell &cell : frame.cells) {
    drawCell(canvas, cell, place(cell.x, cell.y), size);
  }
  const cv::Scalar colour = colourOf(frame.status);
  cv::rectangle(canvas, cv::Rect(0, large.rows, 8, canvas.rows - large.rows), colour, cv::FILLED);
  std::string first = text("image %u  %d of %zu cells", number, frame.validCells, frame.cells.size());
  if (frame.hasMotion) {
    first += text("   moved %+.3f %+.3f px (+- %.3f %.3f)", frame.dx, frame.dy, frame.sigmaDx, frame.sigmaDy);
  }
  cv::putText(canvas, first, cv::Point(16, large.rows + 17), cv::FONT_HERSHEY_SIMPLEX, 0.45, cv::Scalar::all(235), 1,
              cv::LINE_AA);
  cv::putText(canvas, frame.message(), cv::Point(16, large.rows + 36), cv::FONT_HERSHEY_SIMPLEX, 0.42, colour, 1,
              cv::LINE_AA);
  return canvas;
}

OverlayFiles::OverlayFiles(vpApp::OutputFolder &out, OverlayKind kind, double rate)
  : m_out(out), m_kind(kind), m_rate(rate)
{}

OverlayFiles::~OverlayFiles() = default;

void OverlayFiles::add(const cv::Mat &picture, unsigned int number)
{
  if (m_kind == OverlayKind::Png) {
    m_out.write(text("overlay/%06u.png", number), pngOf(picture));
  }
  else if (m_kind == OverlayKind::Mp4) {
    if (!m_video) {
      m_video = std::make_unique<vpApp::VideoFile>(m_out.file("overlay.mp4"), picture.cols, picture.rows, m_rate);
    }
    m_video->write(picture);
  }
}

void OverlayFiles::close()
{
  if (m_video) {
    m_video->close();
  }
}

std::string pngOf(const cv::Mat &picture)
{
  std::vector<unsigned char> bytes;
  if (!cv::imencode(".png", picture, bytes)) {
    throw std::runtime_error("OpenCV cannot write PNG images");
  }
  return {bytes.begin(), bytes.end()};
}
} // namespace trackPattern
