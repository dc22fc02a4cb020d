/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpProductOdometer.h
 * \brief Displacement of the product since the first frame, from the cells that successive frames have in common.
 */
#ifndef vpProductOdometer_h
#define vpProductOdometer_h

#include <visp3/printing/vpCellVelocity.h>

#include <vector>

BEGIN_VISP_NAMESPACE

/*!
 * \class vpProductOdometer
 * \ingroup group_printing
 * \brief Adds up vpFindCellVelocity() over the frames. While the same cells are in view, with the same deviations, the sum
 * telescopes: its error is that of two frames, not of all; it walks slowly as cells leave and enter or their weights change.
 *
 * A dropped frame loses nothing as long as the next one has cells in common with the last one seen. After a change of
 * epoch, or without common cells, the displacement in between is taken from a prediction.
 *
 * step() does not allocate, throw, lock or print.
 */
class VISP_EXPORT vpProductOdometer
{
public:
  //! \brief Where the product is.
  struct Output {
    double x = 0.;         //!< Displacement since the first frame, px to the right.
    double y = 0.;         //!< Displacement, px down.
    double dx = 0.;        //!< Since the last frame that was given, px.
    double dy = 0.;        //!< As dx, down.
    double sigmaX = 0.;    //!< Standard deviation of dx if the errors of the cells are independent, px.
    double sigmaY = 0.;    //!< Of dy, px.
    int cells = 0;         //!< In common with the last frame.
    bool measured = false; //!< dx and dy were measured, not predicted.
    bool lost = false; //!< A displacement since reset() was neither measured nor predicted: x and y are off since then.
  };

  /*!
   * \param capacity : Cells of a frame that are kept, 1..65536; more are ignored.
   * \throw vpException (badValue) naming the capacity and its value.
   */
  explicit vpProductOdometer(int capacity = 1024);

  /*!
   * Take a frame. The first one only sets the start.
   * \param cells, count : Its cells. \param epoch : Theirs.
   * \param predictedX, predictedY : Displacement since the last frame to use when none can be measured, px; plausible by
   * vpIsPlausible().
   */
  const Output &step(const vpPatternCell *cells, std::size_t count, unsigned int epoch, double predictedX = 0.,
                     double predictedY = 0.) noexcept;
  //! Of the last step.
  [[nodiscard]] const Output &output() const { return m_output; }
  //! The next frame is the first.
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
