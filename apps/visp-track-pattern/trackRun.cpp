/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "trackRun.h"

#include "calibration.h"
#include "overlay.h"
#include "truth.h"

#include "appMain.h"
#include "pictureWindow.h"
#include "progress.h"

#include <visp3/core/vpException.h>
#include <visp3/pattern/vpPatternTracker.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <iostream>
#include <memory>
#include <stdexcept>

namespace trackPattern
{
namespace
{
std::string sizeOf(const vpImage<unsigned char> &image)
{
  return std::to_string(image.getWidth()) + " x " + std::to_string(image.getHeight()) + " px";
}

//! The images passed to the tracker, all of one size.
class Window
{
public:
  Window(const vpImage<unsigned char> &first, const std::optional<Roi> &roi, const std::string &name)
    : m_width(first.getWidth()), m_height(first.getHeight()), m_roi(roi), m_firstName(name)
  {
    if (roi && (roi->x + roi->width > m_width || roi->y + roi->height > m_height)) {
      throw std::runtime_error(text("--roi %u,%u,%u,%u does not lie in %s of %s", roi->x, roi->y, roi->width,
                                    roi->height, name.c_str(), sizeOf(first).c_str()));
    }
  }
  [[nodiscard]] unsigned int width() const { return m_roi ? m_roi->width : m_width; }
  [[nodiscard]] unsigned int height() const { return m_roi ? m_roi->height : m_height; }
  [[nodiscard]] double left() const { return m_roi ? m_roi->x : 0.; }
  [[nodiscard]] double top() const { return m_roi ? m_roi->y : 0.; }

  const vpImage<unsigned char> &cut(const vpImage<unsigned char> &image, const std::string &name)
  {
    if (image.getWidth() != m_width || image.getHeight() != m_height) {
      throw std::runtime_error(text("%s: has %s, %s has %u x %u px", name.c_str(), sizeOf(image).c_str(),
                                    m_firstName.c_str(), m_width, m_height));
    }
    if (!m_roi) {
      return image;
    }
    m_part.resize(m_roi->height, m_roi->width);
    for (unsigned int v = 0; v < m_roi->height; ++v) {
      std::copy_n(image[m_roi->y + v] + m_roi->x, m_roi->width, m_part[v]);
    }
    return m_part;
  }

private:
  unsigned int m_width;
  unsigned int m_height;
  std::optional<Roi> m_roi;
  std::string m_firstName;
  vpImage<unsigned char> m_part;
};

// printf distinguishes negative and positive NaN; a table must not.
double plain(double value) { return std::isnan(value) ? NOTHING : value; }

//! A table in the result folder, written line by line; it may exceed the memory.
class TableFile
{
public:
  TableFile(vpApp::OutputFolder &out, const std::string &name, const std::string &heading)
    : m_name((out.path() / name).string()), m_stream(out.file(name), std::ios::binary)
  {
    add(heading);
  }
  void add(const std::string &line) { m_stream << line << '\n'; }
  //! Flush added lines to disk, in case the program is killed.
  void flush() { m_stream.flush(); }
  //! \throw std::runtime_error naming the file when writing fails.
  void close()
  {
    m_stream.close();
    if (!m_stream) {
      throw std::runtime_error(m_name + ": cannot be written");
    }
  }

private:
  std::string m_name;
  std::ofstream m_stream;
};

//! cells.csv and motion.csv.
class Tables
{
public:
  Tables(vpApp::OutputFolder &out, bool um)
    : m_um(um), m_cells(out, "cells.csv",
                        std::string("frame,row,column,x,y,sigma_x,sigma_y,valid,epoch") + (um ? ",x_um,y_um" : "")),
      m_motion(out, "motion.csv",
               std::string("frame,dx,dy,sigma,status,microseconds,sigma_dx,sigma_dy,reason,epoch,valid_cells,sigma_x,"
                           "sigma_y,true_dx,true_dy") +
                   (um ? ",dx_um,dy_um" : ""))
  {}
  void add(const vpPatternFrame &frame, const FrameRecord &record, double left, double top,
           const std::optional<vpMicroscopeCalibration> &calibration)
  {
    for (const vpPatternCell &cell : frame.cells) {
      std::string line = text("%u,%d,%d,%.5f,%.5f,%.5f,%.5f,%d,%u", record.number, cell.row, cell.column, cell.x + left,
                              cell.y + top, cell.sigmaX, cell.sigmaY, cell.valid ? 1 : 0, frame.epoch);
      if (m_um) {
        const Eigen::Vector2d plane = 1e6 * calibration->toPlane(cell.x + left, cell.y + top);
        line += text(",%.5f,%.5f", plain(plane.x()), plain(plane.y()));
      }
      m_cells.add(line);
    }
    std::string line =
        text("%u,%.5f,%.5f,%.5f,%s,%.2f,%.5f,%.5f,%s,%u,%d,%.5f,%.5f,%.5f,%.5f", record.number, plain(record.dx),
             plain(record.dy), plain(std::hypot(record.sigmaDx, record.sigmaDy)), vpToString(record.status),
             record.microseconds, plain(record.sigmaDx), plain(record.sigmaDy), reasonWord(record.reason), record.epoch,
             record.validCells, plain(record.sigmaX), plain(record.sigmaY), plain(record.trueDx), plain(record.trueDy));
    if (m_um) {
      line += text(",%.5f,%.5f", plain(record.dxUm), plain(record.dyUm));
    }
    m_motion.add(line);
    m_cells.flush();
    m_motion.flush();
  }
  void close()
  {
    m_cells.close();
    m_motion.close();
  }

private:
  static const char *reasonWord(vpPatternReason reason)
  {
    static constexpr const char *words[] = {"None",         "WrongSize",       "NoContrast",   "NoCells",
                                            "TooMuchNoise", "NoLattice",       "CellTooSmall", "Learning",
                                            "CellsMissing", "AmbiguousMotion", "IdentitySlip", "Restarted",
                                            "NoMatch",      "ImagesMissing",   "SingleRow",    "TurnedTooFar"};
    static_assert(std::size(words) == static_cast<std::size_t>(vpPatternReason::TurnedTooFar) + 1);
    const auto index = static_cast<std::size_t>(reason);
    return index < std::size(words) ? words[index] : "Unknown";
  }

