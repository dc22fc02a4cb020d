/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPrintExperiment.h
 * \brief Closed-loop printing on the fly: product -> camera -> estimate -> reference -> control -> stage -> drops.
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

//! \brief Source of the cell measurements.
enum class vpPrintSensor {
  Model, //!< True positions plus Gaussian errors: fast.
  Image  //!< Rendered images through vpPatternTracker.
};

/*!
 * \brief Errors of a sensor in px. The errors of the cells of a frame are correlated: their mean has the standard
 * deviation sigma / sqrt(effectiveCells).
 */
struct vpPrintSensorModel {
  double sigmaX = 0.18;       //!< Standard deviation of a cell along x, px, > 0.
  double sigmaY = 0.035;      //!< Standard deviation of a cell along y, px, > 0.
  double effectiveCells = 2.; //!< Effective number of independent cells, >= 1; limited to those in view.

  [[nodiscard]] static vpPrintSensorModel thesis();  //!< Algorithm 7.4: 0.18 and 0.035 px, 2 effective cells.
  [[nodiscard]] static vpPrintSensorModel tracker(); //!< vpPatternTracker: 0.0153 and 0.0078 px, 10 effective cells.
};

/*!
 * \brief Specification of a run; it determines the result. Lengths in px, times in frames unless stated. Geometry and
 * standard deviations of the machine (pitches, origin, nozzle, lateTolerance, sigmas) are taken from product,
 * nozzleOffset and sensor.
 */
struct vpPrintExperimentSpec : vpPrintMachineSpec {
  vpPrintSensor sensor = vpPrintSensor::Model;                    //!< Source of the cell measurements.
  vpPrintSensorModel sensorModel = vpPrintSensorModel::tracker(); //!< Errors; for Image as assumed by the estimators.
  vpXYStageSpec stage = vpXYStageSpec::thesis();                  //!< The plant.
  vpProductPatternSpec product;                                   //!< The product and, for Image, its appearance.
  double captureJitter = 0.; //!< Standard deviation of the (unreported) exposure time error, frames, >= 0.
  double dropped = 0.;       //!< Fraction of frames lost, 0..0.5.
  double nozzleOffset = 0.;  //!< Nozzle minus image centre, along x, px.

  int frames = 0;           //!< Maximum number of frames; 0: until all cells are printed.
  int evaluateFrom = 60;    //!< First frame for the velocity errors, >= 0.
  double frameRate = 1600.; //!< Frame rate, Hz, > 0.
  int stageParts = 32;      //!< Steps of the stage in a frame: a power of 2 from commandsPerFrame to 32.
  unsigned int seed = 1;    //!< Seed of the sensor errors. The product has its own.

  /*!
   * A PID, without or with feedforward, and its filter for the stage of vpXYStageSpec::thesis(): gains chosen by hand.
   */
  [[nodiscard]] static vpPrintExperimentSpec withPid(bool feedforward);
  //! Figure 7.12: velocity step, PID; stage and gains fitted, see vpPrintFit, as for the following ones.
  [[nodiscard]] static vpPrintExperimentSpec thesisStep();
  //! Figure 7.13: PID without feedforward, sensor of the thesis, 5 px/frame on average, 120 frames.
  [[nodiscard]] static vpPrintExperimentSpec thesisPid();
  //! Figure 7.14: PID with feedforward.
  [[nodiscard]] static vpPrintExperimentSpec thesisFeedforward();
  //! Figure 7.15: the same with a poorly tuned filter.
  [[nodiscard]] static vpPrintExperimentSpec thesisPoorFilter();
  /*!
   * Observer and preview, velocity 4 px/frame at the centres and 5 px/frame on average.
   * \param sensor : Errors of the sensor, to which the observer is tuned.
   */
  [[nodiscard]] static vpPrintExperimentSpec withObserver(const vpPrintSensorModel &sensor);
  //! \throw vpException (badValue) naming the field that is out of range, and its value.
  void validate() const;
};

