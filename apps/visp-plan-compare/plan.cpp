/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "plan.h"

#include "appMain.h"
#include "dataFile.h"
#include "numberText.h"

#include "robot.h"

#include "lab/avoidance/vpSceneFrame.h"

#include <algorithm>

namespace planCompare
{
MethodInfo methodInfo(const std::string &id)
{
  static const std::vector<MethodInfo> all = {
      {"potential",
       "The potential field of thesis 8.2.1 as it is printed: the nearer an obstacle, the more the way to the goal "
       "gives "
       "way to going away from it."},
      {"potential-corrected", "The same with the corrected weights and radial distances, and limits."},
      {"dtg", "Direct trajectory generation point to point, thesis 8.2.2: a new least-jerk motion of the tool whenever "
              "something "
              "was seen."},
      {"dtg-via", "The same with a via point beside the obstacle."},
      {"planner", "A planned path of proven motions, timed within all limits, driven as planned."},
      {"planner-dtg",
       "The same path, tracked by direct trajectories and replanned on the fly when something was seen."},
  };
  const auto found = std::find_if(all.begin(), all.end(), [&](const MethodInfo &m) { return m.id == id; });
  return found != all.end() ? *found : MethodInfo{id, vpAvoidanceMethodMessage(id)};
}

const std::vector<SceneInfo> &standardScenes()
{
  static const std::vector<SceneInfo> all = {
      {"S1", "ball, fig. 8.8",
       "Figures 8.6 to 8.12: on its straight way the arm meets a ball that appears, and gets a new goal beside it. "
       "Camera "
       "at 10 Hz.",
       20, 4},
      {"S2", "random static",
       "Random boxes, balls, capsules and cylinders; neither the joints nor the tool "
       "can go straight, and each scene is certified to have a way, with 30 mm to spare.",
       200, 6},
      {"S3", "crossing",
       "Two obstacles at constant speed cross the arm's way, 0.1 to 0.5 m/s, seen at 30 or 10 Hz with 50 ms of latency "
       "and 3 mm of noise. Seed 1 is the shown case: 0.3 m/s at 30 Hz.",
       100, 10},
      {"S4a", "pillar", "A pillar between start and goal.", 5, 1},
      {"S4b", "shelf", "From one compartment of a shelf into the other, two tasks.", 5, 1},
      {"S6", "trap", "A pocket open towards the arm: ways that only descend end in it.", 5, 1},
      {"S7", "moving goal, fig. 8.13",
       "Figure 8.13: nothing is in the way, the goal moves and is measured with 10 mm of noise.", 20, 3},
  };
  return all;
}

const char *selfMotionSentence()
{
  return "What the spare joints do while the tool does its work: three indices, figures 8.14 to 8.17.";
}

namespace
{
constexpr unsigned int OWN_SEEDS = 5; // seeds of a user scene

bool contains(const std::vector<std::string> &names, const std::string &name)
{
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool endsWith(const std::string &text, const std::string &end)
{
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

std::vector<std::string> chooseMethods(const std::vector<std::string> &asked)
{
  const std::vector<std::string> known = vpAvoidanceMethodNames();
  for (const std::string &name : asked) {
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      throw vpApp::UsageError("--method: unknown method \"" + name + "\"; known are " + vpApp::enumerate(known));
    }
  }
  std::vector<std::string> methods;
  for (const std::string &name : known) {
    if (asked.empty() || std::find(asked.begin(), asked.end(), name) != asked.end()) {
      methods.push_back(name);
    }
  }
  return methods;
}

//! Number of seeds of a scene.
unsigned int seedsOf(const Options &options, const SceneInfo &scene)
{
  return options.seeds > 0 ? options.seeds : options.quick ? scene.quick : scene.seeds;
}

//! Adds the problems of a scene one by one.
class Adder
{
public:
  Adder(Plan &plan, const Options &options) : m_plan(&plan), m_options(&options) {}

  using Make = std::function<vpAvoidanceScenario(const std::shared_ptr<const vpArmModel> &, unsigned int)>;

  void add(const SceneInfo &scene, unsigned int seed, const std::string &variant, const Make &make)
  {
    Problem problem;
    problem.scene = scene.id;
    problem.variant = variant;
    problem.seed = seed;
    problem.shown = m_plan->problems.empty() || m_plan->problems.back().scene != scene.id;
    problem.make = [make, seed, arm = m_plan->arm, friction = m_options->friction,
                    compensate = m_options->compensateFriction] {
      vpAvoidanceScenario scenario = make(arm, seed);
      if (friction > 0.) {
        scenario.run.drives.ideal = false;
        scenario.run.drives.frictionScale = friction;
        scenario.run.drives.compensateFriction = compensate;
        scenario.run.goalTolerance = 0.01; // PD drives alone do not reach 1 mm
      }
      return scenario;
    };
    m_plan->problems.push_back(problem);
  }

  void addSeeds(const SceneInfo &scene, const Make &make)
  {
    for (unsigned int i = 0; i < seedsOf(*m_options, scene); ++i) {
      add(scene, m_options->firstSeed + i, "", make);
    }
  }

  void addCrossing(const SceneInfo &scene)
  {
    constexpr double speeds[] = {0.3, 0.1, 0.2, 0.4, 0.5}, rates[] = {30., 10.};
    for (unsigned int i = 0; i < seedsOf(*m_options, scene); ++i) {
      vpCrossingSpec spec;
      spec.speed = speeds[i % 5];
      spec.visionRate = rates[i / 5 % 2];
      add(scene, m_options->firstSeed + i,
          vpApp::number(spec.speed, 2) + " m/s at " + vpApp::number(spec.visionRate, 3) + " Hz",
          [spec](const auto &arm, unsigned int seed) { return vpAvoidanceScenes::crossing(arm, seed, spec); });
    }
  }

  void addFile(const SceneInfo &scene, const vpCollisionSceneFile &file)
  {
    for (std::size_t task = 0; task < file.tasks.size(); ++task) {
      for (unsigned int i = 0; i < seedsOf(*m_options, scene); ++i) {
        add(scene, m_options->firstSeed + i, file.tasks[task].name, [file, task](const auto &arm, unsigned int seed) {
          return vpAvoidanceScenes::fromTask(arm, file, task, seed);
        });
      }
    }
  }

private:
  Plan *m_plan;
  const Options *m_options;
};

//! Why a task is not for the arm; empty: it is.
std::string misfitOf(const vpCollisionScene &scene, const vpMotionTask &task)
{
  const vpArmModel &arm = scene.arm();
  if (task.start.size() != arm.size()) {
    return "is for " + std::to_string(task.start.size()) + " joints, " + arm.label() + " has " +
           std::to_string(arm.size());
  }
  vpCollisionData data;
  for (const vpJointVector &q : {task.start, task.goal}) {
    const std::string outside = arm.outsideLimits(q);
    scene.place(q, data);
    if (!outside.empty() || scene.inCollision(data)) {
      return "is not for " + arm.label() + ": " + (outside.empty() ? "its start or goal touches something" : outside);
    }
  }
  return "";
}

/*!
 * Adds S4 or S6, whose tasks are for AMOR. An arm that they do not suit runs the others.
 * \throw std::runtime_error if the scene was asked for by name.
 */
void addTasks(Plan &plan, Adder &adder, const SceneInfo &scene, bool byName)
{
  const std::string name = scene.id == "S4a" ? "s4a-pillar" : scene.id == "S4b" ? "s4b-shelf" : "s6-trap";
  vpCollisionSceneFile file = vpLoadCollisionScene(vpApp::dataFile("scene/" + name + ".json"));
  file.spec = vpIgnoreUncovered(*plan.arm, file.spec);
  const vpCollisionScene checked(*plan.arm, file.spec);
  for (const vpMotionTask &task : file.tasks) {
    const std::string misfit = misfitOf(checked, task);
    if (!misfit.empty()) {
      const std::string sentence = "task " + task.name + " " + misfit;
      if (byName) {
        throw std::runtime_error("scene " + scene.id + ": " + sentence);
      }
      plan.remarks.push_back("scene " + scene.id + " is left out: " + sentence);
      return;
    }
  }
  plan.scenes.push_back(scene);
  adder.addFile(scene, file);
  if (scene.id != "S6") {
    plan.planned.push_back(file);
  }
}

void addScene(Plan &plan, Adder &adder, const SceneInfo &scene, bool byName)
{
  if (scene.id[1] == '4' || scene.id[1] == '6') {
    addTasks(plan, adder, scene, byName);
    return;
  }
  plan.scenes.push_back(scene);
  if (scene.id == "S1") {
    adder.addSeeds(scene, vpAvoidanceScenes::figure88);
  }
  else if (scene.id == "S2") {
    adder.addSeeds(scene, vpAvoidanceScenes::randomStatic);
  }
  else if (scene.id == "S3") {
    adder.addCrossing(scene);
  }
  else {
    adder.addSeeds(scene, vpAvoidanceScenes::movingGoal);
  }
}

void addOwnScene(Plan &plan, Adder &adder, const std::string &name)
{
  const vpCollisionSceneFile file = vpLoadCollisionScene(name);
  if (file.tasks.empty()) {
    throw std::runtime_error(name + ": tasks is empty, there is nothing to compare");
  }
  const SceneInfo scene{file.name, file.name, "The scene of " + name + ".", OWN_SEEDS, 1};
  const bool twice =
      std::any_of(plan.scenes.begin(), plan.scenes.end(), [&](const SceneInfo &other) { return other.id == scene.id; });
  if (twice) {
    throw vpApp::UsageError("--scene: there are two scenes of the name \"" + scene.id + "\"");
  }
  plan.scenes.push_back(scene);
  adder.addFile(scene, file);
}

//! "S4" stands for S4a and S4b.
bool isAsked(const std::vector<std::string> &asked, const std::string &id)
{
  return std::any_of(asked.begin(), asked.end(),
                     [&](const std::string &name) { return name == "all" || name == id || name + id.back() == id; });
}

void requireKnown(const std::string &name)
{
  bool known = name == "all" || name == "S5";
  for (const SceneInfo &scene : standardScenes()) {
    known = known || isAsked({name}, scene.id);
  }
  if (!known) {
    throw vpApp::UsageError("--scene: unknown scene \"" + name +
                            "\"; known are S1, S2, S3, S4 (S4a, S4b), S5, S6, S7, all, and files that end in .json");
  }
}
} // namespace

Plan makePlan(const Options &options)
{
  Plan plan;
  plan.quick = options.quick;
  plan.methods = chooseMethods(options.methods);
  const vpApp::Robot robot = vpApp::loadUsableRobot(options.robot);
  plan.arm = robot.arm;
  plan.remarks = robot.warnings;
  vpApp::warnOfJointsBehind(*plan.arm, "end effector", plan.arm->toolLink(), plan.remarks);
  Adder adder(plan, options);
  std::vector<std::string> asked, files;
  for (const std::string &name : options.scenes) {
    const bool isFile = endsWith(name, ".json");
    if (!isFile) {
      requireKnown(name);
    }
    (isFile ? files : asked).push_back(name);
  }
  if (asked.empty() && files.empty()) {
    asked.emplace_back("all");
  }
  for (const SceneInfo &scene : standardScenes()) {
    if (isAsked(asked, scene.id)) {
      addScene(plan, adder, scene, !contains(asked, "all"));
    }
  }
  for (const std::string &file : files) {
    addOwnScene(plan, adder, file);
  }
  plan.selfMotion = contains(asked, "S5") || (contains(asked, "all") && options.robot.robot == "amor");
  return plan;
}
} // namespace planCompare
