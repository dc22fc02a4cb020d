/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPrintMachine.h
 * \brief The loop of a machine that prints on the fly: cells in, commands of the stage and shots out.
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
//! \brief What drives the axis of printing.
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
  vpPrintController controller =
      vpPrintController::Observer; //!< Of the axis of printing; across it is Observer always.

  double pitchX = 220. / 4.5; //!< From column to column, px, > 0.
  double pitchY = 80. / 4.5;  //!< From row to row, px, > 0.
  double originX = 79.5; //!< Centre of the cell that is printed first, at the start, px; counts until it was measured.
  double nozzle = 79.5;  //!< Place of the nozzle along x, px; may lie outside of the image.
  double nozzleAcross = 49.5; //!< Its place along y, px: row 0 is there at the start.
  double sigmaX = 0.01;       //!< Standard deviation of a measured displacement, px, > 0.
  double sigmaY = 0.01;       //!< The same along y, px, > 0.

  vpAlphaBetaGains filter{0.37, 0.045};            //!< Of the velocity, for the two PID controllers.
  double filterAhead = 1.;                         //!< How far they predict it, frame, in [0, 64].
  vpPrintVelocityControlSpec pid;                  //!< For the two PID controllers; its field feedforward must fit.
  vpMotionKalmanSpec forecast = defaultForecast(); //!< Motion that the trigger expects, for the two PID controllers.
  vpMotionObserverSpec observer;                   //!< For Observer, and for the axis across always.
  vpPreviewControlSpec preview;                    //!< For Observer; its period is that of the commands.
  vpPreviewControlSpec previewAcross;              //!< For the axis across; its period is that of the commands.
  int commandsPerFrame = 1;                        //!< Commands in a frame: 1, 2, 4, 8 or 16.
  vpPrintReferenceSpec reference;                  //!< Motion from cell to cell.
  double dropVelocity = 4.;                        //!< At the centres, px/frame, > 0.
  double rowStepTime = 30.;                        //!< Of the step from row to row, frame, > 0.
  double followTime = 12.; //!< In which the axis across goes to where the cells are measured, frame, > 0.

  double visionDelay = 1.28;    //!< From the middle of the exposure to the step that uses it, frame, 0..8.
  double travelTime = 0.32;     //!< Of a drop, frame, >= 0.
  double electronicsDelay = 0.; //!< From trigger to drop, frame, >= 0.
  vpPrintTriggerMethod trigger = vpPrintTriggerMethod::Horizon; //!< How the instants are found.
  double lateTolerance = 10. / 4.5;                             //!< vpPrintTriggerSpec::tolerance, px, >= 0.
  double cellDrift = 1e-5; //!< vpPrintTriggerSpec::drift: a cell wanders against the motion, px^2/frame, >= 0.

  int rows = 1;         //!< Rows that are printed one after another, to and fro; 1..1000.
  int cellsPerRow = 20; //!< 1..10000.

  //! Jerk of the reference, about 0.3 px/frame^3 rms and more at the start, as noise; from rest at a known place.
  [[nodiscard]] static vpMotionKalmanSpec defaultForecast();
  //! \throw vpException (badValue) naming the field that is out of range, and its value.
  void validate() const;
};

/*!
 * \ingroup group_printing
 * \brief One image of the product.
 */
struct VISP_EXPORT vpPrintMachineInput {
  double time = 0.;                     //!< Of this step, frame; one more than that of the step before.
  const vpPatternCell *cells = nullptr; //!< Of the newest image, exposed vpPrintMachineSpec::visionDelay ago.
  std::size_t cellCount = 0;            //!< 0: no image arrived; the motion goes on as it is expected.
  unsigned int epoch = 0;               //!< Of the cells, see vpPatternFrame::epoch.
};

/*!
 * \ingroup group_printing
 * \brief What the machine does until the next step.
 */
struct VISP_EXPORT vpPrintMachineOutput {
  static constexpr int mostCommands = 16; //!< Room for vpPrintMachineSpec::commandsPerFrame.

  std::array<double, mostCommands> forceX{}; //!< Commands of the axis of printing, equally spaced from this step on.
  std::array<double, mostCommands> forceY{}; //!< The same of the axis across.
  int commandCount = 0;                      //!< vpPrintMachineSpec::commandsPerFrame.
  const vpPrintTriggerOutput *trigger = nullptr; //!< Shots to be fired; valid until the next step.
  vpAxisState reference{};                       //!< Along x, now: px, px/frame, ...
  double measuredVelocity =
      0.; //!< (7.27), of the last image with cells in common with the one before, along x, px/frame.
  double estimatedVelocity = 0.; //!< What the controller uses, px/frame.
  int row = 0;                   //!< Being printed, 0 is the first.
};

/*!
 * \class vpPrintMachine
 * \ingroup group_printing
 * \brief From the cells of an image to the commands of the stage and the instants to fire: odometer, estimate, reference
 * from cell to cell, control, trigger. One step per image.
 *
 * The product moves along x from one column to the one before: row 0 is printed from column \e firstColumn downwards, the
 * next row, one below, upwards, and so on, with one pitch to turn in while the stage steps to the next row. Numbers of
 * cells must stay with the cells: when the tracker changes its epoch, the caller gives the cells their old numbers, or the
 * rest of the row is found by its pitch.
 * \code
 * vpPrintMachine machine(spec);
 * machine.reset(0, -1); // the cell that comes first
 * for (double frame = 0;; ++frame) {
 *   const vpPatternFrame &seen = tracker.track(grab());
 *   const vpPrintMachineOutput &out = machine.step({frame, seen.cells.data(), seen.cells.size(), seen.epoch});
 *   send(out.forceX, out.forceY, out.commandCount); // to the drives
 *   fire(out.trigger->shots, out.trigger->shotCount);
 * }
 * \endcode
 * step() does not allocate, throw, lock or print.
 */
class VISP_EXPORT vpPrintMachine
{
public:
  //! \throw vpException (badValue) naming the field of \e spec that is out of range, and its value.
  explicit vpPrintMachine(const vpPrintMachineSpec &spec);

  //! Start at rest at time 0. \param firstRow, firstColumn : Numbers of the cell that is printed first.
  void reset(int firstRow = 0, int firstColumn = -1) noexcept;
  //! One image. \return The answer, valid until the next step.
  const vpPrintMachineOutput &step(const vpPrintMachineInput &input) noexcept;
  //! As given.
  [[nodiscard]] const vpPrintMachineSpec &spec() const { return m_spec; }
  //! Signed column of the k-th cell that is printed in the row number \e row, 0 is the first.
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
  std::array<vpPrintTarget, 5> m_targets; // the present cell and those behind it
  std::size_t m_targetCount = 0;
  vpPrintTarget m_targetY;
  int m_firstRow = 0, m_firstColumn = -1;
  unsigned int m_epoch = 0;
  double m_lastCapture = 0.;
  bool m_seen = false; // cells in this step
  long m_present = 0;  // key of the present target: rows times (cells and a turn)
  bool m_turning = false;
  double m_stepArrival = 0.;  // when the step to the row ends
  double m_acrossOffset = 0.; // of the rows from their regular place, px
  int m_knownRow = -1;        // the last cell whose place was known; -1: none
  int m_knownColumn = 0;
  double m_knownAlong = 0.;
};

END_VISP_NAMESPACE
#endif
