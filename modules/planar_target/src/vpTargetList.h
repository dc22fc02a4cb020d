/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpTargetList.h
 * \brief Internal: a folder of reference photographs and its targets.json.
 */
#ifndef vpTargetList_h
#define vpTargetList_h

#include <visp3/core/vpImage.h>
#include <visp3/direct_core/vpDirectCompat.h>

#include <optional>
#include <string>
#include <vector>

BEGIN_VISP_NAMESPACE

//! One entry of targets.json.
struct vpTargetListEntry {
  std::string name;
  std::string file; //!< including the folder
  double width;     //!< m
  std::optional<double> height;
  double depth = 0.; //!< m; 0: not given
};

//! \throw vpException (ioError, badValue) naming the file, the field and its value, or an unlisted photograph.
std::vector<vpTargetListEntry> readTargetList(const std::string &folder);
//! Read a photograph as grey values. \throw vpException (ioError) naming the file.
void readReference(const std::string &file, vpImage<unsigned char> &reference);

END_VISP_NAMESPACE
#endif
