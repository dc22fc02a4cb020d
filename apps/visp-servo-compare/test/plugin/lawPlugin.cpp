/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// A plug-in with two laws: "again" does what pbvs1 does, which the test compares; "late" is refused by its maker.
#include <visp3/core/vpException.h>
#include <visp3/direct_core/vpPlugin.h>
#include <visp3/feedforward/vpServoLaw.h>

VISP_DIRECT_USING_NAMESPACE

namespace
{
class Again : public vpServoLaw
{
public:
  explicit Again(const vpServoGains &gains) : vpServoLaw("again", gains), m_law(vpServoLaw::create("pbvs1", gains)) {}

protected:
  void goalChanged() override { m_law->setGoal(m_goal); }
  vpServoCommand compute(const vpServoMeasurement &seen, double dt) noexcept override { return m_law->step(seen, dt); }

private:
  std::unique_ptr<vpServoLaw> m_law;
};
} // namespace

extern "C" void vispDirectPlugin()
{
  vpServoLaw::add(
      "again", "Does what pbvs1 does, from a plug-in.",
      [](const vpServoGains &gains, const vpServoMotionLimits &) { return std::make_unique<Again>(gains); });
  vpServoLaw::add("late", "Refuses to be made.",
                  [](const vpServoGains &, const vpServoMotionLimits &) -> std::unique_ptr<vpServoLaw> {
                    throw vpException(vpException::badValue, "law late has no weights");
                  });
}
