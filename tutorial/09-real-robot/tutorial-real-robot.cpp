/*! \example tutorial-real-robot.cpp
 * One loop for simulated and real arms, with limits, a watchdog, and recovery of a lost target.
 * Usage: tutorial-real-robot [/dev/video0], a dry run with a live camera: the arm that follows is simulated
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/core/vpTime.h>
#include <visp3/feedforward/vpServoController.h>
#include <visp3/io/vpImageIo.h>
#include <visp3/manipulator/vpArmJson.h>
#include <visp3/planar_target/vpPlanarTarget.h>
#include <visp3/rendering/vpPlaneRenderer.h>
#include <visp3/sensor/vpV4l2Grabber.h>
#include <visp3/servoing/vpServoTarget.h>
#include <visp3/simulation/vpSimulatedArm.h>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iostream>
VISP_DIRECT_USING_NAMESPACE
namespace
{
const vpCameraParameters camera(400., 400., 159.5, 119.5); // for 320 x 240 px; use your calibration
const vpHomogeneousMatrix cdMo(0., 0., 0.35, 0., 0., 0.);  // the goal
using Grab = std::function<void(vpImage<unsigned char> &)>;
//! [Servo]
// All motion code, the same for simulated and real robots. True if the target was lost on the way.
bool servo(vpRobot &robot, const Grab &grab, vpPlanarTarget &target, std::ostream &log)
{
  vpServoControllerSpec spec;
  spec.gains.lambda = 2.;                                         // 1/s
  spec.view = vpViewConstraintSpec::fromCamera(camera, 320, 240); // "+cbf" keeps the target's centre in it
  spec.view.maxLinear = 0.1;           // m/s; use a fifth of it for the first run on a real robot
  spec.view.maxAngular = 0.3;          // rad/s
  spec.recovery = {0.3, 2., 0.1, 0.3}; // target lost: wait 0.3 s, then undo the last 2 s; m/s, rad/s
  vpServoController controller = vpServoController::create("ff-lookat+cbf", spec);
  const vpServoTarget centre({Eigen::Vector3d::Zero()}); // object origin: look-at point, kept in view
  controller.setGoal(centre.goal(cdMo));
  robot.setMaxTranslationVelocity(0.11); // the robot's own limits back up those of the controller
  robot.setMaxRotationVelocity(0.33);
  robot.setRobotState(vpRobot::STATE_VELOCITY_CONTROL);
  vpImage<unsigned char> image;
  vpServoMeasurement seen;
  bool wasLost = false, isGoing = true;
  for (int k = 0; k < 150 && isGoing; ++k) {
    const double before = vpTime::measureTimeMs();
    grab(image);
    const bool fresh = vpTime::measureTimeMs() - before < 200.; // watchdog: ignore images of a stalled camera
    centre.measure(target.process(image), 0.04 * k, seen);
    seen.valid = seen.valid && fresh;
    const auto [v, status] = controller.step(seen, 0.04);
    robot.setVelocity(vpRobot::CAMERA_FRAME, v.toColVector());
    wasLost = wasLost || status == vpServoStatus::Retreating;
    isGoing = vpIsWorking(status); // an error or a permanent loss ends the loop: the robot stops
    log << 0.04 * k << ' ' << v.linearNorm() << ' ' << v.angularNorm() << ' ' << vpToString(status) << std::endl;
  }
  robot.setRobotState(vpRobot::STATE_STOP);
  return wasLost;
}
//! [Servo]
} // namespace
int main(int argc, char **argv)
{
  try {
    //! [Parts]
    vpImage<unsigned char> photo;
    vpImageIo::read(photo, VISP_DIRECT_DATA_DIR "/target/klimt.jpg");
    vpPlanarTargetSpec fast;
    fast.refinementSize = 120;                                                    // px: fast enough for the camera rate
    vpPlanarTarget target(photo, 0.12, 0.12, camera, fast);                       // m
    vpSimulatedArm robot(vpLoadArmJson(VISP_DIRECT_DATA_DIR "/robot/amor.json")); // 40 ms per cycle; any vpRobot works
    const vpHomogeneousMatrix fMo = robot.get_fMc() * vpHomogeneousMatrix(0.06, 0.04, 0.45, 0.2, -0.3, 0.4);
    vpPlaneRenderer view(photo, 0.12, 0.12, camera, 320, 240);
    Grab grab = [&](vpImage<unsigned char> &image) {
      view.render(robot.get_fMc().inverse() * fMo, {}, 1, image);
      image = std::floor(robot.getState().time) == 1. ? vpImage<unsigned char>(240, 320, 0) : image; // covered
    };
#ifdef VISP_HAVE_V4L2
    vpV4l2Grabber live(0, 2); // input 0, 640 x 480 px halved
    if (argc > 1) {
      live.setDevice(argv[1]);
      grab = [&live](vpImage<unsigned char> &image) { live.acquire(image); };
    }
#endif
    //! [Parts]
    std::ofstream log("tutorial-real-robot.txt");
    const bool wasLost = servo(robot, grab, target, log);
    const char *const plot = R"(/usr/bin/python3 -c "
from pylab import *
log = genfromtxt('tutorial-real-robot.txt', dtype=None, encoding='utf-8')
t, v, w, status = (log[name] for name in log.dtype.names[:4])
figure(figsize=(9, 4))
for name, colour, label in (('Holding', 'salmon', 'target lost: holding'), ('Retreating', 'khaki', 'going back')):
    fill_between(t, 0, 0.4, where=status == name, step='mid', color=colour, label=label)
plot(t, v, 'b', label='m/s'); plot(t, w, 'k', label='rad/s')
xlim(0, 6); ylim(0, 0.4); xlabel('time (s)'); ylabel('commanded speed'); legend()
savefig('tutorial-real-robot.png')
")"; // Debian's python3-matplotlib
    const double mm = 1000. * (cdMo * fMo.inverse() * robot.get_fMc()).getTranslationVector().frobeniusNorm();
    std::cout << mm << " mm from the goal; " << robot.getSentence() << std::endl;
    return std::system(plot) == 0 && (argc > 1 || (wasLost && mm < 2.)) ? EXIT_SUCCESS : EXIT_FAILURE;
  }
  catch (const vpException &e) {
    std::cerr << "tutorial-real-robot: " << e.getStringMessage() << std::endl;
  }
  return EXIT_FAILURE;
}
