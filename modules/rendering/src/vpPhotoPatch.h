/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPhotoPatch.h
 * \brief A photograph on a rectangle in space, pixel by pixel, and the wall behind it.
 */
#ifndef vpPhotoPatch_h
#define vpPhotoPatch_h

#include <visp3/core/vpCameraParameters.h>
#include <visp3/core/vpHomogeneousMatrix.h>
#include <visp3/core/vpImage.h>
#include <visp3/direct_core/vpDirectCompat.h>

#include <algorithm>
#include <cmath>
#include <vector>

BEGIN_VISP_NAMESPACE

/*!
 * Image of the rectangle |x| <= width / 2, |y| <= height / 2 in the plane z = 0, clipped just in front of the camera: a
 * convex polygon in pixels, empty if the front side of the rectangle is not visible.
 */
class vpPlaneOutline
{
public:
  vpPlaneOutline(const vpHomogeneousMatrix &cMo, double width, double height, const vpCameraParameters &camera);

  //! True if nothing is visible.
  bool empty() const { return m_u.size() < 3; }
  //! Area of the polygon, px^2, including parts outside the image.
  double area() const;
  //! Smallest box around the polygon, px.
  void box(double &left, double &top, double &right, double &bottom) const;
  /*!
   * Intersection of the polygon with the line of constant \e v, px.
   * \return False if there is none; otherwise the points with left <= u < right are inside.
   */
  bool span(double v, double &left, double &right) const;

private:
  std::vector<double> m_u, m_v;
};

/*!
 * \brief A photograph on a plane at several resolutions.
 *
 * A warp samples the photograph at one point per pixel, which aliases if the photograph is finer than the image. So
 * there are halved copies of it, and draw() uses the one with about the resolution of the image.
 *
 * Not vpImageSimulator, which takes 4 times as long, truncates its interpolated values, maps the centres of the corner
 * pixels instead of their outer edges to the object's corners, and never draws the last row and column of its image. A
 * test compares the two where they must agree.
 */
class vpPhotoPyramid
{
public:
  //! \param photo : At least 8x8 px. \param width, height : Size of the object, m.
  vpPhotoPyramid(const vpImage<unsigned char> &photo, double width, double height);

  /*!
   * Draws into \e image, slightly beyond the photograph's edge; the caller clips that (vpPlaneOutline).
   * \param cMo : Pose of the object, front side visible. \param camera : Intrinsics of \e image, which may be a crop.
   * \param area : Area of the object in \e image, px^2.
   */
  void draw(const vpHomogeneousMatrix &cMo, const vpCameraParameters &camera, double area,
            vpImage<unsigned char> &image) const;

private:
  double m_width, m_height;                     // of the object, m
  unsigned int m_photoWidth, m_photoHeight;     // px
  std::vector<vpImage<unsigned char>> m_levels; // with a margin; a texel of level k is 2^k photograph pixels wide
};

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

//! A wall far behind the object: smooth and faint, so that it neither resembles the object nor offers keypoints.
vpImage<unsigned char> vpFaintWall(unsigned int width, unsigned int height);

END_VISP_NAMESPACE
#endif
