/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/simulation/vpServoPlant.h>

#include <visp3/core/vpException.h>

#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
// NaN fails every comparison, so each check tests for validity, never for invalidity.
void requirePositive(const char *field, double value, const char *unit)
{
  if (!(value > 0.) || !std::isfinite(value)) {
    throw vpException(vpException::badValue, "%s of the plant is %g %s, must be > 0 and finite", field, value, unit);
  }
}

void requireNotNegative(const char *field, double value, const char *unit)
{
  if (!(value >= 0.) || !std::isfinite(value)) {
    throw vpException(vpException::badValue, "%s of the plant is %g %s, must be >= 0 and finite", field, value, unit);
  }
}
} // namespace

vpServoPlant vpServoPlant::byName(const std::string &name)
{
  vpServoPlant plant;
  plant.name = name;
  if (name == "A") {
    return plant;
  }
  if (name == "B" || name == "D") {
    plant.visionRate = 10.;
    plant.latency = 0.1;
    plant.pixelNoise = 0.5;
    plant.lag = 0.03;
    plant.deadband = name == "B" ? 0.10 : 0.20;
    return plant;
  }
  throw vpException(vpException::badValue, "unknown plant '%s', known are A, B and D", name.c_str());
}

void vpServoPlant::validate() const
{
  requirePositive("loopRate", loopRate, "Hz");
  requirePositive("visionRate", visionRate, "Hz");
  if (visionRate > loopRate) {
    throw vpException(vpException::badValue, "visionRate of the plant is %g Hz, must be <= loopRate, which is %g Hz",
                      visionRate, loopRate);
  }
  requireNotNegative("latency", latency, "s");
  requireNotNegative("pixelNoise", pixelNoise, "px");
  requireNotNegative("lag", lag, "s");
  requireNotNegative("deadband", deadband, "rad/s");
  requirePositive("maxLinear", maxLinear, "m/s");
  requirePositive("maxAngular", maxAngular, "rad/s");
}

END_VISP_NAMESPACE
