/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// vpSegmentDistance without its input check, for numbers known to be finite and of plausible magnitude.
#ifndef vpSegmentNearest_h
#define vpSegmentNearest_h

#include <visp3/avoidance/vpSegmentDistance.h>

BEGIN_VISP_NAMESPACE

namespace vpSegmentNearest
{
vpNearestPoints point(const Eigen::Vector3d &from, const Eigen::Vector3d &to, const Eigen::Vector3d &other) noexcept;
vpNearestPoints segment(const Eigen::Vector3d &from, const Eigen::Vector3d &to, const Eigen::Vector3d &otherFrom,
                        const Eigen::Vector3d &otherTo) noexcept;
vpNearestPoints box(const Eigen::Vector3d &from, const Eigen::Vector3d &to, const Eigen::Vector3d &half) noexcept;
vpNearestPoints cylinder(const Eigen::Vector3d &from, const Eigen::Vector3d &to, double radius, double half) noexcept;
vpNearestPoints triangle(const Eigen::Vector3d &from, const Eigen::Vector3d &to, const Eigen::Vector3d &a,
                         const Eigen::Vector3d &b, const Eigen::Vector3d &c) noexcept;
} // namespace vpSegmentNearest

END_VISP_NAMESPACE
#endif
