/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "goal.h"

#include "jsonReader.h"
#include "numberText.h"

#include <visp3/core/vpMath.h>
#include <visp3/core/vpPoseVector.h>
#include <visp3/direct_core/vpSO3.h>
#include <visp3/manipulator/vpArmTypes.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace visualServo
{
namespace
{
Eigen::Vector3d positionOf(const vpHomogeneousMatrix &M) { return {M[0][3], M[1][3], M[2][3]}; }
} // namespace

Goal readGoal(const std::string &file)
{
  const nlohmann::json content = vpApp::readJsonFile(file);
  vpApp::JsonObject object(content, file);
  const std::vector<double> t = object.numbers("position_m", 3), r = object.numbers("rotation_deg", 3);
  Goal goal;
  goal.positionSpread = object.number("position_spread_m", 0.);
  goal.rotationSpread = vpMath::rad(object.number("rotation_spread_deg", 0.));
  goal.images = object.count("images", 0);
  object.finish();
  if (!(t[2] > 0.)) {
    throw vpFileError(file + ": position_m[2] is " + vpApp::number(t[2], 6) +
                      ", must be > 0: the target is in front of the camera");
  }
  goal.cdMo = vpHomogeneousMatrix(vpTranslationVector(t[0], t[1], t[2]),
                                  vpThetaUVector(vpMath::rad(r[0]), vpMath::rad(r[1]), vpMath::rad(r[2])));
  return goal;
}

std::string goalText(const Goal &goal)
{
  const vpPoseVector pose(goal.cdMo);
  return nlohmann::ordered_json{{"position_m", {pose[0], pose[1], pose[2]}},
                                {"rotation_deg", {vpMath::deg(pose[3]), vpMath::deg(pose[4]), vpMath::deg(pose[5])}},
                                {"position_spread_m", goal.positionSpread},
                                {"rotation_spread_deg", vpMath::deg(goal.rotationSpread)},
                                {"images", goal.images}}
             .dump(2) +
         "\n";
}

Goal meanGoal(const std::vector<vpHomogeneousMatrix> &poses)
{
  if (poses.size() < 2) {
    throw std::runtime_error("the target was found in " + std::to_string(poses.size()) +
                             " of the images, a goal needs at least 2");
  }
  const auto n = static_cast<double>(poses.size());
  const Eigen::Matrix3d R0 = vpRigidTransform::fromHomogeneous(poses[0]).R;
  Eigen::Vector3d p = Eigen::Vector3d::Zero(), turn = Eigen::Vector3d::Zero();
  for (const vpHomogeneousMatrix &pose : poses) {
    p += positionOf(pose) / n;
    turn += vpSO3::log(vpRigidTransform::fromHomogeneous(pose).R * R0.transpose()) / n;
  }
  const vpRigidTransform mean{vpSO3::exp(turn) * R0, p};
  double position = 0., rotation = 0.;
  for (const vpHomogeneousMatrix &pose : poses) {
    position += (positionOf(pose) - p).squaredNorm() / (n - 1.);
    rotation += vpSO3::log(vpRigidTransform::fromHomogeneous(pose).R * mean.R.transpose()).squaredNorm() / (n - 1.);
  }
  const Goal goal{mean.toHomogeneous(), std::sqrt(position), std::sqrt(rotation),
                  static_cast<unsigned int>(poses.size())};
  if (goal.positionSpread > std::max(0.001, 0.01 * p.norm()) || goal.rotationSpread > vpMath::rad(0.5)) {
    throw std::runtime_error("the camera or the target moved while the goal was taught: the poses scatter by " +
                             vpApp::number(1000. * goal.positionSpread, 3) + " mm and " +
                             vpApp::number(vpMath::deg(goal.rotationSpread), 3) + " degrees");
  }
  return goal;
}
} // namespace visualServo
