/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpMotionReadingResult.h
 * \brief Result of adding a measurement to a motion filter.
 */
#ifndef vpMotionReadingResult_h
#define vpMotionReadingResult_h

#include <visp3/direct_core/vpDirectCompat.h>

BEGIN_VISP_NAMESPACE

//! \ingroup group_printing
//! \brief Result for a reading. Unless it is Used, Outlier or NoMark, nothing has changed.
enum class vpMotionReadingResult {
  Used,            //!< Used.
  Outlier,         //!< Rejected: beyond the gate.
  TooLate,         //!< Earlier than the filter can still correct.
  ImplausibleTime, //!< Too far ahead of the previous reading: a wrong time stamp, or a gap that needs reset().
  Invalid,         //!< A number is not finite or beyond vpPrintingLargest, or sigma is not > 0.
  NoMark           //!< A displacement before any Mark: used as a Mark.
};

END_VISP_NAMESPACE
#endif
