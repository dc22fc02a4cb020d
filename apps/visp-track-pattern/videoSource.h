/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file videoSource.h
 * \brief Images from a video file or a camera.
 */
#ifndef trackPattern_videoSource_h
#define trackPattern_videoSource_h

#include "imageSource.h"

#include "vpPictureFile.h"

#include <opencv2/videoio.hpp>

namespace trackPattern
{
/*!
 * \brief Images one by one from an OpenCV capture.
 *
 * A camera may fail to give an image twice in a row: the next one comes after a gap. Images dropped inside a camera
 * are not detected. For videos with more than 8 bits OpenCV gives the upper 8 bits; for a camera all bits are read.
 */
class VideoSource : public ImageSource
{
public:
  /*!
   * \param capture : Open. \param name : File or device. \param isCamera : Camera, not a file of finite length.
   * \param frames : Maximum number of images; 0: all of the file.
   */
  VideoSource(std::unique_ptr<cv::VideoCapture> capture, std::string name, bool isCamera, std::size_t frames);

  [[nodiscard]] bool next(vpImage<unsigned char> &image) override;
  [[nodiscard]] std::string name() const override { return "image " + std::to_string(number()) + " of " + m_name; }
  [[nodiscard]] unsigned int number() const override { return static_cast<unsigned int>(m_read + m_failed - 1); }
  [[nodiscard]] bool isAfterGap() const override { return m_afterGap; }
  [[nodiscard]] std::size_t count() const override;
  [[nodiscard]] std::string description() const override
  {
    return (m_isCamera ? "the camera " : "the video ") + m_name;
  }
  [[nodiscard]] std::vector<std::string> remarks() const override;

private:
  bool grab();

  std::unique_ptr<cv::VideoCapture> m_capture;
  std::string m_name;
  bool m_isCamera;
  std::size_t m_frames;
  std::size_t m_promised = 0; // number of images stated by the file; 0: none
  unsigned int m_bits = 8;    // bits per value in the file
  std::size_t m_read = 0, m_failed = 0;
  bool m_afterGap = false, m_short = false;
  vpPictures::GreyScale m_scale;
  cv::Mat m_picture;
};

//! Open a video file. \throw std::runtime_error naming it.
[[nodiscard]] std::unique_ptr<ImageSource> openVideo(const std::string &file, std::size_t frames);
//! Open /dev/videoN. \throw std::runtime_error naming it.
[[nodiscard]] std::unique_ptr<ImageSource> openCamera(const std::string &device, std::size_t frames);
} // namespace trackPattern

#endif
