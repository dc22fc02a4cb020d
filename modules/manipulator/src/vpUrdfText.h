/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpUrdfText.h
 * \brief Prepares the text of a URDF for urdfdom, which refuses more than it has to. Not installed.
 */
#ifndef vpUrdfText_h
#define vpUrdfText_h

#include "vpWarningList.h"

#include <map>
#include <string>
#include <vector>

//! Which limits of a joint a URDF gives; the format sets the others to 0.
struct vpUrdfGiven {
  bool lower = false, upper = false, softLower = false, softUpper = false;
};

//! A URDF that urdfdom accepts, and what the changed text does not show any more.
struct vpUrdfText {
  std::string text;                         //!< With a name, one root, and effort and velocity of each limit.
  std::vector<std::string> roots;           //!< Links that are no child of a joint.
  std::string joinedRoot;                   //!< Link added above several roots; empty if there is one.
  std::map<std::string, vpUrdfGiven> given; //!< By joint.
};

/*!
 * Completes a URDF: the name of the robot by that of the file, a missing effort or velocity limit by 0 (unknown), and
 * several roots by a link above them.
 * \throw vpFileError if the text is malformed (vpReadXmlOutline()) or written in xacro.
 */
vpUrdfText vpPrepareUrdf(const std::string &text, const std::string &file, vpWarningList &warnings);

#endif
