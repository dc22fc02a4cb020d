/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPrintTrigger.h
 * \brief Fires the nozzle so that each cell gets one drop in its centre.
 */
#ifndef vpPrintTrigger_h
#define vpPrintTrigger_h

#include <visp3/pattern/vpPatternFrame.h>
#include <visp3/printing/vpMotionForecast.h>

#include <cstddef>
#include <limits>
#include <vector>

BEGIN_VISP_NAMESPACE

//! \ingroup group_printing
//! \brief How the firing time is found.
enum class vpPrintTriggerMethod {
  Horizon,        //!< Each cell has an identity and a latch and is scheduled ahead.
  ThesisAlgorithm //!< Algorithm 7.5 as printed, for comparison: no memory, no camera delay; misses and doubles cells.
};

//! \ingroup group_printing
//! \brief Image axis along which the cells move to the nozzle.
enum class vpPrintAxis {
  X, //!< To the right or left.
  Y  //!< Down or up.
};

/*!
 * \ingroup group_printing
 * \brief Parameters of a vpPrintTrigger. Lengths in px, from the top left pixel's centre; times in frames, from any
 * common zero. "Along" is the axis of motion, "across" the other one.
 */
struct VISP_EXPORT vpPrintTriggerSpec {
  vpPrintTriggerMethod method = vpPrintTriggerMethod::Horizon; //!< How the firing time is found.
  vpPrintAxis axis = vpPrintAxis::X;                           //!< Axis of motion.
  double nozzle = 79.5;                                        //!< Nozzle position along, px; may be outside the image.
  double nozzleAcross = 49.5;                                  //!< Nozzle position across, px.
  //! Cells farther than this from #nozzleAcross when they pass belong to other rows, px, > 0; may be infinite.
  double rowTolerance = std::numeric_limits<double>::infinity();
  double travelTime = 0.32;     //!< Travel time of the drop, (7.3), frame, >= 0: 1 mm at 5 m/s and 1600 Hz.
  double electronicsDelay = 0.; //!< From the requested firing time to the drop leaving, t_rem of (7.21), frame, >= 0.
  double period = 1.;           //!< Time between steps, frame, > 0.
  double lead = 0.;             //!< Shots are output this long before they are due, beyond one period; frame, >= 0.
  double horizon = 8.;          //!< Shots this far ahead are listed as planned, frame, >= period + lead.
  double tolerance = 10. / 4.5; //!< A late cell is fired at once if the drop lands this close, else missed; px, >= 0.
  double drift = 1e-5;          //!< Random-walk variance of a cell against the motion per frame, px^2/frame, >= 0.
  double match = 8.;  //!< After a change of epoch cells this close to a known one are the same, px, both axes, > 0.
  int capacity = 256; //!< Cells stored, 16..65536. Printed cells are remembered as long as there is space.

  //! \throw vpException (badValue) naming the field that is out of range, and its value.
  void validate() const;
};

//! \ingroup group_printing
//! \brief Input of a trigger step.
struct VISP_EXPORT vpPrintTriggerInput {
  double time = 0.;                     //!< Current time, frame.
  double captureTime = 0.;              //!< Capture time of the cells, frame; earlier than #time by the camera's delay.
  const vpPatternCell *cells = nullptr; //!< Cells of the newest frame; invalid ones are ignored.
  std::size_t cellCount = 0;            //!< 0: no frame, only the motion continues.
  unsigned int epoch = 0;               //!< Epoch of the cells, see vpPatternFrame::epoch.
  int firstColumn = std::numeric_limits<int>::min(); //!< Cells below this column are not printed now.
  int lastColumn = std::numeric_limits<int>::max();  //!< Cells above this column are not printed now.
  double captureAlong = 0.;  //!< Displacement of the product along at #captureTime, best estimate, px.
  double captureAcross = 0.; //!< Displacement of the product across at #captureTime, px.
  vpMotionForecast along;    //!< Displacement from now on, px; any zero, but a constant one.
  vpMotionForecast across;   //!< Displacement across; at rest unless given.
};

//! \ingroup group_printing
//! \brief A cell that is fired at, missed, or planned.
struct VISP_EXPORT vpPrintShot {
  int row = 0;            //!< Row of the cell.
  int column = 0;         //!< Column of the cell.
  unsigned int epoch = 0; //!< Epoch of row and column.
  double fireTime = 0.;   //!< Firing time, frame; in [now, now + period + lead) for a shot.
  double landTime = 0.;   //!< Landing time of the drop, frame.
  double offset = 0.;     //!< Expected landing position minus the cell's centre, along, px; not 0 if late or missed.
  double sigma = 0.;      //!< Standard deviation of the cell's position against the motion, px.
  bool late = false;      //!< It should have been fired before now.
};

//! \ingroup group_printing
//! \brief Which part of an input was used.
enum class vpPrintTriggerStatus {
  Good,         //!< Everything.
  FrameRefused, //!< Motion only: the time or the displacement of the capture is implausible.
  InputRefused  //!< Nothing: time or motion is implausible. No shots, nothing has changed.
};

