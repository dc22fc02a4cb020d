/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file viewData.h
 * \brief What the 3D view of a report shows: arms and obstacles. schema.json in python/visp_direct/report has the fields.
 */
#ifndef vpApp_viewData_h
#define vpApp_viewData_h

#include "outputFolder.h"

#include <visp3/avoidance/vpCollisionObject.h>
#include <visp3/manipulator/vpArmModel.h>

#include <nlohmann/json.hpp>

#include <string>

namespace vpApp
{
//! "revolute", "continuous" or "prismatic".
[[nodiscard]] const char *nameOf(vpJointType type);
//! The four rows of a pose.
[[nodiscard]] nlohmann::ordered_json rowsOf(const vpRigidTransform &pose);
/*!
 * Writes arm.json, and the meshes of the arm as mesh/N.stl. A mesh that cannot be read is named in arm.json.
 * \throw std::runtime_error naming the file that cannot be written.
 */
void writeArm(OutputFolder &out, const vpArmModel &arm);
/*!
 * An obstacle, inflated as it is unless it is a mesh or an octree. A mesh is written as a file of its own.
 * \param file : Name of that file without suffix, "mesh/S4b-shelf".
 * \throw std::runtime_error naming the file that cannot be written.
 */
[[nodiscard]] nlohmann::ordered_json objectData(OutputFolder &out, const vpCollisionObject &object,
                                                const std::string &file);
} // namespace vpApp

#endif
