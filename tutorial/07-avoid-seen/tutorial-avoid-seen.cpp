/*! \example tutorial-avoid-seen.cpp
 * The eye-in-hand camera detects a box by its photograph, and the arm avoids it; with a covered camera it hits the box.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/avoidance/vpCollisionSceneJson.h>
#include <visp3/avoidance/vpDirectTrajectoryAvoidance.h>
#include <visp3/avoidance/vpObstacleDetector.h>
#include <visp3/core/vpFont.h>
#include <visp3/core/vpImageConvert.h>
#include <visp3/core/vpImageDraw.h>
#include <visp3/io/vpImageIo.h>
#include <visp3/manipulator/vpArmJson.h>
#include <visp3/rendering/vpSceneCamera.h>

#include <iostream>

VISP_DIRECT_USING_NAMESPACE

namespace
{
// Position in the right half of the figure, from above, 1 mm per pixel.
vpImagePoint fromAbove(double x, double y) { return vpImagePoint(460. - 1000. * (y - 0.4), 900. + 1000. * x); }

// Moves to the goal and draws: the camera view on the left, the box and the tool path on the right.
double drive(bool isCovered, vpImage<vpRGBa> &picture)
{
  //! [World]
  const vpArmModel arm = vpLoadArmJson(VISP_DIRECT_DATA_DIR "/robot/amor.json");
  vpCollisionSceneFile file = vpLoadCollisionScene(VISP_DIRECT_DATA_DIR "/scene/photo-box.json");
  const vpCollisionScene truth(arm, file.spec);
  vpSceneCameraSpec view; // a simulated camera; the box carries a photograph of 16 x 11 cm
  view.photos = {{truth.object(0).name, {}, truth.object(0).shape.size().head<2>()}};
  vpImageIo::read(view.photos[0].image, VISP_DIRECT_DATA_DIR "/target/box.png");
  vpSceneCamera camera(view);
  //! [World]
  //! [See]
  vpPlanarTargetDatabase targets(view.camera, vpObstacleDetector::fastTargets());
  targets.add("box", view.photos[0].image, 0.16, 0.11012, 0.06); // width, height and depth, m
  vpObstacleDetector detector(std::move(targets), view.camera);
  vpObjectTracks tracks(vpObjectTrackSpec{0.1, 0.2}); // slow objects: m/s^2, rad/s^2
  file.spec.objects.clear();                          // the arm does not know where the box is
  vpCollisionScene known(arm, file.spec);
  vpDirectTrajectoryAvoidanceSpec spec; // via positions beside the obstacle; 0.5 m/s, 1 m/s^2, 10 mm of margin
  spec.keepOrientation = true;          // the camera keeps its viewing direction
  vpDirectTrajectoryAvoidance method(known, spec);
  vpJointVector q = file.tasks[0].start;
  method.start(q, vpAvoidanceGoal::at(arm, file.tasks[0].goal));
  //! [See]
  double least = 1.; // true clearance, m
  vpAvoidanceOutput output;
  vpCollisionData data;
  vpImage<unsigned char> image;
  for (int cycle = 0; cycle < 1000 && (cycle == 0 || vpIsWorking(output)); ++cycle) {
    truth.place(q, data);
    least = std::min(least, truth.clearance(data).distance);
    const vpImagePoint tool = fromAbove(data.arm.tool.p.x(), data.arm.tool.p.y());
    vpImageDraw::drawPoint(picture, tool, isCovered ? vpColor::red : vpColor::blue, 5);
    //! [Loop]
    if (cycle % 8 == 0 && !isCovered) { // 25 images per second
      const vpRigidTransform fMc = vpArmKinematics::camera(arm, data.arm);
      camera.picture(truth, fMc, {}, 1, image);
      for (const vpObstacleDetection &detection : detector.process(image, fMc, 0.005 * cycle)) {
        detection.seen &&tracks.add(detection.sighting); // else detection.message explains why
      }
      tracks.advance(0.005 * cycle);
      tracks.applyTo(known);
      method.look();
    }
    method.step(q, output);
    q += 0.005 * output.velocity; // ideal robot
    //! [Loop]
    if (cycle == 80 && !isCovered) {
      vpImage<vpRGBa> seen;
      vpImageConvert::convert(image, seen);
      const auto &corners = detector.targets()[0].result.corners;
      vpImageDraw::drawPolygon(seen, {corners.begin(), corners.end()}, vpColor::yellow, 3);
      picture.insert(seen, vpImagePoint(0, 0));
    }
  }
  return output.status == vpAvoidanceStatus::Arrived ? least : NAN;
}
} // namespace

int main()
{
  try {
    vpImage<vpRGBa> picture(480, 1280, vpRGBa(255, 255, 255));
    vpImageDraw::drawRectangle(picture, vpRect(fromAbove(-0.05, 0.7), fromAbove(0.11, 0.64)), vpColor::orange, true);
    const double covered = drive(true, picture), seeing = drive(false, picture);
    vpFont(20).drawText(picture, "Camera in the hand, after 0.4 s", {8, 8}, vpColor::black, vpColor::white);
    vpFont(20).drawText(picture, "Tool and box from above: red covered, blue seeing", {8, 660}, vpColor::black);
    vpImageIo::write(picture, "tutorial-avoid-seen.png");
    std::cout << "Least clearance " << 1000. * seeing << " mm, covered " << 1000. * covered << " mm" << std::endl;
    return covered < 0. && seeing > 0.01 ? EXIT_SUCCESS : EXIT_FAILURE;
  }
  catch (const vpException &e) {
    std::cerr << "tutorial-avoid-seen: " << e.getStringMessage() << std::endl;
  }
  return EXIT_FAILURE;
}
