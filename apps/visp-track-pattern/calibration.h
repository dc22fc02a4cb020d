/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file calibration.h
 * \brief Calibration of the microscope from views of the product collected during tracking, and calibrations as files.
 */
#ifndef trackPattern_calibration_h
#define trackPattern_calibration_h

#include "options.h"

#include <visp3/core/vpImage.h>
#include <visp3/pattern/vpPatternFrame.h>
#include <visp3/pattern/vpPlanarMicroscopeCalibration.h>

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace trackPattern
{
/*!
 * \brief Keeps views evenly distributed over a recording of unknown length, so that memory and time are bounded.
 */
class CalibrationRun
{
public:
  explicit CalibrationRun(const Options &options);
  //! Add one image with its result. \param left, top : Corner of the tracked region, px.
  void add(const vpImage<unsigned char> &image, const vpPatternFrame &frame, double left, double top);
  [[nodiscard]] std::size_t viewCount() const { return m_views.size(); }
  //! \throw std::runtime_error explaining why there are no data to calibrate from, or that the fit is poor.
  [[nodiscard]] vpMicroscopeCalibrationResult compute(unsigned int width, unsigned int height) const;

private:
  void keep(std::vector<vpCalibrationPoint> points);

  bool m_dotGrid;
  vpCalibrationPitch m_pitch;
  std::vector<std::vector<vpCalibrationPoint>> m_views;
  std::size_t m_seen = 0;
  std::size_t m_stride = 1;
  std::string m_complaint; // message of the last image without a grid
  std::string m_grid;      // description of the last image with a grid
};

//! A result as the content of calibration.json.
[[nodiscard]] nlohmann::ordered_json jsonOf(const vpMicroscopeCalibrationResult &result, std::size_t views);

/*!
 * Read a file written by jsonOf(), or a ViSP camera file if the name ends in .xml.
 * \param cameraName : Name of the camera in an XML file. \param width, height : Size of the images, px.
 * \throw std::runtime_error naming the file and the field; also if it is for images of another size.
 */
[[nodiscard]] vpMicroscopeCalibration readCalibration(const std::string &file, const std::string &cameraName,
                                                      unsigned int width, unsigned int height);
} // namespace trackPattern

#endif
