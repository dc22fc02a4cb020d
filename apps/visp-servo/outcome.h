/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file outcome.h
 * \brief What came out of a run, as sentences and as data.
 */
#ifndef visualServo_outcome_h
#define visualServo_outcome_h

#include "camera.h"
#include "options.h"
#include "recording.h"
#include "servoRun.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace visualServo
{
//! \brief A finished run.
struct Outcome {
  const Options *options = nullptr;
  const Recording *recording = nullptr;
  const vpServoTiming *timing = nullptr;
  Ending ending = Ending::Quit;
  std::string failure;              //!< Empty: none.
  std::string camera, clock, robot; //!< Descriptions.
  std::string target;
  Eye eye;
  vpHomogeneousMatrix cdMo; //!< The goal; not that of a reference image.
  std::string realTime;     //!< What the operating system allowed; empty: not asked.
  bool hasStarted = false;
  std::size_t lostImages = 0, lostRows = 0, unrecorded = 0;
  std::vector<std::string> laws;    //!< Used, in this order.
  std::vector<std::string> remarks; //!< Of camera and robot.
  //! Where a goal was not reached: see hindrances(), from the last pose of the target.
  std::vector<std::string> hindrances;
};

//! The main results, in sentences.
[[nodiscard]] std::vector<std::string> findings(const Outcome &outcome);
//! The content of summary.json, which schema.json of python/visp_direct/report describes.
[[nodiscard]] nlohmann::ordered_json summaryOf(const Outcome &outcome, const std::string &commandLine);
} // namespace visualServo

#endif
