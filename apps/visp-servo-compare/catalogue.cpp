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

const std::vector<LawInfo> &laws()
{
  static const std::vector<LawInfo> all = {
      {"pbvs1", "PBVS-1", "Position-based on the camera's pose: a straight camera path, the view is not looked after.",
       "#1f77b4", GainGroup::Single},
      {"pbvs1-rot2", "PBVS-1, rotation x2", "PBVS-1 with twice the rotation gain.", "#0b3c6f", GainGroup::Double},
      {"pbvs2", "PBVS-2", "Position-based on the object's pose: the object's origin goes straight in the camera frame.",
       "#17becf", GainGroup::Single},
      {"ibvs", "IBVS", "Image-based on the feature points: straight lines in the image, no care for the path.",
       "#8c564b", GainGroup::Single},
      {"hybrid25d", "2 1/2 D", "Hybrid of Malis: translation by an image point and depth, rotation by pose.", "#7f7f7f",
       GainGroup::Single},
      {"kyrki", "Kyrki, full",
       "Kyrki as published: a straight camera path, the rotation holds the object in the image "
       "and compensates the translation.",
       "#ff7f0e", GainGroup::Single},
      {"kyrki-rot2", "Kyrki, full, rotation x2", "Kyrki as published with twice the rotation gain.", "#a84300",
       GainGroup::Double},
      {"kyrki-decoupled", "Kyrki, decoupled",
       "Kyrki with the rotation driven by the image error alone, without "
       "compensation: what the thesis compares with.",
       "#d4ac0d", GainGroup::Single},
      {"ff-sum", "FF sum (thesis)",
       "The thesis' law, corrected: PBVS-1 plus the bearing of the object as a feedforward of "
       "the rotation.",
       "#2ca02c", GainGroup::Double},
      {"ff-lookat", "FF look-at",
       "Feedforward that keeps the camera turned to the object while it translates; rotation "
       "gain x2.",
       "#d62728", GainGroup::Double},
      {"ff-lookat-pi", "FF look-at PI",
       "FF look-at with an integral of the rotation error against friction; the "
       "default of visp-direct.",
       "#9467bd", GainGroup::Integral},
  };
  return all;
}
} // namespace

const char *titleOf(GainGroup group)
{
  switch (group) {
  case GainGroup::Single:
    return "Rotation gain as given";
  case GainGroup::Double:
    return "Gain-matched rivals: effective rotation gain x2 near the goal, no integral";
  case GainGroup::Integral:
    return "Rotation gain x2 with integral (no rival has one)";
  }
  return "";
}

bool isFiltered(const std::string &id)
{
  const std::string suffix = FILTER;
  return id.size() > suffix.size() && id.compare(id.size() - suffix.size(), suffix.size(), suffix) == 0;
}

std::string withoutFilter(const std::string &id)
{
  return isFiltered(id) ? id.substr(0, id.size() - std::string(FILTER).size()) : id;
}

LawInfo lawInfo(const std::string &id)
{
  LawInfo info{id, id, "No description yet.", "#000000", GainGroup::Single};
  for (const LawInfo &law : laws()) {
    if (law.id == withoutFilter(id)) {
      info = law;
    }
  }
  if (isFiltered(id)) {
    info.id = id;
    info.name += " + filter";
    info.sentence +=
        " Behind it the filter that keeps the object's corners in the view of a robot that executes its twist.";
  }
  return info;
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
