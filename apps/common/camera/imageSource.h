/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file imageSource.h
 * \brief Where images come from: files, a video, or a camera.
 */
#ifndef vpApp_imageSource_h
#define vpApp_imageSource_h

#include <visp3/core/vpImage.h>
#include <visp3/direct_core/vpDirectCompat.h>

#include <limits>
#include <memory>
#include <string>
#include <vector>

VISP_DIRECT_USING_NAMESPACE

namespace vpApp
{
/*!
 * \brief Provides images one by one.
 */
class ImageSource
{
public:
  virtual ~ImageSource() = default;
  ImageSource() = default;
  ImageSource(const ImageSource &) = delete;
  ImageSource &operator=(const ImageSource &) = delete;

  /*!
   * The next image, grey. A live source waits for it.
   * \return False at the end, and after Ctrl-C.
   * \throw std::runtime_error naming the file or the camera.
   */
  [[nodiscard]] virtual bool next(vpImage<unsigned char> &image) = 0;
  //! Name of the image of the last next() in messages ("img0012.png", "frame 12 of film.mp4").
  [[nodiscard]] virtual std::string name() const = 0;
  //! Number of the image of the last next(), from the file name, the video or the camera.
  [[nodiscard]] virtual unsigned int number() const = 0;
  /*!
   * Time of capture of the image of the last next(), s: of a camera on the clock of now(), by its own or its driver's
   * time stamp if there is one, else the time of arrival; of a video since its beginning. NaN: not known.
   */
  [[nodiscard]] virtual double time() const { return std::numeric_limits<double>::quiet_NaN(); }
  //! How time() is obtained, for reports ("time stamps of the driver").
  [[nodiscard]] virtual std::string clock() const { return "none"; }
  //! True for a camera: next() waits for the moment.
  [[nodiscard]] virtual bool isLive() const { return false; }
  //! Number of images; 0: unknown.
  [[nodiscard]] virtual std::size_t count() const = 0;
  //! Images that the camera took and that did not arrive, as far as it tells.
  [[nodiscard]] virtual std::size_t lost() const { return 0; }
  //! Description of the source ("the folder recording", "its own sequence").
  [[nodiscard]] virtual std::string description() const = 0;
  //! True if images are missing between that of the last next() and the previous one.
  [[nodiscard]] virtual bool isAfterGap() const { return false; }
  //! Remarks on the images read so far ("The images are in colour ..."), in sentences.
  [[nodiscard]] virtual std::vector<std::string> remarks() const { return {}; }
};

//! Time of cameras and control loops: std::chrono::steady_clock, s.
[[nodiscard]] double now();

/*!
 * Images of files: one folder, image files, one pattern ("img%04d.png") or one video.
 * \param frames : Maximum number of images; 0: all.
 * \throw std::runtime_error naming an unusable input.
 */
[[nodiscard]] std::unique_ptr<ImageSource> openImages(const std::vector<std::string> &inputs, std::size_t frames = 0);
//! Open a video file. \throw std::runtime_error naming it.
[[nodiscard]] std::unique_ptr<ImageSource> openVideo(const std::string &file, std::size_t frames = 0);
//! The device of "0" and "/dev/video0"; empty when the text names no V4L2 camera.
[[nodiscard]] std::string cameraDevice(const std::string &text);
//! Open /dev/videoN. \throw std::runtime_error naming it.
[[nodiscard]] std::unique_ptr<ImageSource> openCamera(const std::string &device, std::size_t frames = 0);
/*!
 * Open a GigE Vision or USB3 Vision camera by Aravis, set to grey values of 8 bits.
 * \param id : As Aravis lists it, or its address; empty: the first one. \param rate : Images per second; 0: as it is set.
 * \throw std::runtime_error naming the camera and those that are there; or that Aravis is missing.
 */
[[nodiscard]] std::unique_ptr<ImageSource> openAravis(const std::string &id, double rate = 0., std::size_t frames = 0);
} // namespace vpApp

#endif
