/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Which cells of a frame count as measured.
#ifndef vpUsableCell_h
#define vpUsableCell_h

#include <visp3/pattern/vpPatternFrame.h>
#include <visp3/printing/vpPrintingLimits.h>

BEGIN_VISP_NAMESPACE

inline bool vpIsUsableCell(const vpPatternCell &cell) noexcept
{
  return cell.valid && vpIsPlausible(cell.x) && vpIsPlausible(cell.y) && vpIsPlausibleDeviation(cell.sigmaX) &&
         vpIsPlausibleDeviation(cell.sigmaY);
}

END_VISP_NAMESPACE
#endif
