/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpUrdfBodies.h
 * \brief Bodies of an arm from a URDF: shapes, capsules and masses. Not installed.
 */
#ifndef vpUrdfBodies_h
#define vpUrdfBodies_h

#include "vpMeshPath.h"
#include "vpUrdfTree.h"

#include <visp3/manipulator/vpArmSpec.h>

BEGIN_VISP_NAMESPACE

/*!
 * \brief Collects the bodies of an arm while its chain is walked from the base to the tip.
 */
class vpUrdfBodies
{
public:
  /*!
   * \param tree, posture, warnings : Must outlive this. \param paths : Where meshes are. \param chain : Joints between
   * base and tip.
   */
  vpUrdfBodies(const vpUrdfTree &tree, const vpUrdfPosture &posture, const vpMeshPath &paths,
               const std::set<std::string> &chain, vpWarningList &warnings)
    : m_tree(tree), m_posture(posture), m_paths(paths), m_chain(chain), m_warnings(warnings)
  {}
  //! Adds the base, everything that is fixed to it and everything that joints connect with it, except the chain.
  void addBase(const std::string &base);
  //! Begins the next link of the arm; add() then adds bodies to it.
  void nextLink(const std::string &name);
  //! Adds a link of the chain, and everything beside the chain below it. \param at : In the present link of the arm.
  void add(const urdf::Link &link, const vpRigidTransform &at);
  //! Moves links, bodies, shapes, capsules and uncovered bodies to a specification.
  void finish(vpArmSpec &arm);

private:
  struct Part {
    urdf::LinkConstSharedPtr link;
    vpRigidTransform at; // in the link of the arm
    bool moves = false;  // relative to that link
    // A short straight travel, if that is how it moves: all places are within half of the middle, seen from `at`, m.
    bool isShort = false;
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    double half = 0.;
  };
  [[nodiscard]] Part below(const Part &part, const urdf::Joint &joint) const;
  void warnOfMoving(const urdf::Joint &joint) const;
  void addWithBranches(std::vector<Part> parts, const std::string &from);
  void addBody(const Part &part);
  void addMass(const Part &part);
  void addCapsules(const Part &part, const std::vector<vpArmShape> &shapes);
  [[nodiscard]] bool addShape(const urdf::Collision &collision, const Part &part, std::vector<vpArmShape> &shapes);

  const vpUrdfTree &m_tree;
  const vpUrdfPosture &m_posture;
  const vpMeshPath &m_paths;
  std::set<std::string> m_chain;
  vpWarningList &m_warnings;
  std::vector<vpArmLinkSpec> m_links;
  std::vector<bool> m_massUnknown; // of links with a body whose mass or inertia is unknown
  std::vector<vpArmBody> m_bodies;
  std::vector<bool> m_hasShape; // of bodies
  std::vector<vpArmShape> m_shapes;
  std::vector<vpArmCapsule> m_capsules;
  std::vector<std::string> m_uncovered;
};

END_VISP_NAMESPACE
#endif
