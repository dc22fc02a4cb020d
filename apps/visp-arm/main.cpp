/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// visp-arm: what was understood of a robot, before anything moves.
#include "page.h"

#include "appMain.h"
#include "outputFolder.h"
#include "report.h"
#include "viewData.h"

#include <visp3/avoidance/vpCollisionSceneJson.h>
#include <visp3/avoidance/vpExactShapes.h>
#include <visp3/avoidance/vpSelfCollisionStatistics.h>
#include <visp3/core/vpException.h>
#include <visp3/manipulator/vpArmKinematics.h>

#include <iostream>
#include <memory>

namespace
{
using namespace armProgram;

void requireCount(const char *option, const std::vector<double> &q, const vpArmModel &arm)
{
  if (static_cast<int>(q.size()) != arm.size()) {
    throw vpApp::UsageError(std::string(option) + " has " + std::to_string(q.size()) + " numbers, must have " +
                            std::to_string(arm.size()) + ": one for each joint of " + arm.spec().name);
  }
}

vpJointVector configuration(const char *option, const std::vector<double> &q, const vpArmModel &arm)
{
  requireCount(option, q, arm);
  return Eigen::Map<const Eigen::VectorXd>(q.data(), arm.size());
}

Answers answer(const vpApp::Robot &robot, const Options &options)
{
  Answers answers;
  if (!options.fk.empty()) {
    vpArmData data;
    vpArmKinematics::forward(*robot.arm, configuration("--fk", options.fk, *robot.arm), data);
    answers.pose = data.tool;
  }
  if (!options.touches.empty()) {
    const vpJointVector q = configuration("--at", options.at, *robot.arm);
    answers.touches = touchesAt(sceneOf(robot, vpLoadCollisionScene(options.touches).spec), q);
  }
  return answers;
}

void writeFolder(vpApp::OutputFolder &out, const vpApp::Robot &robot, const nlohmann::ordered_json &json,
                 const std::string &commandLine)
{
  out.write("robot.json", json.dump(2) + "\n");
  vpApp::writeArm(out, *robot.arm);
  vpApp::finishWithReport(out,
                          {{"command", commandLine}, {"robot", robot.arm->label()}, {"problems", json.at("problems")}});
}

//! \throw vpException naming the file that cannot be written.
void writePairs(const vpApp::Robot &robot, const std::string &file)
{
  std::shared_ptr<const vpExactShapes> exact;
  try {
    exact = std::make_shared<const vpExactShapes>(*robot.arm);
  }
  catch (const vpException &) { // without FCL capsules decide, and the file says so
  }
  vpSampleBodyPairs(*robot.arm, exact).save(file);
}

vpApp::Robot load(const Options &options)
{
  try {
    return vpApp::loadRobot(options.robot);
  }
  catch (const vpApp::UsageError &) {
    throw;
  }
  catch (const std::exception &error) {
    if (options.json) {
      std::cout << jsonOf(vpApp::sentenceOf(error)).dump(2) << std::endl;
    }
    throw;
  }
}

void tell(const Options &options, const std::string &commandLine)
{
  const auto out = options.out.empty() ? nullptr : std::make_unique<vpApp::OutputFolder>("visp-arm", options.out);
  const vpApp::Robot robot = load(options);
  if (!options.writtenPairs.empty()) {
    writePairs(robot, options.writtenPairs);
  }
  const Description description = describe(robot, options.robot);
  const Answers answers = answer(robot, options);
  const nlohmann::ordered_json json = jsonOf(robot, description, answers);
  if (out) {
    writeFolder(*out, robot, json, commandLine);
  }
  std::cout << (options.json ? json.dump(2) + "\n" : textOf(robot, description, answers)) << std::flush;
  if (!description.problems.empty()) {
    throw std::runtime_error(description.problems.front());
  }
}
} // namespace

int main(int argc, char **argv)
{
  return vpApp::runMain("visp-arm", [&]() -> int {
    Options options;
    if (readOptions(argc, argv, options)) {
      tell(options, vpApp::commandLine("visp-arm", argc, argv));
    }
    return vpApp::ExitOk;
  });
}
