/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file design.h
 * \brief A design of a printing machine's vision and control, and what to evaluate it for.
 */
#ifndef printExplore_design_h
#define printExplore_design_h

#include "lab/printing/vpPrintExperiment.h"

#include <map>
#include <string>
#include <vector>

namespace printExplore
{
VISP_DIRECT_USING_NAMESPACE

//! \brief What a designer may choose.
struct Design {
  double frameRate = 1600.;                                   //!< Hz.
  unsigned int width = 160;                                   //!< Of the image, px.
  unsigned int height = 100;                                  //!< Of the image, px.
  double pixelSize = 4.5;                                     //!< Magnification: um on the product per px.
  double exposure = 50.;                                      //!< us.
  vpPrintController controller = vpPrintController::Observer; //!< Of the axis of printing.
  double dropVelocity = 28.8;                                 //!< At the centres of the cells, mm/s.
  double speedUp = 1.25;                                      //!< Mean velocity between centres over dropVelocity.

  //! The camera of thesis section 7.3.1 and its velocity: 1600 Hz, 160 x 100 px, 4.5 um/px, 50 us, 4 px/frame.
  [[nodiscard]] static Design thesis(vpPrintController controller);
  [[nodiscard]] bool operator==(const Design &other) const;
  [[nodiscard]] double pixels() const { return 1. * width * height; } //!< Of an image.
};

//! \brief The product, and how much of it is printed to judge a design.
struct Task {
  int cells = 40;          //!< Of one row.
  int runs = 2;            //!< With other noise and another product each.
  double jitter = 0.;      //!< Standard deviation of a cell's place, um.
  double flex = 0.;        //!< Flexible pitch: cells lie up to this far off, um.
  double flexPeriod = 20.; //!< Over so many cells.
};

/*!
 * \brief What all cameras have in common. The defaults are thesis section 7.3: 16000 px are read out in 500 us, over Camera
 * Link; the grey values are those of its product at 50 us and 4.5 um/px.
 */
struct Camera {
  double pixelRate = 32.;      //!< Readout, 1e6 px/s.
  double link = 255.;          //!< Bandwidth to the computer, 1e6 bytes/s, a byte a pixel.
  bool overlap = false;        //!< The next image is exposed while this one is read out.
  double interfaceTime = 260.; //!< Grabber, bus and output, us: with it the thesis's camera is 1.28 frames late.
  double dark = 60.;           //!< Grey value between the openings with #lightExposure and #lightPixel.
  double bright = 170.;        //!< Grey value of the openings, likewise.
  double lightExposure = 50.;  //!< us.
  double lightPixel = 4.5;     //!< um.
  double fullGrey = 240.;      //!< The lamp is dimmed so that nothing is brighter.
  double noise = 4.;           //!< vpProductPatternSpec::noise.
  double blur = 3.6;           //!< Standard deviation of the optics' blur on the product, um.
};

/*!
 * \brief Cost of computing on one core, from benchmarks on one machine: perfPatternTracker (magnified, scaling) and
 * perfPrinting. A model, so that results do not depend on the machine that explores.
 */
struct Processor {
  double frame = 0.3;      //!< Of the tracker per image, us.
  double cell = 0.28;      //!< Of the tracker per whole cell in view, us.
  double cellPixel = 0.37; //!< Of the tracker per px of the pitches of these cells, ns.
  double pid = 10.5;       //!< Motion, reference, control, trigger per frame with pid or pid-ff, us.
  double observer = 11.3;  //!< The same with the observer, us.
  double maxLoad = 1.;     //!< Share of a core that is allowed.
};

//! \brief A bound on a figure of a design.
struct Requirement {
  std::string figure; //!< One of figureNames().
  double bound = 0.;  //!< At most, or at least where more is better.
};

//! \brief All that an exploration is made of.
struct Setup {
  std::string name = "exploration"; //!< For the report.
  std::vector<Design> designs;      //!< In the order of the results.
  bool sampled = false;             //!< Drawn from ranges, not a full grid.
  Task task;
  Camera camera;
  Processor processor;
  double maxAcceleration = 50.; //!< Of the stage's drives, m/s^2, > 0.
  int minCells = 4;             //!< Whole cells that must be in view at any time.
  unsigned int seed = 1;        //!< Of samples, noise and product.
  std::vector<std::string> objectives{"landing_worst_um", "throughput_cells_per_s", "load"}; //!< Of the front.
  std::vector<Requirement> requirements; //!< What a design must keep.
};

//! Name on the command line and in files: "pid", "pid-ff", "observer".
[[nodiscard]] std::string nameOf(vpPrintController controller);
//! "1600 Hz, 160 x 100 px, 4.5 um/px, 50 us, observer, 28.8 mm/s (+25 %)".
[[nodiscard]] std::string textOf(const Design &design);
} // namespace printExplore

#endif
