/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpMeanPoint.h
 * \brief The mean of the visible points as an image feature, with its exact interaction matrix.
 */
#ifndef vpMeanPoint_h
#define vpMeanPoint_h

#include <visp3/feedforward/vpServoMeasurement.h>

#include <Eigen/Core>

BEGIN_VISP_NAMESPACE

/*!
 * The mean of image points is not the image of a point of the object, so the interaction matrix of one point at the
 * mean is only approximate. The mean of the points' interaction matrices is exact, and costs a few sums. Rows: mean x,
 * mean y, mean Z. For a single point these are the textbook rows.
 */
struct vpMeanPoint {
  unsigned int count = 0;         //!< Points visible now and in the goal; if 0, the rest is invalid.
  Eigen::Vector2d xy;             //!< Mean of (x, y) now.
  Eigen::Vector2d goalXy;         //!< Mean of (x, y) of the same points in the goal.
  double Z;                       //!< Mean depth now, m.
  double goalZ;                   //!< Mean depth of the same points in the goal, m.
  Eigen::Matrix<double, 2, 3> Lv; //!< (x, y)' = Lv v + Lw w.
  Eigen::Matrix<double, 2, 3> Lw;
  Eigen::RowVector3d depthLw; //!< Z' = -vz + depthLw w.

  vpMeanPoint(const std::vector<vpServoPoint> &points, const std::vector<vpServoPoint> &goal)
    : xy(0., 0.), goalXy(0., 0.), Z(0.), goalZ(0.), Lv(Eigen::Matrix<double, 2, 3>::Zero()),
      Lw(Eigen::Matrix<double, 2, 3>::Zero()), depthLw(0., 0., 0.)
  {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const vpServoPoint &p = points[i], &g = goal[i];
      if (!p.visible || !g.visible) {
        continue;
      }
      ++count;
      xy += Eigen::Vector2d(p.x, p.y);
      goalXy += Eigen::Vector2d(g.x, g.y);
      Z += p.Z;
      goalZ += g.Z;
      const double inverseZ = 1. / p.Z;
      Lv(0, 0) -= inverseZ;
      Lv(0, 2) += p.x * inverseZ;
      Lv(1, 2) += p.y * inverseZ;
      Lw(0, 0) += p.x * p.y;
      Lw(0, 1) -= 1. + p.x * p.x;
      Lw(1, 0) += 1. + p.y * p.y;
      depthLw.x() -= p.y * p.Z;
      depthLw.y() += p.x * p.Z;
    }
    if (count == 0) {
      return;
    }
    Lv(1, 1) = Lv(0, 0);
    Lw(1, 1) = -Lw(0, 0);
    Lw(0, 2) = xy.y();
    Lw(1, 2) = -xy.x();
    const double share = 1. / count;
    xy *= share;
    goalXy *= share;
    Z *= share;
    goalZ *= share;
    Lv *= share;
    Lw *= share;
    depthLw *= share;
  }
};

END_VISP_NAMESPACE
#endif
