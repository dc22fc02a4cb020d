/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file design.h
 * \brief Designs of a printing machine's vision and control, their evaluation task, and the file that has both.
 */
#ifndef printExplore_design_h
#define printExplore_design_h

#include "lab/printing/vpPrintExperiment.h"

#include <array>
#include <string>
#include <vector>

namespace printExplore
{
VISP_DIRECT_USING_NAMESPACE

//! \brief Design variables.
struct Design {
  double frameRate = 1600.;                                   //!< Hz.
  unsigned int width = 160;                                   //!< Image width, px.
  unsigned int height = 100;                                  //!< Image height, px.
  double pixelSize = 4.5;                                     //!< Magnification: um on the product per px.
  double exposure = 50.;                                      //!< us.
  vpPrintController controller = vpPrintController::Observer; //!< Controller of the printing axis.
  double dropVelocity = 28.8;                                 //!< At the centres of the cells, mm/s.
  double speedUp = 1.25;                                      //!< Mean velocity between centres / dropVelocity.

  //! The camera of thesis section 7.3.1 and its velocity: 1600 Hz, 160 x 100 px, 4.5 um/px, 50 us, 4 px/frame.
  [[nodiscard]] static Design thesis(vpPrintController controller);
  [[nodiscard]] bool operator==(const Design &other) const;
  [[nodiscard]] double pixels() const { return 1. * width * height; } //!< Pixels of an image.
};

//! \brief The product, and the amount printed to evaluate a design.
struct Task {
  int cells = 40;          //!< Cells of one row.
  int runs = 2;            //!< Runs, each with different noise and product.
  double jitter = 0.;      //!< Standard deviation of a cell's position, um.
  double flex = 0.;        //!< Flexible pitch: maximum displacement of a cell, um.
  double flexPeriod = 20.; //!< Period of the flexible pitch, cells.
};

/*!
 * \brief Properties shared by all cameras. The defaults are from thesis section 7.3: 16000 px are read out in 500 us,
 * over Camera Link; the grey values are those of its product at 50 us and 4.5 um/px.
 */
struct Camera {
  double pixelRate = 32.;      //!< Readout, 1e6 px/s.
  double link = 255.;          //!< Bandwidth to the computer, 1e6 bytes/s, one byte per pixel.
  bool overlap = false;        //!< Expose the next image during readout.
  double interfaceTime = 260.; //!< Grabber, bus and output, us: gives 1.28 frames of delay for the thesis's camera.
  double dark = 60.;           //!< Grey value between the openings with #lightExposure and #lightPixel.
  double bright = 170.;        //!< Grey value of the openings with #lightExposure and #lightPixel.
  double lightExposure = 50.;  //!< us.
  double lightPixel = 4.5;     //!< um.
  double fullGrey = 240.;      //!< Maximum grey value; the lamp is dimmed accordingly.
  double noise = 4.;           //!< vpProductPatternSpec::noise.
  double blur = 3.6;           //!< Standard deviation of the optics' blur on the product, um.
};

/*!
 * \brief Computing time on one core, from benchmarks on one machine: perfPatternTracker (magnified, scaling) and
 * perfPrinting. A model, so that results do not depend on the machine running the exploration.
 */
struct Processor {
  double frame = 0.3;      //!< Tracker time per image, us.
  double cell = 0.28;      //!< Tracker time per whole cell in view, us.
  double cellPixel = 0.37; //!< Tracker time per px of the pitches of these cells, ns.
  double pid = 10.5;       //!< Motion, reference, control, trigger per frame with pid or pid-ff, us.
  double observer = 11.3;  //!< Motion, reference, control, trigger per frame with the observer, us.
  double maxLoad = 1.;     //!< Maximum load, fraction of a core.
};

//! \brief A bound on a metric of a design.
struct Requirement {
  std::string figure; //!< One of figureNames().
  double bound = 0.;  //!< Upper bound, or lower bound where more is better.
};

//! \brief Complete setup of an exploration.
struct Setup {
  std::string name = "exploration"; //!< Name in the report.
  std::vector<Design> designs;      //!< Designs in the order of the results.
  bool sampled = false;             //!< Drawn from ranges, not a full grid.
  Task task;
  Camera camera;
  Processor processor;
  double maxAcceleration = 50.; //!< Limit of the stage's drives, m/s^2, > 0.
  int minCells = 4;             //!< Minimum number of whole cells in view at any time.
  unsigned int seed = 1;        //!< Seed of samples, noise and product.
  std::vector<std::string> objectives{"landing_worst_um", "throughput_cells_per_s", "load"}; //!< Front objectives.
  std::vector<Requirement> requirements; //!< Bounds that a design must satisfy.
};

//! Name on the command line and in files: "pid", "pid-ff", "observer".
[[nodiscard]] std::string nameOf(vpPrintController controller);
//! "1600 Hz, 160 x 100 px, 4.5 um/px, 50 us, observer, 28.8 mm/s (+25 %)".
[[nodiscard]] std::string textOf(const Design &design);

//! \brief Values of a variable: a list, or a range.
struct Axis {
  std::vector<double> values; //!< Values for a grid; at least one.
  double from = 0.;           //!< Start of a range, else unused.
  double to = 0.;             //!< End of the range, > from; if equal, #values are a list.
  bool logarithmic = false;   //!< Geometric instead of arithmetic steps; from > 0.

  //! Make a list.
  [[nodiscard]] static Axis list(const std::vector<double> &values);
  //! Make a range of \e steps values, including both ends.
  [[nodiscard]] static Axis range(double from, double to, int steps, bool logarithmic);
  //! The value at a fraction 0..1: interpolated in a range, or one of a list.
  [[nodiscard]] double at(double share) const;
};

//! \brief The variables of a Design. Images and controllers are chosen from lists.
struct DesignSpace {
  Axis frameRate = Axis::list({1600.});
  std::vector<std::array<unsigned int, 2>> images{{{160, 100}}};
  Axis pixelSize = Axis::list({4.5});
  Axis exposure = Axis::list({50.});
  std::vector<vpPrintController> controllers{vpPrintController::Observer};
  Axis dropVelocity = Axis::list({28.8});
  Axis speedUp = Axis::list({1.25});

  //! Number of designs of grid().
  [[nodiscard]] double gridSize() const;
  //! Every combination; the last variable here changes fastest.
  [[nodiscard]] std::vector<Design> grid() const;
  /*!
   * Halton sequence in the bases 2, 3, 5, 7, 11, 13, 17, from its 20th point on, shifted by the seed (Cranley and
   * Patterson 1976). Any initial part fills the space evenly, so more samples only add designs.
   */
  [[nodiscard]] std::vector<Design> samples(unsigned int count, unsigned int seed) const;
};

/*!
 * Read an exploration from its JSON file; data/explore/README.md describes the format.
 * \param text : File content. \param file : File name, the prefix of every message.
 * \throw std::runtime_error naming the file, the field and the value.
 */
[[nodiscard]] Setup readSetup(const std::string &text, const std::string &file);
} // namespace printExplore

#endif
