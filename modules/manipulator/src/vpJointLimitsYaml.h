/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpJointLimitsYaml.h
 * \brief Reads a file of joint limits in the format of MoveIt's joint_limits.yaml. Not installed.
 */
#ifndef vpJointLimitsYaml_h
#define vpJointLimitsYaml_h

#include <map>
#include <optional>
#include <string>

//! Limits of a joint that a file gives, in rad, m, s, Nm and N.
struct vpJointLimits {
  std::optional<double> lower, upper, velocity, acceleration, torque;
};

/*!
 * Reads the map `joint_limits`: per joint `has_velocity_limits`, `max_velocity`, and likewise `acceleration` and
 * `effort`; `has_position_limits` with `min_position` and `max_position`. `has_jerk_limits`, `max_jerk` and other maps
 * of the file are not used. A limit counts only if the file says that there is one; `false` leaves that of the URDF.
 *
 * A subset of YAML: one `name: value` per line, joints and their fields indented by blanks, comments.
 * \return Limits by joint. \throw vpFileError naming the line or the joint and the field.
 */
std::map<std::string, vpJointLimits> vpReadJointLimits(const std::string &file);

#endif
