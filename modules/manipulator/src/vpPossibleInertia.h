/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPossibleInertia.h
 * \brief Which matrices are the inertia of a body. Not installed.
 */
#ifndef vpPossibleInertia_h
#define vpPossibleInertia_h

#include <Eigen/Eigenvalues>

/*!
 * True if a matrix is symmetric with principal moments >= 0 of which none exceeds the sum of the others, within 1e-9
 * kg m^2 and 1e-9 of the largest. False for NaN.
 * \param inertia : About the centre of mass, kg m^2. \param moments : Receives the principal moments, ascending.
 */
inline bool vpIsPossibleInertia(const Eigen::Matrix3d &inertia, Eigen::Vector3d &moments)
{
  moments = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(inertia).eigenvalues();
  const double slack = 1e-9 * (1. + moments.cwiseAbs().maxCoeff());
  return (inertia - inertia.transpose()).cwiseAbs().maxCoeff() <= slack && moments(0) >= -slack &&
         moments(0) + moments(1) >= moments(2) - slack;
}

#endif
