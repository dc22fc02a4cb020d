/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPrintTrigger.h
 * \brief When the nozzle fires, so that each cell gets one drop in its centre.
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
//! \brief How the instant is found.
enum class vpPrintTriggerMethod {
  Horizon,        //!< Each cell has an identity and a latch and is scheduled ahead.
  ThesisAlgorithm //!< Algorithm 7.5 as printed, for comparison: no memory, no delay of the camera; misses and doubles cells.
};

//! \ingroup group_printing
//! \brief Axis of the image along which the cells come to the nozzle.
enum class vpPrintAxis {
  X, //!< To the right or left.
  Y  //!< Down or up.
};

/*!
 * \ingroup group_printing
 * \brief Parameters of a vpPrintTrigger. Lengths in px, times in frames, both from the top left pixel's centre and from
 * any common zero. "Along" is the axis of motion, "across" the other one.
 */
struct VISP_EXPORT vpPrintTriggerSpec {
  vpPrintTriggerMethod method = vpPrintTriggerMethod::Horizon; //!< How the instant is found.
  vpPrintAxis axis = vpPrintAxis::X;                           //!< Axis of motion.
  double nozzle = 79.5;       //!< Place of the nozzle along, px; may lie outside of the image.
  double nozzleAcross = 49.5; //!< Its place across, px.
  //! Cells farther than this from #nozzleAcross when they pass are not its own, px, > 0; may be infinite.
  double rowTolerance = std::numeric_limits<double>::infinity();
  double travelTime = 0.32; //!< Of the drop, (7.3), frame, >= 0: 1 mm at 5 m/s and 1600 Hz.
  double electronicsDelay =
      0.;              //!< From the instant that is asked for to the drop leaving, t_rem of (7.21), frame, >= 0.
  double period = 1.;  //!< Time between steps, frame, > 0.
  double lead = 0.;    //!< A shot is given out so long before it is due, beyond one period; frame, >= 0.
  double horizon = 8.; //!< Shots this far ahead are listed as planned, frame, >= period + lead.
  double tolerance =
      10. / 4.5;       //!< A late cell is fired at once if the drop lands this close, else it is missed; px, >= 0.
  double drift = 1e-5; //!< Variance by which a cell wanders against the motion per frame, px^2/frame, >= 0.
  double match = 8.;   //!< After a change of epoch cells this close to a known one are that cell, px, both axes, > 0.
  int capacity = 256;  //!< Cells remembered, 16..65536. Memory of printed cells reaches as far back as there is room.

  //! \throw vpException (badValue) naming the field that is out of range, and its value.
  void validate() const;
};

//! \ingroup group_printing
//! \brief What a trigger is told in each step.
struct VISP_EXPORT vpPrintTriggerInput {
  double time = 0.;        //!< Now, frame.
  double captureTime = 0.; //!< When the cells below were seen, frame; earlier than now by the camera's delay.
  const vpPatternCell *cells = nullptr;              //!< Those of the newest frame; invalid ones are not used.
  std::size_t cellCount = 0;                         //!< 0: no frame, the motion alone goes on.
  unsigned int epoch = 0;                            //!< Of the cells, see vpPatternFrame::epoch.
  int firstColumn = std::numeric_limits<int>::min(); //!< Cells along the rows below this are not printed now.
  int lastColumn = std::numeric_limits<int>::max();  //!< Cells above this are not printed now.
  double captureAlong = 0.;  //!< Displacement of the product along at #captureTime, best estimate, px.
  double captureAcross = 0.; //!< The same across.
  vpMotionForecast along;    //!< Displacement from now on, px; any zero, but always the same.
  vpMotionForecast across;   //!< Displacement across; at rest unless given.
};

//! \ingroup group_printing
//! \brief A cell that is fired at, was missed, or is planned.
struct VISP_EXPORT vpPrintShot {
  int row = 0;            //!< Of the cell.
  int column = 0;         //!< Of the cell.
  unsigned int epoch = 0; //!< Of row and column.
  double fireTime = 0.;   //!< When to trigger, frame; in [now, now + period + lead) for a shot.
  double landTime = 0.;   //!< When the drop lands, frame.
  double offset = 0.;     //!< Expected landing place minus the cell's centre, along, px; not 0 if late or missed.
  double sigma = 0.;      //!< Standard deviation of the cell's place against the motion, px.
  bool late = false;      //!< It should have been fired before now.
};

