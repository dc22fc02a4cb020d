/*! \example tutorial-ibvs-on-arm.cpp
 * Your robot from URDF: image-based visual servoing of four points, as in ViSP's tutorial-ibvs-4pts.cpp, on any arm.
 * Usage: tutorial-ibvs-on-arm [ARM.urdf TIP CAMERA | ARM.json]
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/core/vpFont.h>
#include <visp3/core/vpImageDraw.h>
#include <visp3/core/vpMeterPixelConversion.h>
#include <visp3/io/vpImageIo.h>
#include <visp3/manipulator/vpArmJson.h>
#include <visp3/manipulator/vpArmUrdf.h>
#include <visp3/servoing/vpServoTarget.h>
#include <visp3/simulation/vpSimulatedArm.h>
#include <visp3/visual_features/vpFeaturePoint.h>
#include <visp3/vs/vpServo.h>

#include <iostream>

VISP_DIRECT_USING_NAMESPACE

namespace
{
//! [Load]
vpArmModel loadArm(int argc, char **argv)
{
  if (argc == 2) { // a DH table, including the data that a URDF lacks
    return vpLoadArmJson(argv[1]);
  }
  vpArmUrdfSpec spec;
  spec.tip = argc == 4 ? argv[2] : "tool";      // end-effector link
  spec.camera = argc == 4 ? argv[3] : "camera"; // camera link, z along the optical axis
  spec.acceleration = 10.;                      // rad/s^2, all joints: URDF has none
  return vpLoadArmUrdf(argc == 4 ? argv[1] : VISP_DIRECT_DATA_DIR "/robot/generic-6r.urdf", spec);
}
//! [Load]
void draw(vpImage<vpRGBa> &picture, const vpFeaturePoint &p, const vpColor &color, bool isGoal)
{
  vpImagePoint ip;
  vpMeterPixelConversion::convertPoint(vpCameraParameters(840, 840, 320, 240), p.get_x(), p.get_y(), ip);
  isGoal ? vpImageDraw::drawCross(picture, ip, 15, color, 2) : vpImageDraw::drawPoint(picture, ip, color, 3);
}
} // namespace

int main(int argc, char **argv)
{
  try {
    //! [Robot]
    vpSimulatedArmSpec spec; // torques, stick-slip friction, 5 ms control; spec.drives.ideal = true for an ideal arm
    spec.indices = {vpSelfMotionIndex::jointLimits(), vpSelfMotionIndex::manipulability()}; // for redundant joints
    vpSimulatedArm robot(loadArm(argc, argv), spec);
    robot.setSamplingTime(0.040);
    robot.setRobotState(vpRobot::STATE_VELOCITY_CONTROL);
    //! [Robot]
    //! [Task]
    const vpHomogeneousMatrix cdMo(0, 0, 0.35, 0, 0, 0), cMo(0.07, 0.05, 0.45, 0.17, -0.17, 0.44);
    const vpServoTarget target = vpServoTarget::rectangle(0.1, 0.1); // m; four points
    const vpServoGoal goal = target.goal(cdMo);
    vpServoMeasurement seen;
    vpServo task;
    task.setServo(vpServo::EYEINHAND_CAMERA);
    task.setInteractionMatrixType(vpServo::CURRENT);
    task.setLambda(0.8);
    vpFeaturePoint p[4], pd[4];
    for (unsigned int i = 0; i < 4; ++i) {
      pd[i].set_xyZ(goal.points[i].x, goal.points[i].y, goal.points[i].Z);
      task.addFeature(p[i], pd[i]);
    }
    //! [Task]
    //! [Loop]
    vpImage<vpRGBa> picture(480, 640, vpRGBa(255, 255, 255));
    const vpHomogeneousMatrix fMo = robot.get_fMc() * cMo; // static object
    for (unsigned int iter = 0; iter < 250; ++iter) {
      target.measure(robot.get_fMc().inverse() * fMo, 0.040 * iter, seen); // on a real robot: from image points
      for (unsigned int i = 0; i < 4; ++i) {
        p[i].set_xyZ(seen.points[i].x, seen.points[i].y, seen.points[i].Z);
        draw(picture, p[i], vpColor::getColor(i), false);
      }
      robot.setVelocity(vpRobot::CAMERA_FRAME, task.computeControlLaw()); // 40 ms pass
    }
    //! [Loop]
    for (const vpFeaturePoint &goal : pd) {
      draw(picture, goal, vpColor::black, true);
    }
    vpFont(20).drawText(picture, "Way of the four points to their goals (crosses), 10 s", {10, 10}, vpColor::black);
    vpImageIo::write(picture, "tutorial-ibvs-on-arm.png");
    const vpArmModel &arm = robot.getModel();
    for (int j = 0; j < arm.size(); ++j) {
      std::cout << arm.spec().joints[j].name << ": " << vpMath::deg(robot.getState().q(j)) << " deg, limits "
                << vpMath::deg(arm.lower()(j)) << " to " << vpMath::deg(arm.upper()(j)) << "\n";
    }
    const double pixels = 840. * std::sqrt(task.getError().sumSquare() / 4.);
    std::cout << "Points " << pixels << " px from their goals; " << robot.getSentence() << std::endl;
    return pixels < 2. ? EXIT_SUCCESS : EXIT_FAILURE;
  }
  catch (const vpException &e) {
    std::cerr << "tutorial-ibvs-on-arm: " << e.getStringMessage() << std::endl;
  }
  return EXIT_FAILURE;
}
