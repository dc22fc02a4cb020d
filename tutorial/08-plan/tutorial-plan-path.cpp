/*! \example tutorial-plan-path.cpp
 * Plan a motion among obstacles, certify it, time it, and execute it under a supervisor.
 * Usage: tutorial-plan-path [SCENE.json]
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/avoidance/vpCollisionSceneJson.h>
#include <visp3/avoidance/vpPathPlanner.h>
#include <visp3/avoidance/vpStopSupervisor.h>
#include <visp3/avoidance/vpTimedPath.h>
#include <visp3/core/vpFont.h>
#include <visp3/core/vpImageDraw.h>
#include <visp3/io/vpImageIo.h>
#include <visp3/manipulator/vpArmJson.h>

#include <iostream>

VISP_DIRECT_USING_NAMESPACE

namespace
{
// View from the right (y, z) in the left half of the figure, from above (y, x) in the right half; 4 mm per pixel.
void drawLine(vpImage<vpRGBa> &I, const Eigen::Vector3d &a, const Eigen::Vector3d &b, const vpColor &color)
{
  const auto right = [](const Eigen::Vector3d &p) { return vpImagePoint(330. - 250. * p.z(), 110. + 250. * p.y()); };
  const auto above = [](const Eigen::Vector3d &p) { return vpImagePoint(250. - 250. * p.x(), 530. + 250. * p.y()); };
  vpImageDraw::drawLine(I, right(a), right(b), color);
  vpImageDraw::drawLine(I, above(a), above(b), color);
}
void drawBoxes(vpImage<vpRGBa> &I, const vpCollisionScene &scene)
{
  for (int i = 0; i < scene.objectCount(); ++i) {
    const vpCollisionObject &box = scene.object(i);
    const auto corner = [&box](int c) -> Eigen::Vector3d {
      const Eigen::Vector3d sign(c & 1 ? 0.5 : -0.5, c & 2 ? 0.5 : -0.5, c & 4 ? 0.5 : -0.5);
      return box.pose.p + box.pose.R * sign.cwiseProduct(box.shape.size());
    };
    for (int c = 0; c < 8; ++c) {
      for (const int axis : {1, 2, 4}) {
        drawLine(I, corner(c), corner(c ^ axis), vpColor::darkRed);
      }
    }
  }
}
} // namespace
int main(int argc, char **argv)
{
  try {
    //! [Scene]
    const vpArmModel arm = vpLoadArmJson(VISP_DIRECT_DATA_DIR "/robot/amor.json");
    const auto file = vpLoadCollisionScene(argc > 1 ? argv[1] : VISP_DIRECT_DATA_DIR "/scene/s4b-shelf.json");
    const vpCollisionScene scene(arm, file.spec);
    if (file.tasks.empty()) {
      throw vpException(vpException::badValue, "%s has no tasks", file.spec.source.c_str());
    }
    //! [Scene]
    //! [Plan]
    vpPathPlanner planner(scene); // RRT-Connect with certified motions
    const vpPathResult found = planner.plan(file.tasks.back().start, file.tasks.back().goal);
    std::cout << found.message << " " << found.path.points.size() << " points, " << found.path.length() << " rad, "
              << found.motions << " motions checked" << std::endl;
    if (found.status != vpPathStatus::Solved) {
      return EXIT_FAILURE; // the sentence explains why
    }
    const vpTimedPath motion(scene, found.path);
    std::cout << motion.message(scene) << std::endl;
    //! [Plan]
    //! [Drive]
    vpImage<vpRGBa> picture(500, 860, vpRGBa(255, 255, 255));
    drawBoxes(picture, scene);
    vpStopSupervisor supervisor(scene, {0.005, 0.}); // every 5 ms; margin 0: the plan has its own
    vpSupervisedVelocity command;
    vpCollisionData data;
    vpJointVector q = file.tasks.back().start, wish(arm.size());
    double least = 1.;
    int slowed = 0;
    for (int cycle = 0; cycle * 0.005 < motion.duration(); ++cycle) {
      for (int j = 0; j < arm.size(); ++j) { // towards the plan's position after this period
        wish(j) = (motion.at(j, (cycle + 1) * 0.005)[0] - q(j)) / 0.005;
      }
      supervisor.step(q, wish, command); // on a real robot, update the obstacles first
      slowed += command.status == vpSupervision::Passed ? 0 : 1;
      q += 0.005 * command.velocity;
      scene.place(q, data);
      least = std::min(least, scene.clearance(data).distance);
      for (int i = 0; cycle % 25 == 0 && i < scene.capsuleCount(); ++i) {
        drawLine(picture, data.capsules[i].from, data.capsules[i].to, vpColor::blue);
      }
    }
    //! [Drive]
    vpFont(18).drawText(picture, "Arm every 0.125 s, obstacles; from the right and from above", {10, 10},
                        vpColor::black);
    vpImageIo::write(picture, "tutorial-plan-path.png");
    std::cout << "Least clearance " << 1000. * least << " mm, " << slowed << " periods slowed down" << std::endl;
    return least > 0. && slowed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
  }
  catch (const vpException &e) {
    std::cerr << "tutorial-plan-path: " << e.getStringMessage() << std::endl;
  }
  return EXIT_FAILURE;
}
