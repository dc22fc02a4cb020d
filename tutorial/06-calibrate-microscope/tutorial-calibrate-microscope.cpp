/*! \example tutorial-calibrate-microscope.cpp
 * Scale (pixels per metre) and distortion of a lens from one image of dots of known pitch, rendered unless given.
 * Usage: tutorial-calibrate-microscope [IMAGE PITCH_X_UM PITCH_Y_UM]
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/core/vpFont.h>
#include <visp3/core/vpImageConvert.h>
#include <visp3/core/vpImageDraw.h>
#include <visp3/core/vpImageTools.h>
#include <visp3/io/vpImageIo.h>
#include <visp3/pattern/vpPlanarMicroscopeCalibration.h>
#include <visp3/rendering/vpProductPattern.h>
#include <cmath>
#include <cstdlib>
#include <iostream>

VISP_DIRECT_USING_NAMESPACE

namespace
{
const double scale = 1e6 / 4.5, kappa1 = 5e-8; // rendered image: px/m, px^-2
// 640 x 480 px image of a grid of dots through a lens with barrel distortion: each pixel is the mean of 3 x 3 samples.
vpImage<unsigned char> throughTheLens()
{
  vpProductPatternSpec spec;
  spec.shape = vpProductShape::Dot;
  spec.width = 3 * 672; // undistorted image at three times the resolution, wider than the result
  spec.height = 3 * 512;
  spec.pitchX = spec.pitchY = 3. * scale * 112.5e-6;
  spec.openingX = spec.openingY = 3. * scale * 60e-6;
  spec.rotation = 0.03; // rad
  spec.psf = 2.4;       // px of the fine image
  vpImage<unsigned char> straight, image(480, 640);
  vpProductPattern(spec).render(0., 0., 0., 0., 0, straight);
  for (unsigned int i = 0; i < image.getSize(); ++i) {
    const unsigned int row = i / 640, column = i % 640;
    double sum = 0.;
    for (int k = 0; k < 9; ++k) {
      const double u = column - 319.5 + (k % 3 - 1) / 3., v = row - 239.5 + (k / 3 - 1) / 3.;
      const double factor = 3. * (1. + kappa1 * (u * u + v * v));
      sum += straight.getValue(767.5 + factor * v, 1007.5 + factor * u);
    }
    image.bitmap[i] = static_cast<unsigned char>(vpMath::round(sum / 9.));
  }
  return image;
}
//! [Calibrate]
vpMicroscopeCalibrationResult calibrate(const vpImage<unsigned char> &image, const vpCalibrationPitch &pitch)
{
  vpMicroscopeCalibrationSpec spec;
  spec.sigmaFromResiduals = true; // the accuracy of the dots is unknown for a single image
  vpPlanarMicroscopeCalibration microscope(image.getWidth(), image.getHeight(), spec);
  microscope.addView(vpCalibrationPoints(image, pitch)); // more views of the same microscope improve the result
  return microscope.compute();
}
//! [Calibrate]
void draw(const vpImage<unsigned char> &image, const vpCalibrationPitch &pitch, const vpMicroscopeCalibration &found)
{
  vpImage<vpRGBa> picture;
  vpImageConvert::convert(image, picture);
  for (const vpCalibrationPoint &dot : vpCalibrationPoints(image, pitch)) {
    const double u = dot.u - found.u0, v = dot.v - found.v0, bend = -10. * found.kappa1 * (u * u + v * v);
    const vpImagePoint centre(dot.v, dot.u), shifted(dot.v + bend * v, dot.u + bend * u);
    vpImageDraw::drawLine(picture, centre, shifted, vpColor::red, 2);
    vpImageDraw::drawCross(picture, centre, 7, vpColor::blue);
  }
  const vpRect part(image.getWidth() / 2. - 80., image.getHeight() / 2. - 50., 160., 100.);
  vpImageDraw::drawRectangle(picture, part, vpColor::yellow, false, 3);
  const std::string legend = "Blue: measured. Red: 10 x what the distortion moves the dots. Yellow: small view.";
  vpFont(18).drawText(picture, legend, vpImagePoint(4, 4), vpColor::black, vpColor::white);
  vpImageIo::write(picture, "tutorial-calibrate-microscope.png");
}
} // namespace
int main(int argc, char **argv)
{
  try {
    if (argc != 1 && argc != 4) {
      throw vpException(vpException::badValue, "needs no arguments, or IMAGE PITCH_X_UM PITCH_Y_UM");
    }
    vpImage<unsigned char> image = throughTheLens(), middle;
    vpCalibrationPitch pitch{112.5e-6, 112.5e-6, 0.}; // m, columns and rows
    if (argc == 4) {
      vpImageIo::read(image, argv[1]);
      pitch = {1e-6 * std::atof(argv[2]), 1e-6 * std::atof(argv[3]), 0.};
    }
    const vpMicroscopeCalibrationResult whole = calibrate(image, pitch);
    std::cout << "The whole image. " << whole.message << std::endl;
    draw(image, pitch, whole.calibration);
    vpImageTools::crop(image, image.getHeight() / 2. - 50., image.getWidth() / 2. - 80., 100, 160, middle);
    const vpMicroscopeCalibrationResult part = calibrate(middle, pitch);
    std::cout << "160 x 100 px of it. " << part.message << std::endl;
    const bool isRight = std::fabs(whole.calibration.scaleX / scale - 1.) < 1e-4 &&
                         std::fabs(whole.calibration.kappa1 / kappa1 - 1.) < 0.02;
    return argc == 4 || (isRight && part.kappa1Status == vpKappa1Status::Unobservable) ? EXIT_SUCCESS : EXIT_FAILURE;
  }
  catch (const vpException &e) {
    std::cerr << "tutorial-calibrate-microscope: " << e.getStringMessage() << std::endl;
  }
  return EXIT_FAILURE;
}
