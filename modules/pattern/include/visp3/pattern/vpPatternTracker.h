/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPatternTracker.h
 * \brief Centres and motion of the cells of a repetitive product, frame by frame.
 */
#ifndef vpPatternTracker_h
#define vpPatternTracker_h

#include <visp3/pattern/vpPatternFrame.h>
#include <visp3/pattern/vpPatternTrackerSpec.h>

#include <visp3/core/vpImage.h>

#include <memory>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_pattern
 * \brief Tracks rectangular, rounded or dot cells that repeat on a lattice (thesis section 7.2.2, with another method).
 *
 * Acquisition: threshold, run-length labels, sub-pixel edges, robust lattice. Then a template is learned from the
 * images themselves and aligned with every cell by Gauss-Newton steps that are invariant to brightness, contrast and
 * their gradients; pixels under dust and cracks are masked, cells that do not fit are invalid.
 *
 * The motion must stay below half a pitch per frame: a motion of a pattern without deviations by 0.8 pitch cannot be
 * distinguished from one by -0.2. Motion near half a pitch and sudden jumps start a new epoch.
 *
 * All memory is allocated in the constructor. process() does not allocate, throw, lock or print.
 *
 * \code
 * vpPatternTracker tracker(640, 480); // px
 * double moved = 0.;                  // px to the right
 * for (int i = 0; i < 100; ++i) {
 *   grabber.acquire(image);
 *   const vpPatternFrame &frame = tracker.process(image);
 *   moved += frame.hasMotion ? frame.dx : 0.; // +- frame.sigmaDx
 *   if (frame.status != vpPatternStatus::Tracking) {
 *     std::cerr << frame.message() << std::endl; // learning, or lost and why
 *   }
 *   for (const vpPatternCell &cell : frame.cells) {
 *     if (cell.valid) {
 *       std::cout << cell.row << ", " << cell.column << ": " << cell.x << " +- " << cell.sigmaX << " px\n";
 *     }
 *   }
 * }
 * \endcode
 */
class VISP_EXPORT vpPatternTracker
{
public:
  /*!
   * \param width, height Size of the images, px, each in [16, 16384].
   * \param spec Validated here.
   * \throw vpException (badValue) that names what is out of range, and its value; (fatalError) when a thread cannot be started.
   */
  vpPatternTracker(unsigned int width, unsigned int height, const vpPatternTrackerSpec &spec = vpPatternTrackerSpec());
  ~vpPatternTracker();
  vpPatternTracker(vpPatternTracker &&) noexcept;            //!< Moves; the source can only be destroyed or assigned.
  vpPatternTracker &operator=(vpPatternTracker &&) noexcept; //!< Moves; the source can only be destroyed or assigned.
  vpPatternTracker(const vpPatternTracker &) = delete;
  vpPatternTracker &operator=(const vpPatternTracker &) = delete;

  /*!
   * \brief Process the next image.
   * \param image 8-bit image of the size given to the constructor; another size gives Lost with WrongSize.
   * \return The result, valid until the next call.
   */
  const vpPatternFrame &process(const vpImage<unsigned char> &image);

  //! The result of the last image.
  [[nodiscard]] const vpPatternFrame &frame() const;
  //! The options in use.
  [[nodiscard]] const vpPatternTrackerSpec &spec() const;
  /*!
   * \brief Notify the tracker of missing images, during which the motion of the product is unknown.
   *
   * The next image with the pattern has no motion and begins a new epoch, with reason ImagesMissing; lattice vectors
   * and template are kept. Call it when images were skipped or a camera failed. Does not allocate.
   */
  void interrupt();
  //! Forget lattice, template and identities; the next image starts a new acquisition. Does not allocate.
  void reset();

private:
  class Impl;
  std::unique_ptr<Impl> m_impl;
};

END_VISP_NAMESPACE
#endif
