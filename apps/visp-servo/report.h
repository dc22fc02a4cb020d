/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file report.h
 * \brief The report of a run, its figures and summary.
 */
#ifndef visualServo_report_h
#define visualServo_report_h

#include "camera.h"
#include "options.h"
#include "recording.h"
#include "servoRun.h"

#include "outputFolder.h"

#include <nlohmann/json.hpp>

#include <string>
#include <utility>
#include <vector>

namespace visualServo
{
//! \brief One of the measured times.
struct Duration {
  std::string word;     //!< Short name.
  std::string sentence; //!< What it is.
  const vpTimingStatistics *statistics;
};
//! The times of a servo in the order of the report.
[[nodiscard]] std::vector<Duration> durationsOf(const vpServoTiming &timing);

//! \brief What the report is about.
struct Outcome {
  const Options *options = nullptr;
  const Recording *recording = nullptr;
  const vpServoTiming *timing = nullptr;
  Ending ending = Ending::Quit;
  std::string failure;              //!< Empty: none.
  std::string camera, clock, robot; //!< Descriptions.
  std::string target;
  std::string realTime; //!< What the operating system allowed; empty: not asked.
  bool isAssumedCamera = false;
  bool hasStarted = false;
  std::size_t lostImages = 0, lostRows = 0, unrecorded = 0;
  std::vector<std::string> laws;    //!< Used, in this order.
  std::vector<std::string> remarks; //!< Of camera and robot.
};

//! The main results, in sentences.
[[nodiscard]] std::vector<std::string> findings(const Outcome &outcome);
//! The page. \param video : Bytes of view.mp4; empty: none. \param picture : PNG; empty: none.
[[nodiscard]] std::string reportPage(const Outcome &outcome, const std::string &video, const std::string &picture,
                                     const std::string &commandLine);
//! The figures behind it.
[[nodiscard]] nlohmann::ordered_json summaryOf(const Outcome &outcome, const std::string &commandLine);
} // namespace visualServo

#endif
