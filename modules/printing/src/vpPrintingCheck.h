/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Checks of specifications, for the constructors of this module.
#ifndef vpPrintingCheck_h
#define vpPrintingCheck_h

#include <visp3/core/vpException.h>

#include <cmath>

BEGIN_VISP_NAMESPACE

namespace vpPrintingCheck
{
inline void require(bool good, const char *field, const char *owner, double value, const char *range)
{
  if (!good) {
    throw vpException(vpException::badValue, "%s of the %s is %g, must be %s", field, owner, value, range);
  }
}
inline void positive(const char *field, const char *owner, double value)
{
  require(value > 0. && std::isfinite(value), field, owner, value, "> 0 and finite");
}
inline void notNegative(const char *field, const char *owner, double value)
{
  require(value >= 0. && std::isfinite(value), field, owner, value, ">= 0 and finite");
}
inline void finite(const char *field, const char *owner, double value)
{
  require(std::isfinite(value), field, owner, value, "finite");
}
} // namespace vpPrintingCheck

END_VISP_NAMESPACE
#endif