//! \ingroup group_printing
//! \brief Output of a trigger step. Fixed capacity.
struct VISP_EXPORT vpPrintTriggerOutput {
  static constexpr int capacity = 32; //!< Capacity of each list; the rest waits for the next step.
  vpPrintTriggerStatus status = vpPrintTriggerStatus::Good; //!< Used part of the input.
  int shotCount = 0;                                        //!< Shots to fire; each cell once.
  int missedCount = 0;                                      //!< Cells that can no longer be hit; each once.
  int plannedCount = 0;                                     //!< Future shots within the horizon; they may still change.
  bool overflow = false;                                    //!< No capacity left for a cell.
  std::array<vpPrintShot, capacity> shots{};                //!< Shots to fire.
  std::array<vpPrintShot, capacity> missed{};               //!< Missed cells.
  std::array<vpPrintShot, capacity> planned{};              //!< Planned shots, unordered.

  //! Status, missed cells and overflow as a readable sentence, the most severe first.
  [[nodiscard]] const char *message() const noexcept;
};

/*!
 * \class vpPrintTrigger
 * \ingroup group_printing
 * \brief Print-head trigger, thesis (7.21), (7.22), algorithm 7.5, corrected: on a horizon, each cell exactly once.
 *
 * Each cell gets a position X on the product: measured centre minus displacement at the time of capture, averaged over
 * the frames. It passes the nozzle when X + s(t) equals the nozzle's position; the drop is fired earlier by its travel
 * time and the delay of the electronics. A step outputs the shots that are due before the next step, in the half-open
 * interval [now, now + period + lead), and latches these cells. So noise changes the firing time but never repeats or
 * skips a cell. Cells out of view follow the motion: the nozzle need not be in the image.
 *
 * A cell counts as missed only if it was waiting before the nozzle, in the nozzle's row: cells that have already passed
 * when first seen are ignored. Cells of a new epoch at the positions of known ones inherit their latch. The motion may
 * reverse; cells of other rows wait for their turn.
 *
 * The times of an input are checked against each other: #vpPrintTriggerInput::time must be within
 * vpMotionForecast::longest of the time of the forecast along, and so must the capture, which must not be later than
 * the present by more than a period. Cells with numbers that are not finite or beyond vpPrintingLargest, or with
 * deviations not > 0, are ignored.
 *
 * step() does not allocate, throw, lock or print.
 *
 * \code
 * vpPrintTriggerSpec spec;
 * spec.nozzle = 79.5;     // px to the right
 * spec.rowTolerance = 8.; // px, half a pitch: one row
 * vpPrintTrigger trigger(spec);
 * vpPatternTracker tracker(160, 100);
 * vpPrintTriggerInput input;
 * for (double frame = 1.28; frame < 50.; ++frame) {
 *   grabber.acquire(image);
 *   const vpPatternFrame &seen = tracker.process(image);
 *   input.time = input.along.time = frame;
 *   input.captureTime = frame - 1.28;
 *   input.cells = seen.cells.data();
 *   input.cellCount = seen.cells.size();
 *   input.epoch = seen.epoch;
 *   input.captureAlong = 5. * input.captureTime; // px; of a vpProductOdometer
 *   input.along.position = 5. * frame;
 *   input.along.velocity = 5.; // px/frame
 *   const vpPrintTriggerOutput &out = trigger.step(input);
 *   for (int i = 0; i < out.shotCount; ++i) {
 *     send(out.shots[i].fireTime); // frame
 *   }
 *   if (out.status != vpPrintTriggerStatus::Good || out.missedCount > 0) {
 *     std::cerr << out.message() << std::endl;
 *   }
 * }
 * \endcode
 */
class VISP_EXPORT vpPrintTrigger
{
public:
  //! \throw vpException (badValue) naming the field of \e spec that is out of range, and its value.
  explicit vpPrintTrigger(const vpPrintTriggerSpec &spec = vpPrintTriggerSpec());

  //! One period. \return The output, valid until the next step.
  const vpPrintTriggerOutput &step(const vpPrintTriggerInput &input) noexcept;
  //! Forget all cells.
  void reset() noexcept;
  //! Specification as given.
  [[nodiscard]] const vpPrintTriggerSpec &spec() const { return m_spec; }
  //! Number of cells stored.
  [[nodiscard]] int remembered() const { return m_count; }
  /*!
   * Position of a cell on the product: it passes the nozzle when the displacement is nozzle minus this.
   * \return False when the cell is not known.
   */
  [[nodiscard]] bool find(int row, int column, unsigned int epoch, double &along, double &across) const noexcept;

private:
  enum class Latch { Waiting, Armed, Done };
  //! \brief Known data of a cell.
  struct Entry {
    int row = 0, column = 0;
    unsigned int epoch = 0;
    double along = 0., across = 0.; // at displacement 0
    double varianceAlong = 0., varianceAcross = 0.;
    double seen = 0.; // time of the last measurement
    Latch latch = Latch::Waiting;
    double side = 0.; // side of the nozzle at the last step: 1 beyond it along the axis, -1 before it
  };
  [[nodiscard]] vpPrintTriggerStatus judge(const vpPrintTriggerInput &input) const noexcept;
  void see(const vpPrintTriggerInput &input) noexcept;
  void schedule(const vpPrintTriggerInput &input, const vpAxisState &now, double across, Entry &entry) noexcept;
  void thesisStep(const vpPrintTriggerInput &input) noexcept;
  Entry *known(int row, int column, unsigned int epoch, double along, double across) noexcept;
  Entry *room(double place) noexcept;

  vpPrintTriggerSpec m_spec;
  std::vector<Entry> m_entries; // sized at construction
  int m_count = 0;
  int m_hint = 0;
  vpPrintTriggerOutput m_output;
};

END_VISP_NAMESPACE
#endif
