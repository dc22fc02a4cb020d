/*! \example tutorial-bounded-motion.cpp
 * ViSP's servoing of four points (tutorial-ibvs-4pts.cpp) with bounded acceleration and jerk; after 5 s the goal jumps.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/core/vpPoint.h>
#include <visp3/robot/vpSimulatorCamera.h>
#include <visp3/trajectory/vpTwistShaper.h>
#include <visp3/visual_features/vpFeatureBuilder.h>
#include <visp3/visual_features/vpFeaturePoint.h>
#include <visp3/vs/vpServo.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <string>

VISP_DIRECT_USING_NAMESPACE

namespace
{
const double dt = 0.01, bound = 1.; // s, m/s^2

struct Run {
  std::vector<double> speed, acceleration; // linear, m/s and m/s^2, one value per dt
  double error = 0.;                       // final image error
};

Run servo(bool isShaped)
{
  //! [Task]
  vpPoint point[4] = {vpPoint(-0.1, -0.1, 0), vpPoint(0.1, -0.1, 0), vpPoint(0.1, 0.1, 0), vpPoint(-0.1, 0.1, 0)};
  const vpHomogeneousMatrix firstGoal(0, 0, 0.75, 0, 0, 0), secondGoal(0.1, 0, 0.6, 0, 0.35, -0.35);
  vpSimulatorCamera robot;
  robot.setSamplingTime(dt);
  robot.setPosition(vpHomogeneousMatrix(0.15, -0.1, 1., 0.2, -0.2, 0.5).inverse());
  robot.setMaxTranslationVelocity(2.); // high, so that vpSimulatorCamera does not limit
  robot.setMaxRotationVelocity(4.);
  vpServo task;
  task.setServo(vpServo::EYEINHAND_CAMERA);
  task.setInteractionMatrixType(vpServo::CURRENT);
  task.setLambda(1.);
  vpFeaturePoint p[4], pd[4];
  for (int i = 0; i < 4; ++i) {
    task.addFeature(p[i], pd[i]);
  }
  //! [Task]
  //! [Loop]
  vpTwistShaper shaper({bound, 10. * bound, 2., 20.}); // linear m/s^2, m/s^3; angular rad/s^2, rad/s^3
  Run run;
  vpColVector before(3);
  for (int cycle = 0; cycle < 1000; ++cycle) {
    const vpHomogeneousMatrix cMo = robot.getPosition().inverse();
    for (int i = 0; i < 4; ++i) {
      point[i].track(cycle < 500 ? firstGoal : secondGoal);
      vpFeatureBuilder::create(pd[i], point[i]);
      point[i].track(cMo);
      vpFeatureBuilder::create(p[i], point[i]);
    }
    vpColVector v = task.computeControlLaw();
    if (isShaped) {
      v = shaper.step(vpTwist::fromColVector(v), dt).toColVector(); // the line that bounds the motion
    }
    robot.setVelocity(vpRobot::CAMERA_FRAME, v);
    //! [Loop]
    const vpColVector linear(v, 0, 3);
    run.speed.push_back(std::sqrt(linear.sumSquare()));
    run.acceleration.push_back(std::sqrt((linear - before).sumSquare()) / dt);
    before = linear;
  }
  run.error = std::sqrt(task.getError().sumSquare());
  return run;
}
} // namespace

int main()
{
  const Run raw = servo(false), shaped = servo(true);
  std::ofstream log("tutorial-bounded-motion.txt"); // time, speeds, accelerations
  for (std::size_t i = 0; i < raw.speed.size(); ++i) {
    log << dt * i << ' ' << raw.speed[i] << ' ' << shaped.speed[i] << ' ' << raw.acceleration[i] << ' '
        << shaped.acceleration[i] << '\n';
  }
  log.close();
  const std::string plot = R"(/usr/bin/python3 -c "
from pylab import *
t, v, shaped_v, a, shaped_a = loadtxt('tutorial-bounded-motion.txt').T
figure(figsize=(9, 6.4))
subplot(211); plot(t, v, label='vpServo'); plot(t, shaped_v, label='shaped')
ylabel('speed (m/s)'); grid(); legend()
subplot(212); semilogy(t, a, label='vpServo'); semilogy(t, shaped_a, label='shaped')
axhline()" + std::to_string(bound) +
                           R"(, color='black', linestyle='--', label='bound')
xlabel('time (s)'); ylabel('acceleration (m/s²)'); ylim(0.01, 100); grid(); legend()
savefig('tutorial-bounded-motion.png')
")";
  const bool isDrawn = std::system(plot.c_str()) == 0; // Debian's python3-matplotlib
  const double rawMost = *std::max_element(raw.acceleration.begin(), raw.acceleration.end());
  const double shapedMost = *std::max_element(shaped.acceleration.begin(), shaped.acceleration.end());
  std::cout << "vpServo: at most " << rawMost << " m/s^2, image error at the end " << raw.error << "\n"
            << "shaped:  at most " << shapedMost << " m/s^2, image error at the end " << shaped.error << std::endl;
  return isDrawn && rawMost > 10. * bound && shapedMost < 1.000001 * bound && shaped.error < 0.01 ? EXIT_SUCCESS
                                                                                                  : EXIT_FAILURE;
}