  bool m_um;
  TableFile m_cells;
  TableFile m_motion;
};

FrameRecord recordOf(const vpPatternFrame &frame, unsigned int number, double microseconds)
{
  FrameRecord record;
  record.number = number;
  record.status = frame.status;
  record.reason = frame.reason;
  record.message = frame.message();
  record.epoch = frame.epoch;
  record.validCells = frame.validCells;
  record.cells = static_cast<int>(frame.cells.size());
  record.microseconds = microseconds;
  if (frame.hasMotion) {
    record.dx = frame.dx;
    record.dy = frame.dy;
    record.sigmaDx = frame.sigmaDx;
    record.sigmaDy = frame.sigmaDy;
  }
  std::vector<double> sigmaX, sigmaY;
  for (const vpPatternCell &cell : frame.cells) {
    if (cell.valid) {
      sigmaX.push_back(cell.sigmaX);
      sigmaY.push_back(cell.sigmaY);
    }
  }
  record.sigmaX = quantile(sigmaX, 0.5);
  record.sigmaY = quantile(sigmaY, 0.5);
  return record;
}

// The displacement at the image centre; the scale hardly changes over the image.
void convertMotion(const vpMicroscopeCalibration &calibration, FrameRecord &record)
{
  const double u = 0.5 * (calibration.width - 1.), v = 0.5 * (calibration.height - 1.);
  const Eigen::Vector2d moved = 1e6 * (calibration.toPlane(u + 0.5 * record.dx, v + 0.5 * record.dy) -
                                       calibration.toPlane(u - 0.5 * record.dx, v - 0.5 * record.dy));
  record.dxUm = moved.x();
  record.dyUm = moved.y();
}

//! Objects created at the first image, when its size is known.
class Session
{
public:
  Session(const Options &options, vpApp::OutputFolder &out, const vpImage<unsigned char> &first,
          const std::string &name, RunResults &results)
    : m_options(options), m_results(results), m_window(first, options.roi, name),
      m_tracker(makeTracker(m_window, options.tracker, name)), m_overlays(out, options.overlay, options.videoRate),
      m_collector(options)
  {
    m_results.width = first.getWidth();
    m_results.height = first.getHeight();
    if (!options.calibration.empty()) {
      m_results.calibration =
          readCalibration(options.calibration, options.cameraName, m_results.width, m_results.height);
    }
    m_tables = std::make_unique<Tables>(out, m_results.calibration.has_value());
  }

