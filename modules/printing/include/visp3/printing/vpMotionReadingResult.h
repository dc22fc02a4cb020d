/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpMotionReadingResult.h
 * \brief Answer of the motion filters to a measurement.
 */
#ifndef vpMotionReadingResult_h
#define vpMotionReadingResult_h

#include <visp3/direct_core/vpDirectCompat.h>

BEGIN_VISP_NAMESPACE

//! \ingroup group_printing
//! \brief What became of a reading. Unless it is Used, Outlier or NoMark, nothing has changed.
enum class vpMotionReadingResult {
  Used,            //!< It counts.
  Outlier,         //!< Beyond the gate.
  TooLate,         //!< It lies before what can still be corrected.
  ImplausibleTime, //!< It lies too far ahead of the reading before it: a broken time stamp, or a gap that needs reset().
  Invalid,         //!< A number is not finite or beyond vpPrintingLargest, or sigma is not > 0.
  NoMark           //!< A displacement before any Mark: it counts as a Mark.
};

END_VISP_NAMESPACE
#endif
