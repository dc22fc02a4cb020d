/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file page.h
 * \brief What is understood of a robot, as text and as data.
 */
#ifndef armProgram_page_h
#define armProgram_page_h

#include "description.h"
#include "options.h"

#include <nlohmann/json.hpp>

namespace armProgram
{
//! \brief Answers to the questions of the command line.
struct Answers {
  std::optional<vpRigidTransform> pose;   //!< `--fk`: the tool in the base.
  std::optional<std::set<Names>> touches; //!< `--touches`.
};

//! For people.
[[nodiscard]] std::string textOf(const vpApp::Robot &robot, const Description &description, const Answers &answers);
//! For programs; data/robot/README.md lists the fields.
[[nodiscard]] nlohmann::ordered_json jsonOf(const vpApp::Robot &robot, const Description &description,
                                            const Answers &answers);
//! The same of a robot that could not be loaded.
[[nodiscard]] nlohmann::ordered_json jsonOf(const std::string &problem);
} // namespace armProgram

#endif
