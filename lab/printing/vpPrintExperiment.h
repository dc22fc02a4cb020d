/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPrintExperiment.h
 * \brief Printing on the fly in a closed loop: product -> camera -> estimate -> reference -> control -> stage -> drops.
 */
#ifndef vpPrintExperiment_h
#define vpPrintExperiment_h

#include <visp3/printing/vpPrintMachine.h>
#include <visp3/rendering/vpProductPatternSpec.h>
#include <visp3/simulation/vpXYStage.h>

#include <functional>
#include <string>
#include <vector>

BEGIN_VISP_NAMESPACE

//! \brief Where the cells are measured.
enum class vpPrintSensor {
  Model, //!< True places plus normal errors: fast.
  Image  //!< Rendered pictures through vpPatternTracker.
};

/*!
 * \brief Errors of a sensor in px. Errors of the cells of a frame have a part in common: the mean over all cells has the
 * standard deviation sigma / sqrt(effectiveCells).
 */
struct vpPrintSensorModel {
  double sigmaX = 0.18;       //!< Of a cell, px, > 0.
  double sigmaY = 0.035;      //!< Of a cell, px, > 0.
  double effectiveCells = 2.; //!< >= 1; more than are in view count as these.

  [[nodiscard]] static vpPrintSensorModel thesis();  //!< Algorithm 7.4: 0.18 and 0.035 px, 2 effective cells.
  [[nodiscard]] static vpPrintSensorModel tracker(); //!< vpPatternTracker: 0.0153 and 0.0078 px, 10 effective cells.
};

/*!
 * \brief What to run; all fields with the seed determine the result. Lengths px, times frames unless said. Geometry and
 * deviations of the machine (pitches, origin, nozzle, lateTolerance, sigmas) are taken from product, nozzleOffset and sensor.
 */
struct vpPrintExperimentSpec : vpPrintMachineSpec {
  vpPrintSensor sensor = vpPrintSensor::Model;                    //!< Where the cells are measured.
  vpPrintSensorModel sensorModel = vpPrintSensorModel::tracker(); //!< Errors; for Image what the estimators expect.
  vpXYStageSpec stage = vpXYStageSpec::thesis();                  //!< The plant.
  vpProductPatternSpec product;                                   //!< The product and, for Image, how it looks.
  double captureJitter = 0.; //!< Standard deviation of the instant of exposure; nobody is told, frame, >= 0.
  double dropped = 0.;       //!< Share of frames that never arrive, 0..0.5.
  double nozzleOffset = 0.;  //!< Nozzle minus middle of the image, along x, px.

  int frames = 0;           //!< Stop after so many; 0: when all cells are printed.
  int evaluateFrom = 60;    //!< Velocity errors count from this frame on, >= 0.
  double frameRate = 1600.; //!< Hz, > 0: what a frame is in seconds.
  unsigned int seed = 1;    //!< Of the errors of the sensor. The product has its own.

  //! Figure 7.13: PID without feedforward, thesis's sensor, time from cell to cell 10.8 frames, 120 frames.
  [[nodiscard]] static vpPrintExperimentSpec thesisPid();
  //! Figure 7.14: PID with feedforward.
  [[nodiscard]] static vpPrintExperimentSpec thesisFeedforward();
  //! Figure 7.15: PID with a poorly tuned filter (0.80, 0.08).
  [[nodiscard]] static vpPrintExperimentSpec thesisPoorFilter();
  /*!
   * Observer and preview, velocity 4 at the centres and 5 in the mean.
   * \param sensor : Errors of the sensor; the observer is tuned to them.
   */
  [[nodiscard]] static vpPrintExperimentSpec withObserver(const vpPrintSensorModel &sensor);
  //! \throw vpException (badValue) naming the field that is out of range, and its value.
  void validate() const;
};

//! \brief A row of the log: what is true and known at a control step.
struct vpPrintSample {
  int frame = 0;                 //!< Number of the step; its time in frames.
  double x = 0.;                 //!< True displacement of the product, px to the right.
  double y = 0.;                 //!< True displacement, px down.
  double vx = 0.;                //!< True velocity, px/frame to the right.
  double vy = 0.;                //!< True velocity, px/frame down.
  double referencePosition = 0.; //!< Along x, px.
  double referenceVelocity = 0.; //!< Along x, px/frame.
  double measuredVelocity = 0.;  //!< (7.27), before any filter, along x, px/frame; late by the camera's delay.
  double estimatedVelocity = 0.; //!< What the controller uses, px/frame.
  double force = 0.;             //!< Command along x.
  int row = 0;                   //!< Being printed.
  int cells = 0;                 //!< Measured cells.
  bool dropped = false;          //!< No frame arrived.
};

//! \brief A drop and where it landed.
struct vpPrintDrop {
  int row = 0;          //!< Of the cell that it was meant for.
  int column = 0;       //!< Of that cell.
  double fireTime = 0.; //!< frame.
  double landTime = 0.; //!< frame.
  double errorX = 0.;   //!< Landing place minus true centre, um.
  double errorY = 0.;   //!< The same along y, um.
  double velocity = 0.; //!< True velocity of the product at the landing, along x, px/frame.
  bool late = false;    //!< See vpPrintShot::late.
};

//! \brief The figures of a run.
struct vpPrintMetrics {
  //! Measured velocity (before the filter, as the thesis plots it) minus the reference of the step before, rms, px/frame.
  double rms_velocity_error = 0.;
  double rms_true_velocity_error = 0.; //!< True velocity minus the reference of the same instant, rms, px/frame.
  double centre_velocity_error =
      0.; //!< |true velocity| minus dropVelocity when a cell is at the nozzle, rms, px/frame.
  double centre_velocity_worst = 0.;  //!< The largest of these.
  double landing_rms_um = 0.;         //!< Distance of the drops from the centres, rms, um.
  double landing_worst_um = 0.;       //!< The largest.
  double landed_within_10um = 0.;     //!< Share of the drops, 0..1.
  int printed = 0;                    //!< Cells with at least one drop.
  int missed = 0;                     //!< Cells that passed the nozzle without a drop.
  int doubled = 0;                    //!< Cells with more than one.
  double throughput_cells_per_s = 0.; //!< From the first to the last drop, turning included.
  //! Time at dropVelocity over the time taken, between first and last cell of the rows, minus 1.
  double gain_over_constant = 0.;
  int frames = 0;        //!< Run.
  bool complete = false; //!< All cells passed the nozzle.
};

//! \brief A finished run.
struct vpPrintRun {
  vpPrintExperimentSpec spec;         //!< What was run.
  std::vector<vpPrintSample> samples; //!< One for each frame.
  std::vector<vpPrintDrop> drops;     //!< In the order of landing.
  vpPrintMetrics metrics;             //!< The figures.
};

/*!
 * \brief Run one experiment. Row 0 is at the nozzle at the start, its first cell one pitch before it; rows are printed to and
 * fro, with one pitch to turn in while the stage steps to the next row.
 *
 * With vpPrintSensor::Image the tracker sees 120 frames of a slow motion first, to learn. Its rows and columns are numbered
 * like the product's with the help of the truth, once for each epoch; nothing else of the truth is used.
 * \param spec : Validated first. The same specification gives the same run, bit for bit.
 * \param progress : If given, called now and then with the share done, 0..1; return false to stop early.
 * \throw vpException naming the field of the specification that is out of range.
 */
[[nodiscard]] vpPrintRun runPrintExperiment(const vpPrintExperimentSpec &spec,
                                            const std::function<bool(double)> &progress = {});

END_VISP_NAMESPACE
#endif
