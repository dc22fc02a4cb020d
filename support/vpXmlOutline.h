/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpXmlOutline.h
 * \brief Checks an XML text before it is passed to another library, and lists its elements. Not installed.
 */
#ifndef vpXmlOutline_h
#define vpXmlOutline_h

#include <cstddef>
#include <map>
#include <string>
#include <vector>

//! An element of an XML text.
struct vpXmlElement {
  std::string name;                              //!< As written, with a prefix.
  int parent = -1;                               //!< Index of the element around it; -1: the outermost one.
  std::size_t start = 0;                         //!< Its first byte.
  std::size_t afterName = 0;                     //!< The byte after its name, where an attribute can be inserted.
  std::map<std::string, std::string> attributes; //!< By name.
};

/*!
 * Checks an XML text in one pass, without recursion, and lists its elements in their order.
 *
 * The parsers of urdfdom and assimp recurse into nested elements without a bound and continue after some errors, and
 * urdfdom passes texts of the file to printf as a format. So the text must be well-formed, not nested deeper than
 * vpDeepestNesting, and, if \e forPrintf, without `%` in an attribute, except `filename`, which is never part of a
 * message.
 * \throw vpFileError with the line of the error.
 */
std::vector<vpXmlElement> vpReadXmlOutline(const std::string &text, const std::string &file, bool forPrintf = true);

#endif
