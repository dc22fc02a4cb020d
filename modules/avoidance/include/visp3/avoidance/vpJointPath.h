/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpJointPath.h
 * \brief A path through configurations, without timing.
 */
#ifndef vpJointPath_h
#define vpJointPath_h

#include <visp3/manipulator/vpArmTypes.h>

#include <vector>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_avoidance
 * \brief Configurations joined by straight motions in joint space.
 *
 * \code
 * vpJointPath path;
 * path.points = {q, goal};
 * std::cout << path.length() << " rad, half-way at " << path.at(0.5).transpose() << std::endl;
 * \endcode
 */
struct VISP_EXPORT vpJointPath {
  std::vector<vpJointVector> points; //!< Configurations from start to goal, rad or m.

  //! Sum of the Euclidean lengths of the motions, rad (radians and metres added unscaled).
  [[nodiscard]] double length() const noexcept;
  /*!
   * Configuration at a fraction of the length. Does not allocate.
   * \param s : Fraction, 0..1, clamped. The path must not be empty.
   */
  [[nodiscard]] vpJointVector at(double s) const noexcept;
};

END_VISP_NAMESPACE
#endif
