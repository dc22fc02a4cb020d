/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpProductOdometer.h
 * \brief Displacement of the product since the first frame, from cells common to successive frames.
 */
#ifndef vpProductOdometer_h
#define vpProductOdometer_h

#include <visp3/printing/vpCellVelocity.h>

#include <vector>

BEGIN_VISP_NAMESPACE

/*!
 * \class vpProductOdometer
 * \ingroup group_printing
 * \brief Sums vpFindCellVelocity() over the frames. While the same cells are in view, with the same deviations, the sum
 * telescopes: its error is that of two frames only; it drifts slowly as cells leave and enter or their weights change.
 *
 * A dropped frame loses nothing if the next one has cells in common with the last one received. After a change of
 * epoch, or without common cells, the displacement in between is predicted.
 *
 * step() does not allocate, throw, lock or print.
 *
 * \code
 * vpProductOdometer odometer;
 * vpPatternTracker tracker(160, 100);
 * for (int i = 0; i < 100; ++i) {
 *   grabber.acquire(image);
 *   const vpPatternFrame &seen = tracker.process(image);
 *   const vpProductOdometer::Output &moved = odometer.step(seen.cells.data(), seen.cells.size(), seen.epoch);
 *   std::cout << moved.x << " px" << (moved.lost ? ", wrong since a frame without cells" : "") << std::endl;
 * }
 * \endcode
 */
class VISP_EXPORT vpProductOdometer
{
public:
  //! \brief Position of the product.
  struct Output {
    double x = 0.;         //!< Displacement since the first frame, px to the right.
    double y = 0.;         //!< Displacement, px down.
    double dx = 0.;        //!< Since the last frame that was given, px.
    double dy = 0.;        //!< As dx, down.
    double sigmaX = 0.;    //!< Standard deviation of dx if the errors of the cells are independent, px.
    double sigmaY = 0.;    //!< Of dy, px.
    int cells = 0;         //!< In common with the last frame.
    bool measured = false; //!< dx and dy were measured, not predicted.
    bool lost = false;     //!< A displacement since reset() was neither measured nor predicted: x and y are wrong.
  };

  /*!
   * \param capacity : Maximum number of cells per frame, 1..65536; more are ignored.
   * \throw vpException (badValue) naming the capacity and its value.
   */
  explicit vpProductOdometer(int capacity = 1024);

  /*!
   * Process a frame. The first one only sets the origin.
   * \param cells, count : Cells of the frame. \param epoch : Epoch of the cells.
   * \param predictedX, predictedY : Displacement since the last frame, used when it cannot be measured, px; must
   *   satisfy vpIsPlausible().
   */
  const Output &step(const vpPatternCell *cells, std::size_t count, unsigned int epoch, double predictedX = 0.,
                     double predictedY = 0.) noexcept;
  //! Output of the last step.
  [[nodiscard]] const Output &output() const { return m_output; }
  //! Restart: the next frame is the first.
  void reset() noexcept;

private:
  std::vector<vpPatternCell> m_last; // sized at construction
  std::size_t m_count = 0;
  unsigned int m_epoch = 0;
  bool m_started = false;
  Output m_output;
};

END_VISP_NAMESPACE
#endif
