/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPoseCovariance.h
 * \brief Covariance of a measured pose.
 */
#ifndef vpPoseCovariance_h
#define vpPoseCovariance_h

#include <visp3/direct_core/vpDirectCompat.h>

#include <array>
#include <cstddef>

BEGIN_VISP_NAMESPACE

/*!
 * \class vpPoseCovariance
 * \ingroup group_direct_core
 * \brief Covariance of the error (v, w) of a measured pose cMo = (R, t), in the camera frame: the true pose is
 * (exp([w]x) R, t + v), v in m, w in rad.
 *
 * While `known` is false the numbers carry no information and must not be used: an unknown covariance is not zero.
 *
 * \code
 * const vpPoseCovariance &covariance = measurement.covariance;
 * if (covariance.positionDeviation() < 0.002) { // m; infinite where it is not known
 *   std::cout << "depth is known to " << std::sqrt(covariance(2, 2)) << " m" << std::endl;
 * }
 * \endcode
 */
struct VISP_EXPORT vpPoseCovariance {
  bool known = false;         //!< True when #C has been estimated.
  std::array<double, 36> C{}; //!< Covariance of (v, w), 6 x 6 row-major: m^2, m rad, rad^2.

  //! Element of row \e i and column \e j, 0 to 5.
  [[nodiscard]] constexpr double operator()(std::size_t i, std::size_t j) const { return C[6 * i + j]; }
  //! Element of row \e i and column \e j, writable.
  [[nodiscard]] constexpr double &operator()(std::size_t i, std::size_t j) { return C[6 * i + j]; }
  //! Standard deviation of the position, m: square root of the trace of the v block. Infinite when not known.
  [[nodiscard]] double positionDeviation() const;
  //! Standard deviation of the orientation, rad: square root of the trace of the w block. Infinite when not known.
  [[nodiscard]] double rotationDeviation() const;
};

END_VISP_NAMESPACE
#endif
