/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file answer.h
 * \brief A motion as one line of JSON, as samples, and as data of a report.
 */
#ifndef planTrajectory_answer_h
#define planTrajectory_answer_h

#include "motion.h"

#include <string>

namespace planTrajectory
{
//! The answer to a problem as one line of JSON without the line end. Numbers have all their digits.
[[nodiscard]] std::string answerLine(const Problem &problem, const Motion &motion);

//! The answer to a line that could not be read or planned. \param id : Null if unknown.
[[nodiscard]] std::string refusalLine(std::size_t line, const nlohmann::ordered_json &id, const std::string &sentence);

/*!
 * The motion at every control cycle and at its end as CSV: t, then q, v, a, j of each axis.
 * \throw std::runtime_error naming dt when that would be more than maxCycles rows.
 */
[[nodiscard]] std::string csvOf(const Problem &problem, const Motion &motion);

//! All of a motion for its report, see schema.json in python/visp_direct/report.
[[nodiscard]] nlohmann::ordered_json dataOf(const Problem &problem, const Motion &motion);
} // namespace planTrajectory

#endif
