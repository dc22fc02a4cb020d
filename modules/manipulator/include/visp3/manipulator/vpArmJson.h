/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpArmJson.h
 * \brief Loads an arm from a JSON file with a standard or modified DH table. Requires a build with nlohmann_json.
 */
#ifndef vpArmJson_h
#define vpArmJson_h

#include <visp3/manipulator/vpArmModel.h>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_manipulator
 * \brief Reads an arm model; data/robot/README.md lists the fields. Unknown fields are errors, so that misspelt names
 * are noticed.
 *
 * \code
 * try {
 *   const vpArmModel amor = vpLoadArmJson("data/robot/amor.json");
 *   std::cout << amor.size() << " joints, home at " << amor.home().transpose() << " rad" << std::endl;
 * }
 * catch (const vpException &e) {
 *   std::cerr << e.getStringMessage() << std::endl;
 * }
 * \endcode
 * \param file : File to read, for example data/robot/amor.json.
 * \throw vpException (ioError) if the file cannot be read, (badValue) if it is not valid JSON or a field is missing or
 * out of range; one sentence with the file and the field, such as "arm.json: joints[2].a_m is missing".
 */
[[nodiscard]] VISP_EXPORT vpArmModel vpLoadArmJson(const std::string &file);

END_VISP_NAMESPACE
#endif
