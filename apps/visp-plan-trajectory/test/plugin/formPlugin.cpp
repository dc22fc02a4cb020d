/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// A plug-in with two forms: "slow" takes 4 s where nothing else is asked for, "hasty" never keeps a limit.
#include <visp3/direct_core/vpPlugin.h>
#include <visp3/trajectory/vpMotionFamily.h>
#include <visp3/trajectory/vpMotionForm.h>

#include <algorithm>

VISP_DIRECT_USING_NAMESPACE

namespace
{
class Quintic : public vpMotionForm
{
public:
  explicit Quintic(double duration) : m_duration(duration) {}
  bool plan(const vpTrajectoryProblem &problem, double floor, Writer &writer) const noexcept override
  {
    for (int i = 0; i < problem.axes(); ++i) {
      vpAxisState from = problem.start(i), to = problem.goal(i);
      to[0] -= from[0];
      from[0] = 0.;
      const double T = std::max(floor, m_duration);
      writer.append(i, vpMotionFamily::pointToPoint(from, to, 3).at(T), T);
    }
    return true;
  }

private:
  double m_duration; // s
};
} // namespace

extern "C" void vispDirectPlugin()
{
  vpMotionForm::add("slow", "Takes four seconds.", std::make_unique<Quintic>(4.));
  vpMotionForm::add("hasty", "Takes a millisecond.", std::make_unique<Quintic>(0.001));
}
