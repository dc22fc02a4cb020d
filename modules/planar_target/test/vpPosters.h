/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPosters.h
 * \brief Any number of different targets: random shapes of random grey, and views with some of them.
 */
#ifndef vpPosters_h
#define vpPosters_h

#include "vpPlanarScene.h"

#include <opencv2/imgproc.hpp>

namespace vpPosters
{
using Image = vpPlanarScene::Image;

//! Rectangles, discs and lines over each other.
inline void paint(Image &image, int shapes, std::mt19937_64 &rng)
{
  cv::Mat canvas(static_cast<int>(image.getHeight()), static_cast<int>(image.getWidth()), CV_8UC1, image.bitmap);
  std::uniform_real_distribution<double> uniform(0., 1.);
  const auto at = [&](double side) { return static_cast<int>(uniform(rng) * side); };
  canvas.setTo(60 + at(140));
  for (int i = 0; i < shapes; ++i) {
    const cv::Point a(at(canvas.cols), at(canvas.rows));
    const cv::Scalar grey(at(256));
    switch (rng() % 3) {
    case 0:
      cv::rectangle(canvas, cv::Rect(a, cv::Size(8 + at(60), 8 + at(60))), grey, cv::FILLED);
      break;
    case 1:
      cv::circle(canvas, a, 4 + at(30), grey, cv::FILLED, cv::LINE_AA);
      break;
    default:
      cv::line(canvas, a, cv::Point(at(canvas.cols), at(canvas.rows)), grey, 1 + at(5), cv::LINE_AA);
    }
  }
}

inline vpPlanarScene::Target poster(std::mt19937_64 &rng)
{
  vpPlanarScene::Target target{Image(300, 300), 0.15, 0.15};
  paint(target.image, 90, rng);
  return target;
}

//! A wall full of shapes.
inline Image wall(std::mt19937_64 &rng)
{
  Image image(480, 640);
  paint(image, 300, rng);
  return image;
}
} // namespace vpPosters

#endif
