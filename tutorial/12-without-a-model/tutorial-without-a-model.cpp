/*! \example tutorial-without-a-model.cpp
 * Visual servoing to where one image was taken: neither the object's size nor its distance nor the goal's pose is
 * given. SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/core/vpFont.h>
#include <visp3/core/vpImageConvert.h>
#include <visp3/core/vpImageDraw.h>
#include <visp3/io/vpImageIo.h>
#include <visp3/planar_target/vpTwoViewDecomposition.h>
#include <visp3/rendering/vpPlaneRenderer.h>
#include <visp3/robot/vpSimulatorCamera.h>
#include <visp3/servoing/vpReferenceTeacher.h>
#include <visp3/servoing/vpReferenceVision.h>
#include <visp3/servoing/vpVisualServo.h>

#include <iostream>
#include <memory>

VISP_DIRECT_USING_NAMESPACE

namespace
{
void addPanel(vpImage<vpRGBa> &picture, unsigned int left, const vpImage<unsigned char> &image, const std::string &text,
              const vpPlaneTrack &track)
{
  vpImage<vpRGBa> panel;
  vpImageConvert::convert(image, panel);
  for (std::size_t i = 0; i < track.points.size(); ++i) {
    if (track.visible[i]) {
      vpImageDraw::drawCross(panel, track.points[i], 12, vpColor::yellow, 2);
    }
  }
  vpFont(24).drawText(panel, text, vpImagePoint(8, 8), vpColor::black);
  picture.insert(panel, vpImagePoint(0, left));
}
} // namespace

int main()
{
  try {
    const vpCameraParameters camera(800., 800., 319.5, 239.5);
    vpImage<unsigned char> photo, image;
    vpImageIo::read(photo, VISP_DIRECT_DATA_DIR "/target/klimt.jpg");
    vpPlaneRenderer view(photo, 0.16, 0.16, camera, 640, 480); // the real world, of which the servo is told nothing
    const vpHomogeneousMatrix cdMo(0.02, 0.01, 0.45, 0.25, -0.2, 0.1);
    const vpCameraFaults faults{3.}; // noise, grey levels
    //! [Teach]
    vpReferenceTeacher teacher; // 25 images of the camera at rest where it shall return to
    for (unsigned int k = 0; !teacher.isComplete(); ++k) {
      view.render(cdMo, faults, k, image);
      teacher.add(image);
    }
    const vpImage<unsigned char> reference = teacher.image(); // a PNG file keeps it
    //! [Teach]
    vpSimulatorCamera robot;
    robot.setPosition(vpHomogeneousMatrix(0.08, -0.04, 0.7, 0.35, -0.45, 0.7).inverse());
    robot.setSamplingTime(0.05); // s
    robot.setRobotState(vpRobot::STATE_VELOCITY_CONTROL);
    //! [Homography]
    view.render(robot.getPosition().inverse(), faults, 100, image);
    const vpPlaneMatch match = vpPlaneMatcher(reference).match(image);
    const vpHomography cHr = match.euclidean(camera); // from the reference image to this one, up to scale
    const vpTwoViewResult motions = vpTwoViewDecomposition().process(cHr, match.referencePoints(camera));
    std::cout << match.message << " " << motions.message << std::endl;
    //! [Homography]
    //! [Servo]
    vpReferenceVisionSpec spec;
    spec.pose.nearest = 0.2; // m; all that is stated about the distance
    spec.pose.farthest = 1.2;
    auto owned = std::make_unique<vpReferenceVision>(reference, camera, spec);
    const vpReferenceVision &vision = *owned;
    vpVisualServo servo(vpServoController::create("ff-lookat"), {0.05}); // period, s
    servo.setVision(std::move(owned));
    servo.start();
    //! [Servo]
    vpImage<vpRGBa> picture(480, 1920);
    addPanel(picture, 0, reference, "Reference image", {});
    //! [Loop]
    for (int k = 0; k < 240 && !servo.isConverged(); ++k) {
      vpServoRobotState state;
      state.pose = vpRigidTransform::fromHomogeneous(robot.getPosition()); // the robot's own measurement
      const vpTwist twist = servo.step(state, 0.05 * k).twist;
      view.render(robot.getPosition().inverse(), faults, 200 + k, image);
      servo.see(image, 0.05 * k);
      robot.setVelocity(vpRobot::CAMERA_FRAME, twist.toColVector());
      std::cout << (k % 20 == 0 ? vision.message() + "\n" : "");
      //! [Loop]
      addPanel(picture, k == 0 ? 640 : 1280, image, k == 0 ? "First image" : "Last image", vision.track());
    }
    vpImageIo::write(picture, "tutorial-without-a-model.png");
    const vpHomogeneousMatrix cdMc = cdMo * robot.getPosition();
    const double mm = 1000. * cdMc.getTranslationVector().frobeniusNorm();
    const double degrees = vpMath::deg(cdMc.getThetaUVector().getTheta());
    std::cout << mm << " mm and " << degrees << " deg from where the reference image was taken" << std::endl;
    return mm < 3. && degrees < 0.5 ? EXIT_SUCCESS : EXIT_FAILURE;
  }
  catch (const vpException &e) {
    std::cerr << "tutorial-without-a-model: " << e.getStringMessage() << std::endl;
  }
  return EXIT_FAILURE;
}
