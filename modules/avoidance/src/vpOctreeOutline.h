/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpOctreeOutline.h
 * \brief Checks a file before it is passed to octomap.
 */
#ifndef vpOctreeOutline_h
#define vpOctreeOutline_h

#include <cstddef>
#include <string>

//! Header of an octomap file.
struct vpOctreeOutline {
  bool binary = false;    //!< .bt: two bits per child; else .ot: values.
  double resolution = 0.; //!< Resolution, m.
  unsigned long size = 0; //!< Number of nodes.
  std::size_t data = 0;   //!< Offset of the nodes, bytes.
};

/*!
 * Checks the bytes of an octomap file, .bt or .ot, in one pass, without recursion.
 *
 * octomap recurses into nodes without a bound, reads beyond the end of a truncated file, and prints errors to the
 * terminal. So the tree must have at most 16 levels, all nodes announced in the header, and finite values.
 * \throw vpFileError
 */
vpOctreeOutline vpRequireOctree(const std::string &bytes, const std::string &file);

#endif
