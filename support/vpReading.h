/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpReading.h
 * \brief Converts errors of readers to the exceptions of the modules. Not installed.
 */
#ifndef vpReading_h
#define vpReading_h

#include "vpFileText.h"

#include <visp3/core/vpException.h>
#include <visp3/direct_core/vpDirectCompat.h>

BEGIN_VISP_NAMESPACE

/*!
 * Returns the result of \e read.
 * \throw vpException with one printable sentence: ioError for an unreadable file, badValue for invalid content, else
 * the code of the vpException that \e read threw.
 */
template <class Read> auto vpReading(Read read) -> decltype(read())
{
  try {
    return read();
  }
  catch (const vpFileError &error) {
    const bool unreadable = error.kind() == vpFileError::Kind::Unreadable;
    throw vpException(unreadable ? vpException::ioError : vpException::badValue, std::string(error.what()));
  }
  catch (const vpException &error) {
    throw vpException(error.getCode(), vpPrintable(error.getStringMessage()));
  }
}

END_VISP_NAMESPACE
#endif
