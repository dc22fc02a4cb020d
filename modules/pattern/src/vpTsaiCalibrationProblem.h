/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Step 2 of Tsai's calibration: distances in the image, for vpSolveBundle().
#ifndef vpTsaiCalibrationProblem_h
#define vpTsaiCalibrationProblem_h

#include "vpCalibrationBundle.h"
#include "vpTsaiCalibrationStart.h"

#include <array>
#include <vector>

BEGIN_VISP_NAMESPACE

struct vpTsaiState {
  // f (px, columns), aspect, kappa1 (px^-2), u0, v0 (px).
  enum Shared { F, Aspect, Kappa1, U0, V0, SharedCount };
  std::array<double, SharedCount> shared{};
  std::vector<vpTsaiPose> poses;
};

class vpTsaiProblem
{
public:
  vpTsaiProblem(const std::vector<std::vector<vpCalibrationPoint>> &points, const std::vector<vpTsaiView> &views,
                const std::array<bool, vpTsaiState::SharedCount> &isFree)
    : m_points(&points), m_views(&views)
  {
    for (int i = 0; i < vpTsaiState::SharedCount; ++i) {
      if (isFree[static_cast<std::size_t>(i)]) {
        m_free.push_back(i);
      }
    }
  }
  [[nodiscard]] Eigen::Index shared() const { return static_cast<Eigen::Index>(m_free.size()); }
  [[nodiscard]] std::size_t views() const { return m_views->size(); }
  [[nodiscard]] const std::vector<int> &freeParameters() const { return m_free; }
  // Local parameters: a rotation of the camera frame (rad), then t (m).
  [[nodiscard]] vpBundleView view(const vpTsaiState &state, std::size_t k) const;
  [[nodiscard]] vpTsaiState plus(const vpTsaiState &state, const Eigen::VectorXd &shared,
                                 const std::vector<Eigen::VectorXd> &local) const;

private:
  const std::vector<std::vector<vpCalibrationPoint>> *m_points; // owned by the caller
  const std::vector<vpTsaiView> *m_views;                       // owned by the caller
  std::vector<int> m_free;
};

END_VISP_NAMESPACE
#endif
