/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpXmlOutline.h
 * \brief What a text must be before urdfdom may read it.
 */
#ifndef vpXmlOutline_h
#define vpXmlOutline_h

#include <string>

/*!
 * Go through an XML text once, without recursion.
 *
 * The parser behind urdfdom recurses into nested elements without a bound, goes on after some mistakes, and urdfdom passes
 * texts of the file to printf as a format. So the text must be well-formed, not nested deeper than vpDeepestNesting, and
 * without `%` in an attribute, but for `filename`, which is never part of a message.
 * \throw vpFileError with the line of what is wrong.
 */
void vpRequireXmlOutline(const std::string &text, const std::string &file);

#endif
