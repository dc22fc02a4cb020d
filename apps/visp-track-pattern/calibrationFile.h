/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file calibrationFile.h
 * \brief Calibrations of the microscope as files.
 */
#ifndef trackPattern_calibrationFile_h
#define trackPattern_calibrationFile_h

#include <visp3/pattern/vpPlanarMicroscopeCalibration.h>

#include <nlohmann/json.hpp>

#include <string>

VISP_DIRECT_USING_NAMESPACE

namespace trackPattern
{
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
