/*! \example tutorial-servo-on-your-poster.cpp
 * A camera finds a poster and moves in front of it: image in, twist out, with late images and limits.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/core/vpException.h>
#include <visp3/core/vpExponentialMap.h>
#include <visp3/core/vpMath.h>
#include <visp3/io/vpImageIo.h>
#include <visp3/rendering/vpPlaneRenderer.h>
#include <visp3/servoing/vpVisualServo.h>

#include <cstdlib>
#include <deque>
#include <fstream>
#include <iostream>
#include <utility>

VISP_DIRECT_USING_NAMESPACE

int main()
{
  try {
    //! [Poster]
    vpImage<unsigned char> photo; // yours: photographed straight from the front, cropped at the poster's edges
    vpImageIo::read(photo, VISP_DIRECT_DATA_DIR "/target/starry-night.jpg");
    const double width = 0.42, height = width * photo.getHeight() / photo.getWidth(); // m: measure it
    const vpCameraParameters camera(600., 600., 319.5, 239.5);                        // 640 x 480 px: calibrate it
    const vpHomogeneousMatrix cdMo(0., 0., 0.8, 0., 0., 0.); // goal: 0.8 m in front of its centre
    //! [Poster]

    //! [Servo]
    vpServoControllerSpec law;
    law.gains.lambda = 2.;           // 1/s
    law.motion.linearVelocity = 0.2; // m/s; visp-servo begins with 0.05
    law.motion.angularVelocity = 0.4;
    law.view = vpViewConstraintSpec::fromCamera(camera, 640, 480); // "+cbf" keeps the poster in it
    vpVisualServoSpec spec;
    spec.period = 0.01; // s
    vpVisualServo servo(vpServoController::create("ff-lookat-pi+cbf", law), spec);
    servo.setVision(vpServoVision::photograph(photo, width, height, camera));
    servo.setGoal(servo.vision().goal(cdMo));
    servo.start();
    //! [Servo]

    //! [Loop]
    vpPlaneRenderer view(photo, width, height, camera, 640, 480); // stands in for the camera, with noise
    vpCameraFaults faults;
    faults.noise = 3.;
    vpHomogeneousMatrix cMo(-0.15, 0.1, 1.2, 0.2, 0.3, 0.4);        // the camera at the start
    std::deque<std::pair<double, vpImage<unsigned char>>> onTheWay; // images come 50 ms after their capture
    std::ofstream log("tutorial-servo-on-your-poster.txt");
    vpServoRobotState state;
    vpHomogeneousMatrix fMc;
    for (unsigned int k = 0; k < 1200 && !servo.isConverged(); ++k) {
      const double now = k * spec.period;
      state.pose = vpRigidTransform::fromHomogeneous(fMc);
      const vpVisualServoOutput &out = servo.step(state, now); // control: every 10 ms
      if (k % 4 == 0) {                                        // camera: 25 images per second
        onTheWay.emplace_back(now, vpImage<unsigned char>());
        view.render(cMo, faults, k, onTheWay.back().second);
      }
      if (!onTheWay.empty() && onTheWay.front().first <= now - 0.05) {
        servo.see(onTheWay.front().second, onTheWay.front().first); // with the time of capture
        onTheWay.pop_front();
      }
      const vpHomogeneousMatrix step =
          vpExponentialMap::direct(out.twist.toColVector(), spec.period); // the robot moves
      fMc = fMc * step;
      cMo = step.inverse() * cMo;
      log << now << ' ' << 1e3 * out.positionError << ' ' << vpMath::deg(out.rotationError) << ' '
          << 1e3 * out.twist.linearNorm() << ' ' << vpMath::deg(out.twist.angularNorm()) << '\n';
    }
    log.close();
    //! [Loop]
    const double mm = 1e3 * (cdMo * cMo.inverse()).getTranslationVector().frobeniusNorm();
    std::cout << servo.output().message << " It is " << mm << " mm from the goal." << std::endl;
    const char *const plot = R"(/usr/bin/python3 -c "
from pylab import *
t, mm, degrees, linear, angular = loadtxt('tutorial-servo-on-your-poster.txt').T
figure(figsize=(9, 4.2))
subplot(121); plot(t, mm, label='mm'); plot(t, 10 * degrees, label='degrees x 10')
xlabel('time (s)'); ylabel('from the goal'); grid(); legend()
subplot(122); plot(t, linear, label='mm/s'); plot(t, 10 * angular, label='degrees/s x 10')
xlabel('time (s)'); ylabel('commanded speed'); grid(); legend()
tight_layout(); savefig('tutorial-servo-on-your-poster.png')
")"; // Debian's python3-matplotlib
    return std::system(plot) == 0 && servo.isConverged() && mm < 3. ? EXIT_SUCCESS : EXIT_FAILURE;
  }
  catch (const vpException &e) {
    std::cerr << "tutorial-servo-on-your-poster: " << e.getStringMessage() << std::endl;
  }
  return EXIT_FAILURE;
}