//! \ingroup group_printing
//! \brief Which part of an input a step took.
enum class vpPrintTriggerStatus {
  Good,         //!< All.
  FrameRefused, //!< Not the cells: the time or the displacement of their capture is implausible. The motion went on.
  InputRefused  //!< Nothing: time or motion is implausible. No shots, nothing has changed.
};

//! \ingroup group_printing
//! \brief What a trigger answers. Fixed room.
struct VISP_EXPORT vpPrintTriggerOutput {
  static constexpr int capacity = 32; //!< Of each list; what does not fit waits for the next step.
  vpPrintTriggerStatus status = vpPrintTriggerStatus::Good; //!< What was taken of the input.
  int shotCount = 0;                                        //!< Shots to be fired; each cell once.
  int missedCount = 0;                                      //!< Cells that can no longer be hit; each once.
  int plannedCount = 0;                        //!< Shots to come within the horizon; they may still change.
  bool overflow = false;                       //!< A cell found no room in the memory.
  std::array<vpPrintShot, capacity> shots{};   //!< To be fired.
  std::array<vpPrintShot, capacity> missed{};  //!< Not fired.
  std::array<vpPrintShot, capacity> planned{}; //!< In no order.
};

/*!
 * \class vpPrintTrigger
 * \ingroup group_printing
 * \brief Print-head trigger, thesis (7.21), (7.22), algorithm 7.5, corrected: on a horizon, each cell exactly once.
 *
 * Each cell gets a place X on the product: measured centre minus displacement at the time of capture, averaged over
 * the frames. It passes the nozzle when X + s(t) equals the nozzle's place; the drop is fired travel time and delay of the
 * electronics before. A step gives out the shots that are due before the next step, in the half-open interval
 * [now, now + period + lead), and latches these cells. So noise moves the instant and never repeats or skips a
 * cell. Cells out of view go on with the motion: the nozzle need not be in the image.
 *
 * A cell counts as missed only if it was waiting before the nozzle, in the nozzle's row: those that have passed already when
 * they are seen first are left alone. Cells of a new epoch that lie where known ones do inherit their latch.
 * The motion may reverse; cells of other rows wait for their turn.
 *
 * The clocks of an input check each other: #vpPrintTriggerInput::time must be within vpMotionForecast::longest of the time
 * of the forecast along, the capture as near and not later than the present by more than a period. Cells with numbers that are
 * not finite, beyond vpPrintingLargest or, as deviations, not > 0 are left out.
 *
 * step() does not allocate, throw, lock or print.
 */
class VISP_EXPORT vpPrintTrigger
{
public:
  //! \throw vpException (badValue) naming the field of \e spec that is out of range, and its value.
  explicit vpPrintTrigger(const vpPrintTriggerSpec &spec = vpPrintTriggerSpec());

  //! One period. \return The answer, valid until the next step.
  const vpPrintTriggerOutput &step(const vpPrintTriggerInput &input) noexcept;
  //! Forget all cells.
  void reset() noexcept;
  //! As given.
  [[nodiscard]] const vpPrintTriggerSpec &spec() const { return m_spec; }
  //! Number of cells remembered.
  [[nodiscard]] int remembered() const { return m_count; }
  /*!
   * Place of a cell on the product: it passes the nozzle when the displacement is nozzle minus this.
   * \return False when the cell is not known.
   */
  [[nodiscard]] bool find(int row, int column, unsigned int epoch, double &along, double &across) const noexcept;

private:
  enum class Latch { Waiting, Armed, Done };
  //! \brief What is known of a cell.
  struct Entry {
    int row = 0, column = 0;
    unsigned int epoch = 0;
    double along = 0., across = 0.; // at displacement 0
    double varianceAlong = 0., varianceAcross = 0.;
    double seen = 0.; // time of the last measurement
    Latch latch = Latch::Waiting;
    double side = 0.; // of the nozzle, at the last step: 1 beyond it along the axis, -1 before
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
