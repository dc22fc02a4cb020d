/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/trajectory/vpMotionForm.h>

#include "vpLimitCheck.h"
#include "vpRegistry.h"

#include <algorithm>
#include <cmath>
#include <utility>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr double precision = 1e-9, rounding = 1e-14; // of peaks, and of positions

using Registry = vpRegistry<std::shared_ptr<const vpMotionForm>>;

Registry &forms()
{
  static Registry all("motion form"); // at first use: static objects elsewhere may add forms
  return all;
}

vpAxisState jet(const vpTrajectorySegment &segment, double s)
{
  const auto x = segment.p.jet(s);
  const double r = 1. / segment.duration;
  return {x[0], x[1] * r, x[2] * r * r, x[3] * r * r * r};
}

// Comparisons are written so that NaN fails them.
class Joints
{
public:
  Joints(const vpTrajectoryProblem &problem, const vpTrajectoryPlan &plan, int axis)
    : m_plan(plan), m_axis(axis), m_from(problem.start(axis)), m_to(problem.goal(axis)),
      m_order(2 + static_cast<int>(problem.spec.continuity))
  {
    const vpTrajectoryPeaks peaks = plan.peaks(axis);
    const double place = std::max(std::abs(m_from[0]), std::abs(m_to[0]));
    m_tolerance = {precision * (peaks.maxPosition - peaks.minPosition) + rounding * place, precision * peaks.velocity,
                   precision * peaks.acceleration, precision * peaks.jerk};
  }

  [[nodiscard]] bool areTight() const
  {
    vpAxisState end = m_from;
    bool tight = true;
    for (int i = 0; i < m_plan.segments(m_axis); ++i) {
      tight = tight && isSame(end, jet(m_plan.segment(m_axis, i), 0.));
      end = jet(m_plan.segment(m_axis, i), 1.);
    }
    return tight && isSame(end, m_to);
  }

private:
  [[nodiscard]] bool isSame(const vpAxisState &a, const vpAxisState &b) const
  {
    bool same = true;
    for (int k = 0; k < m_order; ++k) {
      const auto d = static_cast<std::size_t>(k);
      same = same && std::abs(a[d] - b[d]) <= m_tolerance[d];
    }
    return same;
  }

  const vpTrajectoryPlan &m_plan;
  int m_axis;
  vpAxisState m_from, m_to, m_tolerance{};
  int m_order;
};

bool isAsked(const vpTrajectoryProblem &problem)
{
  bool rests = problem.vias() == 0 && problem.spec.synchronisation != vpSynchronisation::Straight;
  for (int i = 0; i < problem.axes(); ++i) {
    const vpAxisState goal = problem.goal(i);
    rests = rests && goal[1] == 0. && goal[2] == 0. && goal[3] == 0.;
  }
  return rests;
}

bool isInTime(const vpTrajectoryProblem &problem, double floor, const vpTrajectoryPlan &plan)
{
  const double T = plan.duration();
  bool good = T >= floor * (1. - precision) &&
              (problem.spec.policy != vpReplanPolicy::FixedArrival || T <= floor * (1. + precision));
  for (int i = 0; i < plan.axes(); ++i) {
    good =
        good && (problem.spec.synchronisation == vpSynchronisation::None || plan.duration(i) >= T * (1. - precision));
  }
  return good;
}
} // namespace

void vpMotionForm::Writer::append(int axis, const vpPolynomial &relative, double duration) noexcept
{
  if (axis >= 0 && axis < m_plan.axes() && relative.degree() <= vpMotionFamily::maxDegree) { // what the check can judge
    m_plan.append(axis, relative, duration);
  }
}

std::vector<std::string> vpMotionForm::names() { return forms().ids(); }

std::string vpMotionForm::sentence(const std::string &name) { return forms().sentence(name); }

const vpMotionForm *vpMotionForm::find(const std::string &name) { return forms().find(name).get(); }

void vpMotionForm::add(const std::string &name, const std::string &sentence, std::unique_ptr<const vpMotionForm> form)
{
  forms().add(name, sentence, std::move(form));
}

bool vpMotionForm::isValid(const vpTrajectoryProblem &problem, double floor, vpTrajectoryPlan &result) const noexcept
{
  result.clear();
  for (int i = 0; i < problem.axes(); ++i) {
    result.begin(i, problem.start(i)[0], vpTrajectoryForm::Own);
  }
  Writer writer(result);
  if (!isAsked(problem) || !plan(problem, floor, writer) || !result.isFinite()) {
    return false;
  }
  bool tight = true;
  for (int i = 0; i < problem.axes(); ++i) {
    result.finish(i, problem.goal(i));
    tight = tight && Joints(problem, result, i).areTight();
  }
  double brakingEnd = 0.;
  return tight && isInTime(problem, floor, result) &&
         vpLimitCheck(problem, result).judge(0., brakingEnd).result == vpTrajectoryResult::Working;
}

END_VISP_NAMESPACE
