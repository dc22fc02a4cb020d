/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "catalogue.h"

#include "format.h"

#include <visp3/feedforward/vpServoLaw.h>

#include <algorithm>
#include <iterator>

namespace servoCompare
{
namespace
{
constexpr const char *FILTER = "+cbf";

//! How a law is shown.
struct Look {
  std::string id, name, colour;
  GainGroup group;
};

const std::vector<Look> &looks()
{
  static const std::vector<Look> all = {
      {"pbvs1", "PBVS-1", "#1f77b4", GainGroup::Single},
      {"pbvs1-rot2", "PBVS-1, rotation x2", "#0b3c6f", GainGroup::Double},
      {"pbvs2", "PBVS-2", "#17becf", GainGroup::Single},
      {"ibvs", "IBVS", "#8c564b", GainGroup::Single},
      {"hybrid25d", "2 1/2 D", "#7f7f7f", GainGroup::Single},
      {"kyrki", "Kyrki, full", "#ff7f0e", GainGroup::Single},
      {"kyrki-rot2", "Kyrki, full, rotation x2", "#a84300", GainGroup::Double},
      {"kyrki-decoupled", "Kyrki, decoupled", "#d4ac0d", GainGroup::Single},
      {"ff-sum", "FF sum (thesis)", "#2ca02c", GainGroup::Double},
      {"ff-lookat", "FF look-at", "#d62728", GainGroup::Double},
      {"ff-lookat-pi", "FF look-at PI", "#9467bd", GainGroup::Integral},
      {"dtg", "DTG", "#e377c2", GainGroup::Integral},
      {"ff-dtg", "FF DTG", "#bcbd22", GainGroup::Integral},
  };
  return all;
}

//! A law of a plug-in: in turn one of the colours that ours do not have.
Look ownLook(const std::string &id)
{
  constexpr const char *colours[] = {"#e377c2", "#637939", "#393b79", "#8c6d31", "#00a087", "#000000"};
  const std::vector<std::string> ids = vpServoLaw::ids();
  const auto place = static_cast<std::size_t>(std::find(ids.begin(), ids.end(), id) - ids.begin());
  return {id, id, colours[place % std::size(colours)], GainGroup::Own};
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
  case GainGroup::Own:
    return "Laws of plug-ins, whose gains are their own";
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
  const std::string law = withoutFilter(id);
  const auto known = std::find_if(looks().begin(), looks().end(), [&](const Look &look) { return look.id == law; });
  const Look look = known == looks().end() ? ownLook(law) : *known;
  LawInfo info{id, look.name, vpServoLaw::sentence(law), look.colour, look.group};
  if (isFiltered(id)) {
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
