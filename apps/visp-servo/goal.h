/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file goal.h
 * \brief A goal as it was taught, and its file.
 */
#ifndef visualServo_goal_h
#define visualServo_goal_h

#include <visp3/core/vpHomogeneousMatrix.h>
#include <visp3/direct_core/vpDirectCompat.h>

#include <string>
#include <vector>

VISP_DIRECT_USING_NAMESPACE

namespace visualServo
{
//! \brief A goal as taught.
struct Goal {
  vpHomogeneousMatrix cdMo;   //!< Identity for vision without a size.
  double positionSpread = 0.; //!< Standard deviation of the taught images' positions, m.
  double rotationSpread = 0.; //!< The same of the rotation, rad.
  unsigned int images = 0;
};
//! \throw vpFileError naming the file and the field.
[[nodiscard]] Goal readGoal(const std::string &file);
//! The file's content, JSON.
[[nodiscard]] std::string goalText(const Goal &goal);
/*!
 * Mean of the poses of a standing camera, with their spread.
 * \throw std::runtime_error if there are fewer than 2, or the camera or the object moved: by more than the larger of 1 mm and 1 % of the distance, or
 * 0.5 degrees.
 */
[[nodiscard]] Goal meanGoal(const std::vector<vpHomogeneousMatrix> &poses);
} // namespace visualServo

#endif
