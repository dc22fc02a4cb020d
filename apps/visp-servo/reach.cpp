/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "reach.h"

#include "numberText.h"

#include <visp3/core/vpMath.h>
#include <visp3/direct_core/vpSO3.h>
#include <visp3/manipulator/vpClosedLoopKinematics.h>

#include <algorithm>
#include <random>

namespace visualServo
{
namespace
{
constexpr double PERIOD = 0.02;               // s, of a virtual motion of which only the end is used
constexpr int LONGEST = 1500, ATTEMPTS = 21;  // periods
constexpr double LENGTH = 1e-4, ANGLE = 1e-4; // m, rad: there
constexpr double AT_LIMIT = 1e-3;             // rad or m

bool leadsThere(const vpArmModel &arm, const vpJointVector &from, const vpRigidTransform &place)
{
  vpRedundancySpec redundancy;
  redundancy.period = PERIOD;
  vpClosedLoopSpec spec;
  spec.maxLinear = spec.maxAngular = 3.;
  spec.linearTolerance = LENGTH;
  spec.angularTolerance = ANGLE;
  spec.stallTime = 1.;
  vpClosedLoopKinematics kinematics(arm, redundancy, spec);
  vpClosedLoopInput input;
  input.goal = place;
  vpClosedLoopState state;
  state.q = from;
  vpClosedLoopOutput output;
  for (int i = 0; i < LONGEST && output.status == vpClosedLoopStatus::Moving; ++i) {
    kinematics.step(input, state, output);
  }
  return output.status == vpClosedLoopStatus::Reached;
}

vpJointVector randomPositions(const vpArmModel &arm, std::mt19937_64 &random)
{
  vpJointVector q(arm.size());
  for (int j = 0; j < arm.size(); ++j) {
    const bool isContinuous = arm.isContinuous(j);
    q(j) = std::uniform_real_distribution<double>(isContinuous ? -M_PI : arm.lower()(j),
                                                  isContinuous ? M_PI : arm.upper()(j))(random);
  }
  return q;
}
} // namespace

vpRigidTransform placeAtGoal(bool isFixed, const vpRigidTransform &fMc, const vpRigidTransform &moving,
                             const vpRigidTransform &cMo, const vpRigidTransform &cdMo)
{
  const vpRigidTransform goalInNow = cdMo * cMo.inverse();
  return isFixed ? fMc * goalInNow * fMc.inverse() * moving : moving * goalInNow.inverse();
}

std::vector<std::string> hindrances(const vpArmModel &arm, const vpJointVector &q, const vpRigidTransform &place,
                                    bool isFixed)
{
  std::vector<std::string> sentences;
  for (int j = 0; j < arm.size(); ++j) {
    const bool isLow = q(j) < arm.lower()(j) + AT_LIMIT;
    if (!arm.isContinuous(j) && (isLow || q(j) > arm.upper()(j) - AT_LIMIT)) {
      sentences.push_back("joint " + arm.spec().joints[static_cast<std::size_t>(j)].name + " is at its " +
                          (isLow ? "lower limit " : "upper limit ") +
                          vpApp::number(isLow ? arm.lower()(j) : arm.upper()(j), 4));
    }
  }
  vpArmSpec spec = arm.spec();
  if (!isFixed) { // the camera is to get there
    spec.tool = spec.cameraLink < 0 ? spec.tool * spec.camera : spec.camera;
    spec.toolLink = arm.cameraLink();
  }
  const vpArmModel model(spec);
  std::mt19937_64 random(1);
  vpJointVector from = q;
  for (int attempt = 0; attempt < ATTEMPTS; ++attempt, from = randomPositions(model, random)) {
    if (leadsThere(model, from, place)) {
      return sentences;
    }
  }
  vpArmData data;
  vpArmKinematics::forward(model, q, data);
  const vpRigidTransform way = data.tool.inverse() * place;
  sentences.push_back("no joint positions were found that reach the goal, " + vpApp::fixed(way.p.norm(), 3) +
                      " m and " + vpApp::fixed(vpMath::deg(vpSO3::log(way.R).norm()), 1) + " degrees away");
  return sentences;
}
} // namespace visualServo
