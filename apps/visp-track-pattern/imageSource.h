/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file imageSource.h
 * \brief Where the images come from: files, a video, a camera, or the program's own sequence.
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
 * \brief Gives one image after the other.
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
  //! What the image of the last next() is called in complaints ("img0012.png", "frame 12 of film.mp4").
  [[nodiscard]] virtual std::string name() const = 0;
  //! Number of the image of the last next(), as the file's name or the video has it.
  [[nodiscard]] virtual unsigned int number() const = 0;
  //! The truth about the image of the last next(), where there is one.
  [[nodiscard]] virtual std::optional<FrameTruth> truth() const { return std::nullopt; }
  //! How many images there will be; 0: unknown.
  [[nodiscard]] virtual std::size_t count() const = 0;
  //! What it is, for people ("the folder recording", "its own sequence").
  [[nodiscard]] virtual std::string description() const = 0;
  //! True when images are missing between that of the last next() and the one before it.
  [[nodiscard]] virtual bool isAfterGap() const { return false; }
  //! What there is to say about what was read so far ("The images are in colour ..."), in sentences.
  [[nodiscard]] virtual std::vector<std::string> remarks() const { return {}; }
};

//! The source that the options name. \throw std::runtime_error naming the input that cannot be used.
[[nodiscard]] std::unique_ptr<ImageSource> makeSource(const Options &options);
} // namespace trackPattern

#endif
