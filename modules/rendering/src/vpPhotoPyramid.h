/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPhotoPyramid.h
 * \brief A photograph on a plane at several resolutions.
 */
#ifndef vpPhotoPyramid_h
#define vpPhotoPyramid_h

#include <visp3/core/vpCameraParameters.h>
#include <visp3/core/vpHomogeneousMatrix.h>
#include <visp3/core/vpImage.h>
#include <visp3/direct_core/vpDirectCompat.h>

#include <vector>

BEGIN_VISP_NAMESPACE

/*!
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

END_VISP_NAMESPACE
#endif
