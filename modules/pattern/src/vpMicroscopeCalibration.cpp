/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpCalibrationBundle.h"
#include "vpCalibrationInput.h"
#include "vpPrintable.h"
#include "vpReading.h"

#include <visp3/pattern/vpMicroscopeCalibration.h>

#include <visp3/core/vpException.h>
#include <visp3/core/vpXmlParserCamera.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <limits>
#include <sstream>

BEGIN_VISP_NAMESPACE

namespace
{
// ViSP's parser reports on the standard streams; errors become an exception here.
class QuietStreams
{
public:
  QuietStreams() : m_out(std::cout.rdbuf(m_sink.rdbuf())), m_err(std::cerr.rdbuf(m_sink.rdbuf())) {}
  ~QuietStreams()
  {
    std::cout.rdbuf(m_out);
    std::cerr.rdbuf(m_err);
  }
  QuietStreams(const QuietStreams &) = delete;
  QuietStreams &operator=(const QuietStreams &) = delete;

private:
  std::ostringstream m_sink;
  std::streambuf *m_out;
  std::streambuf *m_err;
};

Eigen::Rotation2Dd turn(double angle) { return Eigen::Rotation2Dd(angle); }

Eigen::Matrix2d deformed(const vpMicroscopeCalibration &c)
{
  Eigen::Matrix2d D;
  D << 1. + c.stretch, c.shear, c.shear, 1. - c.stretch;
  return D;
}
} // namespace

Eigen::Vector2d vpMicroscopeCalibration::toPlane(double u, double v) const
{
  Eigen::Vector2d d(u - u0, (v - v0) * scaleX / scaleY);
  d *= 1. + kappa1 * d.squaredNorm();
  const double share = 1. - tiltX * d.x() - tiltY * d.y();
  d /= share > 0. ? share : std::numeric_limits<double>::quiet_NaN();
  Eigen::Vector2d p = turn(-rotation) * (deformed(*this).inverse() * (d / scaleX - Eigen::Vector2d(tx, ty)));
  if (mirrored) {
    p.y() = -p.y();
  }
  return p;
}

Eigen::Vector2d vpMicroscopeCalibration::toImage(double x, double y) const
{
  const Eigen::Vector2d q =
      scaleX * (deformed(*this) * (turn(rotation) * Eigen::Vector2d(x, mirrored ? -y : y)) + Eigen::Vector2d(tx, ty));
  const double depth = 1. + tiltX * q.x() + tiltY * q.y();
  const Eigen::Vector2d d = vpDistort(q / (depth > 0. ? depth : std::numeric_limits<double>::quiet_NaN()), kappa1).d;
  return {u0 + d.x(), v0 + d.y() * scaleY / scaleX};
}

vpCameraParameters vpMicroscopeCalibration::toCamera() const
{
  const double kdu = kappa1PerSquareMetre();
  const double farU = std::max(u0, width - 1. - u0), farV = std::max(v0, height - 1. - v0);
  const double seen2 = (farU * farU) / (scaleX * scaleX) + (farV * farV) / (scaleY * scaleY);
  const double longer = 1. + kdu * seen2; // ratio of ideal to observed radius
  const double ideal2 = longer * longer * seen2;
  const double kud = ideal2 > 0. && longer > 0. ? (1. / longer - 1.) / ideal2 : -kdu;
  vpCameraParameters camera;
  camera.initPersProjWithDistortion(scaleX, scaleY, u0, v0, kud, kdu);
  return camera;
}

vpMicroscopeCalibration vpMicroscopeCalibration::fromCamera(const vpCameraParameters &camera, unsigned int width,
                                                            unsigned int height)
{
  vpCheckCalibrationImage(width, height);
  const auto positive = [](const char *name, double value) {
    if (!(value > 0. && std::isfinite(value))) {
      throw vpException(vpException::badValue, "%s of the camera is %g, must be > 0", name, value);
    }
  };
  positive("px", camera.get_px());
  positive("py", camera.get_py());
  for (const auto &[field, value] :
       {std::pair<const char *, double>{"u0", camera.get_u0()}, std::pair<const char *, double>{"v0", camera.get_v0()},
        std::pair<const char *, double>{"kdu", camera.get_kdu()}}) {
    if (!std::isfinite(value)) {
      throw vpException(vpException::badValue, "%s of the camera is %g, must be finite", field, value);
    }
  }
  vpMicroscopeCalibration calibration;
  calibration.width = width;
  calibration.height = height;
  calibration.scaleX = camera.get_px();
  calibration.scaleY = camera.get_py();
  calibration.u0 = camera.get_u0();
  calibration.v0 = camera.get_v0();
  calibration.kappa1 = camera.get_kdu() / (camera.get_px() * camera.get_px());
  return calibration;
}

void vpMicroscopeCalibration::saveXml(const std::string &file, const std::string &name) const
{
  if (std::ifstream(file).good()) {
    throw vpException(vpException::ioError, "%s: exists, ViSP would add to it", file.c_str());
  }
  int status = 0;
  {
    const QuietStreams quiet;
    vpXmlParserCamera parser;
    status = parser.save(toCamera(), file, name, width, height);
  }
  if (status != vpXmlParserCamera::SEQUENCE_OK || !std::ifstream(file).good()) {
    throw vpException(vpException::ioError, "%s: cannot be written", file.c_str());
  }
}

vpMicroscopeCalibration vpMicroscopeCalibration::loadXml(const std::string &file, const std::string &name,
                                                         unsigned int width, unsigned int height)
{
  vpCheckCalibrationImage(width, height);
  static_cast<void>(vpReading([&] { return vpOpenFile(file).good(); }));
  int status = 0;
  const auto named = [&](const auto &call) {
    try {
      return call();
    }
    catch (const vpException &error) { // names neither file nor camera
      throw vpException(error.getCode(), vpPrintable(file + ": camera " + name + ": " + error.getStringMessage()));
    }
  };
  const vpCameraParameters camera = named([&] {
    const QuietStreams quiet;
    vpCameraParameters parsed;
    vpXmlParserCamera parser;
    status = parser.parse(parsed, file, name, vpCameraParameters::perspectiveProjWithDistortion, width, height);
    return parsed;
  });
  if (status != vpXmlParserCamera::SEQUENCE_OK) {
    throw vpException(vpException::ioError, "%s: has no camera %s with distortion for images of %u x %u px",
                      vpPrintable(file).c_str(), vpPrintable(name).c_str(), width, height);
  }
  return named([&] { return fromCamera(camera, width, height); });
}

END_VISP_NAMESPACE
