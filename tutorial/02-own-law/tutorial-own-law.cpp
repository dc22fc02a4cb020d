/*! \example tutorial-own-law.cpp
 * Check the guarantee of a servo law of your own, level-law.cpp, and run it.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/core/vpExponentialMap.h>
#include <visp3/core/vpUniRand.h>
#include <visp3/direct_core/vpPlugin.h>
#include <visp3/feedforward/vpServoLaw.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>

VISP_DIRECT_USING_NAMESPACE

namespace
{
// The error once more, from ViSP's products: what the law promises to drive to zero.
Eigen::Vector4d errorOf(const vpHomogeneousMatrix &cMo, const vpHomogeneousMatrix &cdMo)
{
  const vpHomogeneousMatrix cdMc = cdMo * cMo.inverse();
  return {cdMc[0][3], cdMc[1][3], cdMc[2][3], std::atan2(cdMc[0][2], cdMc[2][2])};
}
} // namespace

int main()
{
  vpServoGoal goal;
  goal.cdMo = vpHomogeneousMatrix(0., 0., 0.5, 0., 0., 0.);
  goal.points = {{0., 0., 0.5}}; // at least one; this law uses only the pose
  vpServoGains gains;
  gains.rotation = 2.; // yaw twice as fast as the rest
  //! [Create]
  vispDirectPlugin(); // here it is part of the program; programs call it in the library of --plugin
  const auto law = vpServoLaw::create("level", gains);
  law->setGoal(goal);
  //! [Create]
  const Eigen::Vector4d k(gains.lambda, gains.lambda, gains.lambda, gains.lambda * gains.rotation);

  //! [Check]
  vpUniRand random(1); // the guarantee e' = -k e, by central differences at random places of a level camera
  double worst = 0.;
  vpServoMeasurement seen;
  seen.valid = true;
  seen.points = goal.points;
  for (int i = 0; i < 1000; ++i) {
    seen.cMo = vpHomogeneousMatrix(random.uniform(-1., 1.), random.uniform(-1., 1.), random.uniform(0.2, 2.), 0.,
                                   random.uniform(-3., 3.), 0.);
    const vpColVector v = law->step(seen, 0.01).v.toColVector();
    const auto at = [&](double t) { return errorOf(vpExponentialMap::direct(v, t).inverse() * seen.cMo, goal.cdMo); };
    const Eigen::Vector4d derivative = (at(1e-5) - at(-1e-5)) / 2e-5;
    worst = std::max(worst, (derivative + k.cwiseProduct(errorOf(seen.cMo, goal.cdMo))).cwiseAbs().maxCoeff());
  }
  std::cout << "e' = -k e, worst difference at 1000 places below " << std::pow(10., std::ceil(std::log10(worst)))
            << std::endl;
  //! [Check]
  //! [Run]
  std::ofstream log("tutorial-own-law.txt"); // time, the four errors, the four expected ones
  seen.cMo = vpHomogeneousMatrix(0.3, 0.1, 0.9, 0., 0.8, 0.);
  const Eigen::Vector4d start = errorOf(seen.cMo, goal.cdMo);
  for (double t = 0.; t < 5.; t += 0.02) {
    const Eigen::Vector4d promised = start.array() * (-t * k.array()).exp();
    log << t << ' ' << errorOf(seen.cMo, goal.cdMo).transpose() << ' ' << promised.transpose() << '\n';
    seen.cMo = vpExponentialMap::direct(law->step(seen, 0.02).v.toColVector(), 0.02).inverse() * seen.cMo;
  }
  //! [Run]
  log.close();
  const char *const plot = R"(/usr/bin/python3 -c "
from pylab import *
t, *e = loadtxt('tutorial-own-law.txt').T
figure(figsize=(8, 4.8))
for i, name in enumerate(['x', 'y', 'z', 'yaw']):
    plot(t, e[i], f'C{i}', label=name)
    plot(t[::10], e[i + 4][::10], f'C{i}o')
title('Own law (lines) and its promise e(0) exp(-k t) (dots)')
xlabel('time (s)'); ylabel('error (m, rad)'); grid(); legend(); savefig('tutorial-own-law.png')
")";
  const bool isDrawn = std::system(plot) == 0; // Debian's python3-matplotlib
  const double left = errorOf(seen.cMo, goal.cdMo).norm();
  std::cout << "Error " << start.norm() << " at the start, " << left << " after 5 s" << std::endl;
  return isDrawn && worst < 1e-6 && left < 0.01 * start.norm() ? EXIT_SUCCESS : EXIT_FAILURE;
}
