/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file scenario.h
 * \brief Task, gains and plants: built-in, or from the user's JSON file.
 */
#ifndef servoCompare_scenario_h
#define servoCompare_scenario_h

#include <visp3/feedforward/vpServoLaw.h>
#include <visp3/feedforward/vpServoMotionLimits.h>
#include <visp3/rendering/vpPlaneRenderer.h>
#include <visp3/simulation/vpServoPlant.h>
#include "lab/servo/vpServoTask.h"
#include <visp3/trajectory/vpTwistShaper.h>

#include <string>
#include <vector>

VISP_DIRECT_USING_NAMESPACE

namespace servoCompare
{
//! \brief A comparison without the laws. The default is the task of the thesis.
struct Scenario {
  Scenario();
  vpServoTask task;
  std::string description;
  vpServoGains gains;
  std::vector<vpServoPlant> plants; //!< At least one, ordered from easy to hard.
  vpCameraFaults faults;            //!< Faults of the rendered views, on non-ideal plants.
  /*!
   * Limits of the shaped runs. By default the angular limits are 2.5 1/m times the linear ones: rotation keeps the
   * object in the image during sideways motion at a distance of 0.4 m.
   */
  vpTwistShaperLimits shape;
  vpServoMotionLimits motion; //!< Limits of every law with --bounded.
};

/*!
 * Read a task file; data/scenario/README.md documents its fields.
 * \throw std::runtime_error naming the file, the field and its value.
 */
[[nodiscard]] Scenario readScenario(const std::string &file);
} // namespace servoCompare

#endif
