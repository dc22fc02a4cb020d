/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpSrdf.h
 * \brief Reads SRDF files, MoveIt's semantic description of a robot.
 */
#ifndef vpSrdf_h
#define vpSrdf_h

#include <visp3/core/vpConfig.h>
#include <visp3/direct_core/vpDirectCompat.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_manipulator
 * \brief Pair of links that is not checked for collisions (`disable_collisions`).
 */
struct VISP_EXPORT vpSrdfPair {
  std::string first;  //!< link1.
  std::string second; //!< link2.
  std::string reason; //!< As written ("Adjacent", "Never", ...); may be empty.
};

/*!
 * \ingroup group_manipulator
 * \brief Named part of a robot (`group`).
 */
struct VISP_EXPORT vpSrdfGroup {
  std::string name;                                        //!< Name.
  std::vector<std::string> links;                          //!< Links; each stands for the joint above it.
  std::vector<std::string> joints;                         //!< Joints.
  std::vector<std::string> groups;                         //!< Other groups that belong to it.
  std::vector<std::pair<std::string, std::string>> chains; //!< First (base) and last (tip) link of each chain.
};

/*!
 * \ingroup group_manipulator
 * \brief Named configuration of a group (`group_state`).
 */
struct VISP_EXPORT vpSrdfState {
  std::string name;                     //!< Name, unique only within the group.
  std::string group;                    //!< Its group; may be empty.
  std::map<std::string, double> joints; //!< Coordinate by joint, rad or m; joints with several numbers are left out.
};

/*!
 * \ingroup group_manipulator
 * \brief Content of an SRDF file, in its order.
 */
struct VISP_EXPORT vpSrdf {
  std::string robot;                //!< Name of the robot; may be empty.
  std::vector<vpSrdfPair> disabled; //!< Pairs that are not checked.
  std::vector<vpSrdfGroup> groups;  //!< Groups.
  std::vector<vpSrdfState> states;  //!< Named configurations.
};

/*!
 * \ingroup group_manipulator
 * \brief Reads an SRDF file. Whether its links and joints exist is not checked: vpLoadArmUrdf() does.
 *
 * Other elements (virtual and passive joints, end effectors, spheres) are not used. `disable_default_collisions` is not
 * used either: more pairs are checked than it asks for.
 *
 * \code
 * const vpSrdf srdf = vpLoadSrdf("robot.srdf");
 * for (const vpSrdfState &state : srdf.states) {
 *   std::cout << state.name << " of " << state.group << ": " << state.joints.size() << " joints" << std::endl;
 * }
 * \endcode
 * \throw vpException (ioError) if the file cannot be read, (badValue) if it is malformed, its outermost element is not
 * `robot`, a name is missing or a coordinate is no finite number; one sentence with the file and the line.
 */
[[nodiscard]] VISP_EXPORT vpSrdf vpLoadSrdf(const std::string &file);

END_VISP_NAMESPACE
#endif
