/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "results.h"

#include "appMain.h"
#include "sweep.h"

// What ranks send, see sweep.h: a run without its specification and samples.
BEGIN_VISP_NAMESPACE
template <class Archive> void exchange(Archive &archive, vpArmMetrics &m)
{
  std::vector<double> rms(m.joint_rms.data(), m.joint_rms.data() + m.joint_rms.size());
  archive(rms, m.least_limit_margin, m.least_margin_joint, m.peak_velocity_share, m.peak_acceleration_share,
          m.least_manipulability, m.self_motion_rad, m.limited_s, m.blocked_s, m.saturated_s, m.shortfall.joint,
          m.shortfall.needed, m.shortfall.given, m.status);
  m.joint_rms = Eigen::Map<const Eigen::VectorXd>(rms.data(), static_cast<Eigen::Index>(rms.size()));
}
template <class Archive> void exchange(Archive &archive, vpServoRun &run)
{
  vpServoMetrics &m = run.metrics;
  archive(m.max_image_error_px, m.rms_image_error_px, m.end_rotation_deg, m.end_translation_mm,
          m.expected_end_rotation_deg, m.expected_end_translation_mm, m.left_end_rotation_deg,
          m.left_end_translation_mm, m.yaw_range_deg, m.ideal_yaw_range_deg, m.out_of_view_s, m.settle_s,
          m.path_length_m, m.peak_linear_mps, m.peak_angular_radps, m.peak_linear_acceleration_mps2,
          m.peak_angular_acceleration_radps2, m.peak_linear_jerk_mps3, m.peak_angular_jerk_radps3,
          m.rms_linear_jerk_mps3, m.rms_angular_jerk_radps3, m.bounds_exceeded_cycles, m.view_losses, m.deadlock_cycles,
          m.status, run.armMetrics);
}
END_VISP_NAMESPACE

namespace servoCompare
{
namespace
{
//! Expected cost of a run relative to one with points: rendering and vision take most of the time.
double costOf(const vpServoRunSpec &spec) { return spec.measure == "image" ? 2. * spec.plant.visionRate : 1.; }

bool matches(const vpServoRunSpec &spec, const std::string &law, const std::string &plant, const std::string &measure,
             Command command)
{
  return spec.law == law && spec.plant.name == plant && spec.measure == measure &&
         spec.shape.has_value() == (command == Command::Shaped);
}
} // namespace

const vpServoRun *Results::find(const std::string &law, const std::string &plant, const std::string &measure,
                                Command command) const
{
  for (const vpServoRun &run : m_runs) {
    if (matches(run.spec, law, plant, measure, command)) {
      return &run;
    }
  }
  return nullptr;
}

Results runAll(const Plan &plan, const std::string &targetFile, const vpApp::Ranks &ranks, unsigned int jobs,
               const std::function<void(const vpServoRun &)> &finished)
{
  vpApp::Sweep sweep;
  sweep.title = "simulating " + std::to_string(plan.runs.size()) + " runs";
  sweep.count = plan.runs.size();
  sweep.effort = [&plan](std::size_t i) { return costOf(plan.runs[i]); };
  sweep.onFirst = [&plan](std::size_t i) { return plan.runs[i].seed == plan.seed; };
  const auto specOf = [&](std::size_t i) {
    vpServoRunSpec spec = plan.runs[i];
    spec.target = targetFile;
    return spec;
  };
  const auto simulate = [&](std::size_t i, const std::function<void(double)> &done) {
    vpServoRun run = runServoExperiment(specOf(i), [&](double share) {
      done(share);
      return !vpApp::interrupted();
    });
    vpApp::throwIfInterrupted();
    if (sweep.onFirst(i)) {
      finished(run);
    }
    else {
      run.samples = {};
      run.arm = {};
    }
    return run;
  };
  std::vector<vpServoRun> runs = vpApp::runSweep<vpServoRun>(ranks, sweep, jobs, simulate);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    runs[i].spec = specOf(i); // not sent between ranks
  }
  return Results(std::move(runs));
}
} // namespace servoCompare
