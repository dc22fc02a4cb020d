/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// True motion of the product in a print experiment.
#ifndef vpPrintTruth_h
#define vpPrintTruth_h

#include <visp3/simulation/vpXYStage.h>

#include <algorithm>
#include <vector>

BEGIN_VISP_NAMESPACE

//! \brief True motion, stored for exposures and landings.
class vpPrintTruth
{
public:
  //! \brief State at a time.
  struct Point {
    double t, x, y, vx, vy;
  };
  explicit vpPrintTruth(const vpXYStageSpec &spec) : m_stage(spec) { remember(); }
  void step(double fx, double fy, int share)
  {
    for (int i = 0; i < partsPerFrame / share; ++i) {
      m_stage.step(1. / partsPerFrame, {{fx, fy}});
      remember();
    }
  }
  [[nodiscard]] double now() const { return m_points.back().t; }
  [[nodiscard]] const Point &last() const { return m_points.back(); }
  //! State at time \e t, cubic interpolation; at rest before the start.
  [[nodiscard]] Point at(double t) const
  {
    if (t <= 0.) {
      return {t, m_points[0].x, m_points[0].y, 0., 0.};
    }
    const auto i = std::min(static_cast<std::size_t>(t * partsPerFrame), m_points.size() - 2);
    const Point &a = m_points[i], &b = m_points[i + 1];
    const double h = b.t - a.t, s = (t - a.t) / h;
    const auto cubic = [&](double p, double v, double q, double w) {
      const double d = q - p, c = 3. * d - h * (2. * v + w), e = -2. * d + h * (v + w);
      return p + s * (h * v + s * (c + s * e));
    };
    return {t, cubic(a.x, a.vx, b.x, b.vx), cubic(a.y, a.vy, b.y, b.vy), a.vx + s * (b.vx - a.vx),
            a.vy + s * (b.vy - a.vy)};
  }

private:
  static constexpr int partsPerFrame = 32;

  void remember()
  {
    const vpXYStage::State &s = m_stage.state();
    m_points.push_back({static_cast<double>(m_points.size()) / partsPerFrame, s.position[0], s.position[1],
                        s.velocity[0], s.velocity[1]});
  }
  vpXYStage m_stage;
  std::vector<Point> m_points;
};

END_VISP_NAMESPACE
#endif
