/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file imageSource.h
 * \brief Image sources: files, a video, a camera, or the program's own sequence.
 */
#ifndef trackPattern_imageSource_h
#define trackPattern_imageSource_h

#include "options.h"
#include "truth.h"

#include <visp3/core/vpImage.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace trackPattern
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
   * The next image, grey.
   * \return False at the end.
   * \throw std::runtime_error naming the file or the camera.
   */
  [[nodiscard]] virtual bool next(vpImage<unsigned char> &image) = 0;
  //! Name of the image of the last next() in messages ("img0012.png", "frame 12 of film.mp4").
  [[nodiscard]] virtual std::string name() const = 0;
  //! Number of the image of the last next(), from the file name or the video.
  [[nodiscard]] virtual unsigned int number() const = 0;
  //! Ground truth of the image of the last next(), if any.
  [[nodiscard]] virtual std::optional<FrameTruth> truth() const { return std::nullopt; }
  //! Number of images; 0: unknown.
  [[nodiscard]] virtual std::size_t count() const = 0;
  //! Description of the source ("the folder recording", "its own sequence").
  [[nodiscard]] virtual std::string description() const = 0;
  //! True if images are missing between that of the last next() and the previous one.
  [[nodiscard]] virtual bool isAfterGap() const { return false; }
  //! Remarks on the images read so far ("The images are in colour ..."), in sentences.
  [[nodiscard]] virtual std::vector<std::string> remarks() const { return {}; }
};

//! The source named by the options. \throw std::runtime_error naming an unusable input.
[[nodiscard]] std::unique_ptr<ImageSource> makeSource(const Options &options);
} // namespace trackPattern

#endif
