/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/simulation/vpServoPlant.h>

#include <visp3/core/vpException.h>

BEGIN_VISP_NAMESPACE

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

const vpFields<vpServoPlant> &vpServoPlant::fields()
{
  using Plant = vpServoPlant;
  const vpFieldRange positive = vpFieldRange::positive(), notNegative = vpFieldRange::notNegative();
  static const vpFields<Plant> all = {
      {"loopRate", &Plant::loopRate, positive, "Hz", "Rate of the inner loop that runs the law"},
      {"visionRate", &Plant::visionRate, positive, "Hz", "Rate of the camera"},
      {"latency", &Plant::latency, notNegative, "s", "Latency from exposure to result"},
      {"pixelNoise", &Plant::pixelNoise, notNegative, "px", "Standard deviation of the image points"},
      {"lag", &Plant::lag, notNegative, "s", "Time constant of the velocity response"},
      {"deadband", &Plant::deadband, notNegative, "rad/s", "Coulomb friction of the rotation axes, as lost velocity"},
      {"maxLinear", &Plant::maxLinear, positive, "m/s", "Limit of the linear speed"},
      {"maxAngular", &Plant::maxAngular, positive, "rad/s", "Limit of the angular speed"},
  };
  return all;
}

void vpServoPlant::validate() const
{
  vpCheckFields(*this, fields(), "the plant");
  if (visionRate > loopRate) {
    throw vpException(vpException::badValue, "visionRate of the plant is %g Hz, must be <= loopRate, which is %g Hz",
                      visionRate, loopRate);
  }
}

END_VISP_NAMESPACE
