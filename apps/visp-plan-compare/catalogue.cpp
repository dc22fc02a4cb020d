/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "catalogue.h"

#include <algorithm>

namespace planCompare
{
MethodInfo methodInfo(const std::string &id)
{
  static const std::vector<MethodInfo> all = {
      {"potential", "(i)", "potential, as printed",
       "The potential field of thesis 8.2.1 as it is printed: the nearer an obstacle, the more the way to the goal "
       "gives "
       "way to going away from it.",
       "#7f7f7f"},
      {"potential-corrected", "(i)", "potential, corrected",
       "The same with the corrected weights and radial distances, and limits.", "#8c564b"},
      {"dtg", "(ii)", "DTG",
       "Direct trajectory generation point to point, thesis 8.2.2: a new least-jerk motion of the tool whenever "
       "something "
       "was seen.",
       "#1f77b4"},
      {"dtg-via", "(iii)", "DTG with via", "The same with a via point beside the obstacle.", "#17becf"},
      {"planner", "(iv)", "planner", "A path of OMPL on proven motions, timed within all limits, driven as planned.",
       "#ff7f0e"},
      {"planner-dtg", "(v)", "planner + DTG",
       "The same path, tracked by direct trajectories and replanned on the fly when something was seen.", "#2ca02c"},
  };
  const auto found = std::find_if(all.begin(), all.end(), [&](const MethodInfo &m) { return m.id == id; });
  return found != all.end() ? *found : MethodInfo{id, "", id, "", "#9467bd"};
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
} // namespace planCompare
