/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpConfigurationTree.h
 * \brief A tree of configurations in flat arrays, with the nearest one by a scan.
 */
#ifndef vpConfigurationTree_h
#define vpConfigurationTree_h

#include <visp3/avoidance/vpJointPath.h>

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

BEGIN_VISP_NAMESPACE

/*!
 * \brief Configurations, each joined to an earlier one. start() keeps the memory.
 *
 * The nearest is found by looking at all of them in single precision, blocks of nodes side by side: for the few thousand
 * nodes of a search this is faster than a tree for neighbours, which would have to be updated at each node.
 */
class vpConfigurationTree
{
public:
  //! Only the root is left. \param root : n finite numbers.
  void start(const vpJointVector &root);
  //! Adds a node and returns its index. \param parent : Index of the node that it is joined to.
  int add(const vpJointVector &q, int parent);
  //! Index of the nearest node, Euclidean; among those that differ by less than single precision any.
  [[nodiscard]] int nearest(const vpJointVector &q) const noexcept;
  //! The configuration of a node.
  [[nodiscard]] vpJointVector at(int node) const
  {
    return Eigen::Map<const Eigen::VectorXd>(m_nodes.data() + node * m_size, m_size);
  }
  //! Index of the node added last.
  [[nodiscard]] int last() const noexcept { return static_cast<int>(m_parents.size()) - 1; }
  //! Configurations from a node to the root.
  [[nodiscard]] std::vector<vpJointVector> wayToRoot(int node) const;

private:
  static constexpr std::size_t block = 32, firstRoom = 512;

  Eigen::Index m_size = 0; // of a configuration
  std::vector<double> m_nodes;
  std::vector<int> m_parents; // -1: root
  std::vector<float> m_scan;  // by block of nodes, joint, node in the block
};

inline void vpConfigurationTree::start(const vpJointVector &root)
{
  m_size = root.size();
  m_nodes.clear();
  m_parents.clear();
  m_scan.clear();
  m_nodes.reserve(firstRoom * static_cast<std::size_t>(m_size));
  m_scan.reserve(firstRoom * static_cast<std::size_t>(m_size));
  m_parents.reserve(firstRoom);
  add(root, -1);
}

inline int vpConfigurationTree::add(const vpJointVector &q, int parent)
{
  const std::size_t size = static_cast<std::size_t>(m_size), node = m_parents.size(), lane = node % block;
  if (lane == 0) { // the rest of a block is farther than all else
    m_scan.resize(m_scan.size() + block * size, std::numeric_limits<float>::infinity());
  }
  float *place = m_scan.data() + (node - lane) * size + lane;
  for (Eigen::Index i = 0; i < m_size; ++i, place += block) {
    *place = static_cast<float>(q(i));
  }
  m_nodes.insert(m_nodes.end(), q.data(), q.data() + m_size);
  m_parents.push_back(parent);
  return static_cast<int>(node);
}

inline int vpConfigurationTree::nearest(const vpJointVector &q) const noexcept
{
  std::size_t best = 0;
  float least = std::numeric_limits<float>::infinity();
  const float *place = m_scan.data();
  for (std::size_t first = 0; first < m_parents.size(); first += block) {
    std::array<float, block> squares{};
    for (Eigen::Index i = 0; i < m_size; ++i, place += block) {
      const auto x = static_cast<float>(q(i));
      for (std::size_t k = 0; k < block; ++k) {
        squares[k] += (place[k] - x) * (place[k] - x);
      }
    }
    const auto nearest = std::min_element(squares.begin(), squares.end());
    if (*nearest < least) {
      least = *nearest;
      best = first + static_cast<std::size_t>(nearest - squares.begin());
    }
  }
  return static_cast<int>(best);
}

inline std::vector<vpJointVector> vpConfigurationTree::wayToRoot(int node) const
{
  std::vector<vpJointVector> way;
  for (int k = node; k >= 0; k = m_parents[static_cast<std::size_t>(k)]) {
    way.push_back(at(k));
  }
  return way;
}

END_VISP_NAMESPACE
#endif
