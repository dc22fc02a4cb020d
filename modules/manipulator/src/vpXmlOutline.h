/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpXmlOutline.h
 * \brief Checks an XML text before it is passed to urdfdom.
 */
#ifndef vpXmlOutline_h
#define vpXmlOutline_h

#include <string>

/*!
 * Checks an XML text in one pass, without recursion.
 *
 * The parser of urdfdom recurses into nested elements without a bound and continues after some errors, and urdfdom
 * passes texts of the file to printf as a format. So the text must be well-formed, not nested deeper than
 * vpDeepestNesting, and without `%` in an attribute, except `filename`, which is never part of a message.
 * \throw vpFileError with the line of the error.
 */
void vpRequireXmlOutline(const std::string &text, const std::string &file);

#endif
