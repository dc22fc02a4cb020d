/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpOctomapCells.h"
#include "vpReading.h"

#include <algorithm>
#include <bitset>
#include <cmath>
#include <cstring>
#include <locale>
#include <sstream>
#include <utility>

BEGIN_VISP_NAMESPACE

namespace
{
// Nodes of octomap are recursive, at most 16 levels deep.
struct Occupied {
  const octomap::OcTree *tree;
  bool skipsFree;
  std::vector<vpOctreeCell> cells;

  void visit(const octomap::OcTreeNode *node, const octomap::OcTreeKey &key, unsigned int depth)
  {
    const bool isLeaf = !tree->nodeHasChildren(node);
    if ((isLeaf || skipsFree) && !tree->isNodeOccupied(node)) {
      return;
    }
    if (isLeaf) {
      cells.push_back(
          {{tree->keyToCoord(key[0], depth), tree->keyToCoord(key[1], depth), tree->keyToCoord(key[2], depth)},
           tree->getNodeSize(depth)});
      return;
    }
    const auto offset = static_cast<octomap::key_type>((1U << (tree->getTreeDepth() - 1)) >> (depth + 1));
    for (unsigned int i = 0; i < 8; ++i) {
      if (tree->nodeChildExists(node, i)) {
        octomap::OcTreeKey child;
        octomap::computeChildKey(i, offset, key, child);
        visit(tree->getNodeChild(node, i), child, depth + 1);
      }
    }
  }
};
} // namespace

std::vector<vpOctreeCell> vpOctomapCells(const octomap::OcTree &tree, bool skipsFree)
{
  Occupied occupied{&tree, skipsFree, {}};
  if (tree.getRoot() != nullptr) {
    const auto middle = static_cast<octomap::key_type>(1U << (tree.getTreeDepth() - 1));
    occupied.visit(tree.getRoot(), octomap::OcTreeKey(middle, middle, middle), 0);
  }
  return std::move(occupied.cells);
}

namespace
{
constexpr const char *binaryHead = "# Octomap OcTree binary file";
constexpr const char *fullHead = "# Octomap OcTree file";
constexpr int levels = 16; // levels of octomap's trees

//! Header of an octomap file.
struct vpOctreeOutline {
  bool binary = false;    //!< .bt: two bits per child; else .ot: values.
  double resolution = 0.; //!< Resolution, m.
  unsigned long size = 0; //!< Number of nodes.
  std::size_t data = 0;   //!< Offset of the nodes, bytes.
};

[[noreturn]] void fail(const std::string &file, const std::string &what) { throw vpFileError(file + ": " + what); }

bool begins(const std::string &bytes, const char *mark)
{
  return bytes.compare(0, std::char_traits<char>::length(mark), mark) == 0;
}

vpOctreeOutline readHead(const std::string &bytes, const std::string &file)
{
  vpOctreeOutline head;
  head.binary = begins(bytes, binaryHead);
  if (!head.binary && !begins(bytes, fullHead)) {
    fail(file, "is no octree of octomap");
  }
  std::string id;
  for (std::size_t at = 0; at < bytes.size();) {
    const std::size_t end = std::min(bytes.find('\n', at), bytes.size());
    std::istringstream line(bytes.substr(at, end - at));
    line.imbue(std::locale::classic());
    at = end + 1;
    std::string word;
    line >> word;
    if (word == "data") {
      head.data = std::min(at, bytes.size());
      break;
    }
    if (word == "id") {
      line >> id;
    }
    else if (word == "res" && !(line >> head.resolution)) {
      fail(file, "its resolution is no number");
    }
    else if (word == "size" && !(line >> head.size)) {
      fail(file, "its size is no number");
    }
  }
  if (head.data == 0) {
    fail(file, "is cut off in its head");
  }
  if (id != "OcTree") {
    fail(file, "is a tree of the kind " + vpPrintable(id, 60) + ", must be OcTree");
  }
  if (!std::isfinite(head.resolution) || !(head.resolution > 0.)) {
    std::ostringstream text;
    text << "its resolution is " << head.resolution << " m, must be > 0";
    fail(file, text.str());
  }
  return head;
}

//! Children of a node, and those described by their own nodes.
struct Children {
  unsigned long all = 0, described = 0;
};

// Two bits per child: 01 and 10 are leaves, 11 is described later.
Children binaryNode(const char *record)
{
  Children children;
  for (int byte = 0; byte < 2; ++byte) {
    for (int k = 0; k < 4; ++k) {
      const unsigned int kind = (static_cast<unsigned char>(record[byte]) >> (2 * k)) & 3U;
      children.all += kind != 0 ? 1 : 0;
      children.described += kind == 3 ? 1 : 0;
    }
  }
  return children;
}

// A value and one bit per child; all children are described later.
Children fullNode(const char *record, const std::string &file)
{
  float value = 0.;
  std::memcpy(&value, record, sizeof(value));
  if (!std::isfinite(value)) {
    fail(file, "has a node whose occupancy is not finite");
  }
  const unsigned long count = std::bitset<8>(static_cast<unsigned char>(record[4])).count();
  return {count, count};
}

void requireNodes(const std::string &bytes, const vpOctreeOutline &head, const std::string &file)
{
  const std::size_t record = head.binary ? 2 : 5;
  std::size_t at = head.data;
  unsigned long nodes = head.size > 0 ? 1 : 0;
  // Depths of the pending nodes: the last one is next, as in the file.
  std::vector<int> coming(head.size > 0 ? 1 : 0, 0);
  while (!coming.empty()) {
    const int depth = coming.back();
    coming.pop_back();
    if (at + record > bytes.size()) {
      fail(file, "says " + std::to_string(head.size) + " nodes and is cut off");
    }
    const Children children = head.binary ? binaryNode(bytes.data() + at) : fullNode(bytes.data() + at, file);
    if (children.all > 0 && depth >= levels) {
      fail(file, "has more than " + std::to_string(levels) + " levels");
    }
    if (children.described > 0 && head.binary && depth + 1 >= levels) {
      fail(file, "has more than " + std::to_string(levels) + " levels");
    }
    coming.insert(coming.end(), children.described, depth + 1);
    nodes += children.all;
    at += record;
  }
  if (nodes != head.size) {
    fail(file, "says " + std::to_string(head.size) + " nodes and has " + std::to_string(nodes));
  }
}

/*!
 * Checks the bytes of an octomap file, .bt or .ot, in one pass, without recursion.
 *
 * octomap recurses into nodes without a bound, reads beyond the end of a truncated file, and prints errors to the
 * terminal. So the tree must have at most 16 levels, all nodes announced in the header, and finite values.
 * \throw vpFileError
 */
vpOctreeOutline requireOctree(const std::string &bytes, const std::string &file)
{
  const vpOctreeOutline head = readHead(bytes, file);
  requireNodes(bytes, head, file);
  return head;
}

vpOctree read(const std::string &file)
{
  const std::string bytes = vpReadFileText(file, vpLargestDataFile);
  const vpOctreeOutline outline = requireOctree(bytes, file);
  octomap::OcTree tree(outline.resolution);
  if (outline.size > 0) {
    std::istringstream data(bytes.substr(outline.data));
    outline.binary ? tree.readBinaryData(data) : tree.readData(data);
  }
  return vpOctree(vpOctomapCells(tree, false), file);
}
} // namespace

vpOctree vpOctree::load(const std::string &file)
{
  return vpReading([&] { return read(file); });
}

END_VISP_NAMESPACE
