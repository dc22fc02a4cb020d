/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpSegmentDistance.h
 * \brief Exact distance of a segment, the axis of a capsule, from simple solids.
 */
#ifndef vpSegmentDistance_h
#define vpSegmentDistance_h

#include <visp3/direct_core/vpDirectCompat.h>

#include <Eigen/Core>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_avoidance
 * \brief Two nearest points. All lengths in m, all points in one frame.
 */
struct VISP_EXPORT vpNearestPoints {
  double distance = 0.; //!< |onSegment - onOther|, m, >= 0; 0 in contact; -infinity: unknown, points are 0.
  Eigen::Vector3d onSegment = Eigen::Vector3d::Zero(); //!< Nearest point on the segment.
  Eigen::Vector3d onOther = Eigen::Vector3d::Zero();   //!< Nearest point on or in the other body.
};

/*!
 * \ingroup group_avoidance
 * \brief Distances of a segment from other bodies; no allocation, exception or lock. Solids are filled: the distance is
 * 0 for a segment inside. A segment with coinciding ends is a point. Relative accuracy about 1e-15, for the
 * cylinder 1e-12 m; tests against an independent search require 1e-9 m. If a number is not finite or beyond
 * 100 vpLargestLength the distance is -infinity, which every comparison treats as near.
 *
 * \code
 * const Eigen::Vector3d from(0.3, 0., 0.), to(0.3, 0., 0.4), half(0.1, 0.1, 0.1); // m
 * const vpNearestPoints near = vpSegmentDistance::box(from, to, half);
 * if (near.distance > 0.05) { // radius of the capsule, m; -infinity where a number is invalid
 *   std::cout << near.distance - 0.05 << " m between capsule and box" << std::endl; // 0.15
 * }
 * \endcode
 */
namespace vpSegmentDistance
{
//! Distance from a point.
[[nodiscard]] VISP_EXPORT vpNearestPoints point(const Eigen::Vector3d &from, const Eigen::Vector3d &to,
                                                const Eigen::Vector3d &other) noexcept;
//! Distance from another segment, parallel ones included.
[[nodiscard]] VISP_EXPORT vpNearestPoints segment(const Eigen::Vector3d &from, const Eigen::Vector3d &to,
                                                  const Eigen::Vector3d &otherFrom,
                                                  const Eigen::Vector3d &otherTo) noexcept;
/*!
 * Distance from the box |x| <= half(0), |y| <= half(1), |z| <= half(2): the root of the piecewise linear slope of the
 * squared distance along the segment.
 */
[[nodiscard]] VISP_EXPORT vpNearestPoints box(const Eigen::Vector3d &from, const Eigen::Vector3d &to,
                                              const Eigen::Vector3d &half) noexcept;
//! Distance from the cylinder x^2 + y^2 <= radius^2, |z| <= half.
[[nodiscard]] VISP_EXPORT vpNearestPoints cylinder(const Eigen::Vector3d &from, const Eigen::Vector3d &to,
                                                   double radius, double half) noexcept;
//! Distance from the triangle with corners a, b, c, which may be degenerate.
[[nodiscard]] VISP_EXPORT vpNearestPoints triangle(const Eigen::Vector3d &from, const Eigen::Vector3d &to,
                                                   const Eigen::Vector3d &a, const Eigen::Vector3d &b,
                                                   const Eigen::Vector3d &c) noexcept;
} // namespace vpSegmentDistance

END_VISP_NAMESPACE
#endif
