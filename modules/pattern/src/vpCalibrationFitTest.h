/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Tests of a bundle by its residuals, from its linearisation at the solution.
#ifndef vpCalibrationFitTest_h
#define vpCalibrationFitTest_h

#include "vpCalibrationBundle.h"

#include <visp3/pattern/vpFitTest.h>

BEGIN_VISP_NAMESPACE

struct vpFitTestView {
  vpBundleView linear;        // residuals (two per point) and derivatives, in standard deviations
  Eigen::MatrixXd covariance; // of (shared, local of this view)
  Eigen::Matrix2Xd sigma;     // of the points, px
  Eigen::Matrix2Xd place;     // image positions of the points, px
};

// stated: the deviations are absolute, not only ratios.
[[nodiscard]] vpFitTest vpTestFit(const std::vector<vpFitTestView> &views, double level, bool stated);

// The joint covariance of the shared and one view's own parameters.
template <class State>
[[nodiscard]] Eigen::MatrixXd vpJointCovariance(const vpBundleSolution<State> &solution, std::size_t k)
{
  const Eigen::Index s = solution.sharedCovariance.rows(), l = solution.localCovariance[k].rows();
  Eigen::MatrixXd joint(s + l, s + l);
  joint << solution.sharedCovariance, solution.crossCovariance[k], solution.crossCovariance[k].transpose(),
      solution.localCovariance[k];
  return joint;
}

END_VISP_NAMESPACE
#endif
