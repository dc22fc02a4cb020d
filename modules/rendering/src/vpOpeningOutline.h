/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpOpeningOutline.h
 * \brief Exact outline of an opening.
 */
#ifndef vpOpeningOutline_h
#define vpOpeningOutline_h

#include "vpOpeningTemplate.h"

BEGIN_VISP_NAMESPACE

/*!
 * \brief An opening about its centre, rotated with the product. A damaged one has two fifths closed on one side.
 */
class vpOpeningOutline
{
public:
  //! \param spec : Valid. \param damage : Which side is closed.
  vpOpeningOutline(const vpProductPatternSpec &spec, vpOpeningDamage damage);

  //! Half the size of the bounding box of the rotated opening along the image's axes, px.
  [[nodiscard]] double halfX() const { return m_halfX; }
  [[nodiscard]] double halfY() const { return m_halfY; }
  //! Open fraction of the square of side \e h around (x, y), px from the centre.
  [[nodiscard]] double coverage(double x, double y, double h) const;

private:
  vpProductShape m_shape;
  double m_a, m_b; // half lengths
  double m_radius; // of the corners
  double m_cos, m_sin;
  double m_left, m_right, m_upper, m_lower; // bounds of the open part, product axes
  double m_halfX, m_halfY;
};

END_VISP_NAMESPACE
#endif
