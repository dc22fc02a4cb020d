/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The calls that overhead.py makes from Python, in a loop in C++: microseconds for each.
#include "casters.h"

#include <visp3/pattern/vpPatternTracker.h>
#include <visp3/trajectory/vpDirectTrajectory.h>

#include <algorithm>
#include <chrono>
#include <limits>

namespace
{
template <class Call> double perCall(int count, Call call)
{
  double best = std::numeric_limits<double>::infinity();
  for (int round = 0; round < 15; ++round) {
    const auto begin = std::chrono::steady_clock::now();
    for (int i = 0; i < count; ++i) {
      call();
    }
    best = std::min(best, std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin).count() /
                              count);
  }
  return best;
}

double trajectory(const vpTrajectoryInput<Eigen::Dynamic> &given, int count)
{
  vpTrajectoryInput<Eigen::Dynamic> input = given;
  const int axes = static_cast<int>(input.goal.q.size());
  vpDirectTrajectory<Eigen::Dynamic> dtg(axes);
  vpTrajectoryOutput<Eigen::Dynamic> output(axes);
  return perCall(count, [&] {
    input.goal.q = given.goal.q;
    dtg.step(input, output, 1e-9);
  });
}

double tracker(vpPatternTracker &tracker, const vpImage<unsigned char> &image, int count)
{
  return perCall(count, [&] { tracker.process(image); });
}
} // namespace

PYBIND11_MODULE(visp_direct_timed, m)
{
  pybind11::module_::import("visp_direct"); // whose types are used
  m.def("trajectory", &trajectory);
  m.def("tracker", &tracker);
}
