/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Checks of specifications with one number per joint, for the constructors of the joint controllers. Numbers are
// bounded so that no step overflows.
#ifndef vpJointCheck_h
#define vpJointCheck_h

#include <visp3/core/vpException.h>
#include <visp3/manipulator/vpArmTypes.h>

#include <cmath>

BEGIN_VISP_NAMESPACE

namespace vpJointCheck
{
inline bool isUsual(double value) { return value >= 1e-12 && value <= vpArmLargest; }
inline void positive(const char *field, const char *owner, double value)
{
  if (!isUsual(value)) {
    throw vpException(vpException::badValue, "%s of the %s is %g, must be > 0 and finite (1e-12 to 1e9)", field, owner,
                      value);
  }
}
inline void size(const char *field, const char *owner, const vpJointVector &vector, int n)
{
  if (vector.size() != n || n < 1) {
    throw vpException(vpException::badValue, "%s of the %s has %d numbers, must have one for each of %d joints", field,
                      owner, static_cast<int>(vector.size()), n);
  }
}
inline void notNegative(const char *field, const char *owner, const vpJointVector &vector, int n)
{
  size(field, owner, vector, n);
  for (int i = 0; i < n; ++i) {
    if (vector(i) != 0. && !isUsual(vector(i))) {
      throw vpException(vpException::badValue,
                        "%s of joint %d of the %s is %g, must be >= 0 and finite (0, or 1e-12 to 1e9)", field, i + 1,
                        owner, vector(i));
    }
  }
}
//! An infinite limit is allowed.
inline void limit(const char *field, const char *owner, const vpJointVector &vector, int n)
{
  size(field, owner, vector, n);
  for (int i = 0; i < n; ++i) {
    if (!(vector(i) >= 1e-12)) {
      throw vpException(vpException::badValue, "%s of joint %d of the %s is %g, must be > 0, at least 1e-12", field,
                        i + 1, owner, vector(i));
    }
  }
}
} // namespace vpJointCheck

END_VISP_NAMESPACE
#endif
