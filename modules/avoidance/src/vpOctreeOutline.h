/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpOctreeOutline.h
 * \brief What a file must be before octomap may read it.
 */
#ifndef vpOctreeOutline_h
#define vpOctreeOutline_h

#include <cstddef>
#include <string>

//! What the head of a file of octomap tells.
struct vpOctreeOutline {
  bool binary = false;    //!< .bt: two bits a child; else .ot: values.
  double resolution = 0.; //!< m.
  unsigned long size = 0; //!< Nodes.
  std::size_t data = 0;   //!< Where the nodes begin, byte.
};

/*!
 * Go through the bytes of a file of octomap, .bt or .ot, once, without recursion.
 *
 * octomap recurses into nodes without a bound, reads on beyond the end of a file that is cut off, and tells what it does
 * not like to the terminal. So the tree must have at most 16 levels, all nodes that the head promises and finite values.
 * \throw vpFileError
 */
vpOctreeOutline vpRequireOctree(const std::string &bytes, const std::string &file);

#endif
