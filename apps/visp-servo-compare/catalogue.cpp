/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "catalogue.h"

#include "format.h"

#include <visp3/feedforward/vpServoLaw.h>

namespace servoCompare
{
namespace
{
constexpr const char *FILTER = "+cbf";

bool isFiltered(const std::string &id)
{
  const std::string suffix = FILTER;
  return id.size() > suffix.size() && id.compare(id.size() - suffix.size(), suffix.size(), suffix) == 0;
}
} // namespace

std::string withoutFilter(const std::string &id)
{
  return isFiltered(id) ? id.substr(0, id.size() - std::string(FILTER).size()) : id;
}

std::string sentenceOf(const std::string &law)
{
  return vpServoLaw::sentence(withoutFilter(law)) +
         (isFiltered(law)
              ? " Behind it the filter that keeps the object's corners in the view of a robot that executes its twist."
              : "");
}

std::string knownLaws()
{
  std::string known;
  for (const std::string &id : vpServoLaw::ids()) {
    known += (known.empty() ? "" : ", ") + id;
  }
  return known;
}

const std::vector<std::string> &standardPlants()
{
  static const std::vector<std::string> names{"A", "B", "D"};
  return names;
}

std::string sentenceOf(const vpServoPlant &plant, bool onArm)
{
  const bool perfect = plant.latency == 0. && plant.pixelNoise == 0. && plant.lag == 0. && plant.deadband == 0.;
  std::string sentence = perfect && onArm ? "Perfect: the joints are where they are commanded to be, no noise"
                         : perfect        ? "Perfect: executes every twist at once, no noise"
                                          : "Imperfect";
  sentence += "; vision at " + number(plant.visionRate, 3) + " Hz";
  if (!perfect) {
    sentence += " with " + number(1000. * plant.latency, 3) + " ms latency and " + number(plant.pixelNoise, 3) +
                " px noise, odometry between frames; ";
    if (!onArm) {
      sentence += "velocity lag " + number(1000. * plant.lag, 3) + " ms; friction takes " + number(plant.deadband, 3) +
                  " rad/s off each rotation axis";
    }
    else if (plant.lag == 0. && plant.deadband == 0.) {
      sentence += "the joints are where they are commanded to be";
    }
    else {
      sentence += "joints driven by torques at 1 kHz against " + number(plant.deadband / 0.1, 3) +
                  " times the friction of the arm's file";
    }
  }
  return sentence + "; inner loop " + number(plant.loopRate, 3) + " Hz.";
}
} // namespace servoCompare
