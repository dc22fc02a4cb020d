/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// From the solution of the bundle to the public parameters, with their covariance.
#ifndef vpMicroscopeCalibrationCovariance_h
#define vpMicroscopeCalibrationCovariance_h

#include "vpMicroscopeCalibrationProblem.h"

#include <visp3/pattern/vpPlanarMicroscopeCalibration.h>

BEGIN_VISP_NAMESPACE

using vpMicroscopeCovariance = Eigen::Matrix<double, vpMicroscopeParameterCount, vpMicroscopeParameterCount>;

// Placement of the product in a view; the covariance is not set.
[[nodiscard]] vpMicroscopePlacement vpMicroscopePlaceOf(const vpMicroscopeState &state, const vpPlanarView &view,
                                                        std::size_t k);

// The common parameters and the placement of the first view.
[[nodiscard]] vpMicroscopeCalibration vpMicroscopeCalibrationOf(const vpMicroscopeState &state,
                                                                const vpPlanarView &first, unsigned int width,
                                                                unsigned int height);

// Covariance in the order of vpMicroscopeParameter with the placement of view k; zero for given parameters.
[[nodiscard]] vpMicroscopeCovariance vpMicroscopeCovarianceOf(const vpBundleSolution<vpMicroscopeState> &solution,
                                                              const std::vector<int> &isFree, const vpPlanarView &view,
                                                              std::size_t k);

END_VISP_NAMESPACE
#endif
