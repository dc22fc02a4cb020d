/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpMissingLibrary.h
 * \brief Error of a class that was built without its library.
 */
#ifndef vpMissingLibrary_h
#define vpMissingLibrary_h

#include <visp3/core/vpException.h>
#include <visp3/direct_core/vpDirectCompat.h>

BEGIN_VISP_NAMESPACE

//! \throw vpException (notImplementedError) naming class and library.
[[noreturn]] inline void vpMissingLibrary(const char *what, const char *library)
{
  throw vpException(vpException::notImplementedError, "%s needs %s, which this build of visp-direct is without", what,
                    library);
}

END_VISP_NAMESPACE
#endif
