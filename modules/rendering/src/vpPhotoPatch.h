/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPhotoPatch.h
 * \brief A photograph on a rectangle in space, pixel by pixel.
 */
#ifndef vpPhotoPatch_h
#define vpPhotoPatch_h

#include "vpPhotoPyramid.h"
#include "vpPlaneOutline.h"

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

/*!
 * Draws a rectangle |x| <= width / 2, |y| <= height / 2, z = 0 with a photograph edge to edge, sampled 2x2 times per
 * pixel. The caller processes each pixel.
 */
class vpPhotoPatch
{
public:
  //! \param photo : At least 8x8 px. \param width, height : Size of the rectangle, m.
  vpPhotoPatch(const vpImage<unsigned char> &photo, double width, double height)
    : m_photo(photo, width, height), m_width(width), m_height(height)
  {}

  /*!
   * \param cMo : Pose of the rectangle. \param camera : Without distortion. \param width, height : Size of the image,
   * px.
   * \param visit : Called for every pixel that the rectangle covers at least partly, as visit(int row, int column, int
   * sum, int samples): number of its four samples on the rectangle, 1 to 4, and the sum of their grey values.
   */
  template <class Visit>
  void draw(const vpHomogeneousMatrix &cMo, const vpCameraParameters &camera, unsigned int width, unsigned int height,
            Visit visit)
  {
    const vpPlaneOutline outline(cMo, m_width, m_height, camera);
    if (outline.empty()) {
      return;
    }
    double left, top, right, bottom;
    outline.box(left, top, right, bottom);
    const double w = width, h = height;
    if (right < -0.5 || bottom < -0.5 || left > w - 0.5 || top > h - 0.5) {
      return;
    }
    // Whole pixels that the object touches.
    const int c0 = static_cast<int>(std::floor(std::clamp(left, 0., w - 1.)));
    const int c1 = static_cast<int>(std::ceil(std::clamp(right, 0., w - 1.)));
    const int r0 = static_cast<int>(std::floor(std::clamp(top, 0., h - 1.)));
    const int r1 = static_cast<int>(std::ceil(std::clamp(bottom, 0., h - 1.)));
    m_fine.resize(2 * (r1 - r0 + 1), 2 * (c1 - c0 + 1));
    // Samples lie at a quarter and three quarters of a pixel: fine = 2 (coarse - first) + 1/2.
    vpCameraParameters fineCamera;
    fineCamera.initPersProjWithoutDistortion(2. * camera.get_px(), 2. * camera.get_py(),
                                             2. * (camera.get_u0() - c0) + 0.5, 2. * (camera.get_v0() - r0) + 0.5);
    m_photo.draw(cMo, fineCamera, 4. * outline.area(), m_fine);
    for (int r = r0; r <= r1; ++r) {
      averageRow(outline, r, r0, c0, c1, visit);
    }
  }

private:
  // One row of the image from its two rows of samples.
  template <class Visit>
  void averageRow(const vpPlaneOutline &outline, int r, int r0, int c0, int c1, Visit &visit) const
  {
    const unsigned char *const rows[2] = {m_fine[2 * (r - r0)], m_fine[2 * (r - r0) + 1]};
    int begin[2] = {0, 0}, end[2] = {0, 0}; // samples on the object
    for (int k = 0; k < 2; ++k) {
      double from, to;
      if (outline.span(r - 0.25 + 0.5 * k, from, to)) {
        const double last = m_fine.getWidth();
        begin[k] = static_cast<int>(std::clamp(std::ceil(2. * (from - c0) + 0.5), 0., last));
        end[k] = static_cast<int>(std::clamp(std::ceil(2. * (to - c0) + 0.5), 0., last));
      }
    }
    for (int c = c0; c <= c1; ++c) {
      int samples = 0, sum = 0;
      for (int k = 0; k < 4; ++k) {
        const int column = 2 * (c - c0) + k % 2;
        if (column >= begin[k / 2] && column < end[k / 2]) {
          sum += rows[k / 2][column];
          ++samples;
        }
      }
      if (samples > 0) {
        visit(r, c, sum, samples);
      }
    }
  }

  vpPhotoPyramid m_photo;
  double m_width, m_height;      // m
  vpImage<unsigned char> m_fine; // the box around the rectangle at twice the resolution
};

END_VISP_NAMESPACE
#endif
