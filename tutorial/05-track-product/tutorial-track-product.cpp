/*! \example tutorial-track-product.cpp
 * Track a repetitive product: its cells and its motion. Rendered images, with dirt, are compared with the ground truth.
 * Usage: tutorial-track-product [IMAGES], a sequence of 8 bits or a video for vpVideoReader, such as frames/%06d.png
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/core/vpFont.h>
#include <visp3/core/vpImageDraw.h>
#include <visp3/io/vpImageIo.h>
#include <visp3/io/vpVideoReader.h>
#include <visp3/pattern/vpPatternTracker.h>
#include <visp3/rendering/vpProductPattern.h>
#include <cmath>
#include <iostream>

VISP_DIRECT_USING_NAMESPACE

namespace
{
//! [Product]
vpProductPattern dirtyProduct()
{
  vpProductPatternSpec spec; // the display of the thesis; lengths in px
  spec.width = 240;
  spec.height = 120;
  spec.rotation = vpMath::rad(1.5);
  spec.flexAmplitudeX = 1.; // the pitch varies
  spec.jitter = 0.2;
  spec.noise = 4.;
  spec.dust = 5.;     // specks per 100 x 100 px
  spec.missing = 0.1; // fraction of all cells
  return vpProductPattern(spec);
}
//! [Product]
// Blue: measured cell, with row and column. Red: expected position of a cell that was not measured.
void drawCells(const vpImage<unsigned char> &image, const vpPatternFrame &frame, const std::string &file)
{
  const unsigned int zoom = 5;
  vpImage<vpRGBa> picture(zoom * image.getHeight(), zoom * image.getWidth());
  for (unsigned int i = 0; i < picture.getSize(); ++i) {
    const unsigned char grey = image[i / picture.getWidth() / zoom][i % picture.getWidth() / zoom];
    picture.bitmap[i] = vpRGBa(grey, grey, grey);
  }
  const vpFont font(18);
  for (const vpPatternCell &cell : frame.cells) {
    const vpImagePoint centre(zoom * (cell.y + 0.5), zoom * (cell.x + 0.5)); // pixel (0, 0) is centred at 0
    const std::string name = std::to_string(cell.row) + ", " + std::to_string(cell.column);
    vpImageDraw::drawCross(picture, centre, 30, cell.valid ? vpColor::blue : vpColor::red, 2);
    font.drawText(picture, name, centre + vpImagePoint(10, 10), cell.valid ? vpColor::blue : vpColor::red);
  }
  vpImageIo::write(picture, file);
}
} // namespace

int main(int argc, char **argv)
{
  try {
    const vpProductPattern product = dirtyProduct();
    vpImage<unsigned char> image;
    vpVideoReader reader;
    if (argc > 1) {
      reader.setFileName(argv[1]);
    }
    argc > 1 ? reader.open(image) : product.render(0., 0., 0., 0., 0, image);
    //! [Track]
    vpPatternTracker tracker(image.getWidth(), image.getHeight()); // learns lattice and template from the images
    double moved = 0., truth = 0.;                                 // px
    int tracked = 0, otherSize = 0;
    for (unsigned int i = 0; argc > 1 ? !reader.end() : i < 300; ++i) {
      truth = 5. * i + 10. * std::sin(0.1 * i);
      argc > 1 ? reader.acquire(image) : product.render(truth, 0., 5. + std::cos(0.1 * i), 0., i, image);
      const vpPatternFrame &frame = tracker.process(image);
      moved += frame.hasMotion ? frame.dx : 0.; // since the previous image
      tracked += frame.status == vpPatternStatus::Tracking ? 1 : 0;
      otherSize += frame.reason == vpPatternReason::WrongSize ? 1 : 0;
    }
    //! [Track]
    const vpPatternFrame &last = tracker.frame();
    drawCells(image, last, "tutorial-track-product.png");
    std::cout << "Pitch " << last.lattice.columnPitch() << " x " << last.lattice.rowPitch() << " px, " << tracked
              << " of " << last.index + 1 << " images tracked, moved by " << moved << " px. " << last.message()
              << (otherSize > 0 ? " Left out: " + std::to_string(otherSize) + " of another size." : "") << std::endl;
    if (argc > 1) {
      return tracked > 0 ? EXIT_SUCCESS : EXIT_FAILURE;
    }
    double worst = 0.; // distance of a measured cell from the nearest true one, px
    for (const vpPatternCell &cell : last.cells) {
      double least = cell.valid ? HUGE_VAL : 0.;
      for (const vpPatternTruthCell &there : product.cells(truth, 0.)) {
        least = std::min(least, std::hypot(cell.x - there.x, cell.y - there.y));
      }
      worst = std::max(worst, least);
    }
    std::cout << "Truly moved by " << truth << " px; worst cell in the last image " << worst << " px off" << std::endl;
    return tracked > 200 && std::fabs(moved - truth) < 1. && worst < 0.2 ? EXIT_SUCCESS : EXIT_FAILURE;
  }
  catch (const std::exception &e) {
    std::cerr << "tutorial-track-product: " << (argc > 1 ? argv[1] : "") << " as %d.png or video: " << e.what() << "\n";
  }
  return EXIT_FAILURE;
}
