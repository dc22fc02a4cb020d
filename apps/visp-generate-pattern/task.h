/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file task.h
 * \brief What is to be made, and its form as a JSON file.
 */
#ifndef generatePattern_task_h
#define generatePattern_task_h

#include "fields.h"
#include "motion.h"

#include <nlohmann/json.hpp>

#include <string>

namespace generatePattern
{
//! \brief A sequence.
struct Task {
  vpProductPatternSpec product;
  Motion motion;
  unsigned int frames = 100; //!< 1..1000000.
};

/*!
 * Read a task; what the file does not give stays at its default.
 * \throw std::runtime_error naming the file, the field and the value.
 */
[[nodiscard]] Task readTask(const std::string &file);
//! The task as a file from which readTask() makes the same one.
[[nodiscard]] nlohmann::ordered_json jsonOf(const Task &task);

//! How a complaint calls what it is about.
enum class Naming {
  CommandLine, //!< --pitch-x
  File         //!< pitch_x
};
//! \throw std::runtime_error naming what is out of its range, and its value.
void check(const Task &task, Naming naming);
} // namespace generatePattern

#endif
