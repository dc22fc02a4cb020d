/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPrintingCheck.h
 * \brief Which numbers the classes of this module accept.
 */
#ifndef vpPrintingCheck_h
#define vpPrintingCheck_h

#include <visp3/core/vpException.h>
#include <visp3/pattern/vpPatternFrame.h>
#include <visp3/printing/vpPrintingLimits.h>

#include <cmath>

BEGIN_VISP_NAMESPACE

// Checks of specifications, for the constructors of this module. Nonzero values have magnitudes from 1e-30 to 1e15, so
// that no step overflows.
namespace vpPrintingCheck
{
inline void require(bool good, const char *field, const char *owner, double value, const char *range)
{
  if (!good) {
    throw vpException(vpException::badValue, "%s of the %s is %g, must be %s", field, owner, value, range);
  }
}
inline bool usual(double value) { return value >= 1e-30 && value <= 1e15; }

inline void positive(const char *field, const char *owner, double value)
{
  require(usual(value), field, owner, value, "> 0 and finite (1e-30 to 1e15)");
}
inline void notNegative(const char *field, const char *owner, double value)
{
  require(value == 0. || usual(value), field, owner, value, ">= 0 and finite (0, or 1e-30 to 1e15)");
}
//! Check of a bound that may be infinite.
inline void bound(const char *field, const char *owner, double value)
{
  require(value >= 1e-30, field, owner, value, "> 0, at least 1e-30 or infinite");
}
inline void place(const char *field, const char *owner, double value)
{
  require(vpIsPlausible(value), field, owner, value, "finite, at most 1e12 in magnitude");
}
} // namespace vpPrintingCheck

// Which cells of a frame count as measured.
inline bool vpIsUsableCell(const vpPatternCell &cell) noexcept
{
  return cell.valid && vpIsPlausible(cell.x) && vpIsPlausible(cell.y) && vpIsPlausibleDeviation(cell.sigmaX) &&
         vpIsPlausibleDeviation(cell.sigmaY);
}

END_VISP_NAMESPACE
#endif
