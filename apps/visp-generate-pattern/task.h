/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file task.h
 * \brief The sequence to generate, and its JSON format.
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
 * Read a task; fields missing in the file keep their defaults.
 * \throw std::runtime_error naming the file, the field and the value.
 */
[[nodiscard]] Task readTask(const std::string &file);
//! The task as JSON, from which readTask() restores it.
[[nodiscard]] nlohmann::ordered_json jsonOf(const Task &task);

//! How messages name a field.
enum class Naming {
  CommandLine, //!< --pitch-x
  File         //!< pitch_x
};
//! \throw std::runtime_error naming an out-of-range field and its value.
void check(const Task &task, Naming naming);
} // namespace generatePattern

#endif