  //! The overlay for the window; empty if not requested.
  cv::Mat take(const vpImage<unsigned char> &image, const Input &input, bool draw)
  {
    const vpApp::ImageSource &source = *input.images;
    const vpImage<unsigned char> &part = m_window.cut(image, source.name());
    if (source.isAfterGap()) {
      m_hasGaps = true;
      m_tracker.interrupt();
      m_comparison.skip();
    }
    const auto start = std::chrono::steady_clock::now();
    const vpPatternFrame &frame = m_tracker.process(part);
    const double microseconds =
        std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
    FrameRecord record = recordOf(frame, source.number(), microseconds);
    if (m_results.calibration) {
      convertMotion(*m_results.calibration, record);
    }
    const std::optional<FrameTruth> truth = input.truth();
    if (truth) {
      m_comparison.add(frame, *truth, m_window.left(), m_window.top(), record, m_results);
    }
    else {
      m_comparison.skip();
    }
    for (const vpPatternCell &cell : frame.cells) {
      if (cell.valid) {
        m_results.deviations[{frame.epoch, cell.row, cell.column}] = {cell.deviationX, cell.deviationY};
      }
    }
    if (frame.lattice.columnPitch() > 0.) {
      m_results.lattice = frame.lattice;
    }
    if (m_options.calibrate) {
      m_collector.add(part, frame, m_window.left(), m_window.top());
    }
    m_tables->add(frame, record, m_window.left(), m_window.top(), m_results.calibration);
    m_results.frames.push_back(record);
    const bool better = frame.status == vpPatternStatus::Tracking || m_results.frames.size() == 1 ||
                        (frame.validCells > 0 && !m_pictureHasCells);
    if (!draw && m_options.overlay == OverlayKind::None && !better) {
      return {};
    }
    cv::Mat picture = drawOverlay(image, frame, m_options.roi, record.number);
    m_overlays.add(picture, record.number);
    if (better) {
      m_pictureHasCells = frame.validCells > 0;
      m_picture = picture;
    }
    return picture;
  }

  void finish(const vpApp::ImageSource &source, vpApp::OutputFolder &out)
  {
    m_tables->close();
    m_overlays.close();
    m_results.input = source.description();
    m_results.remarks = source.remarks();
    if (m_hasGaps) {
      m_results.remarks.emplace_back("How far the product moved across a gap is not known: no displacement is given "
                                     "there, and a new epoch begins.");
    }
    m_results.picture = pngOf(m_picture);
    if (m_options.calibrate) {
      calibrate(out);
    }
  }

private:
  // Tracking results are written to the tables even without a calibration.
  void calibrate(vpApp::OutputFolder &out)
  {
    try {
      m_results.calibrated = m_collector.compute(m_results.width, m_results.height);
    }
    catch (const std::runtime_error &error) {
      m_results.failure += (m_results.failure.empty() ? "" : "; ") + std::string(error.what());
      m_results.ending = m_results.ending == Ending::Complete ? Ending::Incomplete : m_results.ending;
      return;
    }
    m_results.calibrationViews = m_collector.viewCount();
    out.write("calibration.json", jsonOf(*m_results.calibrated, m_results.calibrationViews).dump(2) + "\n");
    m_results.calibrated->calibration.saveXml(out.file("calibration.xml"));
  }

  static vpPatternTracker makeTracker(const Window &window, const vpPatternTrackerSpec &options,
                                      const std::string &name)
  {
    try {
      return vpPatternTracker(window.width(), window.height(), options);
    }
    catch (const vpException &error) {
      throw std::runtime_error(name + ": " + error.getStringMessage());
    }
  }

  const Options &m_options;
  RunResults &m_results;
  Window m_window;
  vpPatternTracker m_tracker;
  std::unique_ptr<Tables> m_tables;
  OverlayFiles m_overlays;
  CalibrationRun m_collector;
  Comparison m_comparison;
  cv::Mat m_picture;
  bool m_pictureHasCells = false, m_hasGaps = false;
};
// False at the end, and after a failure if there are results.
bool takeNext(vpApp::ImageSource &source, vpImage<unsigned char> &image, RunResults &results)
{
  try {
    return source.next(image);
  }
  catch (const std::runtime_error &error) {
    if (results.frames.empty()) {
      throw;
    }
    results.failure = error.what();
    results.ending = Ending::Incomplete;
    return false;
  }
}
} // namespace

void trackAll(const Options &options, const Input &input, vpApp::OutputFolder &out, RunResults &results)
{
  vpApp::ImageSource &source = *input.images;
  std::unique_ptr<vpApp::PictureWindow> screen;
  if (options.display) {
    screen = std::make_unique<vpApp::PictureWindow>("visp-track-pattern: click to end");
  }
  results.expected = source.count();
  std::unique_ptr<vpApp::Progress> progress;
  if (results.expected > 0) {
    progress = std::make_unique<vpApp::Progress>("tracking " + std::to_string(results.expected) + " images",
                                                 static_cast<double>(results.expected));
  }
  std::unique_ptr<Session> session;
  vpImage<unsigned char> image;
  bool clicked = false;
  while (!clicked && !vpApp::interrupted() && takeNext(source, image, results)) {
    if (!session) {
      session = std::make_unique<Session>(options, out, image, source.name(), results);
    }
    const cv::Mat picture = session->take(image, input, screen != nullptr);
    if (screen) {
      clicked = !screen->show(picture, options.camera.empty() ? 1. / options.videoRate : 0.);
    }
    if (progress) {
      progress->add(1.);
    }
  }
  if (!session) {
    vpApp::throwIfInterrupted();
    throw std::runtime_error(source.description() + " holds no image");
  }
  if (results.ending == Ending::Complete && (clicked || vpApp::interrupted())) {
    results.ending = Ending::Interrupted;
  }
  session->finish(source, out);
}
} // namespace trackPattern
