/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Random URDFs with mimic joints in the chain.
#ifndef vpRandomRow_h
#define vpRandomRow_h

#include "vpUrdfTestKit.h"

#include <algorithm>
#include <numeric>
#include <sstream>

namespace vpUrdfTestKit
{
inline std::string numbers(std::initializer_list<double> values)
{
  std::ostringstream text;
  text.precision(17);
  for (const double value : values) {
    text << (text.tellp() > 0 ? " " : "") << value;
  }
  return text.str();
}

/*!
 * A row of 3 to 7 moving joints between fixed ones, l0 to the last link; some mimic another one of the row, which may
 * mimic a third one. All are within their limits where those that mimic none are at 0.
 */
inline std::string randomRow(std::mt19937_64 &rng)
{
  const auto below = [&rng](int count) { return std::uniform_int_distribution<int>(0, count - 1)(rng); };
  const int count = 3 + below(5);
  std::vector<int> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), rng);
  std::vector<std::string> mimics(order.size());
  std::vector<double> zero(order.size(), 0.); // coordinates where those that mimic none are at 0
  for (std::size_t k = 1; k < order.size(); ++k) {
    if (below(2) == 0) {
      const int own = order[k], of = order[static_cast<std::size_t>(below(static_cast<int>(k)))];
      const double ratio = uniform(rng, 0.2, 1.3) * (below(2) == 0 ? 1. : -1.), offset = uniform(rng, -1., 1.);
      zero[static_cast<std::size_t>(own)] = ratio * zero[static_cast<std::size_t>(of)] + offset;
      mimics[static_cast<std::size_t>(own)] = "<mimic joint='j" + std::to_string(of) + "' multiplier='" +
                                              numbers({ratio}) + "' offset='" + numbers({offset}) + "'/>";
    }
  }
  const auto origin = [&rng] {
    return "<origin xyz='" + numbers({uniform(rng, -.3, .3), uniform(rng, -.3, .3), uniform(rng, -.3, .3)}) +
           "' rpy='" + numbers({uniform(rng, -3., 3.), uniform(rng, -1.5, 1.5), uniform(rng, -3., 3.)}) + "'/>";
  };
  std::string urdf = "<robot name='row'>" + link("l0");
  std::string last = "l0";
  for (int i = 0; i < count; ++i) {
    const std::string number = std::to_string(i);
    if (below(3) == 0) {
      urdf += link("f" + number, mass + ball) + joint("fixed" + number, "fixed", last, "f" + number, origin());
      last = "f" + number;
    }
    const int type = below(5);
    const double at = zero[static_cast<std::size_t>(i)];
    const std::string range =
        "lower='" + numbers({at - uniform(rng, 0.2, 2.)}) + "' upper='" + numbers({at + uniform(rng, 0.2, 2.)}) + "' ";
    urdf += link("l" + number + "m", "<inertial>" + origin() + mass.substr(10) + ball) +
            joint("j" + number,
                  type == 0   ? "continuous"
                  : type == 1 ? "prismatic"
                              : "revolute",
                  last, "l" + number + "m",
                  origin() + "<axis xyz='" +
                      numbers({uniform(rng, 0.1, 1.), uniform(rng, -1., 1.), uniform(rng, -1., 1.)}) + "'/><limit " +
                      (type == 0 ? "" : range) + "velocity='" + numbers({uniform(rng, 0.5, 3.)}) +
                      "' effort='9'/><dynamics damping='" + numbers({uniform(rng, 0., 2.)}) + "' friction='" +
                      numbers({uniform(rng, 0., 2.)}) + "'/>" + mimics[static_cast<std::size_t>(i)]);
    last = "l" + number + "m";
  }
  return urdf + "</robot>";
}
} // namespace vpUrdfTestKit
#endif
