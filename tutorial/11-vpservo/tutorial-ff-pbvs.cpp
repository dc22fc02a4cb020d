/*! \example tutorial-ff-pbvs.cpp
 * FF-PBVS as a task of ViSP, beside classical PBVS: for a free camera, and for a camera in the hand of an arm.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/core/vpExponentialMap.h>
#include <visp3/core/vpPoint.h>
#include <visp3/feedforward/vpFeedforwardTask.h>
#include <visp3/robot/vpViper850.h>
#include <visp3/visual_features/vpFeatureThetaU.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>

VISP_DIRECT_USING_NAMESPACE

namespace
{
//! [Measure]
vpServoMeasurement look(const vpHomogeneousMatrix &cMo) // an ideal camera; else a tracker gives the pose
{
  vpServoMeasurement seen;
  seen.valid = true; // false when the target was not found
  seen.cMo = cMo;
  for (int i = 0; i < 4; ++i) {
    vpPoint corner(i % 3 == 0 ? -0.08 : 0.08, i < 2 ? -0.08 : 0.08, 0.);
    corner.track(cMo);
    seen.points.push_back({corner.get_x(), corner.get_y(), corner.get_Z()});
  }
  return seen;
}
//! [Measure]
// Writes the corners, px; true if all are in a picture of 640 x 480 px.
bool write(std::ofstream &log, const vpServoMeasurement &seen)
{
  bool inside = true;
  for (const vpServoPoint &p : seen.points) {
    log << 320. + 800. * p.x << ' ' << 240. + 800. * p.y << ' ';
    inside = inside && std::abs(p.x) < 0.4 && std::abs(p.y) < 0.3;
  }
  log << std::endl;
  return inside;
}
} // namespace

int main()
{
  const vpHomogeneousMatrix cdMo(0., 0., 0.5, 0., 0., 0.), start(0.2, 0.1, 0.85, 0.2, -0.8, -0.9);
  const vpServoGoal goal{cdMo, look(cdMo).points};
  //! [PBVS]
  vpFeatureTranslation t(vpFeatureTranslation::cdMc);
  vpFeatureThetaU tu(vpFeatureThetaU::cdRc);
  vpServo pbvs;
  pbvs.setServo(vpServo::EYEINHAND_CAMERA);
  pbvs.setInteractionMatrixType(vpServo::CURRENT);
  pbvs.addFeature(t);
  pbvs.addFeature(tu);
  //! [PBVS]
  vpViper850 arm; // its kinematics
  vpMatrix eJe;
  vpHomogeneousMatrix cMe;
  arm.get_cMe(cMe);
  //! [Task]
  vpFeedforwardTask task("ff-lookat"); // for a camera that flies freely
  task.setGoal(goal);
  vpFeedforwardTask armTask("ff-lookat", vpServoGains(), vpServo::EYEINHAND_L_cVe_eJe);
  armTask.set_cVe(cMe);
  armTask.setGoal(goal);
  //! [Task]
  vpColVector q({0., -0.8, 3.3, -0.1, 1.4, 0.4});
  const vpHomogeneousMatrix fMo = arm.get_fMc(q) * start;
  vpHomogeneousMatrix cMoPbvs = start, cMo = start, cMoArm = start;
  std::ofstream log("tutorial-ff-pbvs.dat"); // of PBVS and of FF-PBVS, in turn
  bool isSeen = true, isSeenByPbvs = true;
  for (int k = 0; k < 400; ++k) { // 8 s
    isSeenByPbvs = write(log, look(cMoPbvs)) && isSeenByPbvs;
    isSeen = write(log, look(cMo)) && isSeen;
    //! [Loop]
    t.buildFrom(cdMo * cMoPbvs.inverse());
    tu.buildFrom(cdMo * cMoPbvs.inverse());
    cMoPbvs = vpExponentialMap::direct(pbvs.computeControlLaw(), 0.02).inverse() * cMoPbvs;
    cMo = vpExponentialMap::direct(task.computeControlLaw(look(cMo)), 0.02).inverse() * cMo;
    arm.get_eJe(q, eJe);
    armTask.set_eJe(eJe);
    q += 0.02 * armTask.computeControlLaw(look(cMoArm)); // joint velocities, rad/s
    cMoArm = arm.get_fMc(q).inverse() * fMo;
    //! [Loop]
  }
  pbvs.kill();
  const auto mm = [&](const auto &M) { return 1e3 * (cdMo * M.inverse()).getTranslationVector().frobeniusNorm(); };
  std::cout << "Corners: PBVS " << (isSeenByPbvs ? "kept" : "lost") << " them, FF-PBVS " << (isSeen ? "kept" : "lost")
            << " them; camera " << mm(cMo) << " mm and arm " << mm(cMoArm) << " mm from the goal" << std::endl;
  const char *const plot = R"(/usr/bin/python3 -c "
from pylab import *
pixels = loadtxt('tutorial-ff-pbvs.dat')
figure(figsize=(8, 3.3))
for k, name in enumerate(['PBVS', 'FF-PBVS']):
    subplot(1, 2, k + 1, title=name + ', px', aspect='equal', xlim=(-40, 760), ylim=(620, -40))
    gca().add_patch(Rectangle((0, 0), 640, 480, fill=False))
    for i in range(4):
        plot(pixels[k::2, 2 * i], pixels[k::2, 2 * i + 1])
savefig('tutorial-ff-pbvs.png')
")";
  const int failed = std::system(plot); // Debian's python3-matplotlib
  return failed || !isSeen || isSeenByPbvs || mm(cMo) > 1. || mm(cMoArm) > 1. ? EXIT_FAILURE : EXIT_SUCCESS;
}
