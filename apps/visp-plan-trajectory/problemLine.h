/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file problemLine.h
 * \brief One line of the input: a requested motion.
 */
#ifndef planTrajectory_problemLine_h
#define planTrajectory_problemLine_h

#include <visp3/trajectory/vpTrajectoryInput.h>

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace planTrajectory
{
//! Number of axes known only at run time.
using Input = vpTrajectoryInput<Eigen::Dynamic>;

//! \brief A change of goal, limits, vias or options during the motion.
struct Event {
  double t = 0.; //!< s from the start of the motion.
  Input input;   //!< Complete input from then on.
};

//! \brief A requested motion. The format is described in data/trajectory/README.md.
struct Problem {
  std::string place;         //!< Source location for messages: "problems.jsonl:3".
  std::size_t line = 1;      //!< Number of the line, from 1.
  nlohmann::ordered_json id; //!< User-defined id, any JSON value; null: none.
  Input input;               //!< Start, goal, limits, vias, options.
  std::vector<Event> events; //!< In time order.
  double dt = 0.001;         //!< Control cycle, s.

  [[nodiscard]] int axes() const { return static_cast<int>(input.goal.q.size()); } //!< Number of axes.
};

/*!
 * Read one line.
 * \param text : The line, a JSON object. \param place : Prefix of every message. \param line : Number of the line.
 * \param id : Not null: gets the id, also where the rest is refused.
 * \throw std::runtime_error: one sentence with the location, the field with its axis, and the value. Whether the
 * numbers are valid for a motion is checked by vpDirectTrajectory.
 */
[[nodiscard]] Problem readProblem(const std::string &text, const std::string &place, std::size_t line,
                                  nlohmann::ordered_json *id = nullptr);
} // namespace planTrajectory

#endif
