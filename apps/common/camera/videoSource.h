/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file videoSource.h
 * \brief Images of a video file or a V4L2 camera.
 */
#ifndef vpApp_videoSource_h
#define vpApp_videoSource_h

#include "imageSource.h"

#include "vpPictureFile.h"

#include <opencv2/videoio.hpp>

#include <memory>
#include <string>
#include <vector>

namespace vpApp
{
/*!
 * \brief Images one by one from an OpenCV capture.
 *
 * A camera may fail to give an image twice in a row: the next one comes after a gap. Images dropped inside a camera
 * are not detected. V4L2 gives the time of capture by the clock of now(); where a driver gives another time, it is the time of
 * arrival. A lossy codec between images (H.264) is a remark: it removes noise, from which deviations are estimated. For videos with more than 8 bits OpenCV gives the upper 8 bits; for a camera all bits are read.
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
  [[nodiscard]] double time() const override { return m_time; }
  [[nodiscard]] std::string clock() const override;
  [[nodiscard]] bool isLive() const override { return m_isCamera; }
  [[nodiscard]] std::size_t lost() const override { return m_failed; }
  [[nodiscard]] std::size_t count() const override;
  [[nodiscard]] std::string description() const override
  {
    return (m_isCamera ? "the camera " : "the video ") + m_name;
  }
  [[nodiscard]] std::vector<std::string> remarks() const override;

private:
  bool grab();
  void readTime();

  std::unique_ptr<cv::VideoCapture> m_capture;
  std::string m_name;
  bool m_isCamera;
  std::size_t m_frames;
  std::size_t m_promised = 0; // number of images stated by the file; 0: none
  unsigned int m_bits = 8;    // bits per value in the file
  std::string m_codec;        // of a file, if it predicts images from others with loss
  std::size_t m_read = 0, m_failed = 0;
  bool m_afterGap = false, m_short = false, m_stamped = true;
  double m_time = 0.;
  vpPictures::GreyScale m_scale;
  cv::Mat m_picture;
};
} // namespace vpApp

#endif
