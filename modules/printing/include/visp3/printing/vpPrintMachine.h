/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPrintMachine.h
 * \brief Control loop of a machine that prints on the fly: cells in, stage commands and shots out.
 */
#ifndef vpPrintMachine_h
#define vpPrintMachine_h

#include <visp3/printing/vpAlphaBetaFilter.h>
#include <visp3/printing/vpMotionKalmanFilter.h>
#include <visp3/printing/vpMotionObserver.h>
#include <visp3/printing/vpPreviewControl.h>
#include <visp3/printing/vpPrintReference.h>
#include <visp3/printing/vpPrintTrigger.h>
#include <visp3/printing/vpPrintVelocityControl.h>
#include <visp3/printing/vpProductOdometer.h>

#include <array>

BEGIN_VISP_NAMESPACE

//! \ingroup group_printing
//! \brief Controller of the printing axis.
enum class vpPrintController {
  Pid,            //!< Velocity PID, figure 7.13.
  PidFeedforward, //!< Velocity PID with mass and friction feedforward, figure 7.14.
  Observer        //!< vpMotionObserver with vpPreviewControl.
};

/*!
 * \ingroup group_printing
 * \brief Parameters of a vpPrintMachine. Lengths px, times frames, forces px/frame^2 (per mass).
 */
struct VISP_EXPORT vpPrintMachineSpec {
  vpPrintController controller = vpPrintController::Observer; //!< Controller of the printing axis; across: Observer.

  double pitchX = 220. / 4.5; //!< Pitch of the columns, px, > 0.
  double pitchY = 80. / 4.5;  //!< Pitch of the rows, px, > 0.
  double originX = 79.5;      //!< Initial centre of the first cell to print, px; used until the cell is measured.
  double nozzle = 79.5;       //!< Nozzle position along x, px; may be outside the image.
  double nozzleAcross = 49.5; //!< Nozzle position along y, px: row 0 is there at the start.
  double sigmaX = 0.01;       //!< Standard deviation of a measured displacement, px, > 0.
  double sigmaY = 0.01;       //!< Standard deviation of a measured displacement along y, px, > 0.

  vpAlphaBetaGains filter{0.37, 0.045};            //!< Velocity filter of the two PID controllers.
  double filterAhead = 1.;                         //!< Prediction time of the velocity filter, frame, in [0, 64].
  vpPrintVelocityControlSpec pid;                  //!< The two PID controllers; its field feedforward must match.
  vpMotionKalmanSpec forecast = defaultForecast(); //!< Motion expected by the trigger, for the two PID controllers.
  vpMotionObserverSpec observer;                   //!< Observer of the axis across, and of Observer.
  vpPreviewControlSpec preview;                    //!< Control of Observer; its period is that of the commands.
  vpPreviewControlSpec previewAcross;              //!< Control of the axis across; its period is that of the commands.
  int commandsPerFrame = 1;                        //!< Commands per frame: 1, 2, 4, 8 or 16.
  vpPrintReferenceSpec reference;                  //!< Motion from cell to cell.
  double dropVelocity = 4.;                        //!< Velocity at the cell centres, px/frame, > 0.
  double rowStepTime = 30.;                        //!< Duration of the step from row to row, frame, > 0.
  double followTime = 12.;                         //!< Duration of corrections of the axis across, frame, > 0.

  double visionDelay = 1.28;    //!< Delay from mid-exposure to the step that uses the image, frame, 0..8.
  double travelTime = 0.32;     //!< Travel time of a drop, frame, >= 0.
  double electronicsDelay = 0.; //!< Delay from trigger to drop, frame, >= 0.
  vpPrintTriggerMethod trigger = vpPrintTriggerMethod::Horizon; //!< Trigger method.
  double lateTolerance = 10. / 4.5;                             //!< vpPrintTriggerSpec::tolerance, px, >= 0.
  double cellDrift = 1e-5; //!< vpPrintTriggerSpec::drift: random walk of a cell against the motion, px^2/frame, >= 0.

  int rows = 1;         //!< Number of rows, printed in alternating directions; 1..1000.
  int cellsPerRow = 20; //!< Cells per row, 1..10000.

  //! Jerk of the reference, about 0.3 px/frame^3 rms and more at the start, as noise; from rest at a known position.
  [[nodiscard]] static vpMotionKalmanSpec defaultForecast();
  //! \throw vpException (badValue) naming the field that is out of range, and its value.
  void validate() const;
};

/*!
 * \ingroup group_printing
 * \brief Cells of one image of the product.
 */
struct VISP_EXPORT vpPrintMachineInput {
  double time = 0.;                     //!< Time of this step, frame; one more than that of the previous step.
  const vpPatternCell *cells = nullptr; //!< Cells of the newest image, exposed vpPrintMachineSpec::visionDelay ago.
  std::size_t cellCount = 0;            //!< 0: no image arrived; the expected motion continues.
  unsigned int epoch = 0;               //!< Epoch of the cells, see vpPatternFrame::epoch.
};

/*!
 * \ingroup group_printing
 * \brief Actions of the machine until the next step.
 */
struct VISP_EXPORT vpPrintMachineOutput {
  static constexpr int mostCommands = 16; //!< Maximum of vpPrintMachineSpec::commandsPerFrame.

