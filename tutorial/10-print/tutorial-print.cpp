/*! \example tutorial-print.cpp
 * Print on the fly on a flexible product: a drop at the centre of each cell, the camera is the only encoder.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/pattern/vpPatternTracker.h>
#include <visp3/printing/vpPrintMachine.h>
#include <visp3/rendering/vpProductPattern.h>
#include <visp3/simulation/vpXYStage.h>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>

VISP_DIRECT_USING_NAMESPACE

int main()
{
  //! [Machine]
  vpProductPatternSpec spec; // the display of the thesis, 160 x 100 px of 4.5 um; all in px and frames
  spec.flexAmplitudeX = 2.;  // cells lie up to 2 px off a regular pitch
  const vpProductPattern product(spec);
  vpXYStage stage(vpXYStageSpec::thesis()); // stick-slip friction, rises by 30 % on the way
  vpPrintMachineSpec print;                 // geometry as above; 4 px/frame at the centres of the cells, 5 on average
  print.originX = 79.5 - print.pitchX;      // first cell: one pitch before the nozzle
  print.cellsPerRow = 200;
  print.visionDelay = 1.; // frame
  print.observer.model = print.preview.model =
      print.previewAcross.model = {1., 0.02, 0.08, 0.12, 0.3}; // identified friction
  print.preview.positionGain = 0.03;
  print.preview.velocityGain = 0.7;
  print.commandsPerFrame = 4;
  vpPrintMachine machine(print);
  vpImage<unsigned char> image;
  vpPatternTracker tracker(spec.width, spec.height);
  vpPatternCell first;              // under the nozzle at the start; printing begins after it
  for (int i = -100; i <= 0; ++i) { // in slow motion the tracker learns the template of the cell
    product.render(0.5 * i, 0., 0.5, 0., 100 + i, image);
    for (const vpPatternCell &cell : tracker.process(image).cells) {
      first = std::hypot(cell.x - 79.5, cell.y - 49.5) < 8. ? cell : first;
    }
  }
  machine.reset(first.row, first.column - 1);
  //! [Machine]
  std::vector<vpPrintShot> shots;
  std::vector<vpXYStage::State> log(5, stage.state()); // ground truth, every quarter of a frame
  for (double now = 0.; now < 320.; ++now) {
    //! [Loop]
    const vpXYStage::State seen = log[log.size() - 5]; // the camera is one frame late
    product.render(seen.position[0], 0., seen.velocity[0], 0., static_cast<unsigned int>(now), image);
    const vpPatternFrame &frame = tracker.process(image);
    const vpPrintMachineOutput &out = machine.step({now, frame.cells.data(), frame.cells.size(), frame.epoch});
    shots.insert(shots.end(), out.trigger->shots.begin(), out.trigger->shots.begin() + out.trigger->shotCount);
    for (std::size_t i = 0; i < 4; ++i) {
      log.push_back(stage.step(0.25, {{out.forceX[i], out.forceY[i]}}));
    }
    //! [Loop]
  }
  double worst = 0.;                        // um
  std::ofstream list("tutorial-print.txt"); // time (frames), landing place minus centre of the cell (um)
  for (const vpPrintShot &shot : shots) {
    const vpXYStage::State &at = log[std::min(log.size() - 1, static_cast<std::size_t>(4. + 4. * shot.landTime))];
    const double x = at.position[0] + at.velocity[0] * (shot.landTime - at.time); // product position at the landing
    for (const vpPatternTruthCell &cell : product.cells(x, 0.)) {
      if (cell.row == 0 && cell.column == shot.column - first.column) {
        list << shot.landTime << ' ' << (79.5 - cell.x) * spec.pixelSize << '\n';
        worst = std::max(worst, std::fabs(79.5 - cell.x) * spec.pixelSize);
      }
    }
  }
  list.close();
  std::cout << shots.size() << " drops, the worst " << worst << " um beside the centre of its cell" << std::endl;
  const char *const plot = R"(/usr/bin/python3 -c "
from pylab import *
t, off = loadtxt('tutorial-print.txt').T
figure(figsize=(9, 4))
vlines(t, 0, off, linewidth=3, label='drops; a pixel is 4.5 um, a cell comes every 10 frames')
xlabel('time (frames)'); ylabel('landing place minus centre of the cell (um)')
ylim(-0.5, 0.5); grid(); legend(); savefig('tutorial-print.png')
")"; // Debian's python3-matplotlib
  return std::system(plot) == 0 && shots.size() >= 30 && worst < 1. ? EXIT_SUCCESS : EXIT_FAILURE;
}
