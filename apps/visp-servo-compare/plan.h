/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file plan.h
 * \brief From what the user asked for to the list of runs.
 */
#ifndef servoCompare_plan_h
#define servoCompare_plan_h

#include "options.h"
#include "scenario.h"

#include <visp3/core/vpImage.h>
#include "lab/servo/vpServoExperiment.h"

namespace servoCompare
{
//! \brief The photo of the object.
struct Target {
  std::string file;             //!< Where the user's photo, or ours, is.
  bool isDefault = true;        //!< It is the one of the data folder.
  vpImage<unsigned char> photo; //!< Grey values, at most 1024 px wide and high.
  std::string remark;           //!< What reading did to colours and depth; empty: nothing.
};

//! \brief All that will be run, checked.
struct Plan {
  Scenario scenario; //!< Its plants are those asked for.
  Target target;
  std::vector<std::string> laws;
  std::vector<std::string> measures; //!< Those that occur in #runs, points before image.
  std::vector<vpServoRunSpec>
      runs; //!< For each law, plant and measure one after another all seeds, raw and, if #shaped, then shaped.
            //!< vpServoRunSpec::target is still empty.
  std::shared_ptr<const vpServoArm> arm; //!< Carries the camera in all runs; null: it flies freely.
  bool shaped = false;                   //!< Every run occurs raw and shaped.
  unsigned int seed = 1;
  unsigned int repetitions = 1;

  //! The measure of the main table and the figures.
  [[nodiscard]] const std::string &mainMeasure() const { return measures.front(); }
  //! The first plant: the one of the ideal figures 5.6 and 5.7.
  [[nodiscard]] const vpServoPlant &easyPlant() const { return scenario.plants.front(); }
  //! The last plant: the one of figures 5.8 to 5.11, of the videos and of the answer.
  [[nodiscard]] const vpServoPlant &hardPlant() const { return scenario.plants.back(); }
};

/*!
 * Look up and check what the user asked for.
 * \throw vpApp::UsageError for an unknown law, plant or measure, naming the known ones; std::runtime_error naming the
 * file for a bad task file or photo.
 */
[[nodiscard]] Plan makePlan(const Options &options);
} // namespace servoCompare

#endif
