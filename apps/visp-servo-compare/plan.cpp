/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "plan.h"

#include "appMain.h"
#include "catalogue.h"
#include "dataFile.h"
#include "format.h"
#include "greyPicture.h"
#include "robot.h"

#include <visp3/core/vpMath.h>
#include <visp3/manipulator/vpTwistAxes.h>
#include <visp3/planar_target/vpPlanarTarget.h>

#include "lab/servo/vpServoStart.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <filesystem>

namespace servoCompare
{
namespace
{
constexpr const char *POINTS = "points";
constexpr const char *IMAGE = "image";
constexpr int LARGEST_PHOTO = 1024; // px; more detail than any view shows
constexpr int SMALLEST_PHOTO = 32;  // px

bool contains(const std::vector<std::string> &list, const std::string &item)
{
  return std::find(list.begin(), list.end(), item) != list.end();
}

std::vector<std::string> withoutRepeats(const std::vector<std::string> &list)
{
  std::vector<std::string> unique;
  for (const std::string &item : list) {
    if (!contains(unique, item)) {
      unique.push_back(item);
    }
  }
  return unique;
}

std::vector<std::string> chooseLaws(const std::vector<std::string> &asked)
{
  for (const std::string &id : asked) {
    if (!contains(vpServoLaw::ids(), withoutFilter(id))) {
      throw vpApp::UsageError("--law: unknown law \"" + id + "\"; known are " + knownLaws() +
                              ", each but those that plan also with +cbf");
    }
    if (withoutFilter(id) != id && vpServoLaw::create(withoutFilter(id))->plansMotion()) {
      throw vpApp::UsageError("--law: \"" + id +
                              "\": the view filter (+cbf) cannot follow a law that plans its motion");
    }
  }
  return asked.empty() ? vpServoLaw::ids() : withoutRepeats(asked);
}

std::vector<vpServoPlant> choosePlants(const std::vector<std::string> &asked, const std::vector<vpServoPlant> &own)
{
  if (asked.empty()) {
    return own;
  }
  std::vector<vpServoPlant> plants;
  for (const std::string &name : withoutRepeats(asked)) {
    const auto found =
        std::find_if(own.begin(), own.end(), [&](const vpServoPlant &plant) { return plant.name == name; });
    if (found != own.end()) {
      plants.push_back(*found);
    }
    else if (contains(standardPlants(), name)) {
      plants.push_back(vpServoPlant::byName(name));
    }
    else {
      std::vector<std::string> known = standardPlants();
      for (const vpServoPlant &plant : own) {
        known.push_back(plant.name);
      }
      throw vpApp::UsageError("--plant: unknown plant \"" + name + "\"; known are " + enumerate(withoutRepeats(known)));
    }
  }
  return plants;
}

//! Measures used for a law on a plant.
std::vector<std::string> chooseMeasures(const Options &options, const std::string &law, const vpServoPlant &plant)
{
  if (options.full) {
    return {POINTS, IMAGE};
  }
  if (!options.measures.empty()) {
    return withoutRepeats(options.measures);
  }
  const bool alsoImage = contains({"pbvs1", "kyrki", "ff-lookat-pi"}, law) && plant.deadband > 0.;
  return alsoImage ? std::vector<std::string>{POINTS, IMAGE} : std::vector<std::string>{POINTS};
}

Target readTarget(const std::string &asked)
{
  Target target;
  target.isDefault = asked.empty();
  target.file = asked.empty() ? vpApp::dataFile("target/klimt.jpg") : asked;
  vpPictures::GreyScale depth;
  cv::Mat photo = vpApp::readGreyPicture(target.file, depth);
  target.remark = depth.depthRemark();
  if (photo.cols < SMALLEST_PHOTO || photo.rows < SMALLEST_PHOTO) {
    throw std::runtime_error(target.file + ": is " + std::to_string(photo.cols) + "x" + std::to_string(photo.rows) +
                             " px, must be at least 32x32 px");
  }
  const double scale = double(LARGEST_PHOTO) / std::max(photo.cols, photo.rows);
  if (scale < 1.) {
    cv::resize(photo, photo, cv::Size(), scale, scale, cv::INTER_AREA);
  }
  vpApp::copyGrey(photo, target.photo);
  return target;
}

//! Check early that the photo can serve as a target.
void requireUsableTarget(const Target &target, const vpServoTask &task)
{
  try {
    const vpPlanarTarget probe(target.photo, task.objectWidth, task.objectHeight, task.camera);
  }
  catch (const std::exception &error) {
    throw std::runtime_error(target.file + ": " + vpApp::sentenceOf(error));
  }
}

std::vector<vpSelfMotionIndex> indicesOf(const RobotOptions &options, const vpArmModel &model)
{
  std::vector<vpSelfMotionIndex> indices;
  for (const std::string &name : options.selfMotion) {
    if (name == "limits") {
      indices.push_back(vpSelfMotionIndex::jointLimits());
    }
    else if (name == "manipulability") {
      indices.push_back(vpSelfMotionIndex::manipulability());
    }
    else if (name == "posture") {
      indices.push_back(vpSelfMotionIndex::posture(model.home()));
    }
    else if (name != "none" || options.selfMotion.size() > 1) {
      throw vpApp::UsageError("--self-motion: unknown wish \"" + name +
                              "\"; known are limits, manipulability, posture, or none alone");
    }
  }
  return indices;
}

vpLimitPolicy policyOf(const RobotOptions &options)
{
  if (options.limits != "stop" && options.limits != "scale") {
    throw vpApp::UsageError("--limits is " + options.limits + ", must be stop or scale");
  }
  return options.limits == "stop" ? vpLimitPolicy::StopJoints : vpLimitPolicy::ScaleMotion;
}

vpDriveReference referenceOf(const RobotOptions &options)
{
  return options.drive == "measured" ? vpDriveReference::Measured : vpDriveReference::Integrated;
}

std::array<bool, 6> freeAxesOf(const RobotOptions &options)
{
  if (!options.free.empty() && options.robot == "camera") {
    throw vpApp::UsageError("--free needs an arm, given by --robot: a free-flying camera can follow all axes");
  }
  try {
    return vpFreeAxes(options.free);
  }
  catch (const vpException &error) {
    throw vpApp::UsageError("--free: " + vpApp::sentenceOf(error));
  }
}

std::string listOf(const vpArmModel &model, const vpJointVector &q)
{
  std::string text;
  for (int i = 0; i < model.size(); ++i) {
    text += (i > 0 ? ", " : "") + (model.isPrismatic(i) ? fixed(q(i), 3) + " m" : fixed(vpMath::deg(q(i)), 1));
  }
  return text;
}

/*!
 * The requested arm, with a start configuration from which the task is feasible and its self-motion; null for a
 * free-flying camera.
 * \throw vpApp::UsageError for an unknown choice; vpException naming the file and the invalid element.
 */
std::shared_ptr<const vpServoArm> chooseArm(const RobotOptions &options, const vpServoTask &task)
{
  const vpLimitPolicy policy = policyOf(options);
  const std::array<bool, 6> free = freeAxesOf(options);
  if (options.robot == "camera") {
    return nullptr;
  }
  auto arm = std::make_shared<vpServoArm>(vpServoArm{vpApp::loadArm(options), {}});
  arm->spec.indices = indicesOf(options, arm->model);
  arm->spec.redundancy.policy = policy;
  const std::string missing = vpApp::missingLimitSentence(arm->model);
  if (!missing.empty()) {
    throw std::runtime_error(missing);
  }
  arm->spec.drives.reference = referenceOf(options);
  arm->spec.free = free;
  arm->spec.validate(arm->model);
  arm->spec.start = findServoStart(arm->model, task, free);
  return arm;
}

//! Why the arm does not support the drives of a plant; empty: it does.
std::string misfitOf(const vpServoArm &arm, const vpServoPlant &plant)
{
  try {
    const vpArmDrives probe(arm.model, arm.forPlant(plant).drives);
    return "";
  }
  catch (const vpException &error) {
    return vpApp::sentenceOf(error) + "; plant " + plant.name +
           " needs masses, plants without lag and deadband such as A do not";
  }
}

/*!
 * Leaves out plants that the arm does not support.
 * \throw std::runtime_error if they were asked for, or no other is left.
 */
void chooseDrivable(const Options &options, Plan &plan)
{
  std::vector<vpServoPlant> drivable;
  std::string misfit;
  for (const vpServoPlant &plant : plan.scenario.plants) {
    const std::string sentence = misfitOf(*plan.arm, plant);
    if (sentence.empty()) {
      drivable.push_back(plant);
      continue;
    }
    misfit = misfit.empty() ? sentence : misfit;
    plan.remarks.push_back("plant " + plant.name + " is left out: " + sentence);
  }
  if (!misfit.empty() && (!options.plants.empty() || drivable.empty())) {
    throw std::runtime_error(misfit);
  }
  plan.scenario.plants = drivable;
}
} // namespace

Plan makePlan(const Options &options)
{
  for (const std::string &measure : options.measures) {
    if (measure != POINTS && measure != IMAGE) {
      throw vpApp::UsageError("--measure: unknown measure \"" + measure + "\"; known are points and image");
    }
  }
  Plan plan;
  plan.laws = chooseLaws(options.laws);
  if (!options.taskFile.empty()) {
    plan.scenario = readScenario(options.taskFile);
  }
  if (options.lambda > 0.) {
    plan.scenario.gains.lambda = options.lambda;
  }
  plan.scenario.plants = choosePlants(options.plants, plan.scenario.plants);
  plan.target = readTarget(options.target);
  vpServoTask &task = plan.scenario.task;
  if (!plan.target.isDefault) {
    task.objectHeight = task.objectWidth * plan.target.photo.getHeight() / plan.target.photo.getWidth();
    requireUsableTarget(plan.target, task);
  }
  plan.seed = options.seed;
  plan.repetitions = options.repetitions;
  plan.shaped = options.shape;
  plan.arm = chooseArm(options.robot, task);
  if (plan.arm) {
    plan.remarks = plan.arm->model.spec().warnings;
    vpApp::warnOfJointsBehind(plan.arm->model, "camera", plan.arm->model.cameraLink(), plan.remarks);
    chooseDrivable(options, plan);
  }

  for (const std::string &law : plan.laws) {
    for (const vpServoPlant &plant : plan.scenario.plants) {
      for (const std::string &measure : chooseMeasures(options, law, plant)) {
        vpServoRunSpec spec;
        spec.law = law;
        spec.measure = measure;
        spec.gains = plan.scenario.gains;
        spec.average = options.bounded;
        if (options.bounded) {
          spec.bounds = plan.scenario.motion;
        }
        spec.plant = plant;
        spec.task = task;
        spec.arm = plan.arm;
        if (plant.pixelNoise > 0.) {
          spec.faults = plan.scenario.faults;
        }
        for (const bool shaped : {false, true}) {
          if (shaped && !plan.shaped) {
            continue;
          }
          if (shaped) {
            spec.shape = plan.scenario.shape;
          }
          for (unsigned int i = 0; i < plan.repetitions; ++i) {
            spec.seed = plan.seed + i;
            plan.runs.push_back(spec);
          }
        }
      }
    }
  }
  for (const char *measure : {POINTS, IMAGE}) {
    if (std::any_of(plan.runs.begin(), plan.runs.end(),
                    [&](const vpServoRunSpec &run) { return run.measure == measure; })) {
      plan.measures.emplace_back(measure);
    }
  }
  return plan;
}

namespace
{
bool hasDryFriction(const vpArmModel &model)
{
  const std::vector<vpArmJointSpec> &joints = model.spec().joints;
  return std::any_of(joints.begin(), joints.end(), [](const vpArmJointSpec &joint) { return joint.coulomb > 0.; });
}
} // namespace

std::string sentenceOf(const vpServoArm &arm)
{
  std::string wishes;
  for (const vpSelfMotionIndex &index : arm.spec.indices) {
    wishes += (wishes.empty() ? "" : ", ") +
              std::string(index.kind == vpIndexKind::JointLimits ? "away from joint limits"
                          : index.kind == vpIndexKind::Posture   ? "near the posture of the start"
                                                                 : "away from singularities");
  }
  const int n = arm.model.size();
  const auto commanded = std::count(arm.spec.free.begin(), arm.spec.free.end(), false);
  const std::string free = vpAxesInWords(arm.spec.free);
  return arm.model.spec().name + ", " + std::to_string(n) + " joints, starts at (" + listOf(arm.model, arm.spec.start) +
         ") deg; " +
         (n <= commanded   ? "no joint is to spare"
          : wishes.empty() ? "the spare joint does nothing"
                           : "the spare joint leads it " + wishes) +
         "; at position limits " +
         (arm.spec.redundancy.policy == vpLimitPolicy::StopJoints ? "only the joint concerned stops."
                                                                  : "the whole motion is slowed down.") +
         (arm.spec.drives.reference == vpDriveReference::Measured
              ? " Where there is friction, the drives add velocities to the measured position, (3.18) of the thesis: "
                "friction suppresses small velocities."
              : " Where there is friction, the drives integrate velocities in open loop: friction delays the joints.") +
         (hasDryFriction(arm.model)
              ? ""
              : " Its file gives no Coulomb friction: plants that differ in friction alone are nearly the same.") +
         (free.empty() ? ""
                       : " Free axes of the camera: " + free +
                             ". They are not commanded, and errors of the pose are without them.");
}
} // namespace servoCompare
