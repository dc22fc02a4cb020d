/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Step 2 of the planar calibration: residuals of (7.7) in the image, for vpSolveBundle().
#ifndef vpMicroscopeCalibrationProblem_h
#define vpMicroscopeCalibrationProblem_h

#include "vpCalibrationBundle.h"
#include "vpMicroscopeCalibrationStart.h"

#include <array>
#include <vector>

BEGIN_VISP_NAMESPACE

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

END_VISP_NAMESPACE
#endif
