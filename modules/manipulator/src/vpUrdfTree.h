/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpUrdfTree.h
 * \brief Links and joints of a URDF file, and which of the joints stand still. Not installed.
 */
#ifndef vpUrdfTree_h
#define vpUrdfTree_h

#include "vpUrdfText.h"

#include <visp3/manipulator/vpArmTypes.h>

#include <urdf_model/model.h>
#include <urdf_world/types.h>

#include <optional>
#include <set>

BEGIN_VISP_NAMESPACE

//! Throws a vpFileError: the file and a sentence.
[[noreturn]] void vpUrdfFail(const std::string &file, const std::string &sentence);
//! "a, b, c"; of many names the first 20.
std::string vpListed(const std::vector<std::string> &names);
//! A pose of urdfdom.
vpRigidTransform vpUrdfPose(const urdf::Pose &from);

/*!
 * \brief A URDF that is a tree: every link but the root is the child of one joint.
 */
struct vpUrdfTree {
  std::string file;
  urdf::ModelInterfaceSharedPtr model;
  std::string joinedRoot;                   //!< Link added above several roots; empty if there is one.
  std::map<std::string, vpUrdfGiven> given; //!< Which limits the file gives, by joint.

  /*!
   * Reads a file.
   * \throw vpFileError if it cannot be read, is malformed, written in xacro, or no tree.
   */
  static vpUrdfTree read(const std::string &file, vpWarningList &warnings);
  //! \param field : Name of the field of vpArmUrdfSpec with the value \e name; empty: nothing is required.
  //! \throw vpFileError naming the field and the links if there is none of this name.
  void requireLink(const char *field, const std::string &name) const;
  //! A link by its name. \throw vpFileError if there is none.
  [[nodiscard]] urdf::LinkConstSharedPtr link(const std::string &name) const;
  //! The joint above a link, also if that is the base; null: none, or one that was added to join the roots.
  [[nodiscard]] urdf::JointConstSharedPtr above(const urdf::Link &link) const;
  //! Joints from a link down to another one, in this order. \throw vpFileError if that is not below.
  [[nodiscard]] std::vector<urdf::JointConstSharedPtr> path(const std::string &base, const std::string &tip) const;
};

/*!
 * \brief Which joints stand still, and where: fixed ones, those that the caller holds, and those that mimic one of
 * them.
 */
class vpUrdfPosture
{
public:
  //! \param tree : Must outlive this. \param held : Coordinates of joints that stand still, rad or m.
  //! \throw vpFileError if a joint does not exist, is beyond its limits or cannot be held by one number.
  vpUrdfPosture(const vpUrdfTree &tree, const std::map<std::string, double> &held);
  //! Lets all other joints stand still at home(), except those of the chain and what mimics them.
  //! \param chain : Joints of the chain. \param state : Coordinates of joints at home, rad or m.
  void holdOthers(const std::set<std::string> &chain, const std::map<std::string, double> &state);
  //! Where a joint stands still, rad or m; none: it moves.
  [[nodiscard]] std::optional<double> stands(const urdf::Joint &joint) const;
  //! A coordinate within the limits: that of the state, else 0 or the limit next to it.
  [[nodiscard]] double home(const urdf::Joint &joint) const;
  //! The joint whose coordinate decides on that of a joint: the joint itself, or what it mimics in the end.
  //! \param ratio, offset : Receive the coordinate of \e joint as ratio * leader + offset.
  [[nodiscard]] const urdf::Joint &leader(const urdf::Joint &joint, double &ratio, double &offset) const;
  //! Frame of the child link in the parent link where the joint stands, else at home.
  [[nodiscard]] vpRigidTransform frame(const urdf::Joint &joint) const;

private:
  [[nodiscard]] std::optional<double> standsAlone(const urdf::Joint &joint) const;

  const vpUrdfTree &m_tree;
  std::map<std::string, double> m_held, m_state;
  bool m_holdsOthers = false;
  std::set<std::string> m_chain;
};

END_VISP_NAMESPACE
#endif
