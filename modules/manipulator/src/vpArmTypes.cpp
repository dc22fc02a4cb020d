/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/manipulator/vpArmTypes.h>

BEGIN_VISP_NAMESPACE

vpHomogeneousMatrix vpRigidTransform::toHomogeneous() const
{
  vpHomogeneousMatrix M;
  for (unsigned int i = 0; i < 3; ++i) {
    for (unsigned int j = 0; j < 3; ++j) {
      M[i][j] = R(i, j);
    }
    M[i][3] = p(i);
  }
  return M;
}

vpRigidTransform vpRigidTransform::fromHomogeneous(const vpHomogeneousMatrix &M)
{
  vpRigidTransform T;
  for (unsigned int i = 0; i < 3; ++i) {
    for (unsigned int j = 0; j < 3; ++j) {
      T.R(i, j) = M[i][j];
    }
    T.p(i) = M[i][3];
  }
  return T;
}

END_VISP_NAMESPACE
