/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/pattern/vpCalibrationPoint.h>
#include <visp3/pattern/vpPatternTracker.h>

#include <visp3/core/vpException.h>

#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr double unknownSigma = 0.1; // px, see vpCalibrationPoints()

double known(double sigma) { return std::isfinite(sigma) ? sigma : unknownSigma; }
} // namespace

void vpCalibrationPitch::check() const
{
  const auto positive = [](const char *name, double value) {
    if (!(value > 0. && std::isfinite(value))) {
      throw vpException(vpException::badValue, "the pitch of the %s is %g m, must be > 0", name, value);
    }
  };
  positive("columns", columns);
  positive("rows", rows);
  if (!(sigmaPlane >= 0. && std::isfinite(sigmaPlane))) {
    throw vpException(vpException::badValue, "sigmaPlane of the pitch is %g m, must be >= 0", sigmaPlane);
  }
}

std::vector<vpCalibrationPoint> vpCalibrationPoints(const vpPatternFrame &frame, const vpCalibrationPitch &pitch)
{
  pitch.check();
  std::vector<vpCalibrationPoint> points;
  for (const vpPatternCell &cell : frame.cells) {
    if (cell.valid) {
      vpCalibrationPoint point;
      point.u = cell.x;
      point.v = cell.y;
      point.x = cell.column * pitch.columns;
      point.y = cell.row * pitch.rows;
      point.sigmaU = known(cell.sigmaX);
      point.sigmaV = known(cell.sigmaY);
      point.sigmaPlane = pitch.sigmaPlane;
      points.push_back(point);
    }
  }
  return points;
}

std::vector<vpCalibrationPoint> vpCalibrationPoints(const vpImage<unsigned char> &image,
                                                    const vpCalibrationPitch &pitch)
{
  pitch.check();
  vpPatternOptions options;
  options.method = vpPatternMethod::HalfMaximumEdges;
  vpPatternTracker tracker(image.getWidth(), image.getHeight(), options);
  const vpPatternFrame &frame = tracker.track(image);
  if (frame.validCells == 0) {
    throw vpException(vpException::fatalError, "no dots of a grid were found: %s", frame.message());
  }
  return vpCalibrationPoints(frame, pitch);
}

END_VISP_NAMESPACE
