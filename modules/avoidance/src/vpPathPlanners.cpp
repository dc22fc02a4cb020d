/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The names of the planners and their parameters.
#include "vpPathPlanners.h"

#include "vpBiRrt.h"
#include "vpFieldCheck.h"
#include "vpOmplSearch.h"

BEGIN_VISP_NAMESPACE

namespace
{
constexpr vpFieldCheck fields("the path planner");

vpPathSearchMaker byOmpl(const std::string &name, const vpPathPlanner::Maker &maker)
{
  return [name, maker](vpMotionCheck &check) { return vpMakeOmplSearch(check, name, maker); };
}

struct Planners : vpRegistry<vpPathSearchMaker> {
  Planners() : vpRegistry("path planner")
  {
    add("BiRRT", "Two trees, from start and goal, that grow towards each other, in flat arrays; needs no OMPL.",
        [](vpMotionCheck &check) { return std::make_unique<vpBiRrt>(check); });
    const auto addOurs = [this](const char *name, const char *sentence) {
      add(name, sentence,
          byOmpl(name, [name](const std::shared_ptr<ompl::base::SpaceInformation> &space,
                              const vpPathPlannerSpec &spec) { return vpMakeOmplPlanner(name, space, spec); }));
    };
    addOurs("RRT", "One tree of random motions, from the start.");
    addOurs("RRTConnect", "The same two trees by OMPL.");
    addOurs("RRTstar", "RRT that rewires its tree, so that the path gets shorter until the time limit.");
    addOurs("PRM", "A graph of random configurations, joined to their neighbours.");
    addOurs("BITstar",
            "Batches of samples, searched in the order of the path's length; improves until the time limit.");
    addOurs("KPIECE", "A tree that prefers the border of the cells that it has explored.");
  }
};
} // namespace

vpRegistry<vpPathSearchMaker> &vpPathPlanners()
{
  static Planners all; // at first use: static objects elsewhere may add planners
  return all;
}

std::vector<std::string> vpPathPlanner::names() { return vpPathPlanners().ids(); }

std::string vpPathPlanner::sentence(const std::string &name) { return vpPathPlanners().sentence(name); }

void vpPathPlanner::add(const std::string &name, const std::string &sentence, Maker maker)
{
  vpPathPlanners().add(name, sentence, maker ? byOmpl(name, maker) : nullptr);
}

void vpPathPlannerSpec::validate() const
{
  static_cast<void>(vpPathPlanners().find(planner));
  fields.notNegative("margin", margin);
  fields.positive("step", step);
  fields.positive("timeLimit", timeLimit);
  fields.notNegative("range", range);
  fields.notNegative("shortenTime", shortenTime);
  fields.in("seed", seed, {1});
}

END_VISP_NAMESPACE
