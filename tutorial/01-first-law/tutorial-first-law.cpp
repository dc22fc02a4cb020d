/*! \example tutorial-first-law.cpp
 * From pixels to a servo law: a camera detects a photograph in its images and moves to its desired pose.
 * Usage: tutorial-first-law [LAW], one of the ids listed by vpServoLaw::ids()
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/core/vpFont.h>
#include <visp3/core/vpImageConvert.h>
#include <visp3/core/vpImageDraw.h>
#include <visp3/core/vpMeterPixelConversion.h>
#include <visp3/feedforward/vpServoLaw.h>
#include <visp3/io/vpImageIo.h>
#include <visp3/planar_target/vpPlanarTarget.h>
#include <visp3/rendering/vpPlaneRenderer.h>
#include <visp3/robot/vpSimulatorCamera.h>
#include <visp3/servoing/vpServoTarget.h>

#include <iostream>

VISP_DIRECT_USING_NAMESPACE

namespace
{
const vpCameraParameters camera(800., 800., 319.5, 239.5); // for images of 640 x 480 pixels

void drawOutline(vpImage<vpRGBa> &picture, const std::vector<vpServoPoint> &corners, const vpColor &color,
                 unsigned int wide)
{
  std::vector<vpImagePoint> pixels(corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    vpMeterPixelConversion::convertPoint(camera, corners[i].x, corners[i].y, pixels[i]);
  }
  vpImageDraw::drawPolygon(picture, pixels, color, wide);
}
} // namespace

int main(int argc, char **argv)
{
  try {
    //! [Target]
    vpImage<unsigned char> photo, image;
    vpImageIo::read(photo, VISP_DIRECT_DATA_DIR "/target/klimt.jpg");
    const double w = 0.16, h = w * photo.getHeight() / photo.getWidth(); // m, from edge to edge
    vpPlanarTarget target(photo, w, h, camera);
    //! [Target]

    //! [Law]
    const vpServoTarget plate = vpServoTarget::rectangle(w, h);                        // laws also use its corners
    const vpServoGoal goal = plate.goal(vpHomogeneousMatrix(0., 0., 0.4, 0., 0., 0.)); // straight ahead, 0.4 m away
    const auto law = vpServoLaw::create(argc > 1 ? argv[1] : "ff-lookat");
    law->setGoal(goal);
    //! [Law]
    //! [Robot]
    vpSimulatorCamera robot; // the world is the photograph, so wMc is the inverse of cMo
    robot.setPosition(vpHomogeneousMatrix(0.12, -0.05, 0.7, 0.35, -0.45, 0.5).inverse());
    robot.setSamplingTime(0.05); // s
    robot.setRobotState(vpRobot::STATE_VELOCITY_CONTROL);
    vpPlaneRenderer view(photo, w, h, camera, 640, 480); // replaces a real camera
    //! [Robot]
    //! [Loop]
    vpImage<vpRGBa> panel, picture(480, 1280); // first image beside the last one
    vpServoMeasurement seen;
    vpServoCommand command{vpTwist(), vpServoStatus::Holding};
    for (int k = 0; k < 160 && vpIsWorking(command.status); ++k) { // an error ends the loop
      view.render(robot.getPosition().inverse(), {}, 1, image);
      plate.measure(target.process(image), 0.05 * k, seen);
      command = law->step(seen, 0.05); // zero twist and Holding if the photograph was not found
      robot.setVelocity(vpRobot::CAMERA_FRAME, vpLimitTwist(command.v, 0.2, 0.7).toColVector()); // m/s, rad/s
      //! [Loop]
      vpImageConvert::convert(image, panel);
      drawOutline(panel, goal.points, vpColor::blue, 6);
      drawOutline(panel, seen.points, vpColor::yellow, 2);
      picture.insert(panel, vpImagePoint(0, k == 0 ? 0 : 640));
    }
    vpFont(24).drawText(picture, "First image: yellow found, blue goal", vpImagePoint(8, 8), vpColor::black);
    vpFont(24).drawText(picture, "Last image, 8 s later", vpImagePoint(8, 648), vpColor::black);
    vpImageIo::write(picture, "tutorial-first-law.png");
    const vpHomogeneousMatrix cdMc = goal.cdMo * robot.getPosition();
    const double mm = 1000. * cdMc.getTranslationVector().frobeniusNorm();
    const double degrees = vpMath::deg(cdMc.getThetaUVector().getTheta());
    std::cout << law->id() << ": " << mm << " mm and " << degrees << " deg from the goal" << std::endl;
    return mm < 1. && degrees < 0.1 ? EXIT_SUCCESS : EXIT_FAILURE;
  }
  catch (const vpException &e) {
    std::cerr << "tutorial-first-law: " << e.getStringMessage() << std::endl;
  }
  return EXIT_FAILURE;
}