  std::array<double, mostCommands> forceX{};     //!< Commands of the printing axis, equally spaced from this step on.
  std::array<double, mostCommands> forceY{};     //!< Commands of the axis across, equally spaced from this step on.
  int commandCount = 0;                          //!< Number of commands, vpPrintMachineSpec::commandsPerFrame.
  const vpPrintTriggerOutput *trigger = nullptr; //!< Shots to fire; valid until the next step.
  vpAxisState reference{};                       //!< Current reference along x: px, px/frame, ...
  double measuredVelocity = 0.;  //!< (7.27), of the last image with cells in common with its predecessor, x, px/frame.
  double estimatedVelocity = 0.; //!< Velocity used by the controller, px/frame.
  int row = 0;                   //!< Row being printed, 0 is the first.
};

/*!
 * \class vpPrintMachine
 * \ingroup group_printing
 * \brief Computes stage commands and firing times from the cells of an image: odometer, estimate, reference from cell
 * to cell, control, trigger. One step per image.
 *
 * The product moves along x from one column to the previous one: row 0 is printed from column \e firstColumn downwards,
 * the next row, one below, upwards, and so on, with one pitch for turning while the stage steps to the next row. Cell
 * numbers must stay with the cells: when the tracker changes its epoch, the caller must restore the old numbers, or the
 * rest of the row is located by its pitch.
 * \code
 * vpPrintMachineSpec spec; // that of the thesis; px and frames
 * spec.observer.model = spec.preview.model = spec.previewAcross.model = {1., 0.02, 0.08, 0.12, 0.3};
 * vpPrintMachine machine(spec);
 * machine.reset(0, -1); // the first cell to print
 * vpPatternTracker tracker(160, 100);
 * for (double frame = 0.; frame < 250.; ++frame) {
 *   grabber.acquire(image);
 *   const vpPatternFrame &seen = tracker.process(image);
 *   const vpPrintMachineOutput &out = machine.step({frame, seen.cells.data(), seen.cells.size(), seen.epoch});
 *   send(out.forceX[0], out.forceY[0]); // to the drives
 *   for (int i = 0; i < out.trigger->shotCount; ++i) {
 *     send(out.trigger->shots[i].fireTime); // to the print head, frame
 *   }
 *   for (int i = 0; i < out.trigger->missedCount; ++i) {
 *     std::cerr << "cell " << out.trigger->missed[i].column << " was missed" << std::endl;
 *   }
 * }
 * \endcode
 * step() does not allocate, throw, lock or print.
 */
class VISP_EXPORT vpPrintMachine
{
public:
  //! \throw vpException (badValue) naming the field of \e spec that is out of range, and its value.
  explicit vpPrintMachine(const vpPrintMachineSpec &spec);

  //! Start at rest at time 0. \param firstRow, firstColumn : Numbers of the cell to print first.
  void reset(int firstRow = 0, int firstColumn = -1) noexcept;
  //! Process one image. \return The output, valid until the next step.
  const vpPrintMachineOutput &step(const vpPrintMachineInput &input) noexcept;
  //! Specification as given.
  [[nodiscard]] const vpPrintMachineSpec &spec() const { return m_spec; }
  //! Signed column of the k-th cell printed in row number \e row, 0 is the first.
  [[nodiscard]] int columnOf(int row, int k) const noexcept;

private:
  [[nodiscard]] int direction(int row) const noexcept { return row % 2 == 0 ? 1 : -1; }
  double placeOf(int row, int column) noexcept;
  void see(const vpPrintMachineInput &input) noexcept;
  void makeTargets() noexcept;
  void makeTargetAcross(double now) noexcept;
  void follow(double now) noexcept;
  void fire(const vpPrintMachineInput &input) noexcept;
  void drive(double now) noexcept;
  double pidForce() noexcept;
  [[nodiscard]] double positionAt(double time) const noexcept;
  [[nodiscard]] bool isObserved() const noexcept { return m_spec.controller == vpPrintController::Observer; }

  vpPrintMachineSpec m_spec;
  vpPrintTrigger m_trigger;
  vpPrintReference m_reference, m_referenceY;
  vpPrintVelocityControl m_pid;
  vpPreviewControl m_preview, m_previewAcross;
  vpMotionObserver m_observer, m_observerY;
  vpAlphaBetaFilter m_alphaBeta;
  vpMotionKalmanFilter m_kalman;
  vpProductOdometer m_odometer;
  vpPrintMachineOutput m_output;
  std::array<vpPrintTarget, 5> m_targets; // the current target and the following ones
  std::size_t m_targetCount = 0;
  vpPrintTarget m_targetY;
  int m_firstRow = 0, m_firstColumn = -1;
  unsigned int m_epoch = 0;
  double m_lastCapture = 0.;
  bool m_seen = false; // cells in this step
  long m_present = 0;  // key of the current target: rows times (cells and a turn)
  bool m_turning = false;
  double m_stepArrival = 0.;  // end time of the step to the row
  double m_acrossOffset = 0.; // offset of the rows from their regular position, px
  int m_knownRow = -1;        // the last cell with known position; -1: none
  int m_knownColumn = 0;
  double m_knownAlong = 0.;
};

END_VISP_NAMESPACE
#endif
