/*! \example tutorial-ibvs-on-arm.cpp
 * Image-based visual servoing of four points, as in ViSP's tutorial-ibvs-4pts.cpp, with an arm in the place of the free
 * camera. Usage: tutorial-ibvs-on-arm [ARM.json | ARM.urdf TIP CAMERA]
 */
#include <visp3/core/vpCameraParameters.h>
#include <visp3/core/vpImageDraw.h>
#include <visp3/core/vpMeterPixelConversion.h>
#include <visp3/core/vpPoint.h>
#include <visp3/io/vpImageIo.h>
#include <visp3/manipulator/vpArmJson.h>
#include <visp3/manipulator/vpArmUrdf.h>
#include <visp3/simulation/vpSimulatedArm.h>
#include <visp3/visual_features/vpFeatureBuilder.h>
#include <visp3/visual_features/vpFeaturePoint.h>
#include <visp3/vs/vpServo.h>

#include <iostream>

VISP_DIRECT_USING_NAMESPACE

namespace
{
vpArmModel loadArm(int argc, char **argv)
{
  if (argc == 4) { // a URDF names neither the camera nor accelerations
    vpArmUrdfOptions options;
    options.tip = argv[2];
    options.camera = argv[3];
    options.acceleration = 10.;
    return vpLoadArmUrdf(argv[1], options);
  }
  return vpLoadArmJson(argc > 1 ? argv[1] : VISP_DIRECT_DATA_DIR "/robot/amor.json");
}
} // namespace

int main(int argc, char **argv)
{
  try {
    //! [Robot]
    vpSimulatedArmSpec spec; // torques, friction that sticks, 5 ms control; spec.drives.ideal = true for a perfect arm
    spec.indices = {vpSelfMotionIndex::jointLimits(), vpSelfMotionIndex::manipulability()};
    vpSimulatedArm robot(loadArm(argc, argv), spec);
    robot.setSamplingTime(0.040);
    robot.setRobotState(vpRobot::STATE_VELOCITY_CONTROL);
    //! [Robot]

    //! [Task]
    const vpHomogeneousMatrix cdMo(0, 0, 0.35, 0, 0, 0);
    const vpHomogeneousMatrix cMo(0.07, 0.05, 0.45, vpMath::rad(10), vpMath::rad(-10), vpMath::rad(25));
    vpPoint point[4] = {vpPoint(-0.05, -0.05, 0), vpPoint(0.05, -0.05, 0), vpPoint(0.05, 0.05, 0),
                        vpPoint(-0.05, 0.05, 0)};
    vpServo task;
    task.setServo(vpServo::EYEINHAND_CAMERA);
    task.setInteractionMatrixType(vpServo::CURRENT);
    task.setLambda(0.8);
    vpFeaturePoint p[4], pd[4];
    for (unsigned int i = 0; i < 4; ++i) {
      point[i].track(cdMo);
      vpFeatureBuilder::create(pd[i], point[i]);
      point[i].track(cMo);
      vpFeatureBuilder::create(p[i], point[i]);
      task.addFeature(p[i], pd[i]);
    }
    //! [Task]

    //! [Loop]
    const vpCameraParameters cam(840, 840, 320, 240);
    vpImage<vpRGBa> picture(480, 640, vpRGBa(255, 255, 255));
    const vpHomogeneousMatrix fMo = robot.get_fMc() * cMo; // the object stands still
    for (unsigned int iter = 0; iter < 250; ++iter) {
      const vpHomogeneousMatrix cMoNow = robot.get_fMc().inverse() * fMo;
      for (unsigned int i = 0; i < 4; ++i) {
        point[i].track(cMoNow);
        vpFeatureBuilder::create(p[i], point[i]);
        vpImagePoint ip;
        vpMeterPixelConversion::convertPoint(cam, p[i].get_x(), p[i].get_y(), ip);
        vpImageDraw::drawPoint(picture, ip, vpColor::getColor(i), 3);
      }
      robot.setVelocity(vpRobot::CAMERA_FRAME, task.computeControlLaw()); // 40 ms pass
    }
    //! [Loop]
    for (unsigned int i = 0; i < 4; ++i) {
      vpImagePoint ip;
      vpMeterPixelConversion::convertPoint(cam, pd[i].get_x(), pd[i].get_y(), ip);
      vpImageDraw::drawCross(picture, ip, 15, vpColor::black, 2);
    }
    vpImageIo::write(picture, "tutorial-ibvs-on-arm.png");

    const double pixels = 840. * std::sqrt(task.getError().sumSquare() / 4.);
    const vpSimulatedArmState state = robot.getState();
    std::cout << "Points " << pixels << " px from their goals after " << state.time << " s; " << robot.getSentence()
              << "\nJoints (deg): " << (state.q * 180. / M_PI).transpose() << std::endl;
    return pixels < 2. ? EXIT_SUCCESS : EXIT_FAILURE;
  }
  catch (const vpException &e) {
    std::cerr << "tutorial-ibvs-on-arm: " << e.getStringMessage() << std::endl;
    return EXIT_FAILURE;
  }
}
