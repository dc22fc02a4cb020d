/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpReferenceTeacher.h
 * \brief Reference image with little noise for vpReferenceVision.
 */
#ifndef vpReferenceTeacher_h
#define vpReferenceTeacher_h

#include <visp3/core/vpImage.h>
#include <visp3/direct_core/vpDirectCompat.h>

#include <memory>
#include <string>

BEGIN_VISP_NAMESPACE

/*!
 * \class vpReferenceTeacher
 * \ingroup group_servoing
 * \brief Averages images of a camera at rest to a reference image with little noise.
 *
 * \code
 * vpReferenceTeacher teacher;
 * while (!teacher.isComplete()) {
 *   grabber.acquire(image);
 *   if (!teacher.add(image)) {
 *     std::cerr << teacher.message() << std::endl; // moved: starts again
 *   }
 * }
 * vpImageIo::write(teacher.image(), "reference.png");
 * \endcode
 */
class VISP_EXPORT vpReferenceTeacher
{
public:
  /*!
   * \param images : Number of images to average, 1..1000.
   * \param motion : Median shift of the corners, against the first image, from which on the camera has moved, px, > 0.
   * \throw vpException (badValue) naming the number that is out of range.
   */
  explicit vpReferenceTeacher(unsigned int images = 25, double motion = 0.5);
  ~vpReferenceTeacher();
  vpReferenceTeacher(vpReferenceTeacher &&) noexcept;            //!< Moves.
  vpReferenceTeacher &operator=(vpReferenceTeacher &&) noexcept; //!< Moves.

  /*!
   * Adds an image.
   * \return False if the camera or the scene has moved since the first image: the average then starts again with this
   *   one.
   * \throw vpException as vpPlaneTracker for an image without texture; (dimensionError) for one of another size.
   */
  bool add(const vpImage<unsigned char> &image);
  [[nodiscard]] bool isComplete() const; //!< True when all images have been added.
  //! The average. \throw vpException (notInitialized) before the first image.
  [[nodiscard]] vpImage<unsigned char> image() const;
  //! Standard deviation of a coordinate of a corner from image to image, px; NaN before the second one.
  [[nodiscard]] double pointNoise() const;
  //! The same for the average, for vpReferenceVisionSpec::referenceNoise: pointNoise() / sqrt(number of images).
  [[nodiscard]] double averageNoise() const;
  //! One sentence about the last image.
  [[nodiscard]] const std::string &message() const;

private:
  class Impl;
  std::unique_ptr<Impl> m_impl;
};

END_VISP_NAMESPACE
#endif
