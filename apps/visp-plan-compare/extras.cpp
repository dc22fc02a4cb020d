/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "extras.h"

#include "appMain.h"
#include "progress.h"

#include <visp3/avoidance/vpPathPlanner.h>
#include <visp3/core/vpException.h>
#include <visp3/direct_core/vpQuantile.h>

#include <iterator>

namespace planCompare
{
namespace
{
constexpr int PLACES = 10000;
constexpr unsigned int SEEDS = 50, QUICK = 5;

struct Validator {
  const char *planner, *name;
  vpMotionValidation validation;
};
constexpr Validator VALIDATORS[] = {{"BiRRT", "certified", vpMotionValidation::Certified},
                                    {"RRTConnect", "certified", vpMotionValidation::Certified},
                                    {"RRTConnect", "samples, own distances", vpMotionValidation::Discrete},
                                    {"RRTConnect", "samples, FCL", vpMotionValidation::DiscreteFcl}};

bool collides(const vpCollisionScene &scene, const vpJointPath &path)
{
  vpCollisionData data;
  for (int i = 0; i <= PLACES; ++i) {
    scene.place(path.at(static_cast<double>(i) / PLACES), data);
    if (scene.inCollision(data)) {
      return true;
    }
  }
  return false;
}

ValidatorRow compareOn(const vpCollisionScene &scene, const vpCollisionSceneFile &file, const Validator &validator,
                       unsigned int seeds)
{
  ValidatorRow row;
  row.scene = file.name;
  row.planner = validator.planner;
  row.validator = validator.name;
  std::vector<double> times, lengths;
  for (unsigned int seed = 1; seed <= seeds; ++seed) {
    vpPathPlannerSpec spec;
    spec.planner = validator.planner;
    spec.validation = validator.validation;
    spec.seed = seed;
    spec.margin = 0.; // only contact is checked
    vpPathPlanner planner(scene, spec);
    for (const vpMotionTask &task : file.tasks) {
      const vpPathResult result = planner.plan(task.start, task.goal);
      ++row.plans;
      times.push_back(1000. * result.planningTime);
      if (result.status == vpPathStatus::Solved) {
        ++row.solved;
        lengths.push_back(result.path.length());
        row.colliding += collides(scene, result.path) ? 1 : 0;
      }
    }
    vpApp::throwIfInterrupted();
  }
  row.p50 = vpQuantile(times, 0.50);
  row.p95 = vpQuantile(times, 0.95);
  row.length = vpQuantile(lengths, 0.50);
  return row;
}
} // namespace

std::vector<ValidatorRow> compareValidators(const Plan &plan)
{
  std::vector<ValidatorRow> rows;
  if (plan.planned.empty()) {
    return rows;
  }
  vpApp::Progress progress("comparing validators",
                           static_cast<double>(std::size(VALIDATORS)) * static_cast<double>(plan.planned.size()));
  for (const vpCollisionSceneFile &file : plan.planned) {
    const vpCollisionScene scene(*plan.arm, file.spec);
    for (const Validator &validator : VALIDATORS) {
      try {
        rows.push_back(compareOn(scene, file, validator, plan.quick ? QUICK : SEEDS));
      }
      catch (const vpException &e) {
        if (e.getCode() != vpException::notImplementedError) { // OMPL or FCL was missing when the module was built
          throw;
        }
      }
      progress.add(1.);
    }
  }
  return rows;
}

namespace
{
constexpr int JOINT_4 = 3;

struct Index {
  const char *name;
  std::function<vpSelfMotionIndex(vpIndexSense)> make;
};

//! The geometry of section 8.3.5: a point beside joint 4, the line from base to tool, the plane through three points.
std::vector<Index> indices(const vpArmModel &arm)
{
  const Eigen::Vector3d point(0.45, 0.1, 0.4);
  return {{"point", [=](vpIndexSense s) { return vpSelfMotionIndex::pointDistance(JOINT_4, point, s); }},
          {"line", [=](vpIndexSense s) { return vpSelfMotionIndex::lineDistance(JOINT_4, s); }},
          {"plane", [&arm](vpIndexSense s) { return vpSelfMotionRunSpec::thesisPlane(arm, s); }}};
}
} // namespace

std::vector<SelfMotionRow> runSelfMotion(const Plan &plan)
{
  std::vector<SelfMotionRow> rows;
  if (!plan.selfMotion) {
    return rows;
  }
  vpSelfMotionRunSpec spec = vpSelfMotionRunSpec::thesis(plan.arm);
  for (const Index &index : indices(*plan.arm)) {
    for (const double share : {-0.6, -0.3, 0., 0.3, 0.6}) {
      const vpIndexSense sense = share < 0. ? vpIndexSense::Attract : vpIndexSense::Repel;
      spec.index = index.make(sense);
      spec.share = std::abs(share);
      rows.push_back({index.name,
                      share < 0.   ? "attract"
                      : share > 0. ? "repel"
                                   : "none",
                      std::abs(share), runSelfMotionExperiment(spec)});
    }
  }
  return rows;
}
} // namespace planCompare
