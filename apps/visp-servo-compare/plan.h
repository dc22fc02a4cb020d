/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file plan.h
 * \brief From the user's options to the list of runs.
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
  std::string file;             //!< Path of the user's or the default photo.
  bool isDefault = true;        //!< The photo of the data folder is used.
  vpImage<unsigned char> photo; //!< Grey values, at most 1024 px wide and high.
  std::string remark;           //!< Conversion of colours and depth on reading; empty: none.
};

//! \brief All runs to be done, checked.
struct Plan {
  Scenario scenario; //!< Its plants are the requested ones.
  Target target;
  std::vector<std::string> laws;
  std::vector<std::string> measures; //!< Measures used in #runs, points before image.
  std::vector<vpServoRunSpec>
      runs; //!< For each law, plant and measure all seeds in turn, raw and, if #shaped, then shaped.
            //!< vpServoRunSpec::target is still empty.
  std::shared_ptr<const vpServoArm> arm; //!< Carries the camera in all runs; null: free-flying camera.
  std::vector<std::string> remarks;      //!< On the robot and the plants that it does not suit, one sentence each.
  bool shaped = false;                   //!< Every run is done raw and shaped.
  unsigned int seed = 1;
  unsigned int repetitions = 1;

  //! The measure of the main table and the figures.
  [[nodiscard]] const std::string &mainMeasure() const { return measures.front(); }
  //! The first plant, of the ideal figures 5.6 and 5.7.
  [[nodiscard]] const vpServoPlant &easyPlant() const { return scenario.plants.front(); }
  //! The last plant, of figures 5.8 to 5.11, the videos and the main result.
  [[nodiscard]] const vpServoPlant &hardPlant() const { return scenario.plants.back(); }
};

/*!
 * Resolve and check the user's options.
 * \throw vpApp::UsageError for an unknown law, plant or measure, naming the known ones; std::runtime_error naming the
 * file for a bad task file or photo.
 */
[[nodiscard]] Plan makePlan(const Options &options);

//! The arm in a sentence: joints, start, self-motion.
[[nodiscard]] std::string sentenceOf(const vpServoArm &arm);
} // namespace servoCompare

#endif