//! \brief A row of the log: true and estimated state at a control step.
struct vpPrintSample {
  int frame = 0;                 //!< Number of the step, also its time in frames.
  double x = 0.;                 //!< True displacement of the product, px to the right.
  double y = 0.;                 //!< True displacement, px down.
  double vx = 0.;                //!< True velocity, px/frame to the right.
  double vy = 0.;                //!< True velocity, px/frame down.
  double referencePosition = 0.; //!< Reference position along x, px.
  double referenceVelocity = 0.; //!< Reference velocity along x, px/frame.
  double measuredVelocity = 0.;  //!< Unfiltered velocity (7.27) along x, px/frame; delayed by the camera.
  double estimatedVelocity = 0.; //!< Velocity used by the controller, px/frame.
  double force = 0.;             //!< Commanded force along x.
  int row = 0;                   //!< Row being printed.
  int cells = 0;                 //!< Number of measured cells.
  bool dropped = false;          //!< True if no frame arrived.
};

//! \brief A drop and its landing.
struct vpPrintDrop {
  int row = 0;          //!< Row of the target cell.
  int column = 0;       //!< Column of the target cell.
  double fireTime = 0.; //!< Firing time, frames.
  double landTime = 0.; //!< Landing time, frames.
  double errorX = 0.;   //!< Landing position minus true centre along x, um.
  double errorY = 0.;   //!< Landing position minus true centre along y, um.
  double velocity = 0.; //!< True velocity of the product at landing, along x, px/frame.
  bool late = false;    //!< See vpPrintShot::late.
};

//! \brief Metrics of a run.
struct vpPrintMetrics {
  //! Measured velocity (before the filter, as plotted in the thesis) minus the reference of the previous step, rms,
  //! px/frame.
  double rms_velocity_error = 0.;
  double rms_true_velocity_error = 0.; //!< True velocity minus the simultaneous reference, rms, px/frame.
  double centre_velocity_error = 0.;   //!< |true velocity| minus dropVelocity with a cell at the nozzle, rms, px/frame.
  double centre_velocity_worst = 0.;   //!< Largest such error, px/frame.
  double centre_velocity_mean = 0.;    //!< Mean |true velocity| with a cell at the nozzle, px/frame.
  double landing_rms_um = 0.;          //!< Distance of the drops from the centres, rms, um.
  double landing_worst_um = 0.;        //!< Largest distance of a drop from its centre, um.
  double landed_within_10um = 0.;      //!< Fraction of the drops, 0..1.
  int printed = 0;                     //!< Number of cells with at least one drop.
  int missed = 0;                      //!< Number of cells that passed the nozzle without a drop.
  int doubled = 0;                     //!< Number of cells with more than one drop.
  double throughput_cells_per_s = 0.;  //!< Cells per second from the first to the last drop, including turns.
  //! Time at dropVelocity divided by the time taken, between first and last cell of the rows, minus 1.
  double gain_over_constant = 0.;
  int frames = 0;        //!< Number of frames run.
  bool complete = false; //!< True if all cells passed the nozzle.
};

//! \brief A finished run.
struct vpPrintRun {
  vpPrintExperimentSpec spec;         //!< Specification of the run.
  std::vector<vpPrintSample> samples; //!< Log, one per frame.
  std::vector<vpPrintDrop> drops;     //!< Drops in order of landing.
  vpPrintMetrics metrics;             //!< Metrics.
};

/*!
 * \brief Runs one experiment. Row 0 is at the nozzle at the start, its first cell one pitch before it; rows are printed
 * back and forth, with one pitch for turning while the stage steps to the next row.
 *
 * With vpPrintSensor::Image the tracker first learns from 120 frames of slow motion. Its rows and columns are numbered
 * like the product's by means of the true state, once per epoch; nothing else of the true state is used.
 * \param spec : Specification; validated first. The same specification gives the same run, bit for bit.
 * \param progress : If given, called periodically with the completed fraction, 0..1; return false to stop early.
 * \throw vpException naming the field of the specification that is out of range.
 */
[[nodiscard]] vpPrintRun runPrintExperiment(const vpPrintExperimentSpec &spec,
                                            const std::function<bool(double)> &progress = {});

END_VISP_NAMESPACE
#endif
