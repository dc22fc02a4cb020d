/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpTwistAxes.h
 * \brief Names of the components of a twist: free axes, and axes that an arm cannot command.
 */
#ifndef vpTwistAxes_h
#define vpTwistAxes_h

#include <visp3/direct_core/vpTwist.h>

#include <array>
#include <string>
#include <vector>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_manipulator
 * \brief Free axes by name, for vpRedundancyInput::free and others.
 *
 * \code
 * vpRedundancyInput input;
 * input.free = vpFreeAxes({"rz"});
 * std::cout << "not commanded: " << vpAxesInWords(input.free) << std::endl; // "rotation about z"
 * \endcode
 * \param names : x, y, z (translation along an axis) and rx, ry, rz (rotation about it), in any order.
 * \return True for each named component of the twist.
 * \throw vpException (badValue) naming an unknown or repeated name; also if all six are named, which leaves no task.
 */
[[nodiscard]] VISP_EXPORT std::array<bool, 6> vpFreeAxes(const std::vector<std::string> &names);

/*!
 * \ingroup group_manipulator
 * \brief Axes in words.
 * \param axes : Bit k: component k of a twist, as in vpRedundancyOutput::unreachableAxes; other bits are ignored.
 * \return "translation along x, rotation about z"; empty for none.
 */
[[nodiscard]] VISP_EXPORT std::string vpAxesInWords(unsigned int axes);
//! \ingroup group_manipulator
//! \brief Axes in words. \param free : As in vpRedundancyInput::free. \return See the other one.
[[nodiscard]] VISP_EXPORT std::string vpAxesInWords(const std::array<bool, 6> &free);

/*!
 * \ingroup group_manipulator
 * \brief A twist with zeros in its free components, so that these do not use up limits of speed.
 */
[[nodiscard]] inline vpTwist vpWithoutFreeAxes(vpTwist twist, const std::array<bool, 6> &free) noexcept
{
  for (std::size_t k = 0; k < free.size(); ++k) {
    twist[k] = free[k] ? 0. : twist[k];
  }
  return twist;
}

END_VISP_NAMESPACE
#endif
