/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpArmJson.h
 * \brief An arm from a JSON file with a standard DH table. Needs nlohmann_json when the module is built.
 */
#ifndef vpArmJson_h
#define vpArmJson_h

#include <visp3/manipulator/vpArmModel.h>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_manipulator
 * \brief Reads an arm; data/robot/README.md has the fields. Unknown fields are errors, so that a misspelt one does not
 * go unseen.
 * \param file : File to read, for example data/robot/amor.json.
 * \throw vpException (ioError) when it cannot be read, (badValue) when it is no JSON or a field is missing or out of
 * range; one sentence with the file and the field, as "arm.json: joints[2].a_m is missing".
 */
[[nodiscard]] VISP_EXPORT vpArmModel vpLoadArmJson(const std::string &file);

END_VISP_NAMESPACE
#endif
