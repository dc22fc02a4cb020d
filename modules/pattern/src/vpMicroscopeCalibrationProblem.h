/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Step 1 of the planar calibration: closed-form initial values.
// Step 2 of the planar calibration: residuals of (7.7) in the image, for vpSolveBundle().
// From the solution of the bundle to the public parameters, with their covariance.
#ifndef vpMicroscopeCalibrationProblem_h
#define vpMicroscopeCalibrationProblem_h

#include "vpCalibrationBundle.h"

#include <visp3/pattern/vpCalibrationPoint.h>
#include <visp3/pattern/vpPlanarMicroscopeCalibration.h>

#include <Eigen/Core>

#include <array>
#include <vector>

BEGIN_VISP_NAMESPACE

// A view relative to the principal point and with square pixels: observed positions d and points of the plane p about
// its origin.
struct vpPlanarView {
  Eigen::Matrix2Xd d;     // px
  Eigen::Matrix2Xd p;     // m, y mirrored where the view is
  Eigen::Vector2d origin; // m, on the plane, before mirroring: the mean of the points
  bool mirrored = false;
};

[[nodiscard]] vpPlanarView vpMakePlanarView(const std::vector<vpCalibrationPoint> &points, double u0, double v0,
                                            double aspect);

// The direction cos, sin of the rotation, and the shift in px once the scale is known.
struct vpPlanarStart {
  double rotation = 0.;
  Eigen::Vector2d t = Eigen::Vector2d::Zero(); // m
};

// From the homogeneous radial alignment, or from an affine fit where that is not unique. Sets view.mirrored and mirrors
// p.
[[nodiscard]] vpPlanarStart vpStartPlanarView(vpPlanarView &view);

// (7.11) with the rows of u and v stacked: scale (px/m) and kappa1 (px^-2) from all views.
struct vpPlanarScale {
  double scale = 0.;
  double kappa1 = 0.;
};
[[nodiscard]] vpPlanarScale vpStartPlanarScale(const std::vector<vpPlanarView> &views,
                                               const std::vector<vpPlanarStart> &starts, bool withKappa1);

struct vpMicroscopeState {
  // Scale (px/m), aspect, kappa1 (px^-2), u0, v0 (px), tilt (px^-1), stretch, shear: see vpMicroscopeCalibration.
  enum Shared { Scale, Aspect, Kappa1, U0, V0, TiltX, TiltY, Stretch, Shear, SharedCount };
  std::array<double, SharedCount> shared{};
  // For each view: rotation (rad), position of the view's origin in the undistorted image (px, square pixels).
  std::vector<Eigen::Vector3d> local;
};

class vpMicroscopeProblem
{
public:
  // isFree: which of the shared parameters are estimated. scale: for the contribution of sigmaPlane to the weights,
  // px/m.
  vpMicroscopeProblem(const std::vector<std::vector<vpCalibrationPoint>> &points,
                      const std::vector<vpPlanarView> &views,
                      const std::array<bool, vpMicroscopeState::SharedCount> &isFree, double scale)
    : m_points(&points), m_views(&views), m_scale(scale)
  {
    for (int i = 0; i < vpMicroscopeState::SharedCount; ++i) {
      if (isFree[static_cast<std::size_t>(i)]) {
        m_free.push_back(i);
      }
    }
  }
  [[nodiscard]] Eigen::Index shared() const { return static_cast<Eigen::Index>(m_free.size()); }
  [[nodiscard]] std::size_t views() const { return m_views->size(); }
  [[nodiscard]] const std::vector<int> &freeParameters() const { return m_free; }
  [[nodiscard]] vpBundleView view(const vpMicroscopeState &state, std::size_t k) const;
  [[nodiscard]] vpMicroscopeState plus(const vpMicroscopeState &state, const Eigen::VectorXd &shared,
                                       const std::vector<Eigen::VectorXd> &local) const;
  // Standard deviation of a residual, px.
  [[nodiscard]] Eigen::Vector2d sigma(std::size_t k, std::size_t i) const;

private:
  const std::vector<std::vector<vpCalibrationPoint>> *m_points; // owned by the caller
  const std::vector<vpPlanarView> *m_views;                     // owned by the caller
  double m_scale;
  std::vector<int> m_free;
};

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
