/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPlaneOutline.h
 * \brief The part of an image that a rectangle in space covers.
 */
#ifndef vpPlaneOutline_h
#define vpPlaneOutline_h

#include <visp3/core/vpCameraParameters.h>
#include <visp3/core/vpHomogeneousMatrix.h>
#include <visp3/direct_core/vpDirectCompat.h>

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

END_VISP_NAMESPACE
#endif
